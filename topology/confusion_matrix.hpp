#pragma once

#include <cstddef>
#include <vector>

namespace sketchloc {

/// How often which answer was given where which one is right.
struct ConfusionMatrix {
  std::vector<std::vector<int>> given_of_right;  ///< [right][given]

  explicit ConfusionMatrix(std::size_t answers)
      : given_of_right(answers, std::vector<int>(answers, 0)) {}
  void add(std::size_t right, std::size_t given) { ++given_of_right[right][given]; }

  int count() const;
  /// Share of right answers; of no answers 0.
  double accuracy() const;
  /// Of those that are right, the share that was given; of none 0.
  double recall(std::size_t answer) const;
  /// Of those that were given, the share that is right; of none 0.
  double precision(std::size_t answer) const;
};

}  // namespace sketchloc
