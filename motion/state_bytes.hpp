#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "motion/se2.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

static_assert(std::endian::native == std::endian::little, "states are little-endian");

/// A plain value that a state keeps bit for bit.
template <typename T>
concept StateValue = std::is_arithmetic_v<T>;

/// Puts values one after the other, exactly, so that what is read back goes on as if it had never
/// stopped. Classes with a state have `void save(StateWriter&) const` and `void
/// load(StateReader&)`.
class StateWriter {
 public:
  template <StateValue T>
  void put(T value) {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    bytes_.append(bytes, sizeof(T));
  }
  template <StateValue T>
  void put_list(const std::vector<T>& values) {
    put<std::uint64_t>(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  template <int kRows, int kColumns>
  void put(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      put(matrix.data()[i]);
    }
  }
  void put_text(std::string_view text);
  void put(const Se2& pose);
  void put(const Sim2& pose);
  template <typename T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) {
      put(*value);
    }
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a StateWriter put, in the same order. Whatever cannot have come from one throws
/// std::runtime_error; lengths are never trusted.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : rest_(bytes) {}

  template <StateValue T>
  T get() {
    if constexpr (std::is_same_v<T, bool>) {
      return get<std::uint8_t>() != 0;
    } else {
      T value{};
      std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
      return value;
    }
  }
  double get_finite();
  /// At most `most` values.
  template <StateValue T>
  std::vector<T> get_list(std::size_t most) {
    std::vector<T> values(get_count(most));
    const std::string_view bytes = take(values.size() * sizeof(T));
    if (!values.empty()) {
      std::memcpy(values.data(), bytes.data(), bytes.size());
    }
    return values;
  }
  /// A length, at most `most`.
  std::size_t get_count(std::size_t most);
  template <int kRows, int kColumns>
  Eigen::Matrix<double, kRows, kColumns> get_matrix() {
    Eigen::Matrix<double, kRows, kColumns> matrix;
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      matrix.data()[i] = get_finite();
    }
    return matrix;
  }
  std::string get_text(std::size_t most);
  Se2 get_se2();
  Sim2 get_sim2();
  std::optional<Se2> get_optional_se2();

  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view take(std::size_t count);

  std::string_view rest_;
};

}  // namespace sketchloc
