#include "datasets/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "datasets/io/detail/place.hpp"
#include "datasets/io/make_beside.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& file, std::string_view step,
                                int reason = errno) {
  detail::fail({.file = file},
               "cannot be written, " + std::string(step) + ": " + std::strerror(reason));
}

/// The permissions of the file that is to be replaced; none: there is no file yet.
std::optional<mode_t> mode_of(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? std::optional(status.st_mode & 0777) : std::nullopt;
}

/// A temporary file beside its target, gone unless it was moved there.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target)
      : target_(std::move(target)), replaced_mode_(mode_of(target_)) {
    const auto make = [this](const char* name) {
      constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
      return descriptor_ = ::open(name, kFlags, replaced_mode_.value_or(0666));
    };
    try {
      name_ = make_beside(target_, make).string();
    } catch (const std::system_error& error) {
      fail_to_write(target_, "making a temporary file beside it", error.code().value());
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
    if (!moved_) {
      ::unlink(name_.c_str());
    }
  }

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t count = ::write(descriptor_, content.data(), content.size());
      if (count < 0 && errno != EINTR) {
        fail_to_write(target_, "writing");
      }
      content.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
  }

  void move_to_target() {
    const bool same_mode = !replaced_mode_ || ::fchmod(descriptor_, *replaced_mode_) == 0;
    if (!same_mode || ::fsync(descriptor_) != 0) {
      fail_to_write(target_, "flushing to the disk");
    }
    if (::close(std::exchange(descriptor_, -1)) != 0) {
      fail_to_write(target_, "closing");
    }
    if (::rename(name_.c_str(), target_.c_str()) != 0) {
      fail_to_write(target_, "renaming the temporary file");
    }
    moved_ = true;
  }

 private:
  std::filesystem::path target_;
  std::optional<mode_t> replaced_mode_;
  std::string name_;
  int descriptor_ = -1;
  bool moved_ = false;
};

/// So that the new name itself survives a power failure; where the system cannot, the file is
/// whole all the same.
void flush_folder(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

}  // namespace

void write_atomically(const std::filesystem::path& file, std::string_view content) {
  TemporaryFile temporary(file);
  temporary.write(content);
  temporary.move_to_target();
  flush_folder(file);
}

}  // namespace sketchloc
