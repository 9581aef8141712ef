#pragma once

#include <filesystem>
#include <functional>

namespace sketchloc {

/// Makes a file or folder under a name of its own beside `target`, where it can take the target's
/// place by a rename. `make` gets one name after the other, makes it with the permissions of any
/// new file (so that the system applies the user's mask), and returns what the system call did; a
/// name that is taken (EEXIST) is passed over. Throws std::system_error for any other failure.
std::filesystem::path make_beside(const std::filesystem::path& target,
                                  const std::function<int(const char* name)>& make);

}  // namespace sketchloc
