#include "datasets/io/detail/picture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "datasets/io/detail/file_bytes.hpp"
#include "datasets/io/detail/place.hpp"

namespace sketchloc::detail {
namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::size_t kMostPictureBytes = std::size_t{256} << 20;
constexpr std::array<unsigned char, 8> kPngStart = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

int big_endian(Bytes bytes) {
  unsigned value = 0;
  for (const unsigned char byte : bytes) {
    value = value << 8U | byte;
  }
  return static_cast<int>(std::min(value, 0x7fffffffU));
}

bool is_png(Bytes bytes) {
  return bytes.size() >= 24 && std::equal(kPngStart.begin(), kPngStart.end(), bytes.begin());
}

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 4 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

bool is_pnm(Bytes bytes) {
  return bytes.size() >= 8 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
         std::isspace(bytes[2]) != 0;
}

/// The head of a JPEG: its size and where the pixels begin.
struct JpegHead {
  std::optional<cv::Size> size;
  std::size_t pixels_at = 0;
};

/// Walks over the segments up to the first scan.
JpegHead read_jpeg_head(Bytes bytes) {
  constexpr unsigned char kStartOfScan = 0xda;
  JpegHead head;
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && bytes[at] == 0xff && bytes[at + 1] != kStartOfScan) {
    const unsigned char marker = bytes[at + 1];
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      head.size =
          cv::Size(big_endian(bytes.subspan(at + 7, 2)), big_endian(bytes.subspan(at + 5, 2)));
    }
    const bool is_fill = marker == 0xff;
    at += is_fill ? 1 : 2 + static_cast<std::size_t>(big_endian(bytes.subspan(at + 2, 2)));
  }
  head.pixels_at = std::min(at, bytes.size());
  return head;
}

/// The decoder would make up what is missing, so we look for the end ourselves: in the pixels, ff
/// d9 stands for nothing else.
bool is_cut_off_jpeg(Bytes bytes) {
  constexpr std::array<unsigned char, 2> kEnd = {0xff, 0xd9};
  const Bytes pixels = bytes.subspan(read_jpeg_head(bytes).pixels_at);
  return std::ranges::search(pixels, kEnd).empty();
}

/// Two decimal numbers after the magic, parted by blanks and #-comments.
std::optional<cv::Size> pnm_size(Bytes bytes) {
  std::array<int, 2> sizes = {0, 0};
  std::size_t at = 2;
  for (int& size : sizes) {
    while (at < bytes.size() && (std::isspace(bytes[at]) != 0 || bytes[at] == '#')) {
      if (bytes[at] == '#') {
        while (at < bytes.size() && bytes[at] != '\n') {
          ++at;
        }
      } else {
        ++at;
      }
    }
    const std::size_t start = at;
    while (at < bytes.size() && std::isdigit(bytes[at]) != 0 && at - start < 9) {
      size = size * 10 + (bytes[at++] - '0');
    }
    if (at == start) {
      return std::nullopt;
    }
  }
  return cv::Size(sizes[0], sizes[1]);
}

cv::Mat to_8_bits(const cv::Mat& picture) {
  cv::Mat out = picture;
  if (picture.depth() == CV_16U) {
    picture.convertTo(out, CV_8U, 1.0 / 257.0);
  }
  if (out.channels() == 2) {
    cv::extractChannel(out, out, 0);
  }
  return out;
}

/// Empty if it cannot be decoded. A photo comes turned as its camera says, as people see it.
cv::Mat decode(const std::vector<unsigned char>& bytes) {
  try {
    cv::Mat picture = cv::imdecode(bytes, is_jpeg(bytes) ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
    return picture.depth() == CV_8U || picture.depth() == CV_16U ? picture : cv::Mat();
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

std::optional<cv::Size> picture_size(Bytes bytes) {
  if (is_png(bytes)) {
    return cv::Size(big_endian(bytes.subspan(16, 4)), big_endian(bytes.subspan(20, 4)));
  }
  if (is_jpeg(bytes)) {
    return read_jpeg_head(bytes).size;
  }
  return is_pnm(bytes) ? pnm_size(bytes) : std::nullopt;
}

cv::Mat read_picture(const std::filesystem::path& file, std::size_t max_pixels) {
  const std::vector<unsigned char> bytes = read_bytes(file, kMostPictureBytes);
  const Place place{.file = file};
  const std::optional<cv::Size> size = picture_size(bytes);
  if (!size) {
    fail(place, "expected a PNG, JPEG or PGM picture, found something else; convert it first");
  }
  const double pixels = static_cast<double>(size->width) * static_cast<double>(size->height);
  if (pixels < 1.0 || pixels > static_cast<double>(max_pixels)) {
    fail_expected(place, "size", "1 to " + std::to_string(max_pixels) + " pixels",
                  std::to_string(size->width) + " x " + std::to_string(size->height),
                  "scale the picture down");
  }
  const cv::Mat picture = decode(bytes);
  const cv::Size turned(picture.rows, picture.cols);
  const bool is_whole = !is_jpeg(bytes) || !is_cut_off_jpeg(bytes);
  if (picture.empty() || !is_whole || (picture.size() != *size && turned != *size)) {
    fail(place, "the picture cannot be decoded: it is damaged, cut off or of an unusual kind");
  }
  return to_8_bits(picture);
}

}  // namespace sketchloc::detail
