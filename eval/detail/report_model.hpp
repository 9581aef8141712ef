#pragma once

#include <string>
#include <vector>

#include "eval/detail/moments.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/svg.hpp"
#include "eval/run_record.hpp"

namespace sketchloc::detail {

/// A run with everything that more than one part of the report needs.
struct ReportModel {
  const RunRecord& record;
  std::vector<StepError> errors;  ///< empty without a reference
  SketchErrors summary;
  std::vector<Moment> moments;
  std::vector<PathLayer> layers;
  View view;  ///< the part of the drawing that the first picture shows
  SketchToSvg to_svg;

  bool has_reference() const { return !errors.empty(); }
  double seconds_since_start(double time_s) const {
    return record.steps.empty() ? 0.0 : time_s - record.steps.front().time_s;
  }
};

/// The record must outlive the model.
ReportModel make_report_model(const RunRecord& record);

// The parts of the page, each as HTML.
std::string verdict_html(const ReportModel& model);
std::string first_picture_html(const ReportModel& model);
std::string overlay_html(const ReportModel& model);
std::string scans_html(const ReportModel& model);
std::string particles_html(const ReportModel& model);
std::string charts_html(const ReportModel& model);
std::string tables_html(const ReportModel& model);

/// The drawing, embedded once; every picture refers to it.
std::string drawing_definition(const ReportModel& model);

/// The page around the parts: head, style, title, foot.
std::string page_html(const RunRecord& record, const std::string& body);

}  // namespace sketchloc::detail
