#pragma once

#include <span>

namespace sketchloc {

/// How far features of a scan look for their like in a drawing, in cells.
inline constexpr int kCorrelationReach = 4;
inline constexpr int kCorrelationShifts = (2 * kCorrelationReach + 1) * (2 * kCorrelationReach + 1);

/// An operation in ONNX files, and the domain it is of. Of a scan's features (1 x c x side x side,
/// or one for each drawing) and drawings' (n x c x side x side) it makes n x (2 c +
/// kCorrelationShifts) planes: the scan's, the drawing's, and what `correlate` says.
inline constexpr const char* kMatchOperation = "Match";
inline constexpr const char* kOperationDomain = "sketchloc";

/// A map of features: planes of side x side cells, one after the other, each row by row.
struct FeatureShape {
  int channels = 1;
  int side = 8;  ///< a multiple of 8

  int cells() const { return side * side; }
  int size() const { return channels * cells(); }
};

/// For every cell of a scan's features, how alike the drawing's are at each shift:
/// kCorrelationShifts planes, shift (dx, dy) with dx fastest, from -reach;
///   result(shift, y, x) = sum over c of scan(c, y, x) drawing(c, y + dy, x + dx) / sqrt(channels).
/// The drawing's features are 0 outside of their map. Same bits on every processor.
void correlate(const FeatureShape& shape, std::span<const float> scan,
               std::span<const float> drawing, std::span<float> result);

/// Gradients of the scan's and the drawing's features from that of the result.
void correlate_backwards(const FeatureShape& shape, std::span<const float> scan,
                         std::span<const float> drawing, std::span<const float> gradient,
                         std::span<float> scan_gradient, std::span<float> drawing_gradient);

}  // namespace sketchloc
