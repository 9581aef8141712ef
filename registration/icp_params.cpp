#include <stdexcept>
#include <string>

#include "motion/validate.hpp"
#include "registration/icp_predictor.hpp"

namespace sketchloc {

void validate(const IcpParams& params) {
  require_above("side_m", params.side_m, 0.0);
  require_at_least("max_scans", params.max_scans, 1);
  require_at_least("max_gap_m", params.max_gap_m, 0.0);
  require_above("voxel_m", params.voxel_m, 0.0);
  require_in_range("layers", params.layers, 1, 99);
  if (params.layers % 2 == 0) {
    throw std::invalid_argument("layers: expected an odd number, found " +
                                std::to_string(params.layers));
  }
  require_above("normal_radius_m", params.normal_radius_m, 0.0);
  require_above("feature_radius_m", params.feature_radius_m, 0.0);
  require_above("tuple_scale", params.tuple_scale, 0.0);
  require_in_range("tuple_scale", params.tuple_scale, 0.0, 1.0);
  require_at_least("tuples", params.tuples, 1);
  require_above("icp_distance_m", params.icp_distance_m, 0.0);
  require_at_least("icp_iterations", params.icp_iterations, 1);
}

}  // namespace sketchloc
