#include <yaml-cpp/yaml.h>

#include <opencv2/core.hpp>
#include <string>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/file_bytes.hpp"
#include "datasets/io/detail/picture.hpp"
#include "datasets/io/detail/place.hpp"
#include "datasets/io/image_rows.hpp"
#include "datasets/io/sketch_io.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::Place;

constexpr std::size_t kMostYamlBytes = std::size_t{1} << 20;

/// What map_server's YAML file says, as far as it matters here.
struct MapServer {
  std::filesystem::path picture;
  double resolution_m_per_px = 0.0;
  bool negate = false;
  double occupied_thresh = 0.65;
};

class MapFields {
 public:
  MapFields(const YAML::Node& root, const std::filesystem::path& file) : root_(root), file_(file) {}

  std::string text(const char* field) const {
    const YAML::Node node = root_[field];
    if (!node || !node.IsScalar() || node.Scalar().empty()) {
      detail::fail_expected(place_of(node), field, "a value", node ? "something else" : "nothing",
                            "the fields are listed in docs/formats.md");
    }
    return node.Scalar();
  }

  std::string text_or(const char* field, const std::string& otherwise) const {
    return root_[field] ? text(field) : otherwise;
  }

  double number(const char* field, double low, double high) const {
    const std::string value = text(field);
    const std::optional<double> number = parse_number<double>(value);
    if (!number || !(*number >= low && *number <= high)) {
      detail::fail_expected(place_of(root_[field]), field,
                            "a number from " + std::to_string(low) + " to " + std::to_string(high),
                            detail::in_quotes(value), "correct the value");
    }
    return *number;
  }

  Place place_of(const YAML::Node& node) const {
    const bool known = node && node.Mark().line >= 0;
    return {.file = file_, .line = known ? static_cast<std::size_t>(node.Mark().line) + 1 : 0};
  }
  Place place_of(const char* field) const { return place_of(root_[field]); }

 private:
  YAML::Node root_;
  std::filesystem::path file_;
};

bool read_negate(const MapFields& fields) {
  const std::string text = fields.text_or("negate", "0");
  if (text == "1" || text == "true") {
    return true;
  }
  if (text != "0" && text != "false") {
    detail::fail_expected(fields.place_of("negate"), "negate", "0 or 1", detail::in_quotes(text),
                          "correct the value");
  }
  return false;
}

MapServer read_fields(const MapFields& fields, const std::filesystem::path& yaml) {
  const std::string mode = fields.text_or("mode", "trinary");
  if (mode != "trinary" && mode != "scale") {
    detail::fail_expected(fields.place_of("mode"), "mode", "trinary or scale",
                          detail::in_quotes(mode), "save the map in mode trinary");
  }
  constexpr double kFinest_m = 1e-4;
  constexpr double kCoarsest_m = 1e3;
  MapServer map;
  map.picture = yaml.parent_path() / fields.text("image");
  map.resolution_m_per_px = fields.number("resolution", kFinest_m, kCoarsest_m);
  map.negate = read_negate(fields);
  map.occupied_thresh = fields.number("occupied_thresh", 0.0, 1.0);
  fields.number("free_thresh", 0.0, map.occupied_thresh);
  return map;
}

MapServer read_yaml(const std::filesystem::path& yaml) {
  const std::vector<unsigned char> bytes = detail::read_bytes(yaml, kMostYamlBytes);
  try {
    const YAML::Node root = YAML::Load(std::string(bytes.begin(), bytes.end()));
    if (!root.IsMap()) {
      detail::fail({.file = yaml}, "expected the YAML map of a map_server file, found none");
    }
    return read_fields(MapFields(root, yaml), yaml);
  } catch (const YAML::Exception& error) {
    detail::fail({.file = yaml, .line = static_cast<std::size_t>(error.mark.line + 1)},
                 "YAML: " + error.msg);
  }
}

/// map_server: the probability of an obstacle is the darkness of the cell, or its lightness.
cv::Mat1b occupied_cells(const cv::Mat& picture, const MapServer& map) {
  const int channels = picture.channels();
  const int colours = channels == 1 ? 1 : 3;
  cv::Mat1b occupied(picture.size());
  for (int row = 0; row < picture.rows; ++row) {
    const unsigned char* values = picture.ptr(row);
    for (int column = 0; column < picture.cols; ++column) {
      int sum = 0;
      for (int colour = 0; colour < colours; ++colour) {
        sum += values[column * channels + colour];
      }
      const double lightness = sum / (255.0 * colours);
      const double probability = map.negate ? lightness : 1.0 - lightness;
      occupied(row, column) = probability > map.occupied_thresh ? 255 : 0;
    }
  }
  return occupied;
}

}  // namespace

Sketch read_map_server(const std::filesystem::path& yaml, const SketchReading& reading) {
  validate(reading);
  const MapServer map = read_yaml(yaml);
  const cv::Mat picture = detail::read_picture(map.picture, reading.max_pixels);
  const cv::Mat1b occupied = occupied_cells(picture, map);
  if (cv::countNonZero(occupied) == 0) {
    detail::fail({.file = map.picture},
                 "map: expected occupied cells, found none; check negate and occupied_thresh");
  }
  return {.occupied = mask_from_image(occupied),
          .kind = Sketch::Kind::Strokes,
          .px_per_m = 1.0 / map.resolution_m_per_px};
}

}  // namespace sketchloc
