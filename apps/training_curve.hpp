#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "registration/train/trainer.hpp"

namespace sketchloc {

/// How far learning was after a number of samples.
struct CurvePoint {
  std::uint64_t samples = 0;
  double seconds = 0.0;  ///< of learning so far, over all sittings
  TrainingLoss loss;     ///< mean since the point before
  ValidationReport validation;
};

/// A curve as CSV, one row per point; errors in cm and deg.
std::string curve_header();
std::string curve_row(const CurvePoint& point);

/// The rows of an earlier CSV up to a number of samples: what a checkpoint made then has seen. With
/// the header; throws std::runtime_error where a row has no number.
std::string curve_until(std::string_view csv, std::uint64_t samples);

/// The curve as a picture: the bytes of an SVG file that shows median position and heading errors,
/// relative to those of the priors, over the samples. Empty for fewer than two points.
std::string curve_svg(std::string_view csv);

/// The seconds in a curve's last row; 0 without one.
double seconds_of_curve(std::string_view csv);

}  // namespace sketchloc
