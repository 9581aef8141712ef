#pragma once

namespace sketchloc::detail {

/// Lets cv::dnn run kCorrelationOperation: two inputs, the scan's and the drawing's features. To be
/// called before reading a network that has it; again does nothing.
void register_correlation_layer();

}  // namespace sketchloc::detail
