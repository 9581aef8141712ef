#pragma once

#include "datasets/sim/building.hpp"
#include "datasets/sim/drive.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/odometry_model.hpp"
#include "datasets/sim/person.hpp"

namespace sketchloc {

/// All parameters; the person's are those of --person where nothing else is said.
struct GenerateParams {
  PersonParams person = human_person();
  DriveParams drive;
  LidarModel lidar;
  OdometryModel odometry;
  MapReadingParams map_reading;
};

template <typename Visitor>
void visit_fields(GenerateParams& params, Visitor&& visit) {
  visit("person", params.person);
  visit("drive", params.drive);
  visit("lidar", params.lidar);
  visit("odometry", params.odometry);
  visit("map_reading", params.map_reading);
}

}  // namespace sketchloc
