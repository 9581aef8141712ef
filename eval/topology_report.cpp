#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/topology_record.hpp"

namespace sketchloc {
namespace {

using detail::with_unit;

std::string error_row(const std::string& name, double before_m, double after_m) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + with_unit(before_m, "m") + "</td><td>" +
         with_unit(after_m, "m") + "</td></tr>";
}

std::string error_table(const TopologyRecord& record) {
  if (!record.reference) {
    return "<p>No reference was given, so nothing is said of errors.</p>";
  }
  const MetricErrors before = metric_errors(*record.reference, record.odometry);
  const MetricErrors after = metric_errors(*record.reference, record.recovered);
  return "<table class=\"facts\"><tr><th></th><th>odometry</th><th>recovered</th></tr>" +
         error_row("as it is, mean", before.unaligned.mean, after.unaligned.mean) +
         error_row("first pose laid onto it, mean", before.first_pose.mean, after.first_pose.mean) +
         error_row("all poses laid onto it, RMSE", before.se2.rmse, after.se2.rmse) + "</table>";
}

}  // namespace

std::string report_html(const TopologyRecord& record) {
  const RecoveredRun& run = record.run;
  const double way_m = run.evidence.travel.way_m.empty() ? 0.0 : run.evidence.travel.way_m.back();
  return detail::open_page("A run recovered by its topology") +
         "<header><h1>A run recovered by its topology</h1><p class=\"note\">" +
         std::to_string(record.odometry.size()) + " poses &#183; " + with_unit(way_m, "m") +
         " &#183; " + std::to_string(run.nodes.size()) + " nodes &#183; " +
         std::to_string(run.pairs.size()) + " pairs taken for one place</p></header><main>" +
         "<section><img style=\"width:100%\" alt=\"odometry, nodes, recovered run\" src=\"data:"
         "image/png;base64," +
         detail::base64(picture_png(record)) +
         "\"><p>Left: the odometry, coloured by the kind of place. Middle: runs of one kind became "
         "nodes, laid along the walls by turns that were decided for the whole run at once; yellow "
         "joins nodes that were taken for one place. Right: the run as it was recovered.</p>"
         "</section><section><h2>Errors</h2>" +
         error_table(record) + "</section></main>" + detail::close_page();
}

}  // namespace sketchloc
