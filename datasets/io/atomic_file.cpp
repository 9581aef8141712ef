#include "datasets/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "datasets/io/detail/place.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& file, std::string_view step) {
  const int reason = errno;
  detail::fail({.file = file},
               "cannot be written, " + std::string(step) + ": " + std::strerror(reason));
}

/// A temporary file beside its target, gone unless it was moved there.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target) : target_(std::move(target)) {
    std::filesystem::path pattern = target_;
    pattern += ".XXXXXX";
    name_ = pattern.string();
    descriptor_ = ::mkstemp(name_.data());
    if (descriptor_ < 0) {
      fail_to_write(target_, "making a temporary file beside it");
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
    if (::fchmod(descriptor_, mode_for_target()) != 0 || ::fsync(descriptor_) != 0) {
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
  /// As an ordinary new file gets it, or as the file that is replaced has it.
  mode_t mode_for_target() const {
    struct stat status {};
    if (::stat(target_.c_str(), &status) == 0) {
      return status.st_mode & 0777;
    }
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
  }

  std::filesystem::path target_;
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
