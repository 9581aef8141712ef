#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <span>

namespace sketchloc::detail {

/// Width and height as the head of a PNG, JPEG or PNM file states them; none for anything else.
/// Lets us refuse a picture before its decoder asks for the memory.
std::optional<cv::Size> picture_size(std::span<const unsigned char> bytes);

/// Decodes PNG, JPEG or PNM to 8 bits, with 1 (grey), 3 (BGR) or 4 (BGRA) channels. Throws with the
/// file and the reason.
cv::Mat read_picture(const std::filesystem::path& file, std::size_t max_pixels);

}  // namespace sketchloc::detail
