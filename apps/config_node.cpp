#include "apps/config_node.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace sketchloc {
namespace {

std::string joined(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : std::string(path) + "." + std::string(key);
}

[[noreturn]] void fail(std::string_view source, const std::string& what) {
  throw std::invalid_argument(std::string(source) + ": " + what);
}

/// Edits (insert, delete, replace) from one word to another. [Levenshtein66]
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// The known path that a mistaken one most likely meant: the same last key elsewhere, or the
/// fewest edits.
std::string nearest(std::string_view path, const std::vector<std::string>& known) {
  const auto last_key = [](std::string_view whole) {
    return whole.substr(whole.rfind('.') + 1);  // npos + 1 == 0
  };
  const auto edits = [&](const std::string& candidate) {
    return std::min(edit_distance(path, candidate),
                    edit_distance(last_key(path), last_key(candidate)) + 1);
  };
  return known.empty() ? "" : *std::ranges::min_element(known, {}, edits);
}

void overlay(ConfigNode& base, const ConfigNode& top, const std::string& path,
             const std::vector<std::string>& known) {
  if (base.is_map != top.is_map) {
    fail(top.source, base.is_map ? path + " is a group of parameters, not a value; set one of them"
                                 : path + " is a value, not a group of parameters");
  }
  if (!top.is_map) {
    base.text = top.text;
    base.source = top.source;
    return;
  }
  for (const auto& [key, value] : top.children) {
    const std::string below = joined(path, key);
    if (base.find(key) == nullptr) {
      fail(value.source,
           "unknown parameter " + below + "; did you mean " + nearest(below, known) + "?");
    }
    overlay(base.child(key), value, below, known);
  }
}

// ---- YAML ----------------------------------------------------------------------------------

std::string source_of(const std::filesystem::path& path, const YAML::Mark& mark) {
  return mark.is_null() ? path.string() : path.string() + ":" + std::to_string(mark.line + 1);
}

ConfigNode converted(const YAML::Node& yaml, const std::filesystem::path& path) {
  ConfigNode node;
  node.source = source_of(path, yaml.Mark());
  if (yaml.IsSequence()) {
    fail(node.source, "a list stands where a value or a group of parameters is expected");
  }
  node.is_map = yaml.IsMap();
  if (!yaml.IsMap()) {
    node.text = yaml.IsNull() ? "none" : yaml.Scalar();
    return node;
  }
  for (const auto& entry : yaml) {
    if (!entry.first.IsScalar()) {
      fail(source_of(path, entry.first.Mark()), "a parameter's name must be a word");
    }
    const std::string key = entry.first.Scalar();
    if (node.find(key) != nullptr) {
      fail(source_of(path, entry.first.Mark()), key + " is given twice; keep one");
    }
    ConfigNode& child = node.child(key);
    child = converted(entry.second, path);
    child.source = source_of(path, entry.first.Mark());  // the value may start lines below its key
  }
  return node;
}

void emit(const ConfigNode& node, YAML::Emitter& out) {
  if (!node.is_map) {
    out << node.text;
    return;
  }
  out << YAML::BeginMap;
  for (const auto& [key, value] : node.children) {
    out << YAML::Key << key << YAML::Value;
    emit(value, out);
  }
  out << YAML::EndMap;
}

void append_value_paths(const ConfigNode& node, const std::string& path,
                        std::vector<std::string>& paths) {
  for (const auto& [key, value] : node.children) {
    if (value.is_map) {
      append_value_paths(value, joined(path, key), paths);
    } else {
      paths.push_back(joined(path, key));
    }
  }
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  const auto found = std::ranges::find(children, key, &std::pair<std::string, ConfigNode>::first);
  return found == children.end() ? nullptr : &found->second;
}

ConfigNode& ConfigNode::child(std::string_view key) {
  is_map = true;
  const auto found = std::ranges::find(children, key, &std::pair<std::string, ConfigNode>::first);
  return found != children.end() ? found->second
                                 : children.emplace_back(std::string(key), ConfigNode{}).second;
}

ConfigNode read_config(const std::filesystem::path& path) {
  try {
    YAML::Node yaml = YAML::LoadFile(path.string());
    if (yaml.IsMap() && yaml["sketchloc"] && yaml["parameters"]) {  // of an earlier run
      yaml.reset(yaml["parameters"]);
    }
    ConfigNode node = converted(yaml, path);
    if (!yaml.IsNull() && !node.is_map) {
      fail(node.source,
           "expected parameters like `resample_below: 0.5`, in the groups that --print-parameters "
           "shows, found only a value");
    }
    node.is_map = true;  // an empty file states nothing
    return node;
  } catch (const YAML::BadFile&) {
    fail(path.string(), "cannot read this configuration; check the path");
  } catch (const YAML::Exception& error) {
    fail(source_of(path, error.mark), error.msg);
  }
}

std::string to_yaml(const ConfigNode& node) {
  YAML::Emitter out;
  emit(node, out);
  return std::string(out.c_str()) + "\n";
}

std::vector<std::string> value_paths(const ConfigNode& node) {
  std::vector<std::string> paths;
  append_value_paths(node, "", paths);
  return paths;
}

void set_value(ConfigNode& node, std::string_view path, ConfigNode value) {
  ConfigNode* at = &node;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    at = &at->child(path.substr(0, dot));
    at->source = value.source;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  *at = std::move(value);
}

ConfigNode without(ConfigNode node, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const std::size_t dot = path.find('.');
    if (dot != path.npos) {
      ConfigNode& part = node.child(path.substr(0, dot));
      part = without(std::move(part), {path.substr(dot + 1)});
    } else {
      std::erase_if(node.children, [&](const auto& child) { return child.first == path; });
    }
  }
  return node;
}

ConfigNode overlaid(ConfigNode base, const ConfigNode& top) {
  if (top.is_map) {
    overlay(base, top, "", value_paths(base));
  }
  return base;
}

}  // namespace sketchloc
