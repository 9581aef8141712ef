#include "tests/datasets/io/drawings.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sketchloc::testing {

cv::Mat1b drawn_strokes(int zoom) {
  cv::Mat1b strokes(200 * zoom, 300 * zoom, static_cast<unsigned char>(0));
  const auto line = [&](int x0, int y0, int x1, int y1) {
    cv::line(strokes, cv::Point(x0, y0) * zoom, cv::Point(x1, y1) * zoom, 255, 3 * zoom);
  };
  cv::rectangle(strokes, cv::Point(30, 20) * zoom, cv::Point(270, 180) * zoom, 255, 3 * zoom);
  line(30, 100, 90, 95);
  line(110, 97, 200, 100);
  line(120, 20, 118, 60);
  line(200, 180, 205, 130);
  cv::circle(strokes, cv::Point(240, 60) * zoom, 12 * zoom, 255, 3 * zoom);
  return strokes;
}

cv::Mat1b painted_rooms() {
  cv::Mat1b rooms(200, 300, static_cast<unsigned char>(0));
  cv::rectangle(rooms, cv::Point(30, 30), cv::Point(120, 170), 255, cv::FILLED);
  cv::rectangle(rooms, cv::Point(100, 90), cv::Point(270, 115), 255, cv::FILLED);
  cv::rectangle(rooms, cv::Point(190, 40), cv::Point(270, 160), 255, cv::FILLED);
  return rooms;
}

cv::Mat1b picture_of(const cv::Mat1b& mask, int inside, int outside, double noise) {
  cv::Mat1s levels(mask.size());
  cv::RNG random(7);
  random.fill(levels, cv::RNG::NORMAL, 0.0, noise);
  cv::Mat1b picture(mask.size());
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      const int level = (mask(row, column) != 0 ? inside : outside) + levels(row, column);
      picture(row, column) = cv::saturate_cast<unsigned char>(level);
    }
  }
  return picture;
}

cv::Mat1b photo_of(const cv::Mat1b& strokes, bool dirt) {
  cv::Mat1b ink = picture_of(strokes, 90, 230, 0.0);
  if (dirt) {
    cv::RNG random(11);
    for (int i = 0; i < 60; ++i) {
      ink(random.uniform(0, ink.rows), random.uniform(0, ink.cols)) = 60;
    }
  }
  cv::GaussianBlur(ink, ink, cv::Size(0, 0), 0.7);
  cv::Mat1f noise(ink.size());
  cv::RNG random(13);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 4.0);
  cv::Mat1b photo(ink.size());
  for (int row = 0; row < ink.rows; ++row) {
    for (int column = 0; column < ink.cols; ++column) {
      const double u = column / static_cast<double>(ink.cols);
      const double v = row / static_cast<double>(ink.rows);
      const double shadow = 0.35 / (1.0 + std::exp(-(u + 0.4 * v - 0.8) / 0.03));
      const double light = 1.0 - 0.35 * v - shadow;
      photo(row, column) =
          cv::saturate_cast<unsigned char>(ink(row, column) * light + noise(row, column));
    }
  }
  return photo;
}

double overlap(const Sketch& sketch, const cv::Mat1b& mask) {
  double both = 0.0;
  double either = 0.0;
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      const bool drawn = mask(row, column) != 0;
      const bool read = sketch.occupied.at({column, mask.rows - 1 - row}) != 0;
      both += drawn && read ? 1.0 : 0.0;
      either += drawn || read ? 1.0 : 0.0;
    }
  }
  return either > 0.0 ? both / either : 1.0;
}

}  // namespace sketchloc::testing
