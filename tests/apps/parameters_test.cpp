#include <gtest/gtest.h>

#include <string_view>
#include <type_traits>
#include <typeinfo>

#include "apps/config.hpp"
#include "apps/generate_params.hpp"
#include "datasets/sim/building.hpp"
#include "datasets/sim/drive.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/odometry_model.hpp"
#include "datasets/sim/person.hpp"
#include "eval/localization.hpp"
#include "eval/registration_suite.hpp"
#include "filter/localizer.hpp"
#include "motion/odometry.hpp"
#include "registration/icp_predictor.hpp"
#include "registration/matched_odometry.hpp"
#include "registration/network_predictor.hpp"
#include "registration/train/sample_source.hpp"
#include "tests/support/field_count.hpp"

namespace sketchloc {
namespace {

/// Every parameter struct that a command reads, the ones inside others by themselves.
template <typename T>
class Parameters : public ::testing::Test {};
using ParameterStructs = ::testing::Types<
    OdometryNoise, PersonParams, DriveParams, LidarModel, OdometryModel, MapReadingParams,
    PredictParams, BeamModelParams, EndPointModelParams, KldParams, ModeParams, MotionGate,
    StartSpread, RecoveryParams, RangeTableParams, MatchedOdometryParams, LocalizerParams,
    LocalizationParams, GenerateParams, SceneParams, PriorError, SampleParams, SampleSourceParams,
    IcpParams, RecentScansParams, RegistrationSuiteParams, RegistrationSetParams,
    NetworkPredictorParams, KeyframeParams, DrawingWalk, SmoothingParams, SmoothingPlan>;
TYPED_TEST_SUITE(Parameters, ParameterStructs);

template <ParameterStruct T>
void expect_all_fields_visited() {
  T parameters;
  std::size_t visited = 0;
  visit_fields(parameters, [&visited]<typename Field>(std::string_view, Field&) {
    ++visited;
    if constexpr (ParameterStruct<Field>) {
      expect_all_fields_visited<Field>();
    }
  });
  constexpr std::size_t kNotTuning = std::is_same_v<T, LocalizerParams> ? 2 : 0;  // seed and jobs
  EXPECT_EQ(visited + kNotTuning, testing::field_count<T>()) << typeid(T).name();
}

TYPED_TEST(Parameters, VisitEveryField) { expect_all_fields_visited<TypeParam>(); }

TYPED_TEST(Parameters, AreValidByDefaultAndSurviveTheirText) {
  const ConfigNode written = to_config(TypeParam{});
  const TypeParam read = from_config<TypeParam>(written);
  EXPECT_EQ(to_yaml(to_config(read)), to_yaml(written));
}

}  // namespace
}  // namespace sketchloc
