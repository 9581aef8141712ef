#pragma once

#include <cstddef>
#include <memory>

#include "motion/graph/optimise.hpp"

namespace sketchloc {

struct IncrementalParams {
  std::size_t neighbourhood = 100;  ///< vertices around a new edge that are moved at once, > 0
  /// Cost that the poses around such a neighbourhood could still save, by the linear model, added
  /// up since the last batch, at which the whole graph is moved, > 0.
  double most_strain = 20.0;
  /// The whole graph is moved too where its loop closures have grown by this share, > 0.
  double most_growth = 0.02;
  int local_iterations = 3;  ///< > 0
  int batch_iterations = 2;  ///< of the whole graph, > 0
  RobustKernel kernel = {};  ///< of edges that may be wrong; not graduated
};
void validate(const IncrementalParams& params);

template <typename Visitor>
void visit_fields(IncrementalParams& params, Visitor&& visit) {
  visit("neighbourhood", params.neighbourhood);
  visit("most_strain", params.most_strain);
  visit("most_growth", params.most_growth);
  visit("local_iterations", params.local_iterations);
  visit("batch_iterations", params.batch_iterations);
  visit("kernel", params.kernel);
}

/// Smooths a graph that grows by poses and edges. It is no exact incremental factorization: an
/// update moves the poses around the new edges and holds the rest; what that leaves unsaid is added
/// up, and from time to time the whole graph is moved from where it stands. Between such batches
/// far poses lag behind the optimum; finish() ends at it.
class IncrementalSmoother {
 public:
  /// Throws std::invalid_argument for the graduated kernel, which needs the whole graph.
  explicit IncrementalSmoother(const IncrementalParams& params = {});
  ~IncrementalSmoother();
  IncrementalSmoother(IncrementalSmoother&& other) noexcept;
  IncrementalSmoother& operator=(IncrementalSmoother&& other) noexcept;

  /// Vertices are numbered from 0 on in the order in which they come. The first edge to an older
  /// vertex places a vertex, whatever its pose says; without one that stands.
  std::size_t add(const GraphVertex& vertex);
  void add(const GraphEdge& edge);

  enum class Update {
    Nothing,  ///< the new edges agree with where the poses are
    Local,
    Batch,
  };
  Update update();
  /// Moves the whole graph until it stands still.
  OptimiseResult::Status finish();

  const PoseGraph& graph() const;  ///< with the poses as they are estimated now

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sketchloc
