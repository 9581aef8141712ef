#include "filter/particle_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sketchloc {
namespace {

constexpr std::array kFields = {&ParticleSet::x_px,
                                &ParticleSet::y_px,
                                &ParticleSet::heading_rad,
                                &ParticleSet::log_scale,
                                &ParticleSet::log_mean_scale,
                                &ParticleSet::axial_strain,
                                &ParticleSet::diagonal_strain,
                                &ParticleSet::log_weight};

}  // namespace

void ParticleSet::resize(std::size_t count) {
  for (const auto field : kFields) {
    (this->*field).resize(count);
  }
}

void ParticleSet::reserve(std::size_t count) {
  for (const auto field : kFields) {
    (this->*field).reserve(count);
  }
}

ParticleSpans ParticleSet::spans() const {
  return {.x_px = x_px,
          .y_px = y_px,
          .heading_rad = heading_rad,
          .log_scale = log_scale,
          .axial_strain = axial_strain,
          .diagonal_strain = diagonal_strain};
}

Sim2 ParticleSet::sketch_from_robot(std::size_t index) const {
  return Sim2::from_xy_yaw_scale(x_px[index], y_px[index], heading_rad[index],
                                 std::exp(log_scale[index]));
}

void ParticleSet::assign(std::size_t index, const ParticleSet& from, std::size_t from_index) {
  for (const auto field : kFields) {
    (this->*field)[index] = (from.*field)[from_index];
  }
}

void ParticleSet::save(StateWriter& state) const {
  for (const auto field : kFields) {
    state.put_list(this->*field);
  }
}

void ParticleSet::load(StateReader& state, std::size_t most) {
  for (const auto field : kFields) {
    const std::vector<float> values = state.get_list<float>(most);
    const bool whole = field == kFields.front() ? !values.empty() : values.size() == size();
    const bool numbers = std::ranges::all_of(values, [&](float value) {
      return std::isfinite(value) || (field == &ParticleSet::log_weight && value < 0.0F);
    });
    if (!whole || !numbers) {
      throw std::runtime_error("the state is damaged: its particles are none");
    }
    (this->*field).assign(values.begin(), values.end());  // keeps what was reserved
  }
}

Eigen::Matrix2d strain_matrix(double axial, double diagonal) {
  const double size = std::hypot(axial, diagonal);
  const double sinh_over = size > 1e-8 ? std::sinh(size) / size : 1.0;
  Eigen::Matrix2d strain;
  strain << axial, diagonal, diagonal, -axial;
  return std::cosh(size) * Eigen::Matrix2d::Identity() + sinh_over * strain;
}

}  // namespace sketchloc
