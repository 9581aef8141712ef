#include "eval/report.hpp"

#include "eval/detail/report_model.hpp"

namespace sketchloc {

std::string report_html(const RunRecord& record) {
  const detail::ReportModel model = detail::make_report_model(record);
  return detail::page_html(record, detail::drawing_definition(model) +      //
                                       detail::verdict_html(model) +        //
                                       detail::first_picture_html(model) +  //
                                       detail::overlay_html(model) +        //
                                       detail::scans_html(model) +          //
                                       detail::particles_html(model) +      //
                                       detail::charts_html(model) +         //
                                       detail::tables_html(model));
}

namespace detail {

ReportModel make_report_model(const RunRecord& record) {
  constexpr std::size_t kOtherMoments = 4;
  ReportModel model{.record = record,
                    .errors = step_errors(record),
                    .summary = {},
                    .moments = {},
                    .layers = {},
                    .view = {},
                    .to_svg = {static_cast<double>(record.sketch.height_px())}};
  model.summary = summarize_sketch_errors(model.errors, record.loss);
  model.moments = choose_moments(record, model.errors, kOtherMoments);
  model.layers = path_layers(record, model.errors);
  model.view = whole_view(record, model.layers);
  return model;
}

}  // namespace detail
}  // namespace sketchloc
