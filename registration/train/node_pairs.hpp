#pragma once

#include <cstdint>

#include "registration/train/place_batch.hpp"
#include "registration/train/sample_source.hpp"

namespace sketchloc {

/// How the comparator's pairs are made. [Topo20]
struct NodePairParams {
  double shortest_m = 1.5;      ///< of a node, > 0
  double longest_m = 7.0;       ///< >= shortest_m
  double across_same_m = 0.5;   ///< two passes of one place are off by up to this, > 0
  double along_same_m = 1.0;    ///< the same of their ends, >= 0
  double across_least_m = 1.5;  ///< other places are at least so far off, > across_same_m
  double across_most_m = 14.5;  ///< and at most so far, >= across_least_m
  int batch = 256;              ///< >= 1
};

template <typename Visitor>
void visit_fields(NodePairParams& params, Visitor&& visit) {
  visit("shortest_m", params.shortest_m);
  visit("longest_m", params.longest_m);
  visit("across_same_m", params.across_same_m);
  visit("along_same_m", params.along_same_m);
  visit("across_least_m", params.across_least_m);
  visit("across_most_m", params.across_most_m);
  visit("batch", params.batch);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NodePairParams& params);

/// Pairs of nodes, half of them of one place. A batch is a function of seed, split and number.
PlaceBatch node_pairs(const NodePairParams& params, SampleSplit split, std::uint64_t seed,
                      std::uint64_t number);

}  // namespace sketchloc
