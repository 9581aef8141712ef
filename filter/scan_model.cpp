#include "filter/scan_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "filter/detail/chunks.hpp"

namespace sketchloc {
namespace {

/// Typical of drawings; only where the end points are scored in one without a scale.
constexpr double kTypicalPxPerM = 20.0;

std::variant<BeamModel, EndPointModel> make_model(const Sketch& sketch, const RangeTable& table,
                                                  const LocalizerParams& params) {
  if (params.measurement == Measurement::Beams) {
    return BeamModel(table, params.beams);
  }
  return EndPointModel(sketch, sketch.px_per_m.value_or(kTypicalPxPerM), params.end_points);
}

/// log((1 - share) exp(first) + share exp(second)).
double log_mixture(double first, double second, double share) {
  const double most = std::max(first, second);
  return most + std::log((1.0 - share) * std::exp(first - most) + share * std::exp(second - most));
}

}  // namespace

ScanModel::ScanModel(const Sketch& sketch, const RangeTable& table, const LocalizerParams& params)
    : model_(make_model(sketch, table, params)),
      exponent_(params.measurement == Measurement::Beams ? params.beams.exponent
                                                         : params.end_points.exponent),
      jobs_(params.jobs),
      unbent_scores_(params.particles.max_particles) {}

std::size_t ScanModel::observe(const Scan& scan) {
  return std::visit([&](auto& model) { return model.observe(scan); }, model_);
}

void ScanModel::score(const ParticleSet& particles, std::span<float> scores) const {
  for_each_chunk(particles.size(), jobs_, [&](std::size_t, ParticleRange range) {
    std::visit([&](const auto& model) { model.score(particles, range, scores); }, model_);
  });
}

void ScanModel::mix_unbent(const ParticleSet& particles, const RegisteredParticles& registered,
                           double exponent, std::span<float> scores) {
  const auto* model = std::get_if<BeamModel>(&model_);
  if (model == nullptr || !(exponent > 0.0)) {
    return;
  }
  unbent_scores_.resize(std::max(unbent_scores_.size(), particles.size()));
  for (std::size_t which = 0; which < registered.registrations.size(); ++which) {
    const Registration& registration = registered.registrations[which];
    const double share = 0.5 * registration.inlier_probability;
    const std::optional<PreparedBeams> beams = model->unbent(registration);
    if (!beams) {
      continue;
    }
    for_each_chunk(particles.size(), jobs_, [&](std::size_t, ParticleRange range) {
      model->score(particles, range, *beams, unbent_scores_);
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (registered.of_particle[i] == static_cast<std::int8_t>(which)) {
          scores[i] = static_cast<float>(
              log_mixture(exponent * scores[i], exponent * unbent_scores_[i], share) / exponent);
        }
      }
    });
  }
}

}  // namespace sketchloc
