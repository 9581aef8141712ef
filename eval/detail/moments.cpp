#include "eval/detail/moments.hpp"

#include <algorithm>
#include <limits>

namespace sketchloc::detail {
namespace {

const StepError* error_at(std::span<const StepError> errors, std::size_t step) {
  const auto it = std::ranges::lower_bound(errors, step, {}, &StepError::step);
  return it != errors.end() && it->step == step ? &*it : nullptr;
}

std::size_t index_of(const RunRecord& record, std::size_t step) {
  const auto it = std::ranges::lower_bound(record.steps, step, {}, &StepReport::step);
  return static_cast<std::size_t>(it - record.steps.begin());
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

std::size_t distance_to(std::span<const std::size_t> taken, std::size_t index) {
  std::size_t nearest = std::numeric_limits<std::size_t>::max();
  for (const std::size_t other : taken) {
    nearest = std::min(nearest, distance(other, index));
  }
  return nearest;
}

std::size_t farthest_step(std::span<const std::size_t> taken, std::size_t steps) {
  std::size_t farthest = 0;
  for (std::size_t index = 0; index < steps; ++index) {
    if (distance_to(taken, index) > distance_to(taken, farthest)) {
      farthest = index;
    }
  }
  return farthest;
}

/// Moments this few steps apart look the same.
constexpr std::size_t kSameMoment = 3;

/// The moments that have a reason; one may have two of them.
std::vector<Moment> notable_moments(const RunRecord& record, std::span<const StepError> errors) {
  std::vector<Moment> moments;
  const auto add = [&](std::size_t index, const std::string& reason) {
    const auto same = std::ranges::find_if(
        moments, [&](const Moment& m) { return distance(m.index, index) <= kSameMoment; });
    if (same != moments.end()) {
      same->reason += ", " + reason;
    } else {
      moments.push_back({.letter = {}, .index = index, .reason = reason, .error = {}});
    }
  };
  if (errors.empty()) {
    const auto least_certain = std::ranges::max_element(
        record.steps, {}, [](const StepReport& r) { return stated_position_sigma_m(r.estimate); });
    add(static_cast<std::size_t>(least_certain - record.steps.begin()), "least certain");
    return moments;
  }
  if (const std::optional<StepError> loss = first_loss(errors, record.loss)) {
    add(index_of(record, loss->step), "first lost");
  }
  const auto worst = std::ranges::max_element(errors, {}, &StepError::translation_m);
  add(index_of(record, worst->step), "largest error");
  return moments;
}

/// The step nearest to this one whose particles are known too; itself where there is none near.
std::size_t with_snapshot(const RunRecord& record, std::size_t index, std::size_t reach) {
  const ParticleSnapshot* snapshot = nearest_snapshot(record, record.steps[index].step);
  if (snapshot == nullptr) {
    return index;
  }
  const std::size_t known = index_of(record, snapshot->step);
  return known < record.steps.size() && distance(known, index) < reach ? known : index;
}

/// Fills up with the steps farthest from those taken already, or a little beside them.
void add_evenly(std::vector<Moment>& moments, const RunRecord& record, std::size_t count) {
  const std::size_t steps = record.steps.size();
  constexpr std::size_t kNearestShare = 3;
  const std::size_t nearest = std::max<std::size_t>(1, steps / (kNearestShare * count));
  std::vector<std::size_t> taken;
  std::ranges::transform(moments, std::back_inserter(taken), &Moment::index);
  while (moments.size() < count) {
    const std::size_t farthest = farthest_step(taken, steps);
    if (distance_to(taken, farthest) < nearest) {
      return;
    }
    const std::size_t index = with_snapshot(record, farthest, nearest);
    moments.push_back({.letter = {}, .index = index, .reason = {}, .error = {}});
    taken.push_back(index);
  }
}

}  // namespace

std::vector<Moment> choose_moments(const RunRecord& record, std::span<const StepError> errors,
                                   std::size_t others) {
  if (record.steps.empty()) {
    return {};
  }
  std::vector<Moment> moments = notable_moments(record, errors);
  add_evenly(moments, record, moments.size() + others);
  std::ranges::sort(moments, {}, &Moment::index);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    moments[i].letter = std::string(1, static_cast<char>('A' + i));
    if (const StepError* error = error_at(errors, record.steps[moments[i].index].step)) {
      moments[i].error = *error;
    }
  }
  return moments;
}

const ParticleSnapshot* nearest_snapshot(const RunRecord& record, std::size_t step) {
  const auto nearest = std::ranges::min_element(
      record.snapshots, {}, [&](const ParticleSnapshot& s) { return distance(s.step, step); });
  return nearest == record.snapshots.end() ? nullptr : &*nearest;
}

}  // namespace sketchloc::detail
