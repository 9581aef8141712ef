#include "eval/detail/report_model.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"

namespace sketchloc::detail {
namespace {

/// "drawing: kitchen.png · log: drive.jsonl · seed 7".
std::string subtitle(const RunRecord& record) {
  std::string html;
  for (const NamedText& input : record.inputs) {
    html += escaped(input.name) + ": " + escaped(input.text) + " &#183; ";
  }
  return html + "seed " + std::to_string(record.seed);
}

}  // namespace

std::string page_html(const RunRecord& record, const std::string& body) {
  return open_page(record.title) + "<header><h1>" + escaped(record.title) +
         "</h1><p class=\"note\">" + subtitle(record) + "</p></header><main>" + body + "</main>" +
         close_page();
}

}  // namespace sketchloc::detail
