#pragma once

namespace sketchloc::detail {

/// The name of `correlate` as an operation in ONNX files, and the domain it is of.
inline constexpr const char* kCorrelationOperation = "Correlation";
inline constexpr const char* kOperationDomain = "sketchloc";

/// Lets cv::dnn run that operation: two inputs, the scan's and the drawing's features. To be called
/// before reading a network that has it; again does nothing.
void register_correlation_layer();

}  // namespace sketchloc::detail
