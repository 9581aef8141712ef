#include "eval/distributions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// x^a e^-x / Gamma(a), the factor in front of both expansions.
double gamma_front(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// P(a, x) = front * sum x^n / (a (a + 1) ... (a + n)); converges fast for x < a + 1.
double gamma_by_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > sum * kEpsilon; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return gamma_front(a, x) * sum;
}

/// Q(a, x) = 1 - P(a, x) = front / (x + 1 - a - 1 (1 - a) / (x + 3 - a - ...)), the continued
/// fraction evaluated forwards as the ratio of two recurrences (Lentz); fast for x >= a + 1.
double gamma_complement_by_fraction(double a, double x) {
  double b = x + 1.0 - a;
  double numerator_ratio = 1.0 / std::numeric_limits<double>::min();
  double denominator_ratio = 1.0 / b;
  double value = denominator_ratio;
  double change = 0.0;
  constexpr double kMaxTerms = 1e6;
  for (double n = 1.0; std::abs(change - 1.0) > 2.0 * kEpsilon && n < kMaxTerms; n += 1.0) {
    const double coefficient = -n * (n - a);
    b += 2.0;
    denominator_ratio = 1.0 / (b + coefficient * denominator_ratio);
    numerator_ratio = b + coefficient / numerator_ratio;
    change = denominator_ratio * numerator_ratio;
    value *= change;
  }
  return gamma_front(a, x) * value;
}

/// Where an increasing function crosses a target: bisection to the last bit.
template <typename Increasing>
double bisect(const Increasing& f, double target, double low, double high) {
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (!(middle > low && middle < high)) {
      return middle;
    }
    (f(middle) < target ? low : high) = middle;
  }
}

/// The value >= 0 below which an increasing probability reaches the given one, in [0, 1).
template <typename Increasing>
double quantile_above_zero(const Increasing& probability_below, double probability) {
  check(probability >= 0.0 && probability < 1.0, "a quantile needs a share in [0, 1)");
  if (probability == 0.0) {
    return 0.0;
  }
  double high = 1.0;
  while (probability_below(high) < probability) {
    high *= 2.0;
  }
  return bisect(probability_below, probability, 0.0, high);
}

}  // namespace

double normal_quantile(double probability) {
  check(probability > 0.0 && probability < 1.0, "a normal quantile needs a probability in (0, 1)");
  if (probability > 0.5) {  // the lower tail keeps its digits
    return -normal_quantile(1.0 - probability);
  }
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  return bisect(below, probability, -40.0, 0.0);  // P(x < -40) underflows
}

double incomplete_gamma(double a, double x) {
  check(a > 0.0 && x >= 0.0, "the incomplete gamma function needs a > 0 and x >= 0");
  if (x == 0.0) {
    return 0.0;
  }
  return x < a + 1.0 ? gamma_by_series(a, x) : 1.0 - gamma_complement_by_fraction(a, x);
}

double chi_square_probability(double x, double degrees) {
  return incomplete_gamma(0.5 * degrees, 0.5 * x);
}

double chi_square_quantile(double probability, double degrees) {
  return quantile_above_zero([&](double x) { return chi_square_probability(x, degrees); },
                             probability);
}

double student_t_probability(double x, int dimensions, int degrees) {
  check(dimensions > 0 && degrees > 2 && degrees % 2 == 0 && x >= 0.0,
        "a Student t with an even number of degrees of freedom that has a covariance");
  // x / (degrees - 2) is a ratio of chi-square variables, so `share` has a beta distribution with
  // (dimensions / 2, degrees / 2): a finite sum, since the second is an integer.
  const double share = x / (x + degrees - 2.0);
  const double a = 0.5 * dimensions;
  double term = 1.0;
  double sum = 1.0;
  for (int j = 1; j < degrees / 2; ++j) {
    term *= (a + j - 1.0) / j * (1.0 - share);
    sum += term;
  }
  return std::pow(share, a) * sum;
}

double student_t_quantile(double probability, int dimensions, int degrees) {
  return quantile_above_zero(
      [&](double x) { return student_t_probability(x, dimensions, degrees); }, probability);
}

}  // namespace sketchloc
