#include "motion/graph/fixed_lag.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "motion/check.hpp"
#include "motion/graph/detail/descent.hpp"
#include "motion/graph/detail/marginal.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

using detail::DensePrior;
using detail::Descent;
using detail::NormalEquations;

void validate(const FixedLagParams& params) {
  require_at_least("lag", static_cast<double>(params.lag), 1.0);
  require_at_least("most_iterations", params.most_iterations, 1.0);
  validate_part("kernel", params.kernel);
}

/// The window is a graph of its own; its vertices carry the number they came with as their place
/// in `numbers`.
struct FixedLagSmoother::State {
  FixedLagParams params;
  PoseGraph window;
  std::vector<std::size_t> numbers;  ///< of the window's vertices, ascending
  std::vector<bool> stays;           ///< beside `numbers`
  std::optional<DensePrior> prior;   ///< over vertices of the window
  std::vector<GraphPose> poses;      ///< of all vertices

  std::optional<std::size_t> place_of(std::size_t number) const {
    const auto found = std::ranges::lower_bound(numbers, number);
    const bool is_there = found != numbers.end() && *found == number;
    return is_there ? std::optional(static_cast<std::size_t>(found - numbers.begin()))
                    : std::nullopt;
  }
  const DensePrior* known() const { return prior ? &*prior : nullptr; }
  std::vector<bool> leaving() const;
  void let_go(const std::vector<bool>& gone);
  void close_up(const std::vector<bool>& gone);
};

FixedLagSmoother::FixedLagSmoother(const FixedLagParams& params)
    : state_(std::make_unique<State>()) {
  validate(params);
  require_no_graduation(params.kernel);
  state_->params = params;
}
FixedLagSmoother::~FixedLagSmoother() = default;
FixedLagSmoother::FixedLagSmoother(FixedLagSmoother&& other) noexcept = default;
FixedLagSmoother& FixedLagSmoother::operator=(FixedLagSmoother&& other) noexcept = default;

std::size_t FixedLagSmoother::add(const GraphVertex& vertex, bool stays) {
  state_->window.vertices.push_back(vertex);
  state_->numbers.push_back(state_->poses.size());
  state_->stays.push_back(stays);
  state_->poses.push_back(vertex.frame_from_body);
  return state_->poses.size() - 1;
}

bool FixedLagSmoother::add(const GraphEdge& edge) {
  check(std::max(edge.first, edge.second) < state_->poses.size(), "vertices before their edges");
  const std::optional<std::size_t> first = state_->place_of(edge.first);
  const std::optional<std::size_t> second = state_->place_of(edge.second);
  if (!first || !second) {
    return false;
  }
  GraphEdge& added = state_->window.edges.emplace_back(edge);
  added.first = *first;
  added.second = *second;
  return true;
}

OptimiseResult::Status FixedLagSmoother::update() {
  State& state = *state_;
  const std::vector<bool> held = detail::held_vertices(state.window, state.known());
  OptimiseResult::Status status = OptimiseResult::Status::Converged;
  NormalEquations equations(state.window, held, state.known());
  if (equations.unknowns().size() > 0) {
    Descent descent(equations, detail::poses_of(state.window), OptimiseParams{});
    status = descent.run({.kernel = state.params.kernel}, state.params.most_iterations);
    state.window = with_poses(std::move(state.window), descent.poses());
    for (std::size_t i = 0; i < state.numbers.size(); ++i) {
      state.poses[state.numbers[i]] = descent.poses()[i];
    }
  }
  const std::vector<bool> gone = state.leaving();
  if (std::ranges::count(gone, true) > 0) {
    state.let_go(gone);
  }
  return status;
}

/// The oldest ones beyond the lag.
std::vector<bool> FixedLagSmoother::State::leaving() const {
  std::vector<bool> gone(numbers.size(), false);
  auto young = static_cast<std::size_t>(std::ranges::count(stays, false));
  for (std::size_t i = 0; i < gone.size() && young > params.lag; ++i) {
    if (!stays[i]) {
      gone[i] = true;
      --young;
    }
  }
  return gone;
}

/// Replaces the edges of those that go, and the prior, by what they say about the others.
void FixedLagSmoother::State::let_go(const std::vector<bool>& gone) {
  const std::vector<bool> held = detail::held_vertices(window, known());
  // Only they, their neighbours and the prior's vertices are in it; the rest counts as known and
  // has no edge there.
  PoseGraph leaving{.vertices = window.vertices, .edges = {}};
  std::vector<bool> outside(gone.size(), true);
  const auto take = [&](std::size_t vertex) { outside[vertex] = held[vertex]; };
  for (const GraphEdge& edge : window.edges) {
    if (gone[edge.first] || gone[edge.second]) {
      leaving.edges.push_back(edge);
      take(edge.first);
      take(edge.second);
    }
  }
  for (std::size_t i = 0; prior && i < prior->vertices.size(); ++i) {
    take(prior->vertices[i]);
  }
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (gone[i]) {
      take(i);
    }
  }
  prior = detail::marginal(leaving, gone, outside, known(), params.kernel);
  std::erase_if(window.edges,
                [&](const GraphEdge& edge) { return gone[edge.first] || gone[edge.second]; });
  close_up(gone);
}

/// Gives the vertices that are left their new places.
void FixedLagSmoother::State::close_up(const std::vector<bool>& gone) {
  std::vector<std::size_t> places(gone.size(), 0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    places[i] = next;
    if (!gone[i]) {
      window.vertices[next] = window.vertices[i];
      numbers[next] = numbers[i];
      stays[next] = stays[i];
      ++next;
    }
  }
  window.vertices.resize(next);
  numbers.resize(next);
  stays.resize(next);
  for (GraphEdge& edge : window.edges) {
    edge.first = places[edge.first];
    edge.second = places[edge.second];
  }
  for (std::size_t& vertex : prior->vertices) {
    vertex = places[vertex];
  }
}

const GraphPose& FixedLagSmoother::pose(std::size_t vertex) const {
  check(vertex < state_->poses.size(), "a vertex that was added");
  return state_->poses[vertex];
}

std::size_t FixedLagSmoother::moving() const { return state_->numbers.size(); }

}  // namespace sketchloc
