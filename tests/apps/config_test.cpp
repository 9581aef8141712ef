#include "apps/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <span>

#include "motion/validate.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

enum class Method { Mcl, Icp };
std::span<const std::pair<std::string_view, Method>> names_of(Method) {
  static constexpr std::array<std::pair<std::string_view, Method>, 2> kNames = {
      {{"mcl", Method::Mcl}, {"icp", Method::Icp}}};
  return kNames;
}

struct Beams {
  double sigma_log = 0.3;
  int count = 60;
  bool operator==(const Beams&) const = default;
};
template <typename Visitor>
void visit_fields(Beams& beams, Visitor&& visit) {
  visit("sigma_log", beams.sigma_log);
  visit("count", beams.count);
}
void validate(const Beams& beams) { require_above("sigma_log", beams.sigma_log, 0.0); }

struct Settings {
  std::uint64_t particles = 2000;
  Beams beams;
  std::optional<double> px_per_m;
  Method method = Method::Mcl;
  bool recover = true;
  std::string title = "a run";
  bool operator==(const Settings&) const = default;
};
template <typename Visitor>
void visit_fields(Settings& settings, Visitor&& visit) {
  visit("particles", settings.particles);
  visit("beams", settings.beams);
  visit("px_per_m", settings.px_per_m);
  visit("method", settings.method);
  visit("recover", settings.recover);
  visit("title", settings.title);
}

class Config : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& yaml) const {
    std::ofstream(folder_ / "tune.yaml") << yaml;
    return folder_ / "tune.yaml";
  }
  Settings read(const std::string& yaml) const {
    return from_config<Settings>(overlaid(to_config(Settings{}), read_config(write(yaml))));
  }
  std::string error_of(const std::string& yaml) const {
    try {
      read(yaml);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(Config, WritesEveryFieldByItsNameInItsOrder) {
  EXPECT_EQ(to_yaml(to_config(Settings{})),
            "particles: 2000\n"
            "beams:\n"
            "  sigma_log: 0.3\n"
            "  count: 60\n"
            "px_per_m: none\n"
            "method: mcl\n"
            "recover: true\n"
            "title: a run\n");
}

TEST_F(Config, ReadsBackWhatItWrote) {
  Settings settings;
  settings.beams.sigma_log = 0.1 + 0.2;  // needs all its digits
  settings.px_per_m = 1e-300;
  settings.method = Method::Icp;
  settings.recover = false;
  settings.title = "true: \"it's\" # not a comment\nsecond line";
  settings.particles = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(read(to_yaml(to_config(settings))), settings);
}

TEST_F(Config, KeepsTheDefaultsOfWhatTheFileLeavesOut) {
  const Settings settings = read("beams:\n  count: 30\n");
  EXPECT_EQ(settings.beams.count, 30);
  EXPECT_EQ(settings.beams.sigma_log, 0.3);
  EXPECT_EQ(read(""), Settings{});
}

TEST_F(Config, TakesTheParametersOfAnEarlierRun) {
  const Settings settings = read("sketchloc: {version: 1}\nseed: 3\nparameters: {particles: 7}\n");
  EXPECT_EQ(settings.particles, 7u);
}

TEST_F(Config, LetsTheLaterSourceWin) {
  ConfigNode flags;
  set_value(flags, "beams.count", {.text = "90", .source = "--beams.count"});
  const ConfigNode file = read_config(write("beams: {count: 30, sigma_log: 0.2}\n"));
  const auto settings =
      from_config<Settings>(overlaid(overlaid(to_config(Settings{}), file), flags));
  EXPECT_EQ(settings.beams, (Beams{.sigma_log = 0.2, .count = 90}));
}

TEST_F(Config, ListsThePathsOfItsValues) {
  EXPECT_THAT(value_paths(to_config(Settings{})),
              ElementsAre("particles", "beams.sigma_log", "beams.count", "px_per_m", "method",
                          "recover", "title"));
}

TEST_F(Config, LeavesOutWhatSomethingElseDecides) {
  const ConfigNode node = without(to_config(Settings{}), {"beams.count", "particles"});
  EXPECT_EQ(node.find("particles"), nullptr);
  EXPECT_EQ(node.find("beams")->find("count"), nullptr);
  EXPECT_NE(node.find("beams")->find("sigma_log"), nullptr);
}

TEST_F(Config, NamesAnUnknownParameterItsLineAndTheNearestKnownOne) {
  EXPECT_THAT(error_of("particles: 10\nbeams:\n  sigmalog: 1\n"),
              EndsWith("tune.yaml:3: unknown parameter beams.sigmalog; did you mean "
                       "beams.sigma_log?"));
  EXPECT_THAT(error_of("sigma_log: 0.2\n"), EndsWith("did you mean beams.sigma_log?"));
  EXPECT_THAT(error_of("partikles: 2\n"), EndsWith("did you mean particles?"));
}

TEST_F(Config, RefusesValuesOfTheWrongType) {
  EXPECT_THAT(error_of("beams:\n  sigma_log: wide\n"),
              EndsWith("tune.yaml:2: beams.sigma_log must be a number, but it is 'wide'"));
  EXPECT_THAT(error_of("beams: {count: 1.5}\n"), HasSubstr("must be a whole number"));
  EXPECT_THAT(error_of("particles: -1\n"), HasSubstr("a whole number, 0 or more"));
  EXPECT_THAT(error_of("particles: 99999999999999999999\n"), HasSubstr("a whole number"));
  EXPECT_THAT(error_of("recover: yes\n"), HasSubstr("true or false"));
  EXPECT_THAT(error_of("method: gps\n"), HasSubstr("must be mcl | icp, but it is 'gps'"));
  EXPECT_THAT(error_of("px_per_m: 3px\n"), HasSubstr("px_per_m must be a number"));
}

TEST_F(Config, PassesOnWhatValidateFindsWithTheLine) {
  EXPECT_THAT(error_of("title: x\nbeams:\n  count: 3\n  sigma_log: 0\n"),
              EndsWith("tune.yaml:4: beams.sigma_log must be finite and above 0, but it is 0"));
}

TEST_F(Config, RefusesValuesForGroupsAndGroupsForValues) {
  EXPECT_THAT(error_of("beams: 3\n"), HasSubstr("beams is a group of parameters, not a value"));
  EXPECT_THAT(error_of("particles: {a: 1}\n"), HasSubstr("particles is a value, not a group"));
  EXPECT_THAT(error_of("particles: [1, 2]\n"), HasSubstr("a list stands where"));
  EXPECT_THAT(error_of("just words\n"), HasSubstr("expected parameters like"));
}

TEST_F(Config, RefusesAKeyGivenTwiceAndBrokenYaml) {
  EXPECT_THAT(error_of("particles: 1\nparticles: 2\n"),
              EndsWith("tune.yaml:2: particles is given twice; keep one"));
  EXPECT_THAT(error_of("beams: {count: 1\n"), HasSubstr("tune.yaml:"));
  EXPECT_THROW(read_config(folder_ / "none.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
