#include "datasets/io/image_rows.hpp"

#include <algorithm>

namespace sketchloc {

cv::Mat1b image_from_grid(const Grid<std::uint8_t>& grid) {
  cv::Mat1b image(grid.height(), grid.width());
  for (int row = 0; row < grid.height(); ++row) {
    std::ranges::copy(grid.row(row), image[grid.height() - 1 - row]);
  }
  return image;
}

Grid<std::uint8_t> grid_from_image(const cv::Mat1b& image) {
  Grid<std::uint8_t> grid(image.cols, image.rows);
  for (int row = 0; row < grid.height(); ++row) {
    std::copy_n(image[grid.height() - 1 - row], grid.width(), grid.row(row).begin());
  }
  return grid;
}

Grid<std::uint8_t> mask_from_image(const cv::Mat1b& image) {
  Grid<std::uint8_t> mask = grid_from_image(image);
  for (int row = 0; row < mask.height(); ++row) {
    for (std::uint8_t& cell : mask.row(row)) {
      cell = cell != 0 ? 1 : 0;
    }
  }
  return mask;
}

}  // namespace sketchloc
