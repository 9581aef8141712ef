#include <stdexcept>

#include "registration/icp_predictor.hpp"

namespace sketchloc {

/// Stands in where the library is built without Open3D.
bool icp_is_built() { return false; }

std::unique_ptr<WarpPredictor> make_icp_predictor(const IcpParams& params) {
  validate(params);
  throw std::runtime_error(
      "this program was built without ICP; install libopen3d-dev and configure with "
      "-D SKETCHLOC_OPEN3D=ON");
}

}  // namespace sketchloc
