#pragma once

#include <filesystem>
#include <vector>

#include "datasets/correspondence.hpp"

namespace sketchloc {

struct PictureSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const PictureSize&) const = default;
};

/// Reads places that correspond (match, drawing, row, column; drawing is `sketch` or `model`) from
/// the image convention (row down from the top, pixel centres at whole numbers) into the frame of
/// each picture, y up. A match with several points in a picture counts as their mean; one with
/// points in one picture only is left out. In the order of the match numbers. Throws
/// std::runtime_error with file, line and column, also for points outside their picture.
std::vector<Correspondence> read_correspondences(const std::filesystem::path& csv,
                                                 const PictureSize& sketch,
                                                 const PictureSize& model);

}  // namespace sketchloc
