#include "datasets/io/correspondence_io.hpp"

#include <map>

#include "datasets/io/csv_table.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

/// The points of one match in one picture.
struct PointSum {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  std::size_t count = 0;

  void add(const Eigen::Vector2d& point) {
    sum += point;
    ++count;
  }
  Eigen::Vector2d mean() const { return sum / static_cast<double>(count); }
};

struct Match {
  PointSum in_sketch;
  PointSum in_model;
};

Eigen::Vector2d point_y_up(const CsvRow& row, const PictureSize& size) {
  const double row_px = row.within("row", 0.0, size.height_px - 1.0);
  const double column_px = row.within("column", 0.0, size.width_px - 1.0);
  return {column_px + 0.5, size.height_px - 0.5 - row_px};
}

}  // namespace

std::vector<Correspondence> read_correspondences(const std::filesystem::path& csv,
                                                 const PictureSize& sketch,
                                                 const PictureSize& model) {
  for (const PictureSize& size : {sketch, model}) {
    check(size.width_px > 0 && size.height_px > 0, "a picture has a size");
  }
  std::map<std::size_t, Match> matches;
  for_each_csv_row(csv, {"match", "drawing", "row", "column"}, [&](const CsvRow& row) {
    Match& match = matches[row.index("match")];
    const bool of_model = row.choice("drawing", {"sketch", "model"}) == 1;
    PointSum& points = of_model ? match.in_model : match.in_sketch;
    points.add(point_y_up(row, of_model ? model : sketch));
  });
  std::vector<Correspondence> correspondences;
  for (const auto& [number, match] : matches) {
    if (match.in_sketch.count > 0 && match.in_model.count > 0) {
      correspondences.push_back({.match = number,
                                 .point_in_sketch = match.in_sketch.mean(),
                                 .point_in_model = match.in_model.mean()});
    }
  }
  return correspondences;
}

}  // namespace sketchloc
