#include "filter/localizer.hpp"

#include <algorithm>
#include <cmath>

#include "filter/detail/chunks.hpp"
#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

// What an engine is for, so that no two uses share a stream.
enum Purpose : std::uint64_t { kStart, kPredict, kResample, kCandidates, kInject, kPurposes };

// The same where time is short, far from the numbers of the usual engines.
constexpr std::uint64_t kShrinkStream = 2ULL << 32;

/// A robot that turns sees new directions: the way that is worth a radian to recovery.
constexpr double kWayPerTurnM = 0.3;

/// Typical of drawings; only where the end points are scored in one without a scale.
constexpr double kTypicalPxPerM = 20.0;

std::variant<BeamModel, EndPointModel> make_model(const Sketch& sketch, const RangeTable& table,
                                                  const LocalizerParams& params) {
  if (params.measurement == Measurement::Beams) {
    return BeamModel(table, params.beams);
  }
  return EndPointModel(sketch, sketch.px_per_m.value_or(kTypicalPxPerM), params.end_points);
}

double exponent_of(const LocalizerParams& params) {
  return params.measurement == Measurement::Beams ? params.beams.exponent
                                                  : params.end_points.exponent;
}

/// Log of the radius of a circle as large as what the scan saw, GlobalSampler's counterpart; none
/// where it saw nothing.
std::optional<double> log_visible_radius_m(const Scan& scan) {
  double sum_squares = 0.0;
  int returns = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (scan.is_return(beam)) {
      const double range_m = scan.ranges_m[beam];
      sum_squares += range_m * range_m;
      ++returns;
    }
  }
  return sum_squares > 0.0 ? std::optional(0.5 * std::log(sum_squares / returns)) : std::nullopt;
}

}  // namespace

void validate(const MotionGate& gate) {
  require_at_least("way_m", gate.way_m, 0.0);
  require_at_least("turn_rad", gate.turn_rad, 0.0);
  require_above("independent_way_m", gate.independent_way_m, 0.0);
  require_above("independent_turn_rad", gate.independent_turn_rad, 0.0);
}

void validate(const StartSpread& spread) {
  require_at_least("position_m", spread.position_m, 0.0);
  require_at_least("heading_rad", spread.heading_rad, 0.0);
  require_at_least("log_scale", spread.log_scale, 0.0);
  require_at_least("log_mean_scale", spread.log_mean_scale, 0.0);
  require_at_least("strain", spread.strain, 0.0);
}

void validate(const LocalizerParams& params) {
  validate_part("predict", params.predict);
  validate_part("beams", params.beams);
  validate_part("end_points", params.end_points);
  validate_part("particles", params.particles);
  validate_part("modes", params.modes);
  validate_part("gate", params.gate);
  validate_part("start", params.start);
  validate_part("recovery", params.recovery);
  validate_part("fusion", params.fusion);
  validate_part("localized", params.localized);
  validate_part("challengers", params.challengers);
  validate_part("table", params.table);
  require_in_range("resample_below", params.resample_below, 0.0, 1.0);
  require_in_range("jobs", params.jobs, 1, 1024);
}

std::span<const std::pair<std::string_view, Measurement>> names_of(Measurement) {
  static constexpr std::pair<std::string_view, Measurement> kNames[] = {
      {"beams", Measurement::Beams}, {"end_points", Measurement::EndPoints}};
  return kNames;
}

LocalizerParams metric_localizer_params() {
  LocalizerParams params;
  params.predict = metric_motion();
  params.measurement = Measurement::EndPoints;
  params.modes.radius_m = 1.0;
  params.particles.max_particles = 10000;  // a similarity less to sample than in a drawing
  params.gate.independent_way_m = params.gate.way_m;  // what errs is mostly the range noise
  params.gate.independent_turn_rad = params.gate.turn_rad;
  params.start = {.position_m = 0.3,
                  .heading_rad = 0.1,
                  .log_scale = 0.0,
                  .log_mean_scale = 0.0,
                  .strain = 0.0};
  return params;
}

