// Writes reports of made-up runs for looking at them: report_sample FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "eval/picture.hpp"
#include "eval/report.hpp"
#include "tests/eval/synthetic_run.hpp"

namespace {

void write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

void write_sample(const std::filesystem::path& folder, const std::string& name,
                  const sketchloc::RunRecord& record) {
  write(folder / (name + ".html"), sketchloc::report_html(record));
  write(folder / (name + ".png"), sketchloc::picture_png(record));
}

}  // namespace

int main(int argument_count, char** arguments) {
  using sketchloc::testing::make_synthetic_run;
  using sketchloc::testing::Outcome;
  if (argument_count != 2) {
    std::cerr << "usage: report_sample FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  write_sample(folder, "located", make_synthetic_run(Outcome::Located));
  write_sample(folder, "recovered", make_synthetic_run(Outcome::Recovered));
  write_sample(folder, "lost", make_synthetic_run(Outcome::Lost));
  sketchloc::RunRecord without_reference = make_synthetic_run(Outcome::Located);
  without_reference.reference.reset();
  write_sample(folder, "without_reference", without_reference);
  return 0;
}
