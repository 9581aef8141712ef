#include "apps/unfinished_work.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cctype>
#include <stdexcept>

#include "apps/read_bytes.hpp"
#include "datasets/io/atomic_file.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWhat = "what.yaml";

/// Without a final separator, so that a suffix lands on the name.
fs::path beside(const fs::path& out) {
  fs::path whole = fs::absolute(out / "").lexically_normal().parent_path();
  whole += ".unfinished";
  return whole;
}

}  // namespace

UnfinishedWork::UnfinishedWork(const fs::path& out, const std::string& what)
    : folder_(beside(out)) {
  const std::optional<std::string> before = read_bytes(folder_ / kWhat);
  if (before && *before != what) {
    throw std::invalid_argument(folder_.string() +
                                " holds the beginning of another comparison; give the options, the "
                                "inputs and the version of the program that it began with, another "
                                "--out, or delete it");
  }
  if (before) {
    spdlog::info("goes on with {}", folder_.string());
    return;
  }
  fs::remove_all(folder_);  // pieces of nobody knows what
  fs::create_directories(folder_);
  write_atomically(folder_ / kWhat, what);
}

fs::path UnfinishedWork::file_of(const std::string& name) const {
  std::string safe;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || c == ' ' || c == ',' || c == '-' || c == '+';
    safe += plain ? std::string(1, c) : fmt::format("%{:02x}", byte);
  }
  return folder_ / (safe + ".json");
}

std::optional<std::string> UnfinishedWork::find(const std::string& name) const {
  return read_bytes(file_of(name));
}

void UnfinishedWork::keep(const std::string& name, const std::string& piece) {
  write_atomically(file_of(name), piece);
}

void UnfinishedWork::finish() {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (entry.path().filename() != kWhat) {
      fs::remove(entry.path());
    }
  }
  fs::remove_all(folder_);  // what they are of goes last
}

}  // namespace sketchloc
