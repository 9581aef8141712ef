#include "eval/detail/run_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace sketchloc::detail {
namespace {

constexpr Colour kUnscored{150, 120, 180};
constexpr double kEstimateWidth = 3.0;

/// Dark blue to yellow in equal steps of lightness; by time where no error is known.
constexpr std::array<Colour, 5> kByTime = {
    Colour{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {230, 200, 20}};

/// Beyond this way between two steps, the filter has moved to another place of the drawing.
constexpr double kJump_m = 3.0;

bool is_jump(const Sim2& from, const Sim2& to) {
  return (to.translation() - from.translation()).norm() > kJump_m * from.scale();
}

/// Index of the class in `estimate_layers` each step belongs to.
std::vector<std::size_t> classes_by_error(const RunRecord& record,
                                          std::span<const StepError> errors) {
  constexpr std::size_t kUnscoredClass = 3;
  std::vector<std::size_t> classes;
  auto error = errors.begin();
  for (const StepReport& report : record.steps) {
    while (error != errors.end() && error->step < report.step) {
      ++error;
    }
    if (error == errors.end() || error->step != report.step) {
      classes.push_back(kUnscoredClass);
    } else {
      classes.push_back(error->translation_m <= 1.0 ? 0 : error->translation_m <= 2.0 ? 1 : 2);
    }
  }
  return classes;
}

std::vector<std::size_t> classes_by_time(const RunRecord& record) {
  std::vector<std::size_t> classes;
  for (std::size_t i = 0; i < record.steps.size(); ++i) {
    classes.push_back(i * kByTime.size() / record.steps.size());
  }
  return classes;
}

std::vector<PathLayer> error_legend() {
  return {{.name = "estimate, at most 1 m off", .colour = kGood, .width = kEstimateWidth},
          {.name = "1 to 2 m off", .colour = kFair, .width = kEstimateWidth},
          {.name = "more than 2 m off", .colour = kBad, .width = kEstimateWidth},
          {.name = "no reference here", .colour = kUnscored, .width = kEstimateWidth}};
}

std::vector<PathLayer> time_legend() {
  std::vector<PathLayer> layers;
  for (const Colour& colour : kByTime) {
    layers.push_back({.name = {}, .colour = colour, .width = kEstimateWidth});
  }
  layers.front().name = "estimate at the start";
  layers.back().name = "estimate at the end";
  return layers;
}

/// The estimated path cut where its class changes or where it jumps; jumps in a layer of theirs.
std::vector<PathLayer> estimate_layers(const RunRecord& record, std::vector<PathLayer> layers,
                                       std::span<const std::size_t> classes) {
  PathLayer jumps{.name = "jump of the estimate", .colour = kGrey, .width = 0.8, .dashed = true};
  std::size_t open_class = layers.size();  // whose last line goes on; layers.size(): none
  for (std::size_t i = 1; i < record.steps.size(); ++i) {
    const Sim2& from = record.steps[i - 1].estimate.sketch_from_robot;
    const Sim2& to = record.steps[i].estimate.sketch_from_robot;
    if (is_jump(from, to)) {
      jumps.lines.push_back({from.translation(), to.translation()});
      open_class = layers.size();
      continue;
    }
    std::vector<Polyline>& lines = layers[classes[i]].lines;
    if (open_class != classes[i]) {
      lines.push_back({from.translation()});
      open_class = classes[i];
    }
    lines.back().push_back(to.translation());
  }
  layers.push_back(jumps);
  return layers;
}

PathLayer reference_layer(const Reference& reference) {
  PathLayer layer{.name = "reference", .colour = kReferenceBlue, .width = 1.8, .dashed = true};
  std::optional<Sim2> last;
  for (const ReferencePose& pose : reference.poses) {
    if (!last || is_jump(*last, pose.sketch_from_robot)) {
      layer.lines.emplace_back();
    }
    layer.lines.back().push_back(pose.sketch_from_robot.translation());
    last = pose.sketch_from_robot;
  }
  return layer;
}

void extend(View& view, const Eigen::Vector2d& point) {
  view.low = view.low.cwiseMin(point);
  view.high = view.high.cwiseMax(point);
}

/// The part of the drawing with something in it: strokes, or painted free space.
View content_view(const Sketch& sketch) {
  const std::uint8_t content = sketch.kind == Sketch::Kind::Strokes ? 1 : 0;
  View view{.low = {sketch.width_px(), sketch.height_px()}, .high = {0.0, 0.0}};
  for (int row = 0; row < sketch.height_px(); ++row) {
    const auto cells = sketch.occupied.row(row);
    const auto first = std::ranges::find(cells, content);
    if (first == cells.end()) {
      continue;
    }
    const auto last = std::find(cells.rbegin(), cells.rend(), content);
    extend(view, {static_cast<double>(first - cells.begin()), row});
    extend(view, {static_cast<double>(cells.rend() - last), row + 1.0});
  }
  const bool blank = view.high.x() <= view.low.x();
  return blank ? View{.low = {0.0, 0.0},
                      .high = {std::max(1, sketch.width_px()), std::max(1, sketch.height_px())}}
               : view;
}

}  // namespace

std::string hex(const Colour& colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += kDigits[part >> 4U];
    text += kDigits[part & 15U];
  }
  return text;
}

