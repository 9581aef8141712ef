#include "eval/navigation_record.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

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
              {"cycle_processor_ms", trial.cycle_processor_ms},
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
    trial.cycle_processor_ms = json.at("cycle_processor_ms").get<std::vector<double>>();
    return trial;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("not a drive to a goal: ") + error.what());
  }
}

}  // namespace sketchloc
