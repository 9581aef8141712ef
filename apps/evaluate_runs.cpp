#include "apps/evaluate_runs.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "eval/run_metrics.hpp"
#include "eval/table.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// The runs of one method on one data set, by the name of their folder, which is that of the seed.
struct NamedRuns {
  std::string data_set;
  std::string method;
  std::map<std::string, SketchErrors> runs;
};

NamedRuns read_runs(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder / "").lexically_normal().parent_path();
  if (!fs::is_directory(whole)) {
    throw std::runtime_error(folder.string() + ": is no folder of runs");
  }
  NamedRuns found{.data_set = whole.parent_path().filename().string(),
                  .method = whole.filename().string(),
                  .runs = {}};
  for (const fs::directory_entry& entry : fs::directory_iterator(whole)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && !name.starts_with(".")) {
      found.runs.emplace(name, read_run_errors(entry.path() / "metrics.json"));
    }
  }
  if (found.runs.empty()) {
    throw std::runtime_error(folder.string() +
                             ": has no folders of runs in it; give the folder above those of the "
                             "seeds");
  }
  return found;
}

RunSet run_set(const NamedRuns& named) {
  RunSet set{.data_set = named.data_set, .method = named.method, .runs = {}};
  for (const auto& [name, errors] : named.runs) {
    set.runs.push_back(errors);
  }
  return set;
}

/// One line of the paired differences in the share within 2 m.
std::string difference_line(const NamedRuns& row, const NamedRuns& base) {
  std::vector<double> percent;
  std::vector<double> base_percent;
  for (const auto& [name, errors] : row.runs) {
    const auto same = base.runs.find(name);
    if (same != base.runs.end()) {
      percent.push_back(100.0 * errors.share_within_2_m);
      base_percent.push_back(100.0 * same->second.share_within_2_m);
    }
  }
  const std::string head =
      fmt::format("| {} | {} | {} |", row.data_set, row.method, percent.size());
  if (percent.empty()) {
    return head + " - |\n";
  }
  Rng rng = make_rng(1);
  const Interval interval = paired_interval(percent, base_percent, {}, rng);
  const double mean = (std::accumulate(percent.begin(), percent.end(), 0.0) -
                       std::accumulate(base_percent.begin(), base_percent.end(), 0.0)) /
                      static_cast<double>(percent.size());
  return head + fmt::format(" {:+.1f} [{:+.1f}, {:+.1f}] |\n", mean, interval.low, interval.high);
}

}  // namespace

std::string runs_table(std::span<const fs::path> folders, const std::optional<fs::path>& against) {
  std::vector<NamedRuns> rows;
  std::vector<RunSet> sets;
  for (const fs::path& folder : folders) {
    rows.push_back(read_runs(folder));
    sets.push_back(run_set(rows.back()));
  }
  std::string text = table_markdown(summarize_runs(sets));
  if (against) {
    const NamedRuns base = read_runs(*against);
    text += fmt::format(
        "\n| data | method | pairs | within 2 m, difference to {} in % |\n|---|---|---|---|\n",
        base.method);
    for (const NamedRuns& row : rows) {
      text += difference_line(row, base);
    }
  }
  return text;
}

}  // namespace sketchloc
