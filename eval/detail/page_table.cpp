#include "eval/detail/page_table.hpp"

#include "eval/detail/text.hpp"

namespace sketchloc::detail {

std::string section(const std::string& title, const std::string& body) {
  return "<section><h2>" + escaped(title) + "</h2>" + body + "</section>";
}

std::string results_table(const std::vector<std::string>& heads,
                          const std::vector<std::vector<std::string>>& lines) {
  std::string html = "<div class=\"scroll\"><table class=\"results\"><thead><tr>";
  for (const std::string& head : heads) {
    html += "<th>" + escaped(head) + "</th>";
  }
  html += "</tr></thead><tbody>";
  for (const std::vector<std::string>& line : lines) {
    html += "<tr>";
    for (const std::string& cell : line) {
      html += "<td>" + escaped(cell) + "</td>";
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

std::string with_interval(const MeanOverSets& mean, double factor, int decimals) {
  std::string text = fixed(factor * mean.mean, decimals);
  if (mean.interval) {
    text += " [" + fixed(factor * mean.interval->low, decimals) + ", " +
            fixed(factor * mean.interval->high, decimals) + "]";
  }
  return text;
}

}  // namespace sketchloc::detail
