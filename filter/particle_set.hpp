#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "filter/particle_spans.hpp"
#include "motion/sim2.hpp"
#include "motion/state_bytes.hpp"

namespace sketchloc {

/// Hypotheses of the robot's pose in the drawing and of the drawing's local deformation, stored as
/// a structure of arrays in float.
///
/// The local map robot metres -> sketch pixels of a particle is the linear map
///   J = exp(log_scale) * S * R(heading),   S = exp([[axial, diagonal], [diagonal, -axial]]),
/// its polar decomposition: R is a rotation, S a symmetric strain of determinant 1 in the sketch
/// frame. People draw the two directions of a room in different proportions; a particle that is a
/// similarity only cannot say so. The ratio of J's singular values is exp(2 |(axial, diagonal)|).
struct ParticleSet {
  std::vector<float> x_px;
  std::vector<float> y_px;
  std::vector<float> heading_rad;      ///< rotation part of J, in (-pi, pi]
  std::vector<float> log_scale;        ///< of the local scale in px/m
  std::vector<float> log_mean_scale;   ///< of the scale of the drawing around here, px/m
  std::vector<float> axial_strain;     ///< > 0: stretched along sketch x, squeezed along y
  std::vector<float> diagonal_strain;  ///< > 0: stretched along x = y
  std::vector<float> log_weight;       ///< not normalised

  std::size_t size() const { return x_px.size(); }
  void resize(std::size_t count);
  void reserve(std::size_t count);

  /// The poses as the measurement kernels read them.
  ParticleSpans spans() const;

  /// The similarity part of one particle.
  Sim2 sketch_from_robot(std::size_t index) const;

  void save(StateWriter& state) const;
  /// Throws std::runtime_error for a set that is empty or larger than `most`.
  void load(StateReader& state, std::size_t most);

  /// Copies one particle of another set, weight included.
  void assign(std::size_t index, const ParticleSet& from, std::size_t from_index);
};

/// S of ParticleSet for one strain.
Eigen::Matrix2d strain_matrix(double axial, double diagonal);

}  // namespace sketchloc
