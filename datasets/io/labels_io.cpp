#include "datasets/io/labels_io.hpp"

#include <array>
#include <string>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/csv_table.hpp"

namespace sketchloc {

std::vector<PlaceLabel> read_labels(const std::filesystem::path& csv) {
  std::vector<PlaceLabel> labels;
  for_each_csv_row(csv, {"index", "label_name"}, [&](const CsvRow& row) {
    if (row.index("index") != labels.size()) {
      row.fail("index", std::to_string(labels.size()),
               "give one row for each pose, in order, counted from 0");
    }
    constexpr std::array kLabels = {PlaceLabel::Rackspace, PlaceLabel::Corridor,
                                    PlaceLabel::Intersection, PlaceLabel::Intersection};
    labels.push_back(
        kLabels[row.choice("label_name", {"rackspace", "corridor", "intersection", "trisection"})]);
  });
  return labels;
}

void write_labels(const std::filesystem::path& csv, const std::vector<PlaceLabel>& labels) {
  std::string text = "index,label_name\n";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    text += std::to_string(i) + "," + std::string(name_of(labels[i])) + "\n";
  }
  write_atomically(csv, text);
}

}  // namespace sketchloc
