#include "planning/random_tree.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <memory>

#include "motion/check.hpp"
#include "motion/random.hpp"

namespace sketchloc {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Plane = ob::RealVectorStateSpace;

Eigen::Vector2d point_of(const ob::State* state) {
  const double* values = state->as<Plane::StateType>()->values;
  return {values[0], values[1]};
}

void set_point(ob::State* state, const Eigen::Vector2d& point) {
  double* values = state->as<Plane::StateType>()->values;
  values[0] = point.x();
  values[1] = point.y();
}

/// Exact: OMPL's own looks at points a step apart, between which a thin stroke may lie.
class ExactMotion : public ob::MotionValidator {
 public:
  ExactMotion(const ob::SpaceInformationPtr& information, const FreeSpace& space)
      : ob::MotionValidator(information), space_(space) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return space_.is_free(point_of(from), point_of(to));
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    return checkMotion(from, to);
  }

 private:
  const FreeSpace& space_;
};

/// Draws from an engine of its own: OMPL's engines are seeded by how many were made before.
class SeededSampler : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* plane, std::uint64_t seed, std::uint64_t sampler)
      : ob::StateSampler(plane), rng_(make_rng(seed, sampler)) {
    const ob::RealVectorBounds& bounds = plane->as<Plane>()->getBounds();
    high_ = {bounds.high[0], bounds.high[1]};
  }

  void sampleUniform(ob::State* state) override {
    const double x = uniform(0.0, high_.x(), rng_);
    set_point(state, {x, uniform(0.0, high_.y(), rng_)});
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    sampleGaussian(state, near, distance);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double sigma) override {
    const Eigen::Vector2d centre = point_of(mean);
    const double x = gaussian(sigma, rng_);
    set_point(state, centre + Eigen::Vector2d(x, gaussian(sigma, rng_)));
    space_->enforceBounds(state);
  }

 private:
  Rng rng_;
  Eigen::Vector2d high_;
};

ob::StateSpacePtr plane_of(const FreeSpace& space, std::uint64_t seed) {
  const auto plane = std::make_shared<Plane>(2);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0.0);
  bounds.setHigh(0, space.width_px());
  bounds.setHigh(1, space.height_px());
  plane->setBounds(bounds);
  plane->setStateSamplerAllocator(
      [seed, made = std::uint64_t{0}](const ob::StateSpace* of) mutable -> ob::StateSamplerPtr {
        return std::make_shared<SeededSampler>(of, seed, made++);
      });
  return plane;
}

ob::SpaceInformationPtr information_of(const FreeSpace& space, std::uint64_t seed) {
  const auto information = std::make_shared<ob::SpaceInformation>(plane_of(space, seed));
  information->setStateValidityChecker(
      [&space](const ob::State* state) { return space.is_free(point_of(state)); });
  information->setMotionValidator(std::make_shared<ExactMotion>(information, space));
  information->setup();
  return information;
}

ob::ProblemDefinitionPtr problem_of(const ob::SpaceInformationPtr& information,
                                    const Eigen::Vector2d& start_in_sketch,
                                    const Eigen::Vector2d& goal_in_sketch) {
  ob::ScopedState<Plane> start(information);
  ob::ScopedState<Plane> goal(information);
  set_point(start.get(), start_in_sketch);
  set_point(goal.get(), goal_in_sketch);
  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  problem->setStartAndGoalStates(start, goal);
  return problem;
}

}  // namespace

std::optional<PathPoints> connect_trees(const FreeSpace& space,
                                        const Eigen::Vector2d& start_in_sketch,
                                        const Eigen::Vector2d& goal_in_sketch, int most_nodes,
                                        std::uint64_t seed) {
  check(space.is_free(start_in_sketch) && space.is_free(goal_in_sketch), "both ends are free");
  ompl::msg::noOutputHandler();
  const ob::SpaceInformationPtr information = information_of(space, seed);
  const ob::ProblemDefinitionPtr problem = problem_of(information, start_in_sketch, goal_in_sketch);
  og::RRTConnect trees(information);
  trees.setNearestNeighbors<ompl::NearestNeighborsLinear>();  // the quickest for so few, no draws
  trees.setRange(0.15 * std::hypot(space.width_px(), space.height_px()));
  trees.setProblemDefinition(problem);
  trees.setup();
  int tries = 0;
  trees.solve(ob::PlannerTerminationCondition([&] { return ++tries > most_nodes; }));
  auto* found =
      problem->hasExactSolution() ? problem->getSolutionPath()->as<og::PathGeometric>() : nullptr;
  if (found == nullptr) {
    return std::nullopt;
  }
  PathPoints path_in_sketch;
  for (const ob::State* state : found->getStates()) {
    path_in_sketch.push_back(point_of(state));
  }
  return path_in_sketch;
}

}  // namespace sketchloc
