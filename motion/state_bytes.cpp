#include "motion/state_bytes.hpp"

#include <cmath>

namespace sketchloc {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("the state is damaged: ") + what);
}

}  // namespace

void StateWriter::put_text(std::string_view text) {
  put<std::uint64_t>(text.size());
  bytes_.append(text);
}

void StateWriter::put(const Se2& pose) {
  put(pose.x_m());
  put(pose.y_m());
  put(pose.rotation().real());
  put(pose.rotation().imag());
}

void StateWriter::put(const Sim2& pose) {
  put(pose.x());
  put(pose.y());
  put(pose.scaled_rotation().real());
  put(pose.scaled_rotation().imag());
}

std::string_view StateReader::take(std::size_t count) {
  if (count > rest_.size()) {
    fail("it ends too early");
  }
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

double StateReader::get_finite() {
  const auto value = get<double>();
  if (!std::isfinite(value)) {
    fail("a number is not finite");
  }
  return value;
}

std::size_t StateReader::get_count(std::size_t most) {
  const auto count = get<std::uint64_t>();
  if (count > most) {
    fail("a list is too long");
  }
  return count;
}

std::string StateReader::get_text(std::size_t most) {
  const std::vector<char> text = get_list<char>(most);
  return {text.begin(), text.end()};
}

Se2 StateReader::get_se2() {
  const double x_m = get_finite();
  const double y_m = get_finite();
  const double real = get_finite();
  const double imaginary = get_finite();
  if (std::abs(std::hypot(real, imaginary) - 1.0) > 1e-9) {
    fail("a rotation is none");
  }
  return Se2::from_parts({x_m, y_m}, {real, imaginary});
}

Sim2 StateReader::get_sim2() {
  const double x = get_finite();
  const double y = get_finite();
  const double real = get_finite();
  const double imaginary = get_finite();
  if (real == 0.0 && imaginary == 0.0) {
    fail("a scale is 0");
  }
  return Sim2::from_parts({x, y}, {real, imaginary});
}

std::optional<Se2> StateReader::get_optional_se2() {
  return get<bool>() ? std::optional(get_se2()) : std::nullopt;
}

}  // namespace sketchloc
