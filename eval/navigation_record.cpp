#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "eval/detail/canvas.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/intervals.hpp"
#include "eval/navigation.hpp"
#include "eval/summary.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;
using detail::fixed;
using detail::Frame;
using detail::PathLayer;

constexpr int kPanel_px = 900;

const char* name_of(NavigationTrial::End end) {
  switch (end) {
    case NavigationTrial::End::Arrived:
      return "arrived";
    case NavigationTrial::End::Stuck:
      return "stuck";
    case NavigationTrial::End::TooLong:
      return "too long";
  }
  return "";
}

NavigationTrial::End end_of(const std::string& name) {
  using enum NavigationTrial::End;
  for (const NavigationTrial::End end : {Arrived, Stuck, TooLong}) {
    if (name == name_of(end)) {
      return end;
    }
  }
  throw std::runtime_error("no end of a drive: " + name);
}

/// Cells in black and white, the whole of them in a panel.
cv::Mat3b panel_of(const Grid<std::uint8_t>& occupied) {
  cv::Mat3b image(occupied.height(), occupied.width(), cv::Vec3b(255, 255, 255));
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      if (occupied.at({column, image.rows - 1 - row}) != 0) {
        image(row, column) = {90, 80, 80};
      }
    }
  }
  const double zoom = static_cast<double>(kPanel_px) / std::max(image.rows, image.cols);
  cv::resize(image, image, {}, zoom, zoom, zoom < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::Mat3b panel(kPanel_px, kPanel_px, cv::Vec3b(255, 255, 255));
  image.copyTo(panel(cv::Rect(0, 0, image.cols, image.rows)));
  return panel;
}

/// Of what a panel shows, from its upper edge on.
int height_of(const Grid<std::uint8_t>& occupied) {
  const double zoom =
      static_cast<double>(kPanel_px) / std::max(occupied.width(), occupied.height());
  return std::min(kPanel_px, cvCeil(zoom * occupied.height()));
}

Frame frame_of(const Grid<std::uint8_t>& occupied) {
  return {.view = {.low = Eigen::Vector2d::Zero(),
                   .high = Eigen::Vector2d(occupied.width(), occupied.height())},
          .zoom = static_cast<double>(kPanel_px) / std::max(occupied.width(), occupied.height())};
}

void mark(cv::Mat3b& image, const cv::Point2d& at, const std::string& name) {
  cv::circle(image, detail::sub_pixel(at), cvRound(std::ldexp(6.0, detail::kShift)),
             detail::bgr(detail::kReferenceBlue), 3, cv::LINE_AA, detail::kShift);
  detail::write_text(image, name, cv::Point(cvRound(at.x) + 10, cvRound(at.y) - 8), 0.55);
}

/// Trials of one kind by one method.
struct Row {
  std::string kind;
  std::string method;
  std::size_t trials = 0;
  std::size_t successes = 0;
  std::size_t passed = 0;  ///< the goal within the bound at some time
  std::size_t collisions = 0;
  std::size_t seen_collisions = 0;
  double spl = 0.0;  ///< sum of success * shortest / driven
  std::vector<double> errors_m = {};
  std::vector<double> cycle_ms = {};
};

std::vector<Row> rows_of(std::span<const NavigationTrial> trials, double success_m) {
  std::vector<Row> rows;
  for (const NavigationTrial& trial : trials) {
    auto row = std::ranges::find_if(
        rows, [&](const Row& one) { return one.kind == trial.kind && one.method == trial.method; });
    if (row == rows.end()) {
      rows.push_back({.kind = trial.kind, .method = trial.method});
      row = rows.end() - 1;
    }
    const bool success = trial.success(success_m);
    ++row->trials;
    row->successes += success ? 1 : 0;
    row->passed += trial.nearest_m <= success_m ? 1 : 0;
    row->collisions += trial.collisions > 0 ? 1 : 0;
    row->seen_collisions += trial.seen_collisions > 0 ? 1 : 0;
    row->spl += success ? trial.shortest_m / std::max(trial.way_m, trial.shortest_m) : 0.0;
    row->errors_m.push_back(trial.error_m);
    row->cycle_ms.insert(row->cycle_ms.end(), trial.cycle_ms.begin(), trial.cycle_ms.end());
  }
  return rows;
}

std::vector<std::string> heads() {
  return {"kind",         "method",      "success",        "within bound on the way",
          "SPL",          "error p50 m", "with collision", "of these seen",
          "cycle p50 ms", "cycle p99 ms"};
}

std::string rate_text(std::size_t count, std::size_t trials) {
  const Interval interval = wilson_interval(count, trials);
  return std::to_string(count) + "/" + std::to_string(trials) + " = " +
         fixed(100.0 * static_cast<double>(count) / static_cast<double>(trials), 0) + " % [" +
         fixed(100.0 * interval.low, 0) + ", " + fixed(100.0 * interval.high, 0) + "]";
}

std::vector<std::string> cells_of(const Row& row) {
  return {row.kind,
          row.method,
          rate_text(row.successes, row.trials),
          rate_text(row.passed, row.trials),
          fixed(row.spl / static_cast<double>(row.trials), 2),
          fixed(quantile(row.errors_m, 0.5), 2),
          std::to_string(row.collisions),
          std::to_string(row.seen_collisions),
          fixed(quantile(row.cycle_ms, 0.5), 1),
          fixed(quantile(row.cycle_ms, 0.99), 1)};
}

}  // namespace