Localizer::Localizer(const Sketch& sketch, const LocalizerParams& params, WarpPredictor* predictor)
    : params_((validate(params), params)),
      table_(sketch.occupied, params.table),
      anywhere_(sketch, table_),
      model_(make_model(sketch, table_, params)),
      mode_finder_(params.modes,
                   std::max(params.particles.max_particles, params.recovery.candidates)),
      evidence_(params.recovery),
      challengers_(params.challengers),
      bins_(params.particles.max_particles) {
  const std::size_t most = std::max(params.particles.max_particles, params.recovery.candidates);
  for (ParticleSet* set : {&particles_, &resampled_, &candidates_}) {
    set->reserve(most);
  }
  scores_.resize(most);
  unbent_scores_.resize(most);
  single_.resize(1);
  if (predictor != nullptr && (params.fusion.propose || params.fusion.measure)) {
    registrar_.emplace(sketch, *predictor, params.fusion);
  }
  parents_.resize(most);
  if (sketch.px_per_m) {
    log_px_per_m_ = std::log(*sketch.px_per_m);
  }
  report_.estimate.modes.reserve(static_cast<std::size_t>(params.modes.max_modes));
}

/// What the filter knew about the robot's past.
void Localizer::forget() {
  evidence_ = EvidenceMonitor(params_.recovery);
  last_odom_from_robot_.reset();
  updated_once_ = false;
  challengers_.forget();
  way_since_signs_m_ = 0.0;
  last_scan_from_robot_.reset();
  report_.estimate.modes.clear();
  report_.limited = false;
  if (registrar_) {
    registrar_->forget();
  }
}

void Localizer::start_at(const Sim2& sketch_from_robot) {
  forget();
  belief_.log_odds = params_.localized.start_log_odds;
  established_ = belief_.log_odds >= params_.challengers.established_log_odds;
  particles_.resize(params_.particles.max_particles);
  for_each_chunk(particles_.size(), params_.jobs, [&](std::size_t chunk, ParticleRange range) {
    Rng rng = make_rng(params_.seed, kStart, chunk);
    draw_around(sketch_from_robot, particles_, range, rng);
  });
}

void Localizer::draw_around(const Sim2& sketch_from_robot, ParticleSet& particles,
                            const ParticleRange& range, Rng& rng) const {
  const StartSpread& spread = params_.start;
  const double position_px = spread.position_m * sketch_from_robot.scale();
  const double log_scale = std::log(sketch_from_robot.scale());
  for (std::size_t i = range.begin; i < range.end; ++i) {
    particles.x_px[i] = static_cast<float>(sketch_from_robot.x() + gaussian(position_px, rng));
    particles.y_px[i] = static_cast<float>(sketch_from_robot.y() + gaussian(position_px, rng));
    particles.heading_rad[i] = static_cast<float>(
        wrap_rad(sketch_from_robot.yaw_rad() + gaussian(spread.heading_rad, rng)));
    particles.log_scale[i] = static_cast<float>(log_scale + gaussian(spread.log_scale, rng));
    particles.log_mean_scale[i] =
        static_cast<float>(log_scale + gaussian(spread.log_mean_scale, rng));
    particles.axial_strain[i] = static_cast<float>(gaussian(spread.strain, rng));
    particles.diagonal_strain[i] = static_cast<float>(gaussian(spread.strain, rng));
    particles.log_weight[i] = 0.0F;
  }
}

