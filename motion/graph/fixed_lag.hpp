#pragma once

#include <cstddef>
#include <memory>

#include "motion/graph/optimise.hpp"

namespace sketchloc {

struct FixedLagParams {
  std::size_t lag = 50;      ///< vertices that are still moved, > 0
  int most_iterations = 5;   ///< per update, > 0
  RobustKernel kernel = {};  ///< of edges that may be wrong; not graduated
};
void validate(const FixedLagParams& params);

template <typename Visitor>
void visit_fields(FixedLagParams& params, Visitor&& visit) {
  visit("lag", params.lag);
  visit("most_iterations", params.most_iterations);
  visit("kernel", params.kernel);
}

/// Smooths the last poses of a graph that grows. What older ones say about them stays, as a joint
/// Gaussian (Schur complement at the last estimate): for linear measurements the answer is that of
/// the whole graph.
class FixedLagSmoother {
 public:
  /// Throws std::invalid_argument for the graduated kernel, which needs the whole graph.
  explicit FixedLagSmoother(const FixedLagParams& params = {});
  ~FixedLagSmoother();
  FixedLagSmoother(FixedLagSmoother&& other) noexcept;
  FixedLagSmoother& operator=(FixedLagSmoother&& other) noexcept;

  /// Vertices are numbered from 0 on in the order in which they come. One that `stays` never leaves
  /// the lag, such as the place of a drawing.
  std::size_t add(const GraphVertex& vertex, bool stays = false);
  /// False, and nothing is done, where a vertex of it has left the lag.
  bool add(const GraphEdge& edge);

  /// Moves the vertices in the lag, then lets the oldest ones beyond it go.
  OptimiseResult::Status update();

  /// The last estimate; of vertices that have left, when they did.
  const GraphPose& pose(std::size_t vertex) const;
  /// Vertices in the lag.
  std::size_t moving() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sketchloc
