// Public pose graphs whose optimum is known or whose truth is.

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "datasets/io/g2o_io.hpp"
#include "eval/graph_record.hpp"
#include "eval/wrong_loops.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/graph/optimise.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

class PublicGraphsEndToEnd : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Graphs, PublicGraphsEndToEnd,
                         ::testing::Values(std::pair("manhattan3500.g2o", 146.077),
                                           std::pair("city10000.g2o.gz", 511.985)));

TEST_P(PublicGraphsEndToEnd, EndAtTheKnownOptimumFromAllStarts) {
  const auto& [name, known] = GetParam();
  const auto file = testing::shared_data(std::filesystem::path("pose_graphs") / name);
  if (!file) {
    GTEST_SKIP() << "needs the pose graphs of the development data";
  }
  const PoseGraph graph = read_g2o(*file);
  for (const PoseGraph& begun : {graph, with_poses(graph, dead_reckoning(graph))}) {
    for (const GraphStart initial : {GraphStart::Given, GraphStart::Linear}) {
      EXPECT_NEAR(optimise(begun, {.initial = initial}).chi2, known, 1e-3);
    }
  }
}

TEST(WrongLoopsEndToEnd, HalfOfManhattansAreTakenForWrongWhateverThePoses) {
  const auto file = testing::shared_data("pose_graphs/manhattan3500.g2o");
  if (!file) {
    GTEST_SKIP() << "needs the pose graphs of the development data";
  }
  const PoseGraph clean = read_g2o(*file);
  const PoseGraph optimum = with_poses(clean, optimise(clean).poses);
  Rng rng = make_rng(4);
  const PoseGraph graph = with_wrong_loops(clean, 0.5, rng);
  for (const PoseGraph& begun : {graph, with_poses(graph, dead_reckoning(graph))}) {
    const OptimiseResult result = optimise(begun, {.kernel = {.shape = KernelShape::Graduated}});
    const std::optional<double> rmse_m = position_rmse_m(with_poses(graph, result.poses), optimum);
    EXPECT_LT(rmse_m.value(), 0.05);
  }
}

}  // namespace
}  // namespace sketchloc
