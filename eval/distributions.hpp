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

}  // namespace sketchloc