std::string navigation_json(const NavigationTrial& trial) {
  Json frames = Json::array();
  for (const NavigationFrame& frame : trial.frames) {
    const Se2& world = frame.world_from_robot;
    const Sim2& sketch = frame.sketch_from_robot;
    frames.push_back({{"world", {world.x_m(), world.y_m(), world.yaw_rad()}},
                      {"sketch", {sketch.x(), sketch.y(), sketch.yaw_rad(), sketch.scale()}},
                      {"localized_probability", frame.localized_probability},
                      {"collided", frame.collided}});
  }
  return Json{{"set", trial.set},
              {"kind", trial.kind},
              {"method", trial.method},
              {"end", name_of(trial.end)},
              {"error_m", trial.error_m},
              {"nearest_m", trial.nearest_m},
              {"way_m", trial.way_m},
              {"shortest_m", trial.shortest_m},
              {"collisions", trial.collisions},
              {"seen_collisions", trial.seen_collisions},
              {"cycle_ms", trial.cycle_ms},
              {"frames", frames}}
             .dump() +
         "\n";
}

NavigationTrial navigation_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    NavigationTrial trial{.set = json.at("set"),
                          .kind = json.at("kind"),
                          .method = json.at("method"),
                          .end = end_of(json.at("end"))};
    trial.error_m = json.at("error_m");
    trial.nearest_m = json.at("nearest_m");
    trial.way_m = json.at("way_m");
    trial.shortest_m = json.at("shortest_m");
    trial.collisions = json.at("collisions");
    trial.seen_collisions = json.at("seen_collisions");
    trial.cycle_ms = json.at("cycle_ms").get<std::vector<double>>();
    return trial;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("not a drive to a goal: ") + error.what());
  }
}

std::string picture_png(const NavigationTask& task, const NavigationTrial& trial) {
  const Grid<std::uint8_t>& drawn = task.drawing.sketch.occupied;
  const MetricMap& map = task.building.map;
  cv::Mat3b left = panel_of(drawn);
  cv::Mat3b right = panel_of(map.cells);
  PathLayer planned{.name = "", .colour = detail::kGrey, .width = 1.0, .dashed = true};
  PathLayer believed{.name = "", .colour = detail::kGood};
  PathLayer driven{.name = "", .colour = detail::kGood};
  planned.lines = {trial.first_path_in_sketch};
  believed.lines.emplace_back();
  driven.lines.emplace_back();
  for (const NavigationFrame& frame : trial.frames) {
    believed.lines.front().push_back(frame.sketch_from_robot.translation());
    driven.lines.front().push_back(map.cells_from_world(frame.world_from_robot.translation()));
  }
  draw_layer(left, planned, frame_of(drawn), 1.5);
  draw_layer(left, believed, frame_of(drawn), 1.5);
  draw_layer(right, driven, frame_of(map.cells), 1.5);
  mark(left, frame_of(drawn).at(task.drawing.sketch_from_world(task.goal_in_world)), "goal");
  mark(right, frame_of(map.cells).at(map.cells_from_world(task.goal_in_world)), "goal");
  mark(right, frame_of(map.cells).at(map.cells_from_world(task.world_from_start.translation())),
       "start");
  cv::Mat3b whole;
  cv::hconcat(left, right, whole);
  const int height_px = std::max(height_of(drawn), height_of(map.cells));
  return detail::png_bytes(whole.rowRange(0, height_px));
}

std::string navigation_suite_json(std::span<const NavigationTrial> trials, double success_m) {
  Json rows = Json::array();
  for (const Row& row : rows_of(trials, success_m)) {
    const Interval interval = wilson_interval(row.successes, row.trials);
    rows.push_back({{"kind", row.kind},
                    {"method", row.method},
                    {"trials", row.trials},
                    {"successes", row.successes},
                    {"success_interval_95", {interval.low, interval.high}},
                    {"within_bound_on_the_way", row.passed},
                    {"spl", row.spl / static_cast<double>(row.trials)},
                    {"error_median_m", quantile(row.errors_m, 0.5)},
                    {"trials_with_collision", row.collisions},
                    {"trials_with_seen_collision", row.seen_collisions},
                    {"cycle_p50_ms", quantile(row.cycle_ms, 0.5)},
                    {"cycle_p99_ms", quantile(row.cycle_ms, 0.99)}});
  }
  return Json{{"success_m", success_m}, {"rows", rows}}.dump(2) + "\n";
}

std::string navigation_suite_markdown(std::span<const NavigationTrial> trials, double success_m) {
  const auto joined = [](const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) {
      line += " " + cell + " |";
    }
    return line + "\n";
  };
  std::string text = joined(heads()) + joined(std::vector<std::string>(heads().size(), "---"));
  for (const Row& row : rows_of(trials, success_m)) {
    text += joined(cells_of(row));
  }
  return text;
}

std::string navigation_suite_html(std::span<const NavigationTrial> trials, double success_m) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows_of(trials, success_m)) {
    lines.push_back(cells_of(row));
  }
  return detail::open_page("Ablation: navigation") +
         "<header><h1>Ablation: navigation</h1><p class=\"note\">Success: the robot stops within " +
         fixed(success_m, 2) +
         " m of the goal. Rates with 95 % Wilson intervals. SPL: success weighted by shortest over "
         "driven way.</p></header><main>" +
         detail::section("Drives to a goal in a drawing", detail::results_table(heads(), lines)) +
         "</main>" + detail::close_page();
}

}  // namespace sketchloc