const StepReport& Localizer::step(const Scan& scan, const Se2& odom_from_robot,
                                  const StepBudget& budget) {
  check(particles_.size() > 0, "start the localizer before its first step");
  check(budget.max_particles > 0, "a step has particles");
  report_.step = steps_;
  report_.time_s = scan.time_s;
  report_.resampled = false;
  report_.injected_share = 0.0;
  report_.log_likelihood = 0.0;
  report_.signs.reset();
  report_.found_anew = false;
  const Se2 robot_from_next =
      last_odom_from_robot_ ? odometry_increment(*last_odom_from_robot_, odom_from_robot) : Se2();
  last_odom_from_robot_ = odom_from_robot;
  if (registrar_) {
    registrar_->add(scan, odom_from_robot, robot_from_next);
  }
  const std::optional<Sim2> expected_sketch_from_robot =
      report_.estimate.modes.empty()
          ? std::nullopt
          : std::optional(report_.estimate.sketch_from_robot * robot_from_next);
  shrink(budget.max_particles);
  report_.registered = look(robot_from_next, budget);
  predict_all(robot_from_next);
  const std::size_t beams = gate_opens() ? observe(scan) : 0;
  report_.updated = beams > 0;
  if (report_.updated) {
    weigh(beams);
  }
  report_.effective_particles = normalise(particles_).effective_particles;
  report_.particles = particles_.size();
  mode_finder_.find(particles_, report_.estimate);
  compare_scans(scan, robot_from_next);
  believe(expected_sketch_from_robot, robot_from_next, budget);
  if (report_.updated || (report_.registered && params_.fusion.propose)) {
    resample(budget);
    recover();
  }
  ++steps_;
  return report_;
}

bool Localizer::gate_opens() const {
  return !updated_once_ || way_since_update_m_ >= params_.gate.way_m ||
         turn_since_update_rad_ >= params_.gate.turn_rad;
}

/// How much of a scan the last update did not know: scans from nearly the same place err together.
double Localizer::new_share() const {
  return updated_once_
             ? std::min(1.0, way_since_update_m_ / params_.gate.independent_way_m +
                                 turn_since_update_rad_ / params_.gate.independent_turn_rad)
             : 1.0;
}

void Localizer::predict_all(const Se2& robot_from_next) {
  way_since_update_m_ += robot_from_next.translation().norm();
  turn_since_update_rad_ += std::abs(robot_from_next.yaw_rad());
  const bool proposes = report_.registered && params_.fusion.propose;
  const double before = proposes ? weight_asked_about() : 0.0;
  for_each_chunk(particles_.size(), params_.jobs, [&](std::size_t chunk, ParticleRange range) {
    Rng rng = make_rng(params_.seed, steps_ * kPurposes + kPredict, chunk);
    if (proposes) {
      propose(particles_, range, robot_from_next, params_.predict, registrar_->likelihoods(),
              likelihood_of_, rng);
    } else {
      predict(particles_, range, robot_from_next, params_.predict, rng);
    }
  });
  if (proposes) {
    // Nobody asked about the others: they keep their share of the whole weight.
    const double change = weight_asked_about() / before;
    if (change > 0.0 && std::isfinite(change)) {
      const auto log_change = static_cast<float>(std::log(change));
      for (std::size_t i = 0; i < particles_.size(); ++i) {
        particles_.log_weight[i] += likelihood_of_[i] == kNoLikelihood ? log_change : 0.0F;
      }
    }
  }
}

/// The weight of the particles that belong to a mode with a registration.
double Localizer::weight_asked_about() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += likelihood_of_[i] == kNoLikelihood ? 0.0 : std::exp(particles_.log_weight[i]);
  }
  return sum;
}

/// Registers, if it is time to; says whether that told anything.
bool Localizer::look(const Se2& robot_from_next, const StepBudget& budget) {
  const bool due = registrar_ && !report_.estimate.modes.empty() && registrar_->is_due();
  report_.looked = due && budget.may_register;
  report_.held_back = due && !budget.may_register;
  if (!report_.looked) {
    return false;
  }
  registrar_->look(report_.estimate.modes, robot_from_next);
  registrar_->assign(particles_, likelihood_of_);
  return !registrar_->likelihoods().empty();
}

