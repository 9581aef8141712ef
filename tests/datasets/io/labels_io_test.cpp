#include "datasets/io/labels_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Labels : public ::testing::Test {
 protected:
  std::vector<PlaceLabel> read(const std::string& content) const {
    std::ofstream(folder_ / "labels.csv") << content;
    return read_labels(folder_ / "labels.csv");
  }
  std::string complaint(const std::string& content) const {
    try {
      read(content);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  testing::TemporaryDirectory folder_;
};

TEST_F(Labels, AreReadByNameWhateverTheOtherColumns) {
  EXPECT_THAT(read("index,label,label_name\n0,0,rackspace\n1,1,corridor\n2,2,trisection\n"
                   "3,3,intersection\n"),
              ElementsAre(PlaceLabel::Rackspace, PlaceLabel::Corridor, PlaceLabel::Intersection,
                          PlaceLabel::Intersection));
}

TEST_F(Labels, ComeBackAsTheyWereWritten) {
  const std::vector<PlaceLabel> labels = {PlaceLabel::Intersection, PlaceLabel::Rackspace};
  write_labels(folder_ / "labels.csv", labels);
  EXPECT_EQ(read_labels(folder_ / "labels.csv"), labels);
}

TEST_F(Labels, ThatAreUnknownAreRefusedByLine) {
  EXPECT_THAT(complaint("index,label_name\n0,corridor\n1,kitchen\n"),
              AllOf(HasSubstr("labels.csv:3"), HasSubstr("kitchen"), HasSubstr("rackspace")));
}

TEST_F(Labels, OutOfOrderAreRefused) {
  EXPECT_THAT(complaint("index,label_name\n0,corridor\n2,corridor\n"),
              AllOf(HasSubstr("labels.csv:3"), HasSubstr("counted from 0")));
}

TEST_F(Labels, WithoutNamesAreRefused) {
  EXPECT_THAT(complaint("index,label\n0,1\n"), HasSubstr("label_name"));
  EXPECT_THAT(complaint(""), HasSubstr("labels.csv"));
}

TEST(PlaceLabel, HasNames) {
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    EXPECT_EQ(name_of(label), name);
    EXPECT_EQ(place_label(name), label);
  }
  EXPECT_EQ(place_label("trisection"), PlaceLabel::Intersection);
  EXPECT_EQ(place_label("kitchen"), std::nullopt);
}

}  // namespace
}  // namespace sketchloc
