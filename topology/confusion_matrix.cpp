#include "topology/confusion_matrix.hpp"

#include <numeric>

namespace sketchloc {
namespace {

double share_of(int part, int whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

int ConfusionMatrix::count() const {
  int sum = 0;
  for (const std::vector<int>& row : given_of_right) {
    sum = std::accumulate(row.begin(), row.end(), sum);
  }
  return sum;
}

double ConfusionMatrix::accuracy() const {
  int right = 0;
  for (std::size_t i = 0; i < given_of_right.size(); ++i) {
    right += given_of_right[i][i];
  }
  return share_of(right, count());
}

double ConfusionMatrix::recall(std::size_t answer) const {
  const std::vector<int>& row = given_of_right[answer];
  return share_of(row[answer], std::accumulate(row.begin(), row.end(), 0));
}

double ConfusionMatrix::precision(std::size_t answer) const {
  int given = 0;
  for (const std::vector<int>& row : given_of_right) {
    given += row[answer];
  }
  return share_of(given_of_right[answer][answer], given);
}

}  // namespace sketchloc