std::size_t Localizer::observe(const Scan& scan) {
  return std::visit([&](auto& model) { return model.observe(scan); }, model_);
}

void Localizer::score(const ParticleSet& particles) {
  for_each_chunk(particles.size(), params_.jobs, [&](std::size_t, ParticleRange range) {
    std::visit([&](const auto& model) { model.score(particles, range, scores_); }, model_);
  });
}

void Localizer::weigh(std::size_t beams) {
  score(particles_);
  const double exponent = exponent_of(params_) * new_share();
  double weight_sum = 0.0;
  double score_sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double weight = std::exp(particles_.log_weight[i]);
    weight_sum += weight;
    score_sum += weight * scores_[i];
  }
  if (report_.registered && params_.fusion.measure && exponent > 0.0) {
    add_unbent_scores(exponent);
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_.log_weight[i] += static_cast<float>(exponent * scores_[i]);
  }
  const double per_beam = score_sum / weight_sum / static_cast<double>(beams);
  update_share_ = new_share();
  update_beams_ = beams;
  evidence_.add(per_beam, way_since_update_m_ + kWayPerTurnM * turn_since_update_rad_);
  report_.log_likelihood = per_beam;
  way_since_update_m_ = 0.0;
  turn_since_update_rad_ = 0.0;
  updated_once_ = true;
}

/// The scan as it is and as its particle's registration unbends it, as a mixture of both by how
/// probable it is that the warp is right: a wrong one costs little.
void Localizer::add_unbent_scores(double exponent) {
  const auto* model = std::get_if<BeamModel>(&model_);
  if (model == nullptr) {
    return;
  }
  const std::span<const Registration> registrations = registrar_->registrations();
  for (std::size_t which = 0; which < registrations.size(); ++which) {
    const double share = 0.5 * registrations[which].inlier_probability;
    const std::optional<PreparedBeams> beams = model->unbent(registrations[which]);
    if (!beams) {
      continue;
    }
    for_each_chunk(particles_.size(), params_.jobs, [&](std::size_t, ParticleRange range) {
      model->score(particles_, range, *beams, unbent_scores_);
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (likelihood_of_[i] == static_cast<std::int8_t>(which)) {
          const double bent = exponent * scores_[i];
          const double unbent = exponent * unbent_scores_[i];
          const double most = std::max(bent, unbent);
          scores_[i] = static_cast<float>((most + std::log((1.0 - share) * std::exp(bent - most) +
                                                           share * std::exp(unbent - most))) /
                                          exponent);
        }
      }
    });
  }
}

/// Fewer particles at once, where time is short.
void Localizer::shrink(std::size_t most) {
  if (particles_.size() <= most) {
    return;
  }
  report_.limited = true;  // until a resampling asks for no more than it may have
  Rng rng = make_rng(params_.seed, kShrinkStream + steps_);
  replace_by_parents(most, rng);
}

void Localizer::replace_by_parents(std::size_t count, Rng& rng) {
  const auto parents = std::span<std::uint32_t>(parents_).first(count);
  systematic_parents(particles_.log_weight, parents, rng);
  resampled_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    resampled_.assign(i, particles_, parents[i]);
    resampled_.log_weight[i] = 0.0F;
  }
  std::swap(particles_, resampled_);
}

void Localizer::resample(const StepBudget& budget) {
  report_.resampled =
      report_.effective_particles < params_.resample_below * static_cast<double>(particles_.size());
  if (!report_.resampled) {
    return;
  }
  Rng rng = make_rng(params_.seed, steps_ * kPurposes + kResample);
  const std::span<std::uint32_t> all(parents_);
  const auto most = all.first(std::min(params_.particles.max_particles, budget.max_particles));
  systematic_parents(particles_.log_weight, most, rng);
  const std::size_t enough = kld_count(count_bins(most), params_.particles);
  report_.limited = enough > budget.max_particles;
  replace_by_parents(std::min(enough, budget.max_particles), rng);
}

