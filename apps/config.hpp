#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "apps/config_node.hpp"
#include "motion/number_text.hpp"

/// Parameter structs to and from text. A struct takes part by one template beside it, which fixes
/// the names (the fields' own) and their order:
///   template <typename Visitor>
///   void visit_fields(OdometryNoise& noise, Visitor&& visit) {
///     visit("slip_m_per_m", noise.slip_m_per_m);
///   }
/// Fields are numbers, bool, strings, std::optional of these, other such structs, and enums with
/// `std::span<const std::pair<std::string_view, Kind>> names_of(Kind)` beside them.
namespace sketchloc {
namespace detail {

struct NoVisitor {
  template <typename Field>
  void operator()(std::string_view /*name*/, Field& /*field*/) const {}
};

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

[[noreturn]] void fail_to_read(const ConfigNode& node, std::string_view name,
                               std::string_view expected);
/// Passes on what validate() found, with the source of the field that its message begins with.
[[noreturn]] void fail_to_validate(const ConfigNode& node, std::string_view name,
                                   const std::invalid_argument& error);

}  // namespace detail

template <typename T>
concept ParameterStruct = requires(T& parameters, detail::NoVisitor visitor) {
  visit_fields(parameters, visitor);
};

template <typename T>
concept NamedEnum = std::is_enum_v<T> && requires(T value) {
  names_of(value);
};

/// A parameter struct as a map of its fields, any other field as a value.
template <typename T>
ConfigNode to_config(T value) {
  ConfigNode node;
  if constexpr (ParameterStruct<T>) {
    node.is_map = true;
    visit_fields(value, [&node](std::string_view name, auto& field) {
      node.child(name) = to_config(field);
    });
  } else if constexpr (detail::IsOptional<T>::value) {
    node = value ? to_config(*value) : ConfigNode{.text = "none"};
  } else if constexpr (NamedEnum<T>) {
    for (const auto& [name, candidate] : names_of(value)) {
      node.text = candidate == value ? std::string(name) : node.text;
    }
  } else if constexpr (std::is_same_v<T, bool>) {
    node.text = value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    node.text = number_text(value);
  } else {
    node.text = value;
  }
  return node;
}

/// One number as it stands in a file or flag; throws std::invalid_argument naming source and field.
template <typename T>
T number_from_config(const ConfigNode& node, std::string_view name) {
  const std::optional<T> number = parse_number<T>(node.text);
  if (!number) {
    detail::fail_to_read(node, name,
                         std::is_floating_point_v<T> ? "a number"
                         : std::is_signed_v<T>       ? "a whole number"
                                                     : "a whole number, 0 or more");
  }
  return *number;
}

template <NamedEnum T>
T enumerator_from_config(const ConfigNode& node, std::string_view name) {
  std::string names;
  for (const auto& [candidate, value] : names_of(T{})) {
    if (candidate == node.text) {
      return value;
    }
    names += (names.empty() ? "" : " | ") + std::string(candidate);
  }
  detail::fail_to_read(node, name, names);
}

/// The inverse of to_config, for a node that states every field. Structs are validated, inner ones
/// first. Throws std::invalid_argument naming source, parameter, what was expected and found.
template <typename T>
T from_config(const ConfigNode& node, const std::string& name = "") {
  if constexpr (ParameterStruct<T>) {
    T parameters{};
    visit_fields(parameters, [&]<typename Field>(std::string_view field_name, Field& field) {
      const std::string whole =
          name.empty() ? std::string(field_name) : name + "." + std::string(field_name);
      field = from_config<Field>(*node.find(field_name), whole);
    });
    if constexpr (requires { validate(parameters); }) {
      try {
        validate(parameters);
      } catch (const std::invalid_argument& error) {
        detail::fail_to_validate(node, name, error);
      }
    }
    return parameters;
  } else if constexpr (detail::IsOptional<T>::value) {
    return node.text == "none" ? T{} : T{from_config<typename T::value_type>(node, name)};
  } else if constexpr (NamedEnum<T>) {
    return enumerator_from_config<T>(node, name);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (node.text != "true" && node.text != "false") {
      detail::fail_to_read(node, name, "true or false");
    }
    return node.text == "true";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return number_from_config<T>(node, name);
  } else {
    return node.text;
  }
}

}  // namespace sketchloc
