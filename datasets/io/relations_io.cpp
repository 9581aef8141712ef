#include "datasets/io/relations_io.hpp"

#include <cmath>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/line_reader.hpp"

namespace sketchloc {
namespace {

using detail::Columns;
using detail::Place;

constexpr double kOutOfPlaneTolerance = 1e-3;  ///< m and rad

void expect_zero(Columns& columns, std::string_view field) {
  const double value = columns.number(field, detail::kMostPosition_m);
  if (std::abs(value) > kOutOfPlaneTolerance) {
    detail::fail_expected(columns.place(), field, "0, a motion in the plane", std::to_string(value),
                          "remove the line");
  }
}

Relation parse_relation(std::string_view line, const Place& place) {
  Columns columns = Columns::blank_separated(line, place);
  Relation relation;
  relation.first_time_s = columns.number("t1", detail::kMostTime_s);
  relation.second_time_s = columns.number("t2", detail::kMostTime_s);
  const double x_m = columns.number("dx", detail::kMostPosition_m);
  const double y_m = columns.number("dy", detail::kMostPosition_m);
  expect_zero(columns, "dz");
  expect_zero(columns, "roll");
  expect_zero(columns, "pitch");
  relation.first_from_second =
      Se2::from_xy_yaw(x_m, y_m, columns.number("yaw", detail::kMostAngle_rad));
  columns.expect_end();
  return relation;
}

}  // namespace

std::vector<Relation> read_relations(const std::filesystem::path& relations) {
  std::vector<Relation> list;
  detail::for_each_data_line(relations, [&list](std::string_view line, const Place& place) {
    list.push_back(parse_relation(line, place));
  });
  if (list.empty()) {
    detail::fail({.file = relations},
                 "relations: expected lines of t1 t2 dx dy dz roll pitch yaw, found none");
  }
  return list;
}

}  // namespace sketchloc
