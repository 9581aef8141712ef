#include "eval/navigation_page.hpp"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>

#include "eval/detail/canvas.hpp"
#include "eval/detail/drive_player.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/navigation_picture.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;
using detail::fixed;

/// With as many decimals as a picture can show; a number that is none is null, which the player
/// leaves out.
Json rounded(double value, double steps_per_unit) {
  return std::isfinite(value) ? Json(std::round(value * steps_per_unit) / steps_per_unit)
                              : Json(nullptr);
}

Json rounded(std::initializer_list<double> values, double steps_per_unit) {
  Json list = Json::array();
  for (const double value : values) {
    list.push_back(rounded(value, steps_per_unit));
  }
  return list;
}

Json json_of(const Eigen::Vector2d& point, double steps_per_unit) {
  return rounded({point.x(), point.y()}, steps_per_unit);
}

Json json_of(const std::vector<Eigen::Vector2d>& points, double steps_per_unit) {
  Json list = Json::array();
  for (const Eigen::Vector2d& point : points) {
    list.push_back(json_of(point, steps_per_unit));
  }
  return list;
}

Json json_of(const std::optional<Eigen::Matrix2d>& covariance) {
  return covariance ? rounded({(*covariance)(0, 0), (*covariance)(0, 1), (*covariance)(1, 1)}, 1e2)
                    : Json(nullptr);
}

constexpr double kOfMetres = 1e2;
constexpr double kOfPixels = 1e1;
constexpr double kOfPose = 1e3;  ///< a heading in rad, a scale in px/m

/// The letters are those of detail::drive_player(), told there.
Json json_of(const NavigationFrame& frame, const Deformation& sketch_from_world) {
  const Se2& world = frame.world_from_robot;
  const Sim2& sketch = frame.sketch_from_robot;
  return {{"w", rounded({world.x_m(), world.y_m(), world.yaw_rad()}, kOfPose)},
          {"s", rounded({sketch.x(), sketch.y(), sketch.yaw_rad(), sketch.scale()}, kOfPose)},
          {"t", json_of(sketch_from_world(world.translation()), kOfPixels)},
          {"c", json_of(frame.position_covariance_px2)},
          {"p", rounded(frame.localized_probability, 1e3)},
          {"doing", static_cast<int>(frame.doing)},
          {"hit", frame.collided},
          {"path", frame.path},
          {"g", json_of(frame.goal_in_robot, kOfMetres)},
          {"e", json_of(frame.seen_in_robot, kOfMetres)}};
}

Json json_of(const NavigationTask& task, const NavigationTrial& trial,
             const NavigationParams& params) {
  const MetricMap& map = task.building.map;
  const Sketch& sketch = task.drawing.sketch;
  Json paths = Json::array();
  for (const PathPoints& path : trial.paths_in_sketch) {
    paths.push_back(json_of(path, kOfPixels));
  }
  Json frames = Json::array();
  for (const NavigationFrame& frame : trial.frames) {
    frames.push_back(json_of(frame, task.drawing.sketch_from_world));
  }
  return {{"drawing_px", {sketch.width_px(), sketch.height_px()}},
          {"world_cells", {map.cells.width(), map.cells.height()}},
          {"cell_m", map.cell_m},
          {"origin_m", json_of(map.origin_in_world, 1e6)},
          {"goal_px", json_of(task.drawing.sketch_from_world(task.goal_in_world), kOfPixels)},
          {"goal_m", json_of(task.goal_in_world, kOfMetres)},
          {"success_m", params.success_m},
          {"radius_m", params.follower.body.radius_m},
          {"cycle_s", NavigationTrial::kCycle_s},
          {"doings",
           {"drives", "plans anew and drives on", "does not know where it is: looks around",
            "nothing free ahead: looks around", "stops, believing to be at the goal", "gives up"}},
          {"paths_px", paths},
          {"frames", frames}};
}

using Bgr = cv::Vec3b;
const Bgr kPaper(255, 255, 255);
const Bgr kInk(80, 80, 90);
const Bgr kGlass(230, 200, 150);
const Bgr kFurniture(120, 168, 200);

/// One px for each cell.
template <typename ColourAt>
std::string cells_png(const Grid<std::uint8_t>& cells, const ColourAt& colour_at) {
  cv::Mat3b image(cells.height(), cells.width());
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      image(row, column) = colour_at(Cell{column, image.rows - 1 - row});
    }
  }
  return detail::png_bytes(image);
}

std::string drawing_png(const Sketch& sketch) {
  return cells_png(sketch.occupied,
                   [&](const Cell& cell) { return sketch.occupied.at(cell) != 0 ? kInk : kPaper; });
}

/// Things that stand around have a colour of their own: most of them are in no drawing.
std::string building_png(const Building& building) {
  FloorPlan bare = building.plan;
  std::erase_if(bare.furniture, [](const Furniture& thing) { return !thing.structural; });
  const MetricMap walls = rasterise(bare, building.map.cell_m);
  return cells_png(building.map.cells, [&](const Cell& cell) {
    const std::uint8_t material = building.map.cells.at(cell);
    const bool stands_around =
        walls.cells.contains(cell) && walls.cells.at(cell) == MetricMap::Free;
    return material == MetricMap::Free    ? kPaper
           : material == MetricMap::Glass ? kGlass
           : stands_around                ? kFurniture
                                          : kInk;
  });
}

std::string verdict(const NavigationTrial& trial, double success_m) {
  const std::string end = trial.end == NavigationTrial::End::Arrived ? "The robot stopped, "
                          : trial.end == NavigationTrial::End::Stuck ? "The robot gave up, "
                                                                     : "The time was over, ";
  return end + fixed(trial.error_m, 2) + " m from the goal, after " + fixed(trial.way_m, 1) +
         " m of way (the shortest is " + fixed(trial.shortest_m, 1) + " m) and " +
         std::to_string(trial.collisions) + " collisions. Success is to stop within " +
         fixed(success_m, 2) + " m.";
}

}  // namespace

std::string drive_html(const NavigationTask& task, const NavigationTrial& trial,
                       const NavigationParams& params) {
  const bool success = trial.success(params.success_m);
  return detail::open_page("A drive to a goal in a drawing", detail::Scripts::OwnAlone) +
         "<header><h1>A drive to a goal in a drawing</h1><p class=\"note\">" +
         detail::escaped(task.set) + " &#183; " + detail::escaped(trial.method) +
         "</p></header><main><section class=\"verdict " + (success ? "located" : "lost") +
         "\"><h2>" + (success ? "Success" : "Failure") + "</h2><p>" +
         detail::escaped(verdict(trial, params.success_m)) + "</p></section>" +
         "<section><img style=\"width:100%\" alt=\"the drawing and the building with the way\" "
         "src=\"data:image/png;base64," +
         detail::base64(picture_png(task, trial)) +
         "\"/><p>Left: the drawing with the first plan (grey) and the way that the robot believes "
         "to have driven (green). Right: the building with the way that it drove.</p></section>" +
         detail::drive_player(json_of(task, trial, params).dump(), drawing_png(task.drawing.sketch),
                              building_png(task.building)) +
         "</main>" + detail::close_page();
}

}  // namespace sketchloc
