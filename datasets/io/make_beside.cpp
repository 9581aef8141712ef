#include "datasets/io/make_beside.hpp"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace sketchloc {

std::filesystem::path make_beside(const std::filesystem::path& target,
                                  const std::function<int(const char* name)>& make) {
  std::string start = ".";  // not "." + ...: g++ 12 warns of that under -O3 (its bug 105651)
  start.append(target.filename().string()).append(".").append(std::to_string(::getpid()));
  for (int i = 0;; ++i) {
    const std::filesystem::path path = target.parent_path() / (start + "-" + std::to_string(i));
    if (make(path.c_str()) >= 0) {
      return path;
    }
    if (errno != EEXIST) {
      throw std::system_error(errno, std::generic_category(),
                              "cannot write beside " + target.string());
    }
  }
}

}  // namespace sketchloc
