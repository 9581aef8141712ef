#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/detail/raster.hpp"
#include "eval/detail/report_model.hpp"
#include "eval/detail/scan_marks.hpp"
#include "eval/detail/text.hpp"
#include "eval/drawing_overlay.hpp"
#include "motion/angles.hpp"

namespace sketchloc::detail {
namespace {

constexpr Colour kEstimate = kBad;
constexpr Colour kParticle{120, 60, 160};

const Sim2& estimated(const RunRecord& record, const Moment& moment) {
  return record.steps[moment.index].estimate.sketch_from_robot;
}

std::optional<Sim2> referenced(const RunRecord& record, const Moment& moment) {
  if (!record.reference) {
    return std::nullopt;
  }
  const auto& poses = record.reference->poses;
  const std::size_t step = record.steps[moment.index].step;
  const auto it = std::ranges::lower_bound(poses, step, {}, &ReferencePose::step);
  return it != poses.end() && it->step == step ? std::optional(it->sketch_from_robot)
                                               : std::nullopt;
}

/// A text of constant size at a place of the picture; near its right edge it stands on the left.
std::string label_at(const View& view, const Eigen::Vector2d& point, const std::string& css_class,
                     const std::string& text) {
  const Eigen::Vector2d percent_there =
      (100.0 * (point - view.low).array() / (view.high - view.low).array()).max(0.0).min(100.0);
  constexpr double kNearEdge_percent = 80.0;
  const std::string side = percent_there.x() > kNearEdge_percent ? " left" : "";
  return "<span class=\"" + css_class + side + "\" style=\"left:" + fixed(percent_there.x(), 2) +
         "%;bottom:" + fixed(percent_there.y(), 2) + "%\">" + text + "</span>";
}

std::string layer_svg(const PathLayer& layer, const SketchToSvg& to_svg, double width_factor) {
  return stroke(path_data(layer.lines, to_svg), layer.colour, layer.width * width_factor,
                layer.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

std::string legend_html(std::span<const PathLayer> layers, bool has_reference) {
  std::string html = "<p class=\"legend\">";
  for (const PathLayer& layer : layers) {
    if (!layer.name.empty() && !layer.lines.empty()) {
      html += "<span><i class=\"" + std::string(layer.dashed ? "dash" : "line") +
              "\" style=\"color:" + hex(layer.colour) + "\"></i>" + escaped(layer.name) + "</span>";
    }
  }
  if (has_reference) {
    html += "<span><i class=\"square\" style=\"color:" + hex(kReferenceBlue) +
            "\"></i>end of the reference</span>";
  }
  return html + "</p>";
}

std::string end_labels(const ReportModel& model) {
  const auto& steps = model.record.steps;
  if (steps.empty()) {
    return {};
  }
  std::string html;
  if (model.has_reference()) {
    const auto& poses = model.record.reference->poses;
    html += label_at(model.view, poses.back().sketch_from_robot.translation(), "end reference",
                     "<b>end of the reference</b>");
  }
  return html +
         label_at(model.view, steps.front().estimate.sketch_from_robot.translation(), "start",
                  "<b>start</b>") +
         label_at(model.view, steps.back().estimate.sketch_from_robot.translation(), "end",
                  "<b>end</b>");
}

std::string moment_labels(const ReportModel& model) {
  std::string html;
  for (const Moment& moment : model.moments) {
    html +=
        label_at(model.view, estimated(model.record, moment).translation(), "badge", moment.letter);
  }
  return html;
}

/// Arrow head of a robot, about one metre long and never invisibly small.
std::string robot_svg(const Sim2& sketch_from_robot, const SketchToSvg& to_svg,
                      const Colour& colour, double view_width) {
  constexpr double kSmallestShare = 0.03;
  const double size_m = std::max(1.0, kSmallestShare * view_width / sketch_from_robot.scale());
  const std::vector<Polyline> lines = {robot_outline(sketch_from_robot, size_m)};
  return "<path class=\"robot\" d=\"" + path_data(lines, to_svg) + "Z\" fill=\"" + hex(colour) +
         "\"/>";
}

/// A square around the poses at a moment with some metres to spare.
View square_around(const Sim2& estimate, const std::optional<Sim2>& reference) {
  constexpr double kRadius_m = 8.0;
  constexpr double kMargin_m = 4.0;
  const Sim2 other = reference.value_or(estimate);
  const double scale = std::max(estimate.scale(), other.scale());
  const Eigen::Vector2d centre = 0.5 * (estimate.translation() + other.translation());
  const double apart = (estimate.translation() - other.translation()).norm();
  const Eigen::Vector2d half =
      Eigen::Vector2d::Constant(std::max(kRadius_m * scale, 0.5 * apart + kMargin_m * scale));
  return {.low = centre - half, .high = centre + half};
}

std::string moment_caption(const ReportModel& model, const Moment& moment) {
  std::string html = "<figcaption><span class=\"badge inline\">" + moment.letter + "</span> " +
                     duration(model.seconds_since_start(model.record.steps[moment.index].time_s));
  if (moment.error) {
    html += " &#183; " + with_unit(moment.error->translation_m, "m") + ", " +
            fixed(deg_from_rad(moment.error->heading_rad), 0) + "&#176; off";
  }
  if (!moment.reason.empty()) {
    html += " &#183; <strong>" + moment.reason + "</strong>";
  }
  return html + "</figcaption>";
}

std::string scan_panel(const ReportModel& model, const Moment& moment) {
  constexpr double kDot = 3.5;
  const Scan& scan = model.record.run.steps[model.record.steps[moment.index].step].scan;
  const Sim2& estimate = estimated(model.record, moment);
  const std::optional<Sim2> reference = referenced(model.record, moment);
  const View view = square_around(estimate, reference);
  std::string svg = open_view(view, model.to_svg, "Scan on the drawing, moment " + moment.letter);
  if (reference) {
    svg += stroke(dot_data(end_points_in_sketch(scan, *reference), model.to_svg), kReferenceBlue,
                  kDot) +
           robot_svg(*reference, model.to_svg, kReferenceBlue, view.width());
  }
  svg += stroke(dot_data(end_points_in_sketch(scan, estimate), model.to_svg), kEstimate, kDot) +
         robot_svg(estimate, model.to_svg, kEstimate, view.width());
  return std::string(moment.reason.empty() ? "<figure>" : "<figure class=\"notable\">") + svg +
         "</svg>" + moment_caption(model, moment) + "</figure>";
}

/// The cloud without its strays, the estimate and the reference, with a margin.
View view_of_cloud(const ParticleSnapshot& snapshot, const Sim2& estimate,
                   const std::optional<Sim2>& reference) {
  View view = square_around(estimate, reference);
  std::vector<double> x;
  std::vector<double> y;
  for (const SnapshotParticle& particle : snapshot.particles) {
    x.push_back(particle.x_px);
    y.push_back(particle.y_px);
  }
  constexpr double kStrays = 0.01;
  if (!x.empty()) {
    view.low = view.low.cwiseMin(Eigen::Vector2d(quantile(x, kStrays), quantile(y, kStrays)));
    view.high =
        view.high.cwiseMax(Eigen::Vector2d(quantile(x, 1.0 - kStrays), quantile(y, 1.0 - kStrays)));
  }
  const Eigen::Vector2d centre = 0.5 * (view.low + view.high);
  const double half = 0.52 * std::max(view.width(), view.height());
  view.low = centre - Eigen::Vector2d::Constant(half);
  view.high = centre + Eigen::Vector2d::Constant(half);
  return view;
}

std::string particle_panel(const ReportModel& model, const Moment& moment,
                           const ParticleSnapshot& snapshot) {
  constexpr double kDot = 2.5;
  std::vector<Eigen::Vector2d> points;
  for (const SnapshotParticle& particle : snapshot.particles) {
    points.emplace_back(particle.x_px, particle.y_px);
  }
  const Sim2& estimate = estimated(model.record, moment);
  const std::optional<Sim2> reference = referenced(model.record, moment);
  const View view = view_of_cloud(snapshot, estimate, reference);
  std::string svg =
      open_view(view, model.to_svg, "Particles, moment " + moment.letter) +
      stroke(dot_data(points, model.to_svg), kParticle, kDot, " stroke-opacity=\"0.5\"");
  if (reference) {
    svg += robot_svg(*reference, model.to_svg, kReferenceBlue, view.width());
  }
  svg += robot_svg(estimate, model.to_svg, kEstimate, view.width());
  return "<figure>" + svg + "</svg>" + moment_caption(model, moment) + "</figure>";
}

/// The moment at the step of a snapshot, with the error there.
Moment moved_to(const ReportModel& model, const Moment& moment, std::size_t step) {
  const auto& steps = model.record.steps;
  const auto report = std::ranges::lower_bound(steps, step, {}, &StepReport::step);
  Moment moved = moment;
  if (report == steps.end() || static_cast<std::size_t>(report - steps.begin()) == moment.index) {
    return moved;
  }
  const double later_s = report->time_s - steps[moment.index].time_s;
  moved.index = static_cast<std::size_t>(report - steps.begin());
  moved.reason =
      duration(std::abs(later_s)) + (later_s < 0.0 ? " before " : " after ") + moment.letter;
  const auto error = std::ranges::find(model.errors, report->step, &StepError::step);
  moved.error = error != model.errors.end() ? std::optional(*error) : std::nullopt;
  return moved;
}

bool has_scan(const RunRecord& record, const Moment& moment) {
  return record.steps[moment.index].step < record.run.steps.size();
}

std::string pose_legend(const ReportModel& model) {
  std::string html = "<p class=\"legend\"><span><i class=\"dot\" style=\"color:" + hex(kEstimate) +
                     "\"></i>estimate</span>";
  if (model.has_reference()) {
    html +=
        "<span><i class=\"dot\" style=\"color:" + hex(kReferenceBlue) + "\"></i>reference</span>";
  }
  return html + "</p>";
}

std::string scans_heading(const ReportModel& model) {
  return !model.has_reference()       ? "The least certain moment"
         : model.summary.first_loss_s ? "Where it goes wrong"
                                      : "The worst moment";
}

std::string scans_text(const ReportModel& model) {
  return model.has_reference()
             ? "The LIDAR scan laid on the drawing, at the estimated and at the reference pose. "
               "Dots should lie on strokes; where the blue ones miss too, the drawing differs "
               "from the place."
             : "The LIDAR scan laid on the drawing, at the estimated pose. Dots should lie on "
               "strokes, as far as the drawing is true.";
}

}  // namespace

std::string drawing_definition(const ReportModel& model) {
  constexpr int kLongest_px = 1600;
  const Sketch& sketch = model.record.sketch;
  const std::string bytes = encode_png(paper(sketch), kLongest_px);
  std::string image = "<g id=\"drawing\">";
  if (!bytes.empty()) {
    image += "<image width=\"" + std::to_string(sketch.width_px()) + "\" height=\"" +
             std::to_string(sketch.height_px()) +
             "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," + base64(bytes) +
             "\"/>";
  }
  return "<svg class=\"definitions\" aria-hidden=\"true\" width=\"0\" height=\"0\"><defs>" + image +
         "</g></defs></svg>";
}

std::string first_picture_html(const ReportModel& model) {
  std::string svg =
      open_view(model.view, model.to_svg,
                model.has_reference() ? "The drawing with the estimated path and the reference path"
                                      : "The drawing with the estimated path");
  for (const PathLayer& layer : model.layers) {
    svg += layer_svg(layer, model.to_svg, 1.0);
  }
  return "<section><h2>Where the robot was</h2><div class=\"paper picture\">" + svg + "</svg>" +
         end_labels(model) + moment_labels(model) + "</div>" +
         legend_html(model.layers, model.has_reference()) + "</section>";
}

std::string overlay_html(const ReportModel& model) {
  if (!model.record.spline) {
    return {};
  }
  return "<section><h2>The drawing in metres</h2><p>One smooth map from metres to the whole "
         "drawing, found together with the path: where the walls that the scans saw (green) fall "
         "onto the strokes, the drawing is understood. Grey: this run does not tell.</p>"
         "<img style=\"width:100%\" alt=\"the drawing with a metric grid, and unbent into metres "
         "with the scans over it\" src=\"data:image/png;base64," +
         base64(overlay_png(model.record)) + "\"/></section>";
}

std::string scans_html(const ReportModel& model) {
  std::string notable;
  std::string others;
  for (const Moment& moment : model.moments) {
    if (has_scan(model.record, moment)) {
      (moment.reason.empty() ? others : notable) += scan_panel(model, moment);
    }
  }
  if (notable.empty() && others.empty()) {
    return {};
  }
  return "<section><h2>" + scans_heading(model) + "</h2><p>" + scans_text(model) + "</p>" +
         pose_legend(model) + "<div class=\"panels\">" + notable + others + "</div></section>";
}

std::string particles_html(const ReportModel& model) {
  std::string panels;
  const ParticleSnapshot* last = nullptr;
  for (const Moment& moment : model.moments) {
    const ParticleSnapshot* snapshot =
        nearest_snapshot(model.record, model.record.steps[moment.index].step);
    if (snapshot != nullptr && snapshot != last) {
      panels += particle_panel(model, moved_to(model, moment, snapshot->step), *snapshot);
      last = snapshot;
    }
  }
  if (panels.empty()) {
    return {};
  }
  return "<section><h2>What the filter considered</h2><p>Each dot is a particle: one guess of the "
         "robot&#39;s place.</p>" +
         pose_legend(model) + "<div class=\"panels three\">" + panels + "</div></section>";
}

}  // namespace sketchloc::detail
