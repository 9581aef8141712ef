#include "datasets/sim/drawing_statistics.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "motion/angles.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

TEST(Quantiles, InterpolateBetweenSortedValues) {
  const Quantiles found = quantiles({4.0, 0.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(found.p5, 0.2);
  EXPECT_DOUBLE_EQ(found.median, 2.0);
  EXPECT_DOUBLE_EQ(found.p95, 3.8);
}

/// A straight drive along x, drawn by a map that stretches x by 20 px/m and y by 10.
std::vector<DrawnPlace> stretched_drive() {
  std::vector<DrawnPlace> places;
  const LocalSimilarity local = local_similarity(Eigen::Vector2d(20.0, 10.0).asDiagonal());
  for (int i = 0; i <= 40; ++i) {
    const Eigen::Vector2d in_world(0.5 * i, 0.0);
    places.push_back({in_world, {20.0 * in_world.x(), 0.0}, local});
  }
  return places;
}

TEST(MeasureDrawing, FindsScaleAndAnisotropyOfAnAffineMap) {
  const DrawingStatistics statistics = measure_drawing(stretched_drive());
  EXPECT_NEAR(statistics.scale_px_per_m.median, std::sqrt(200.0), 1e-9);
  EXPECT_NEAR(statistics.anisotropy.p95, 2.0, 1e-9);
  EXPECT_NEAR(statistics.rotation_rad.median, 0.0, 1e-12);
  EXPECT_NEAR(statistics.residual_rms_m, 0.0, 1e-9);
}

TEST(MeasureDrawing, FindsTheDifferenceOfTheResidualBetweenPlaces) {
  std::vector<DrawnPlace> places = stretched_drive();
  for (DrawnPlace& place : places) {  // a wave of 10 m length and 1 m height
    const double phase_rad = 2.0 * std::numbers::pi * place.position_in_world.x() / 10.0;
    place.position_in_sketch.y() = 20.0 * std::cos(phase_rad);
  }
  const DrawingStatistics statistics = measure_drawing(places);
  EXPECT_NEAR(statistics.residual_rms_m, std::sqrt(0.5), 0.05);
  EXPECT_NEAR(statistics.residual_change_m[2], std::sqrt(2.0), 0.15);  // half a wave apart
  EXPECT_LT(statistics.residual_change_m[3], 0.7);                     // a whole wave
}

TEST(MeasureDrawing, HasNoChangeOverMoreThanTheWholeDrive) {
  const std::vector<DrawnPlace> places = stretched_drive();
  const std::span<const DrawnPlace> first_4_m = std::span(places).first(9);
  EXPECT_TRUE(std::isnan(measure_drawing(first_4_m).residual_change_m[2]));
}

// The same figures were worked out by other people's code for two real drawings.

/// Corrected poses (world) of a log, by index of the scan.
std::vector<Eigen::Vector2d> corrected_positions(const std::filesystem::path& log) {
  std::vector<Eigen::Vector2d> positions;
  gzFile file = gzopen(log.c_str(), "rb");
  std::string line(1 << 16, '\0');
  while (gzgets(file, line.data(), static_cast<int>(line.size())) != nullptr) {
    std::istringstream fields(line);
    std::string kind;
    std::size_t ranges = 0;
    fields >> kind >> ranges;
    double number = 0.0;
    for (std::size_t i = 0; i < ranges; ++i) {
      fields >> number;
    }
    Eigen::Vector2d position;
    fields >> position.x() >> position.y();
    positions.push_back(position);
  }
  gzclose(file);
  return positions;
}

std::vector<DrawnPlace> real_places(const std::filesystem::path& csv,
                                    const std::vector<Eigen::Vector2d>& positions_in_world) {
  std::ifstream file(csv);
  std::string line;
  std::getline(file, line);
  std::vector<DrawnPlace> places;
  while (std::getline(file, line)) {
    std::vector<double> column;
    std::istringstream fields(line);
    for (std::string text; std::getline(fields, text, ',');) {
      column.push_back(std::stod(text));
    }
    places.push_back({positions_in_world.at(static_cast<std::size_t>(column.at(0))),
                      {column.at(2), -column.at(3)},  // the image's y points down
                      {.rotation_rad = rad_from_deg(column.at(8)),
                       .scale = column.at(6),
                       .anisotropy = column.at(9)}});
  }
  return places;
}

struct RealDrawing {
  const char* log;
  const char* reference;
  std::array<double, 3> scale_px_per_m;  ///< p5, median, p95
  std::array<double, 3> rotation_deg;
  std::array<double, 2> anisotropy;  ///< median, p95
  std::array<double, 4> residual_change_m;
};

class RealDrawings : public ::testing::TestWithParam<RealDrawing> {};

TEST_P(RealDrawings, HaveTheFiguresThatWerePublishedForThem) {
  const std::optional<std::filesystem::path> log = testing::shared_data(GetParam().log);
  const std::optional<std::filesystem::path> csv = testing::shared_data(GetParam().reference);
  if (!log || !csv) {
    GTEST_SKIP() << "needs the shared development data";
  }
  const DrawingStatistics statistics =
      measure_drawing(real_places(*csv, corrected_positions(*log)));
  EXPECT_NEAR(statistics.scale_px_per_m.p5, GetParam().scale_px_per_m[0], 0.35);
  EXPECT_NEAR(statistics.scale_px_per_m.median, GetParam().scale_px_per_m[1], 0.35);
  EXPECT_NEAR(statistics.scale_px_per_m.p95, GetParam().scale_px_per_m[2], 0.35);
  EXPECT_NEAR(deg_from_rad(statistics.rotation_rad.p5), GetParam().rotation_deg[0], 0.6);
  EXPECT_NEAR(deg_from_rad(statistics.rotation_rad.median), GetParam().rotation_deg[1], 0.6);
  EXPECT_NEAR(deg_from_rad(statistics.rotation_rad.p95), GetParam().rotation_deg[2], 0.6);
  EXPECT_NEAR(statistics.anisotropy.median, GetParam().anisotropy[0], 0.1);
  EXPECT_NEAR(statistics.anisotropy.p95, GetParam().anisotropy[1], 0.1);
  for (std::size_t i = 0; i < statistics.residual_change_m.size(); ++i) {
    EXPECT_NEAR(statistics.residual_change_m[i], GetParam().residual_change_m[i], 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealDrawings,
    ::testing::Values(RealDrawing{"logs/intel.log.gz",
                                  "references/intel_sketch_3_rot180/reference.csv",
                                  {14.69, 20.65, 29.24},
                                  {143.88, 170.26, 186.64},
                                  {1.82, 4.73},
                                  {0.43, 0.75, 1.34, 1.72}},
                      RealDrawing{"logs/belgioioso.log.gz",
                                  "references/belgioioso_sketch/reference.csv",
                                  {10.79, 18.29, 25.75},
                                  {-89.80, -81.70, -64.74},
                                  {2.29, 4.59},
                                  {0.61, 1.18, 2.85, 5.24}}));

}  // namespace
}  // namespace sketchloc
