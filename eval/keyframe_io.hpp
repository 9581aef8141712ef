#pragma once

#include <filesystem>
#include <string>

#include "smoothing/keyframe.hpp"

namespace sketchloc {

/// The text of `keyframes.jsonl`, see docs/formats.md; every number survives to the last bit.
std::string to_jsonl(const KeyframeRun& run);

/// Throws std::runtime_error with file, line and what to do where it is not such a file.
KeyframeRun read_keyframes(const std::filesystem::path& jsonl);

}  // namespace sketchloc
