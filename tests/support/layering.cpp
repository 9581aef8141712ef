#include "tests/support/layering.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <sstream>

namespace sketchloc::testing {
namespace {

namespace fs = std::filesystem;

/// One row of the floor plan in docs/architecture.md, which a test compares with it.
struct Folder {
  std::string name;
  std::vector<std::string> may_include;      ///< other folders of ours
  std::vector<std::string> heavy_libraries;  ///< names of kLibraries, in .cpp files only
};

const std::vector<std::string> kAllButApps = {
    "motion",        "motion/graph", "datasets",           "datasets/io",
    "datasets/sim",  "registration", "registration/train", "filter",
    "filter/online", "planning",     "smoothing",          "topology"};

std::vector<std::string> all_but_apps_and(std::initializer_list<std::string> more) {
  std::vector<std::string> folders = kAllButApps;
  folders.insert(folders.end(), more);
  return folders;
}

const std::vector<Folder>& floor_plan() {
  static const std::vector<Folder> plan = {
      {"motion", {}, {}},
      {"motion/graph", {"motion"}, {"suitesparse"}},
      {"datasets", {"motion"}, {}},
      {"datasets/io", {"motion", "datasets"}, {"opencv", "json", "yaml", "zlib"}},
      {"datasets/sim", {"motion", "datasets", "registration"}, {}},
      {"registration", {"motion", "datasets"}, {"highway", "opencv", "open3d"}},
      {"registration/train",
       {"motion", "datasets", "registration", "datasets/sim", "topology"},
       {"torch", "onnx"}},
      {"filter", {"motion", "datasets", "registration"}, {"highway"}},
      {"filter/online", {"motion", "datasets", "registration", "filter"}, {}},
      {"planning", {"motion", "datasets", "registration"}, {"ompl"}},
      {"smoothing", {"motion", "motion/graph", "datasets", "registration"}, {}},
      {"topology", {"motion", "motion/graph", "datasets", "registration"}, {}},
      {"eval", kAllButApps, {"opencv", "json"}},
      {"eval/bench", all_but_apps_and({"eval", "tests"}), {"benchmark", "highway"}},
      {"apps", all_but_apps_and({"eval"}), {"cli11", "spdlog", "yaml", "json", "mpi"}},
      {"tests",
       all_but_apps_and({"eval", "apps"}),
       {"googletest", "opencv", "torch", "json", "yaml", "zlib", "highway", "cli11", "ceres"}},
  };
  return plan;
}

/// How the headers of a library begin.
struct Library {
  std::string_view name;
  std::string_view prefix;
};
constexpr std::array<Library, 20> kLibraries = {{{"opencv", "opencv2/"},
                                                 {"json", "nlohmann/"},
                                                 {"yaml", "yaml-cpp/"},
                                                 {"zlib", "zlib.h"},
                                                 {"highway", "hwy/"},
                                                 {"cli11", "CLI/"},
                                                 {"spdlog", "spdlog/"},
                                                 {"httplib", "httplib.h"},
                                                 {"ceres", "ceres/"},
                                                 {"suitesparse", "suitesparse/"},
                                                 {"suitesparse", "cholmod.h"},
                                                 {"ompl", "ompl/"},
                                                 {"torch", "torch/"},
                                                 {"torch", "ATen/"},
                                                 {"onnx", "onnx/"},
                                                 {"open3d", "open3d/"},
                                                 {"mpi", "mpi.h"},
                                                 {"benchmark", "benchmark/"},
                                                 {"googletest", "gtest/"},
                                                 {"googletest", "gmock/"}}};

bool contains(std::span<const std::string> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// The row of the floor plan that a path belongs to: the longest folder that it starts with.
const Folder* folder_of(std::string_view path) {
  const Folder* found = nullptr;
  for (const Folder& folder : floor_plan()) {
    if (path.starts_with(folder.name + "/") &&
        (found == nullptr || found->name.size() < folder.name.size())) {
      found = &folder;
    }
  }
  return found;
}

/// Nothing, or the rule that an #include "target" in `file` breaks.
std::optional<std::string> own_include_breaks(const std::string& file, const Folder& from,
                                              const std::string& target, const fs::path& root) {
  const Folder* to = folder_of(target);
  if (to == nullptr || !fs::exists(root / target)) {
    return "quoted includes start at the root and name one of our headers";
  }
  if (to != &from && !contains(from.may_include, to->name)) {
    return from.name + "/ may not include " + to->name + "/";
  }
  const bool in_detail = target.starts_with(to->name + "/detail/");
  const bool at_home = &from == to || file.starts_with("tests/" + to->name + "/");
  if (in_detail && !at_home) {
    return to->name + "/detail/ belongs to " + to->name + "/ alone";
  }
  return std::nullopt;
}

/// Nothing, or the rule that an #include <target> in `file` breaks.
std::optional<std::string> system_include_breaks(const std::string& file, const Folder& from,
                                                 const std::string& target) {
  const bool standard = target.find_first_of("./") == std::string::npos;
  if (standard || target.starts_with("Eigen/")) {
    return std::nullopt;
  }
  const bool test_code = from.name == "tests" || from.name == "eval/bench";
  const bool public_header =
      file.ends_with(".hpp") && file.find("/detail/") == std::string::npos && !test_code;
  const bool image_exception = from.name == "datasets/io" && target == "opencv2/core/mat.hpp";
  if (public_header && !image_exception) {
    return "public headers include only the standard library, Eigen and our own";
  }
  for (const Library& library : kLibraries) {
    if (target.starts_with(library.prefix) && !contains(from.heavy_libraries, library.name)) {
      return from.name + "/ does not use " + std::string(library.name);
    }
  }
  return std::nullopt;
}

struct Include {
  std::string target;
  bool quoted = false;
};

/// The include of a line such as `#  include <vector>`; none on other lines.
std::optional<Include> include_in(std::string_view line) {
  for (const std::string_view word : {"#", "include"}) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(word)) {
      return std::nullopt;
    }
    line.remove_prefix(word.size());
  }
  const std::size_t open = line.find_first_of("\"<");
  const std::size_t close = open == line.npos ? line.npos : line.find_first_of("\">", open + 1);
  if (close == line.npos) {
    return std::nullopt;
  }
  return Include{std::string(line.substr(open + 1, close - open - 1)), line[open] == '"'};
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

/// Which folders a folder may include, in words: long lists by what is missing in them.
std::string may_include_text(const Folder& folder) {
  constexpr std::size_t kLongList = 8;
  if (folder.may_include.size() < kLongList) {
    return joined(folder.may_include);
  }
  std::vector<std::string> missing;
  for (const Folder& other : floor_plan()) {
    if (&other != &folder && !contains(folder.may_include, other.name)) {
      missing.push_back(other.name);
    }
  }
  return "all but " + joined(missing);
}

/// A library as the documentation spells it.
std::string spelling(const std::string& library) {
  static const std::map<std::string, std::string> kSpellings = {{"opencv", "OpenCV"},
                                                                {"json", "JSON"},
                                                                {"yaml", "YAML"},
                                                                {"zlib", "zlib"},
                                                                {"highway", "Highway"},
                                                                {"cli11", "CLI11"},
                                                                {"mpi", "MPI"},
                                                                {"spdlog", "spdlog"},
                                                                {"ceres", "Ceres"},
                                                                {"suitesparse", "SuiteSparse"},
                                                                {"ompl", "OMPL"},
                                                                {"torch", "libtorch"},
                                                                {"onnx", "libonnx"},
                                                                {"open3d", "Open3D"},
                                                                {"benchmark", "Google Benchmark"},
                                                                {"googletest", "GoogleTest"}};
  return kSpellings.at(library);
}

}  // namespace

std::vector<FloorPlanRow> floor_plan_rows() {
  std::vector<FloorPlanRow> rows;
  for (const Folder& folder : floor_plan()) {
    std::vector<std::string> libraries;
    std::ranges::transform(folder.heavy_libraries, std::back_inserter(libraries), spelling);
    rows.push_back({folder.name, may_include_text(folder), joined(libraries)});
  }
  return rows;
}

std::vector<LayeringViolation> layering_violations(std::string_view source, const std::string& file,
                                                   const fs::path& root) {
  const Folder* from = folder_of(file);
  if (from == nullptr) {
    return {{file, 1, "the folder is not on the floor plan"}};
  }
  std::vector<LayeringViolation> violations;
  std::istringstream lines{std::string(source)};
  std::string text;
  for (int line = 1; std::getline(lines, text); ++line) {
    const std::optional<Include> include = include_in(text);
    if (!include) {
      continue;
    }
    const std::optional<std::string> broken =
        include->quoted ? own_include_breaks(file, *from, include->target, root)
                        : system_include_breaks(file, *from, include->target);
    if (broken) {
      violations.push_back({file, line, include->target + ": " + *broken});
    }
  }
  return violations;
}

std::vector<LayeringViolation> layering_violations(const fs::path& root) {
  std::vector<LayeringViolation> violations;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
    const std::string file = entry->path().lexically_relative(root).generic_string();
    const bool ours = !file.starts_with(".") && file != "build" && file != "out" &&
                      file != "tests/consumer";  // the consumer is a project of its own
    if (entry->is_directory() && !ours) {
      entry.disable_recursion_pending();
    }
    if (!entry->is_regular_file() || !(file.ends_with(".hpp") || file.ends_with(".cpp"))) {
      continue;
    }
    std::ifstream stream(entry->path());
    std::ostringstream source;
    source << stream.rdbuf();
    const std::vector<LayeringViolation> found = layering_violations(source.str(), file, root);
    violations.insert(violations.end(), found.begin(), found.end());
  }
  return violations;
}

}  // namespace sketchloc::testing
