#include "eval/registration_report.hpp"

#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::escaped;
using detail::fixed;
using detail::with_unit;

std::string row(const std::string& name, const std::string& text) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + text + "</td></tr>";
}

std::string pose_text(const Sim2& sketch_from_robot) {
  return "x " + fixed(sketch_from_robot.x(), 1) + " px, y " + fixed(sketch_from_robot.y(), 1) +
         " px, heading " + fixed(deg_from_rad(sketch_from_robot.yaw_rad()), 1) + "&#176;, " +
         fixed(sketch_from_robot.scale(), 1) + " px/m";
}

std::string difference_text(const PoseDifference& difference) {
  return with_unit(difference.shift_m, "m") + ", " + fixed(deg_from_rad(difference.turn_rad), 1) +
         "&#176;";
}

std::string registration_rows(const Registration& found, const RegistrationResult& result) {
  std::string rows =
      row("estimate", pose_text(found.sketch_from_robot)) +
      row("estimate from prior",
          difference_text(difference(found.sketch_from_robot, result.prior_sketch_from_robot))) +
      row("probability that it is right", detail::percent(found.inlier_probability));
  if (found.covariance) {
    const PoseSigma sigma = sigma_of(*found.covariance);
    rows += row("its 1-sigma", with_unit(sigma.position_m, "m") + ", " +
                                   fixed(deg_from_rad(sigma.heading_rad), 1) + "&#176;");
  }
  return rows + row("the warp folds in the window",
                    find_folds(found.warp, result.window).folds() ? "yes" : "no");
}

std::string reference_rows(const RegistrationResult& result) {
  if (!result.reference) {
    return {};
  }
  const Sim2& reference = result.reference->sketch_from_robot;
  std::string rows = row("reference", pose_text(reference)) +
                     row("prior from reference",
                         difference_text(difference(result.prior_sketch_from_robot, reference)));
  if (result.registration) {
    rows += row("estimate from reference",
                difference_text(difference(result.registration->sketch_from_robot, reference)));
  }
  return rows;
}

std::string explanation(const RegistrationResult& result) {
  const bool submap = result.scans > 1;
  return "<p>The prior says where the robot may be. From there, the " +
         (submap ? "last " + std::to_string(result.scans) + " scans are" : std::string("scan is")) +
         " compared with the drawing. What comes out is a warp: how the floor around the robot was "
         "bent when somebody drew it. The squares are that floor. Orange dots are the walls that "
         "the robot saw, bent alike: they should lie on strokes, as far as the drawing shows the "
         "same things.</p>";
}

}  // namespace

std::string registration_html(const RegistrationView& view, const RegistrationResult& result,
                              std::span<const NamedText> inputs) {
  const std::string title = "Scan " + std::to_string(result.step) + " in the drawing";
  std::string subtitle;
  for (const NamedText& input : inputs) {
    subtitle +=
        (subtitle.empty() ? "" : " &#183; ") + escaped(input.name) + ": " + escaped(input.text);
  }
  std::string rows = row("prior", pose_text(result.prior_sketch_from_robot));
  rows += result.registration ? registration_rows(*result.registration, result)
                              : row("estimate", "none");
  rows += reference_rows(result) + row("took", with_unit(result.milliseconds, "ms"));
  return detail::open_page(title) + "<header><h1>" + title + "</h1><p class=\"note\">" + subtitle +
         "</p></header><main><section><div class=\"paper\" style=\"max-width:42rem\">" +
         registration_svg(view) + "</div>" + explanation(result) +
         "</section><section><table class=\"facts\">" + rows + "</table></section></main>" +
         detail::close_page();
}

}  // namespace sketchloc
