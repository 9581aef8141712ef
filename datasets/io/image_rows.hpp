#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "datasets/grid.hpp"

namespace sketchloc {

/// The one place where the rows of a grid (row 0 at the bottom) become rows of an image (row 0 at
/// the top), and back; values as they are.
cv::Mat1b image_from_grid(const Grid<std::uint8_t>& grid);
Grid<std::uint8_t> grid_from_image(const cv::Mat1b& image);

/// The same with 1 where the image is not 0.
Grid<std::uint8_t> mask_from_image(const cv::Mat1b& image);

}  // namespace sketchloc
