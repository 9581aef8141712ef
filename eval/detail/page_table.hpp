#pragma once

#include <string>
#include <vector>

#include "eval/mean_over_sets.hpp"

namespace sketchloc::detail {

/// A part of a page under a heading; `body` is HTML.
std::string section(const std::string& title, const std::string& body);

/// A table of results that scrolls where it is wider than the page; all cells are plain text.
std::string results_table(const std::vector<std::string>& heads,
                          const std::vector<std::vector<std::string>>& lines);

/// "12.3 [11.0, 14.1]": a mean with its interval, both times a factor.
std::string with_interval(const MeanOverSets& mean, double factor, int decimals);

}  // namespace sketchloc::detail
