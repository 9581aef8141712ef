#include "eval/plan_record.hpp"

#include <nlohmann/json.hpp>

#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;
using detail::fixed;

Json json_of(const PathFigures& figures) {
  return {{"length_m", figures.length_m},
          {"cost_m", figures.cost_m},
          {"least_clearance_m", figures.least_clearance_m},
          {"mean_clearance_m", figures.mean_clearance_m},
          {"crossings", figures.crossings}};
}

Json json_of(const Eigen::Vector2d& point) { return {point.x(), point.y()}; }

std::string verdict(const PlanRecord& record) {
  const PathFigures& figures = record.plan.figures;
  if (record.plan.found()) {
    return std::string(name_of(record.plan.status)) + ": " + fixed(figures.length_m, 1) +
           " m, at least " + fixed(figures.least_clearance_m, 2) + " m from strokes";
  }
  std::string text(name_of(record.plan.status));
  if (const auto& nearest = record.plan.nearest_free_in_sketch) {
    text += "; the robot fits at " + fixed(nearest->x(), 1) + ", " + fixed(nearest->y(), 1);
  }
  return text;
}

std::string stage_table(const PlanRecord& record) {
  std::vector<std::vector<std::string>> lines;
  for (const PlanStage& stage : record.stages) {
    lines.push_back({std::string(name_of(stage.source)), fixed(stage.ms, 1),
                     fixed(stage.figures.length_m, 2), fixed(stage.figures.cost_m, 2),
                     fixed(stage.figures.least_clearance_m, 2)});
  }
  return detail::results_table({"found by", "ms", "length m", "cost m", "least clearance m"},
                               lines);
}

}  // namespace

std::string to_json(const PlanRecord& record) {
  Json stages = Json::array();
  for (const PlanStage& stage : record.stages) {
    Json json = {{"source", name_of(stage.source)}, {"ms", stage.ms}};
    json.update(json_of(stage.figures));
    stages.push_back(json);
  }
  Json path = Json::array();
  for (const Eigen::Vector2d& point : record.plan.path_in_sketch) {
    path.push_back(json_of(point));
  }
  Json json = {{"status", name_of(record.plan.status)}, {"found", record.plan.found()}};
  json.update(json_of(record.plan.figures));
  const auto& nearest = record.plan.nearest_free_in_sketch;
  json["nearest_free_px"] = nearest ? json_of(*nearest) : Json(nullptr);
  json["kept_clear_m"] = record.params.body.clear_m();
  json["prepare_ms"] = record.prepare_ms;
  json["first_path_ms"] = record.stages.empty() ? Json(nullptr) : Json(record.stages.front().ms);
  json["ms"] = record.ms;
  json["stages"] = stages;
  json["path_px"] = path;
  return json.dump(2) + "\n";
}

std::string path_csv(const PlanRecord& record) {
  std::string text = "x_px,y_px,way_m,clearance_m,px_per_m\n";
  const PathPoints& path = record.plan.path_in_sketch;
  double way_m = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    way_m += i == 0 ? 0.0 : record.space.length_m(path[i - 1], path[i]);
    append_number(text, path[i].x());
    for (const double value :
         {path[i].y(), way_m, record.space.clearance_m(path[i]), record.space.px_per_m(path[i])}) {
      text += ",";
      append_number(text, value);
    }
    text += "\n";
  }
  return text;
}

std::string report_html(const PlanRecord& record) {
  return detail::open_page("A way in a drawing") +
         "<header><h1>A way in a drawing</h1><p class=\"note\">" +
         detail::escaped(verdict(record)) + "</p></header><main>" +
         "<section><img style=\"width:100%\" alt=\"the way over the drawing\" src=\"data:image/"
         "png;base64," +
         detail::base64(picture_png(record)) +
         "\"/><p>Discs: the robot and what is kept clear around it. Green: room to spare; yellow: "
         "less than twice what is kept clear; red: the way crosses a stroke. Grey: where the "
         "robot does not fit.</p></section>" +
         detail::section("Better and better", stage_table(record)) + "</main>" +
         detail::close_page();
}

}  // namespace sketchloc
