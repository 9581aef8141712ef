#pragma once

#include <filesystem>

namespace sketchloc {

/// A folder of results that appears whole or not at all: files are written into a hidden folder
/// beside it, which takes its name on commit(). Without commit() nothing stays.
class OutputFolder {
 public:
  /// Throws std::invalid_argument where `target` exists and may not be replaced: never without
  /// `force`, and with it only a folder that holds an earlier result (a run.yaml). An empty folder
  /// may always be replaced. Where `target` is a link to a folder, that folder is meant.
  OutputFolder(const std::filesystem::path& target, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file of this name until commit().
  std::filesystem::path operator/(const std::filesystem::path& name) const {
    return staging_ / name;
  }
  const std::filesystem::path& target() const { return target_; }

  /// Gives the folder its name. Checks that it was not called before. Throws std::runtime_error
  /// where the system refuses: then an earlier result stands as it did, and the new one stays whole
  /// in the hidden folder that the message names.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staging_;  ///< empty once committed
};

}  // namespace sketchloc
