#pragma once

namespace sketchloc {

/// The value that a standard normal deviate stays below with probability p, 0 < p < 1.
double normal_quantile(double probability);

/// Regularised lower incomplete gamma function P(a, x), a > 0, x >= 0.
double incomplete_gamma(double a, double x);

/// Probability that a chi-square variable with `degrees` > 0 degrees of freedom is at most x.
double chi_square_probability(double x, double degrees);

/// The value that a chi-square variable stays below with the given probability in [0, 1).
double chi_square_quantile(double probability, double degrees);

/// The share of a Student t in `dimensions` with `degrees` of freedom, an even number > 2, whose
/// squared Mahalanobis distance by its covariance is at most x >= 0.
double student_t_probability(double x, int dimensions, int degrees);

/// The squared Mahalanobis distance, by its covariance, that it stays below with the given
/// probability in [0, 1): chi_square_quantile's counterpart with long tails.
double student_t_quantile(double probability, int dimensions, int degrees);

}  // namespace sketchloc
