#include "registration/train/node_pairs.hpp"

#include <utility>

#include "motion/random.hpp"
#include "motion/validate.hpp"
#include "topology/place_comparator.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kPurpose = 2;  ///< scenes and samples have 0 and 1

struct Interval {
  double low_m = 0.0;
  double high_m = 0.0;
};

/// A node along x at a distance from the axis.
NodeEnds node_at(const Interval& along, double across_m) {
  return {.from_in_manhattan = {along.low_m, across_m},
          .to_in_manhattan = {along.high_m, across_m}};
}

/// The same turned onto the other axis.
NodeEnds turned(const NodeEnds& node) {
  return {.from_in_manhattan = node.from_in_manhattan.reverse(),
          .to_in_manhattan = node.to_in_manhattan.reverse()};
}

NodeEndsPair draw_pair(const NodePairParams& params, bool same, Rng& rng) {
  const auto jitter_m = [&] { return uniform(-params.along_same_m, params.along_same_m, rng); };
  const double length_m = uniform(params.shortest_m, params.longest_m, rng);
  const double sign = uniform(rng) < 0.5 ? -1.0 : 1.0;
  const double across_m = same ? uniform(0.0, params.across_same_m, rng)
                               : uniform(params.across_least_m, params.across_most_m, rng);
  const NodeEndsPair pair = {
      .first = node_at({0.0, length_m}, 0.0),
      .second = node_at({jitter_m(), length_m + jitter_m()}, sign * across_m)};
  return uniform(rng) < 0.5 ? pair : NodeEndsPair{turned(pair.first), turned(pair.second)};
}

}  // namespace

void validate(const NodePairParams& params) {
  require_above("shortest_m", params.shortest_m, 0.0);
  require_at_least("longest_m", params.longest_m, params.shortest_m);
  require_above("across_same_m", params.across_same_m, 0.0);
  require_at_least("along_same_m", params.along_same_m, 0.0);
  require_above("across_least_m", params.across_least_m, params.across_same_m);
  require_at_least("across_most_m", params.across_most_m, params.across_least_m);
  require_at_least("batch", params.batch, 1.0);
}

PlaceBatch node_pairs(const NodePairParams& params, SampleSplit split, std::uint64_t seed,
                      std::uint64_t number) {
  validate(params);
  const auto count = static_cast<std::size_t>(params.batch);
  PlaceBatch batch{.count = params.batch,
                   .input = std::vector<float>(2 * count * kComparatorInputs)};
  Rng rng = make_rng(split_seed(split, seed, kPurpose), number);
  for (std::size_t i = 0; i < count; ++i) {
    const bool same = i % 2 == 0;
    const auto nodes = comparator_input(draw_pair(params, same, rng));
    std::ranges::copy(nodes[0],
                      batch.input.begin() + static_cast<std::ptrdiff_t>(i * kComparatorInputs));
    std::ranges::copy(nodes[1], batch.input.begin() +
                                    static_cast<std::ptrdiff_t>((count + i) * kComparatorInputs));
    batch.answer.push_back(same ? 1 : 0);
  }
  return batch;
}

}  // namespace sketchloc
