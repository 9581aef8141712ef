// What the documents say about the project: links, papers, flags of the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

const fs::path kRoot = SKETCHLOC_SOURCE_DIR;

/// Flags that the documents mention of evo, CMake and ./dev.
const std::set<std::string> kFlagsOfOthers = {
    "--t_max_diff", "--align", "--align_origin", "--correct_scale", "--all_pairs",
    "--target",     "--all",   "--check",        "--install",       "--prefix"};

std::string content_of(const fs::path& file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

/// All files of the project with one of these extensions, not what was built.
std::vector<fs::path> project_files(const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (auto it = fs::recursive_directory_iterator(kRoot); it != end(it); ++it) {
    const std::string name = it->path().filename();
    if (name.starts_with(".") || (it.depth() == 0 && name.starts_with("build"))) {
      it.disable_recursion_pending();
    } else if (extensions.contains(it->path().extension())) {
      files.push_back(it->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

/// The first groups of all matches.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

/// The keys of papers in a text, such as Thrun05 in "[Thrun05 5.4]".
std::set<std::string> keys_in(const std::string& text) {
  static const std::regex citation(R"re(\[([A-Z][A-Za-z]+[0-9][0-9])[ \]])re");
  const std::vector<std::string> keys = all_matches(text, citation);
  return {keys.begin(), keys.end()};
}

/// Targets of the links and pictures in Markdown that lie in the project, without "#section".
std::vector<std::string> relative_links_in(const std::string& markdown) {
  static const std::regex link(R"re(\]\(([^)#\s]+)(?:#[^)]*)?\))re");
  std::vector<std::string> links = all_matches(markdown, link);
  std::erase_if(links, [](const std::string& target) {
    return target.find("://") != std::string::npos || target.starts_with("mailto:");
  });
  return links;
}

/// A flag such as --map, not the rule of a table.
const std::regex kFlag(R"re((?:^|[^\w-])(--[a-z](?:[\w.-]*\w)?))re");

/// A flag, and the subcommand that the text gives it to: empty where it stands alone.
struct MentionedFlag {
  std::string subcommand;
  std::string flag;
  friend bool operator==(const MentionedFlag&, const MentionedFlag&) = default;
};

/// The subcommand whose call is not over at the end of this text; empty where there is none.
std::string open_call(const std::string& text) {
  static const std::regex call(R"re(sketchloc"? ([a-z]+) [^`\n]*$)re");
  const std::size_t last = text.rfind("sketchloc");
  std::smatch found;
  const std::string tail = last == std::string::npos ? "" : text.substr(last);
  return std::regex_search(tail, found, call) ? found[1].str() : "";
}

/// Flags after "sketchloc SUBCOMMAND" are that subcommand's, up to the end of the line (one that
/// goes on after a backslash is not over) or of the code.
std::vector<MentionedFlag> mentioned_flags(const std::string& text) {
  static const std::regex continued(R"re(\\\n)re");
  const std::string joined = std::regex_replace(text, continued, " ");
  std::vector<MentionedFlag> mentioned;
  for (std::sregex_iterator it(joined.begin(), joined.end(), kFlag), end; it != end; ++it) {
    const auto at = static_cast<std::size_t>(it->position(1));
    const std::size_t line = joined.rfind('\n', at) + 1;  // 0 in the first line
    mentioned.push_back({open_call(joined.substr(line, at - line)), (*it)[1].str()});
  }
  return mentioned;
}

std::string help_of(const std::string& subcommand, const std::string& what) {
  return testing::run_command({SKETCHLOC_PROGRAM, subcommand, what}).out;
}

std::vector<std::string> subcommands() {
  return {"demo", "localize", "track",  "register", "smooth",   "topology",
          "plan", "navigate", "ablate", "evaluate", "generate", "convert"};
}

/// The flags of a subcommand, and the names in its parameters (which --help does not list).
struct KnownFlags {
  std::set<std::string> flags;
  std::set<std::string> parameter_names;

  bool knows(const std::string& flag) const {
    if (flags.contains(flag)) {
      return true;
    }
    std::istringstream parts(flag.substr(2));
    bool known = flag.find('.') != std::string::npos;
    for (std::string part; std::getline(parts, part, '.');) {
      known = known && parameter_names.contains(part);
    }
    return known;
  }
};

std::map<std::string, KnownFlags> flags_by_subcommand() {
  static const std::regex parameter(R"re((\w+):)re");
  std::map<std::string, KnownFlags> known;
  for (const std::string& subcommand : subcommands()) {
    const std::vector<std::string> flags = all_matches(help_of(subcommand, "--help"), kFlag);
    const std::vector<std::string> names =
        all_matches(help_of(subcommand, "--print-parameters"), parameter);
    known[subcommand] = {{flags.begin(), flags.end()}, {names.begin(), names.end()}};
  }
  return known;
}

TEST(Documents, FindKeysWithAndWithoutASection) {
  EXPECT_THAT(keys_in("[Thrun05 5.4], [Chen20]; list[Index0], [0, 1]"),
              ElementsAre("Chen20", "Thrun05"));
}

TEST(Documents, FindLinksIntoTheProjectOnly) {
  EXPECT_THAT(relative_links_in("[a](b.md), ![c](d/e.png) [f](https://g.h/i) [j](k.md#l) [m](#n)"),
              ElementsAre("b.md", "d/e.png", "k.md"));
}

TEST(Documents, FindFlagsWithTheirSubcommand) {
  EXPECT_THAT(
      mentioned_flags("`--a`\n--b; sketchloc localize --map-c X \\\n  --d.e_f.\n|---|\n"),
      ElementsAre(MentionedFlag{"", "--a"}, MentionedFlag{"", "--b"},
                  MentionedFlag{"localize", "--map-c"}, MentionedFlag{"localize", "--d.e_f"}));
}

TEST(Documents, LinkToFilesThatExist) {
  for (const fs::path& document : project_files({".md"})) {
    for (const std::string& target : relative_links_in(content_of(document))) {
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << " links " << target;
    }
  }
}

TEST(Documents, ListEveryPaperThatIsCited) {
  const std::set<std::string> listed = keys_in(content_of(kRoot / "docs/references.md"));
  for (const fs::path& file : project_files({".hpp", ".cpp", ".md", ".sh"})) {
    if (file.filename() == "documents_test.cpp") {
      continue;
    }
    for (const std::string& key : keys_in(content_of(file))) {
      EXPECT_TRUE(listed.contains(key)) << file << " cites " << key;
    }
  }
}

TEST(Documents, HaveEveryPageOfResultsInTheirList) {
  const std::vector<std::string> listed =
      relative_links_in(content_of(kRoot / "docs/results/README.md"));
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / "docs/results")) {
    const std::string name = entry.path().filename();
    if (entry.path().extension() == ".md" && name != "README.md") {
      EXPECT_THAT(listed, ::testing::Contains(name));
    }
  }
}

TEST(DocumentsEndToEnd, KnowTheSubcommandsOfTheProgram) {
  const std::string help = testing::run_command({SKETCHLOC_PROGRAM, "--help"}).out;
  static const std::regex listed(R"re(\n  ([a-z]+) )re");
  EXPECT_THAT(all_matches(help, listed), ::testing::IsSupersetOf(subcommands()));
}

TEST(DocumentsEndToEnd, NameFlagsThatTheProgramHas) {
  const std::map<std::string, KnownFlags> known = flags_by_subcommand();
  const auto some_subcommand_knows = [&](const std::string& flag) {
    return std::ranges::any_of(known, [&](const auto& one) { return one.second.knows(flag); });
  };
  const bool learns = help_of("train", "--help").find("not in this build") == std::string::npos;
  for (const fs::path& document : project_files({".md"})) {
    if (document.filename() == "training.md" && !learns) {
      continue;  // the flags of a build with libtorch
    }
    for (const auto& [subcommand, flag] : mentioned_flags(content_of(document))) {
      if (subcommand == "train" && !learns) {
        continue;
      }
      const bool exists = known.contains(subcommand) ? known.at(subcommand).knows(flag)
                                                     : some_subcommand_knows(flag);
      EXPECT_TRUE(exists || kFlagsOfOthers.contains(flag))
          << document << ": sketchloc " << subcommand << " has no " << flag;
    }
  }
}

}  // namespace
}  // namespace sketchloc