std::size_t Localizer::count_bins(std::span<const std::uint32_t> parents) {
  bins_.clear();
  const double side_px = params_.particles.bin_m * report_.estimate.sketch_from_robot.scale();
  for (const std::uint32_t parent : parents) {
    bins_.add(pose_bin(particles_.x_px[parent], particles_.y_px[parent],
                       particles_.heading_rad[parent], side_px, params_.particles.bin_rad),
              1.0);
  }
  return bins_.size();
}

void Localizer::recover() {
  if (registrar_) {
    return;  // challengers find a lost robot, and must prove themselves before they do
  }
  if (anywhere_.empty() || !report_.resampled) {
    return;  // between resamplings the weights differ: newcomers of weight one would win
  }
  Rng rng = make_rng(params_.seed, steps_ * kPurposes + kInject);
  const double expected = evidence_.injection_share() * static_cast<double>(particles_.size());
  // Rounded at random, so that shares below one particle count too.
  const auto count = static_cast<std::size_t>(expected + uniform(rng));
  if (count > 0) {
    draw_candidates();
    replace_by_candidates(count, rng);
    report_.injected_share = static_cast<double>(count) / static_cast<double>(particles_.size());
  }
}

void Localizer::draw_candidates() {
  candidates_.resize(params_.recovery.candidates);
  double log_mean = 0.0;
  for (const float log_mean_scale : particles_.log_mean_scale) {
    log_mean += log_mean_scale;
  }
  const ScalePrior scale{.log_px_per_m = log_mean / static_cast<double>(particles_.size()),
                         .sigma = params_.start.log_mean_scale};
  for_each_chunk(candidates_.size(), params_.jobs, [&](std::size_t chunk, ParticleRange range) {
    Rng rng = make_rng(params_.seed, steps_ * kPurposes + kCandidates, chunk);
    anywhere_.draw(candidates_, range, scale, params_.start.strain, rng);
  });
  score(candidates_);
  const auto exponent = static_cast<float>(params_.recovery.candidate_exponent);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    candidates_.log_weight[i] = exponent * scores_[i];
  }
  normalise(candidates_);
}

void Localizer::replace_by_candidates(std::size_t count, Rng& rng) {
  const std::span<std::uint32_t> parents(parents_.data(), count);
  systematic_parents(candidates_.log_weight, parents, rng);
  const double spacing = static_cast<double>(particles_.size()) / static_cast<double>(count);
  const double offset = uniform(rng);
  for (std::size_t k = 0; k < count; ++k) {
    const auto victim = static_cast<std::size_t>((static_cast<double>(k) + offset) * spacing);
    particles_.assign(victim, candidates_, parents[k]);
    particles_.log_weight[victim] = 0.0F;
  }
}

GlobalStart Localizer::start_anywhere(const Scan& first_scan) {
  if (anywhere_.empty()) {
    return GlobalStart::NoFreeSpace;
  }
  const std::optional<double> log_radius_m = log_visible_radius_m(first_scan);
  if (!log_px_per_m_ && !log_radius_m) {
    return GlobalStart::NoReturns;
  }
  forget();
  belief_.log_odds = params_.localized.anywhere_log_odds;
  established_ = false;
  const ScalePrior scale{
      .log_px_per_m =
          log_px_per_m_ ? *log_px_per_m_ : anywhere_.median_log_visible_radius() - *log_radius_m,
      .sigma = params_.start.log_mean_scale};
  particles_.resize(params_.particles.max_particles);
  for_each_chunk(particles_.size(), params_.jobs, [&](std::size_t chunk, ParticleRange range) {
    Rng rng = make_rng(params_.seed, kStart, chunk);
    anywhere_.draw(particles_, range, scale, params_.start.strain, rng);
  });
  return GlobalStart::Started;
}

}  // namespace sketchloc
