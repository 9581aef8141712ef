#include "motion/graph/incremental.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>
#include <vector>

#include "motion/graph/detail/descent.hpp"
#include "motion/graph/detail/neighbourhood.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using detail::Descent;
using detail::EdgeWeighting;
using detail::LinkedGraph;
using detail::NormalEquations;

/// Below it a new edge tells nothing that the poses do not show.
constexpr double kAgreement = 1e-9;

/// What the vertices around a neighbourhood could save by moving, each on its own, by the linear
/// model: g^T H^-1 g.
double strain_around(const LinkedGraph::Part& part, const EdgeWeighting& weighting) {
  PoseGraph freed = part.graph;
  std::vector<bool> held(freed.vertices.size(), true);
  for (std::size_t i = part.moving; i < freed.vertices.size(); ++i) {
    held[i] = false;
  }
  NormalEquations equations(freed, held);
  equations.linearise(detail::poses_of(freed), weighting);
  double strain = 0.0;
  for (std::size_t i = part.moving; i < freed.vertices.size(); ++i) {
    const int size = equations.unknowns().size_of(i);
    const auto slot = equations.unknowns().slot(i, i);
    Eigen::MatrixXd block(size, size);
    for (int column = 0; column < size; ++column) {
      for (int row = column; row < size; ++row) {
        block(row, column) = block(column, row) =
            equations.values()[static_cast<std::size_t>(slot.at(row, column))];
      }
    }
    const Eigen::VectorXd gradient =
        equations.gradient().segment(equations.unknowns().offset(i), size);
    strain += std::max(0.0, gradient.dot(block.ldlt().solve(gradient)));
  }
  return strain;
}

}  // namespace

void validate(const IncrementalParams& params) {
  require_at_least("neighbourhood", static_cast<double>(params.neighbourhood), 1.0);
  require_above("most_strain", params.most_strain, 0.0);
  require_above("most_growth", params.most_growth, 0.0);
  require_at_least("local_iterations", params.local_iterations, 1.0);
  require_at_least("batch_iterations", params.batch_iterations, 1.0);
  validate_part("kernel", params.kernel);
}

struct IncrementalSmoother::State {
  IncrementalParams params;
  LinkedGraph linked;
  std::vector<std::size_t> fresh;  ///< edges since the last update
  std::vector<bool> is_placed;     ///< vertices that an edge has placed
  std::size_t loops = 0;           ///< edges that closed one
  std::size_t loops_at_batch = 0;
  double strain = 0.0;  ///< since the last batch

  const PoseGraph& graph() const { return linked.graph(); }
  bool place_by(const GraphEdge& edge);
  double fresh_chi2() const;
  OptimiseResult::Status move_all(int most_iterations);
  void move_around();
};

IncrementalSmoother::IncrementalSmoother(const IncrementalParams& params)
    : state_(std::make_unique<State>()) {
  validate(params);
  require_no_graduation(params.kernel);
  state_->params = params;
}
IncrementalSmoother::~IncrementalSmoother() = default;
IncrementalSmoother::IncrementalSmoother(IncrementalSmoother&& other) noexcept = default;
IncrementalSmoother& IncrementalSmoother::operator=(IncrementalSmoother&& other) noexcept = default;

std::size_t IncrementalSmoother::add(const GraphVertex& vertex) {
  state_->is_placed.push_back(vertex.is_fixed || state_->is_placed.empty());
  return state_->linked.add(vertex);
}

void IncrementalSmoother::add(const GraphEdge& edge) {
  state_->fresh.push_back(state_->linked.add(edge));
  if (!state_->place_by(edge)) {
    ++state_->loops;
  }
}

/// Places a vertex that nothing has placed yet; false where both are.
bool IncrementalSmoother::State::place_by(const GraphEdge& edge) {
  const bool is_relative = edge.kind == EdgeKind::Between;
  if (!is_relative || is_placed[edge.first] == is_placed[edge.second]) {
    return false;
  }
  const auto& vertices = graph().vertices;
  if (is_placed[edge.first]) {
    linked.move(edge.second, compose(vertices[edge.first].frame_from_body, edge.measured));
  } else {
    linked.move(edge.first, compose(vertices[edge.second].frame_from_body,
                                    between(edge.measured, GraphPose{})));
  }
  is_placed[edge.first] = is_placed[edge.second] = true;
  return true;
}

double IncrementalSmoother::State::fresh_chi2() const {
  double sum = 0.0;
  for (const std::size_t index : fresh) {
    const GraphEdge& edge = graph().edges[index];
    const Eigen::Vector4d error =
        error_of(edge, detail::turned(graph().vertices[edge.first].frame_from_body),
                 detail::turned(graph().vertices[edge.second].frame_from_body));
    sum += error.dot(detail::turned_information(edge) * error);
  }
  return sum;
}

OptimiseResult::Status IncrementalSmoother::State::move_all(int most_iterations) {
  strain = 0.0;
  loops_at_batch = loops;
  NormalEquations equations(graph(), detail::held_vertices(graph()));
  if (equations.unknowns().size() == 0) {
    return OptimiseResult::Status::Converged;
  }
  Descent descent(equations, detail::poses_of(graph()), OptimiseParams{});
  const OptimiseResult::Status status = descent.run({.kernel = params.kernel}, most_iterations);
  linked.place(descent.poses());
  return status;
}

void IncrementalSmoother::State::move_around() {
  std::vector<std::size_t> seeds;
  for (const std::size_t edge : fresh) {
    seeds.push_back(graph().edges[edge].first);
    seeds.push_back(graph().edges[edge].second);
  }
  LinkedGraph::Part part = linked.around(seeds, params.neighbourhood);
  NormalEquations equations(part.graph, detail::held_vertices(part.graph));
  if (equations.unknowns().size() == 0) {
    return;
  }
  Descent descent(equations, detail::poses_of(part.graph), OptimiseParams{});
  descent.run({.kernel = params.kernel}, params.local_iterations);
  for (std::size_t i = 0; i < part.moving; ++i) {
    part.graph.vertices[i].frame_from_body = descent.poses()[i];
    linked.move(part.vertices[i], descent.poses()[i]);
  }
  strain += strain_around(part, {.kernel = params.kernel});
}

IncrementalSmoother::Update IncrementalSmoother::update() {
  State& state = *state_;
  const bool agrees = state.fresh_chi2() < kAgreement;
  Update update = Update::Nothing;
  if (!agrees) {
    update = Update::Local;
    state.move_around();
    const double grown = static_cast<double>(state.loops - state.loops_at_batch) /
                         static_cast<double>(std::max<std::size_t>(state.loops, 1));
    if (state.strain > state.params.most_strain || grown > state.params.most_growth) {
      update = Update::Batch;
      state.move_all(state.params.batch_iterations);
    }
  }
  state.fresh.clear();
  return update;
}

OptimiseResult::Status IncrementalSmoother::finish() {
  state_->fresh.clear();
  return state_->move_all(OptimiseParams{}.most_iterations);
}

const PoseGraph& IncrementalSmoother::graph() const { return state_->linked.graph(); }

}  // namespace sketchloc
