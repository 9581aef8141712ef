#include "apps/output_folder.hpp"

#include <stdlib.h>
#include <sys/stat.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

void require_replaceable(const fs::path& target, bool force) {
  if (!fs::exists(fs::symlink_status(target)) ||
      (fs::is_directory(target) && fs::is_empty(target))) {
    return;
  }
  if (!force) {
    throw std::invalid_argument(target.string() +
                                " exists; choose another --out, or replace it with --force");
  }
  if (!fs::exists(target / "run.yaml")) {
    throw std::invalid_argument(target.string() +
                                " holds no earlier result (no run.yaml), so --force does not "
                                "replace it; choose another --out");
  }
}

/// A new empty folder beside `target`, on the same file system, readable like any other.
fs::path make_beside(const fs::path& target) {
  fs::create_directories(target.parent_path());
  std::string name =
      (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(),
                            "cannot write beside " + target.string());
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(name.c_str(), 0777 & ~mask);  // mkdtemp makes it private
  return name;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target, bool force)
    : target_(fs::absolute(target / "").parent_path().lexically_normal()) {
  require_replaceable(target_, force);
  staging_ = make_beside(target_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) {
    fs::remove_all(staging_, ignored);
  }
}

void OutputFolder::commit() {
  check(!staging_.empty(), "an output folder is committed once");
  fs::path old;
  if (fs::exists(target_)) {
    old = make_beside(target_);
    fs::rename(target_, old);  // replaces the empty folder just made
  }
  fs::rename(staging_, target_);
  staging_.clear();
  std::error_code ignored;
  fs::remove_all(old, ignored);
}

}  // namespace sketchloc
