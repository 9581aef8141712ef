#pragma once

#include <optional>
#include <span>

#include "datasets/scan.hpp"
#include "motion/pose_graph.hpp"
#include "registration/scan_matcher.hpp"
#include "registration/surface_points.hpp"
#include "topology/same_place.hpp"
#include "topology/travel.hpp"

namespace sketchloc {

/// When the scans of two passes of a place say how these lie to each other.
struct ScanClosureParams {
  SurfaceParams surface = {};
  ScanMatchParams match = {};
  double submap_way_m = 3.0;         ///< scans so far before and after a pose make its submap, > 0
  double submap_spacing_m = 0.5;     ///< way between these scans, > 0
  double search_radius_m = 1.0;      ///< reach of the nearest-neighbour look-up, > 0
  double merge_cell_m = 0.06;        ///< points of a submap are merged within this, > 0
  double along_sigma_m = 0.5;        ///< of the passes' offset along their axis, beforehand, > 0
  double across_sigma_m = 0.5;       ///< the same across, > 0
  double heading_sigma_deg = 5.0;    ///< > 0
  double least_matched_share = 0.6;  ///< of the later submap's points; else they do not fit, [0, 1]
  double least_sigma_m = 0.1;        ///< of the measured offset: submaps err together, > 0
  double least_sigma_deg = 1.0;      ///< > 0
};
void validate(const ScanClosureParams& params);

template <typename Visitor>
void visit_fields(ScanClosureParams& params, Visitor&& visit) {
  visit("surface", params.surface);
  visit("match", params.match);
  visit("submap_way_m", params.submap_way_m);
  visit("submap_spacing_m", params.submap_spacing_m);
  visit("search_radius_m", params.search_radius_m);
  visit("merge_cell_m", params.merge_cell_m);
  visit("along_sigma_m", params.along_sigma_m);
  visit("across_sigma_m", params.across_sigma_m);
  visit("heading_sigma_deg", params.heading_sigma_deg);
  visit("least_matched_share", params.least_matched_share);
  visit("least_sigma_m", params.least_sigma_m);
  visit("least_sigma_deg", params.least_sigma_deg);
}

/// A drive with what was seen on it, where it lies by now.
struct SeenRun {
  std::span<const Scan> scans;  ///< one for each pose
  std::span<const Se2> manhattan_from_robot;
  const Travel& travel;
};

/// Lays the scans around the later pass onto those around the earlier one by point-to-line ICP: a
/// loop closure between the two poses side by side that are typical of the pair. None where they do
/// not fit: the places differ, or one of them sees too little. Along a bare aisle the scans say
/// little; then the edge says little.
std::optional<GraphEdge> close_by_scans(const SeenRun& run, const SamePlacePair& pair,
                                        const ScanClosureParams& params);

}  // namespace sketchloc
