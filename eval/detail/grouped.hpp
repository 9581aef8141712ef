#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sketchloc::detail {

/// Groups of trials of one key, in the order in which they first appear.
template <typename Trial, typename KeyOf>
std::vector<std::vector<const Trial*>> grouped(const std::vector<const Trial*>& trials,
                                               const KeyOf& key_of) {
  std::vector<std::vector<const Trial*>> groups;
  std::map<decltype(key_of(std::declval<const Trial&>())), std::size_t> places;
  for (const Trial* trial : trials) {
    const auto [place, is_new] = places.emplace(key_of(*trial), groups.size());
    if (is_new) {
      groups.emplace_back();
    }
    groups[place->second].push_back(trial);
  }
  return groups;
}

}  // namespace sketchloc::detail
