#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sketchloc {

/// Pieces of a long piece of work, kept in a folder beside the one that the results will have
/// (OUT.unfinished), so that the same command goes on where it was stopped. Safe to use from many
/// threads.
class UnfinishedWork {
 public:
  /// `what`: all that the pieces depend on. Where the folder holds pieces of something else, throws
  /// std::invalid_argument with what to do.
  UnfinishedWork(const std::filesystem::path& out, const std::string& what);

  std::optional<std::string> find(const std::string& name) const;
  void keep(const std::string& name, const std::string& piece);

  /// The results are there: the pieces go.
  void finish();

 private:
  std::filesystem::path file_of(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace sketchloc
