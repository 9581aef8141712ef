#include "filter/recovery.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sketchloc {
namespace {

TEST(EvidenceMonitor, InjectsNothingWhileTheEvidenceIsSteady) {
  EvidenceMonitor monitor({.base_share = 0.0});
  EXPECT_EQ(monitor.injection_share(), 0.0);
  for (int step = 0; step < 100; ++step) {
    monitor.add(-0.4, 0.5);
  }
  EXPECT_EQ(monitor.injection_share(), 0.0);
}

TEST(EvidenceMonitor, InjectsMoreTheWorseTheEvidenceGets) {
  const RecoveryParams params{.max_share = 0.5, .base_share = 0.01};
  EvidenceMonitor slightly(params);
  EvidenceMonitor badly(params);
  for (EvidenceMonitor* monitor : {&slightly, &badly}) {
    monitor->add(-0.3, 1.0);
  }
  slightly.add(-0.35, 2.0);
  badly.add(-0.6, 2.0);
  EXPECT_GT(slightly.injection_share(), 0.01);
  EXPECT_GT(badly.injection_share(), slightly.injection_share());
}

TEST(EvidenceMonitor, NeverInjectsMoreThanItsLimit) {
  EvidenceMonitor monitor({.max_share = 0.05});
  monitor.add(-0.1, 1.0);
  monitor.add(-50.0, 100.0);
  EXPECT_EQ(monitor.injection_share(), 0.05);
}

TEST(RecoveryParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(RecoveryParams{.slow_way_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(RecoveryParams{.max_share = 0.9}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