View whole_view(const RunRecord& record, std::span<const PathLayer> layers) {
  constexpr double kMostBeyond = 0.5;  // of the drawing's size: an estimate may leave it for good
  View view = content_view(record.sketch);
  const double beyond = kMostBeyond * std::max(view.width(), view.height());
  const Eigen::Array2d lowest = view.low.array() - beyond;
  const Eigen::Array2d highest = view.high.array() + beyond;
  for (const PathLayer& layer : layers) {
    for (const Polyline& line : layer.lines) {
      std::ranges::for_each(line, [&](const Eigen::Vector2d& point) {
        extend(view, point.array().max(lowest).min(highest));
      });
    }
  }
  constexpr double kMargin = 0.03;
  const double margin = kMargin * std::max(view.width(), view.height());
  view.low.array() -= margin;
  view.high.array() += margin;
  return view;
}

std::vector<PathLayer> path_layers(const RunRecord& record, std::span<const StepError> errors) {
  const bool by_error = !errors.empty();
  std::vector<PathLayer> layers =
      by_error ? estimate_layers(record, error_legend(), classes_by_error(record, errors))
               : estimate_layers(record, time_legend(), classes_by_time(record));
  if (record.reference) {
    layers.insert(layers.begin(), reference_layer(*record.reference));
  }
  return layers;
}

Grid<std::uint8_t> paper(const Sketch& sketch, std::uint8_t ink) {
  constexpr std::uint8_t kPaper = 255;
  constexpr std::uint8_t kOutside = 205;
  const std::uint8_t occupied = sketch.kind == Sketch::Kind::Strokes ? ink : kOutside;
  Grid<std::uint8_t> grey(sketch.width_px(), sketch.height_px(), kPaper);
  for (int row = 0; row < grey.height(); ++row) {
    std::ranges::transform(sketch.occupied.row(row), grey.row(row).begin(),
                           [&](std::uint8_t cell) { return cell != 0 ? occupied : kPaper; });
  }
  return grey;
}

PaperExcerpt paper_excerpt(const Sketch& sketch, const View& view, std::uint8_t ink) {
  const Eigen::Array2d size_px(sketch.width_px(), sketch.height_px());
  const Eigen::Array2d low = view.low.array().floor().max(0.0).min(size_px);
  const Eigen::Array2d high = view.high.array().ceil().max(low).min(size_px);
  const Eigen::Array2i first = low.cast<int>();
  const Eigen::Array2i size = (high - low).cast<int>();
  Sketch part{.occupied = Grid<std::uint8_t>(size.x(), size.y()),
              .kind = sketch.kind,
              .px_per_m = std::nullopt};
  for (int row = 0; row < size.y(); ++row) {
    const auto from =
        sketch.occupied.row(first.y() + row)
            .subspan(static_cast<std::size_t>(first.x()), static_cast<std::size_t>(size.x()));
    std::ranges::copy(from, part.occupied.row(row).begin());
  }
  return {.grey = paper(part, ink), .view = {.low = low, .high = high}};
}

}  // namespace sketchloc::detail
