#include "apps/output_folder.hpp"

#include <sys/stat.h>

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "datasets/io/make_beside.hpp"
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
fs::path make_folder_beside(const fs::path& target) {
  fs::create_directories(target.parent_path());
  return make_beside(target, [](const char* name) { return ::mkdir(name, 0777); });
}

/// Without a slash at the end; where it is a link, what that points to.
fs::path resolved(const fs::path& target) {
  if (target.empty()) {
    throw std::invalid_argument("--out has no name; give the folder of the results");
  }
  const fs::path plain = fs::absolute(target / "").parent_path().lexically_normal();
  return fs::is_symlink(plain) && fs::exists(plain) ? fs::canonical(plain) : plain;
}

/// Renames `whole`, in place of a `target` that is there; if that fails, the target stays.
std::error_code take_name(const fs::path& whole, const fs::path& target) {
  std::error_code error;
  std::error_code ignored;
  if (!fs::exists(whole)) {
    return std::make_error_code(std::errc::no_such_file_or_directory);
  }
  if (!fs::exists(target)) {
    fs::rename(whole, target, error);
    return error;
  }
  const fs::path old = make_folder_beside(target);
  fs::rename(target, old, error);  // replaces the empty folder just made
  if (error) {
    fs::remove(old, ignored);
    return error;
  }
  fs::rename(whole, target, error);
  if (error) {
    fs::rename(old, target, ignored);
  } else {
    fs::remove_all(old, ignored);
  }
  return error;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target, bool force) : target_(resolved(target)) {
  require_replaceable(target_, force);
  staging_ = make_folder_beside(target_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) {
    fs::remove_all(staging_, ignored);
  }
}

void OutputFolder::commit() {
  check(!staging_.empty(), "an output folder is committed once");
  const fs::path whole = std::exchange(staging_, {});  // kept from now on, whatever happens
  if (const std::error_code error = take_name(whole, target_)) {
    throw std::runtime_error("the results cannot take the name " + target_.string() + " (" +
                             error.message() + "); they are whole in " + whole.string());
  }
}

}  // namespace sketchloc
