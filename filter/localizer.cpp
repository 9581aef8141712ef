#include "filter/localizer.hpp"

#include <algorithm>
#include <cmath>

#include "filter/detail/chunks.hpp"
#include "motion/angles.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

// What an engine is for, so that no two uses share a stream.
enum Purpose : std::uint64_t { kStart, kPredict, kResample, kCandidates, kInject, kPurposes };

// The same where time is short, far from the numbers of the usual engines.
constexpr std::uint64_t kShrinkStream = 2ULL << 32;

/// A robot that turns sees new directions: the way that is worth a radian to recovery.
constexpr double kWayPerTurnM = 0.3;

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

Localizer::Localizer(const Sketch& sketch, const LocalizerParams& params, WarpPredictor* predictor)
    : params_((validate(params), params)),
      table_(sketch.occupied, params.table),
      anywhere_(sketch, table_),
      model_(sketch, table_, params),
      mode_finder_(params.modes,
                   std::max(params.particles.max_particles, params.recovery.candidates)),
      evidence_(params.recovery),
      challengers_(params.challengers),
      resampler_(params.particles) {
  const std::size_t most = std::max(params.particles.max_particles, params.recovery.candidates);
  for (ParticleSet* set : {&particles_, &candidates_}) {
    set->reserve(most);
  }
  scores_.resize(most);
  chosen_.reserve(most);
  if (predictor != nullptr && (params.fusion.propose || params.fusion.measure)) {
    registrar_.emplace(sketch, *predictor, params.fusion);
  }
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
  const std::size_t beams = gate_opens() ? model_.observe(scan) : 0;
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
  registrar_->assign(particles_, params_.modes, likelihood_of_);
  return !registrar_->likelihoods().empty();
}

void Localizer::weigh(std::size_t beams) {
  model_.score(particles_, scores_);
  const double exponent = model_.exponent() * new_share();
  double weight_sum = 0.0;
  double score_sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double weight = std::exp(particles_.log_weight[i]);
    weight_sum += weight;
    score_sum += weight * scores_[i];
  }
  if (report_.registered && params_.fusion.measure) {
    model_.mix_unbent(particles_, {registrar_->registrations(), likelihood_of_}, exponent, scores_);
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_.log_weight[i] += static_cast<float>(exponent * scores_[i]);
  }
  const double per_beam = score_sum / weight_sum / static_cast<double>(beams);
  update_share_ = new_share();
  evidence_.add(per_beam, way_since_update_m_ + kWayPerTurnM * turn_since_update_rad_);
  report_.log_likelihood = per_beam;
  way_since_update_m_ = 0.0;
  turn_since_update_rad_ = 0.0;
  updated_once_ = true;
}

/// Fewer particles at once, where time is short.
void Localizer::shrink(std::size_t most) {
  if (particles_.size() <= most) {
    return;
  }
  report_.limited = true;  // until a resampling asks for no more than it may have
  Rng rng = make_rng(params_.seed, kShrinkStream + steps_);
  resampler_.draw(particles_, most, rng);
}

void Localizer::resample(const StepBudget& budget) {
  report_.resampled =
      report_.effective_particles < params_.resample_below * static_cast<double>(particles_.size());
  if (!report_.resampled) {
    return;
  }
  Rng rng = make_rng(params_.seed, steps_ * kPurposes + kResample);
  const std::size_t enough = resampler_.adapt(particles_, budget.max_particles,
                                              report_.estimate.sketch_from_robot.scale(), rng);
  report_.limited = enough > budget.max_particles;
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
    chosen_.resize(count);
    systematic_parents(candidates_.log_weight, chosen_, rng);
    replace_evenly(particles_, candidates_, chosen_, rng);
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
  model_.score(candidates_, scores_);
  const auto exponent = static_cast<float>(params_.recovery.candidate_exponent);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    candidates_.log_weight[i] = exponent * scores_[i];
  }
  normalise(candidates_);
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
