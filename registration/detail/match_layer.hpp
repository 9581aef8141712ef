#pragma once

namespace sketchloc::detail {

/// Lets cv::dnn run kMatchOperation. To be called before a network that has it is read.
void register_match_layer();

}  // namespace sketchloc::detail
