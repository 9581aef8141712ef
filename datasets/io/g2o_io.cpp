#include "datasets/io/g2o_io.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/line_reader.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::Columns;
using detail::Place;

constexpr double kMostInformation = 1e18;
constexpr std::int64_t kLowestId = std::numeric_limits<std::int64_t>::min() / 4;
constexpr std::int64_t kHighestId = std::numeric_limits<std::int64_t>::max() / 4;

std::int64_t read_id(Columns& columns, std::string_view field) {
  return columns.integer(field, kLowestId, kHighestId);
}

GraphPose read_pose(Columns& columns) {
  GraphPose pose;
  pose.x = columns.number("x", detail::kMostPosition_m);
  pose.y = columns.number("y", detail::kMostPosition_m);
  pose.yaw_rad = columns.number("theta", detail::kMostAngle_rad);
  return pose;
}

/// The upper triangle, row by row.
Eigen::Matrix4d read_information(Columns& columns) {
  static constexpr std::array<std::string_view, 6> kFields = {"I11", "I12", "I13",
                                                              "I22", "I23", "I33"};
  Eigen::Matrix3d information;
  auto field = kFields.begin();
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      information(row, column) = columns.number(*field++, kMostInformation);
      information(column, row) = information(row, column);
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // No covariance has less on its diagonal: |I_ij| <= sqrt(I_ii I_jj).
      const double most = std::sqrt(information(i, i) * information(j, j));
      if (!(std::abs(information(i, j)) <= most * (1.0 + 1e-9))) {
        detail::fail_expected(
            columns.place(), "information", "the inverse of a covariance: I11 I12 I13 I22 I23 I33",
            "a matrix with a negative eigenvalue", "correct the values or remove the line");
      }
    }
  }
  return information_of(information);
}

/// An edge whose vertices may come later in the file.
struct NamedEdge {
  std::size_t line = 0;
  std::int64_t first = 0;
  std::int64_t second = 0;
};

/// What has been read so far.
class G2oReader {
 public:
  void take(std::string_view line, const Place& place) {
    Columns columns = Columns::blank_separated(line, place);
    const std::string_view tag = columns.text("tag");
    if (tag == "VERTEX_SE2") {
      take_vertex(columns);
    } else if (tag == "EDGE_SE2") {
      take_edge(columns);
    } else if (tag == "EDGE_PRIOR_SE2") {
      take_prior(columns);
    } else if (tag == "FIX") {
      take_fix(columns);
    } else {
      detail::fail_expected(place, "tag", "VERTEX_SE2, EDGE_SE2, EDGE_PRIOR_SE2 or FIX",
                            detail::in_quotes(tag),
                            "project the graph to the plane first, or remove the line");
    }
  }

  PoseGraph finish(const std::filesystem::path& file) {
    if (graph_.vertices.empty()) {
      detail::fail({.file = file},
                   "vertices: expected lines of VERTEX_SE2 id x y theta, found none");
    }
    for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
      const NamedEdge& named = edges_[i];
      const Place place{.file = file, .line = named.line};
      graph_.edges[i].first = index_of(named.first, place);
      graph_.edges[i].second = index_of(named.second, place);
    }
    for (const auto& [id, line] : fixed_) {
      graph_.vertices[index_of(id, {.file = file, .line = line})].is_fixed = true;
    }
    return std::move(graph_);
  }

 private:
  void take_vertex(Columns& columns) {
    const std::int64_t id = read_id(columns, "id");
    const GraphPose pose = read_pose(columns);
    columns.expect_end();
    if (!indices_.emplace(id, graph_.vertices.size()).second) {
      detail::fail_expected(columns.place(), "id", "an id of its own",
                            std::to_string(id) + " again", "remove the vertex that is not meant");
    }
    GraphVertex& vertex = graph_.vertices.emplace_back();
    vertex.id = id;
    vertex.frame_from_body = pose;
  }

  void take_edge(Columns& columns) {
    const std::int64_t first = read_id(columns, "first id");
    const std::int64_t second = read_id(columns, "second id");
    if (first == second) {
      detail::fail_expected(columns.place(), "second id", "another vertex than the first",
                            std::to_string(second) + " again", "remove the line");
    }
    add(columns, {.line = columns.place().line, .first = first, .second = second},
        EdgeKind::Between);
  }

  void take_prior(Columns& columns) {
    const std::int64_t id = read_id(columns, "id");
    add(columns, {.line = columns.place().line, .first = id, .second = id}, EdgeKind::Prior);
  }

  void add(Columns& columns, const NamedEdge& named, EdgeKind kind) {
    GraphEdge edge;
    edge.kind = kind;
    edge.measured = read_pose(columns);
    edge.information = read_information(columns);
    columns.expect_end();
    edge.may_be_wrong = kind == EdgeKind::Between && std::abs(named.first - named.second) != 1;
    graph_.edges.push_back(edge);
    edges_.push_back(named);
  }

  void take_fix(Columns& columns) {
    while (!columns.at_end()) {
      fixed_.emplace_back(read_id(columns, "id"), columns.place().line);
    }
  }

  std::size_t index_of(std::int64_t id, const Place& place) const {
    const auto found = indices_.find(id);
    if (found == indices_.end()) {
      detail::fail_expected(place, "id", "the id of a vertex", std::to_string(id),
                            "add VERTEX_SE2 " + std::to_string(id) + " or remove the line");
    }
    return found->second;
  }

  PoseGraph graph_;
  std::vector<NamedEdge> edges_;                             ///< beside those of the graph
  std::vector<std::pair<std::int64_t, std::size_t>> fixed_;  ///< id, line
  std::unordered_map<std::int64_t, std::size_t> indices_;
};

void append_pose(std::string& text, const GraphPose& pose) {
  for (const double value : {pose.x, pose.y, pose.yaw_rad}) {
    text += ' ';
    append_number(text, value);
  }
}

void append_edge(std::string& text, const PoseGraph& graph, const GraphEdge& edge) {
  const bool is_prior = edge.kind == EdgeKind::Prior;
  text += is_prior ? "EDGE_PRIOR_SE2 " : "EDGE_SE2 ";
  append_number(text, graph.vertices[edge.first].id);
  if (!is_prior) {
    text += ' ';
    append_number(text, graph.vertices[edge.second].id);
  }
  append_pose(text, edge.measured);
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      text += ' ';
      append_number(text, edge.information(row, column));
    }
  }
  text += '\n';
}

}  // namespace

PoseGraph read_g2o(const std::filesystem::path& g2o) {
  G2oReader reader;
  detail::for_each_data_line(
      g2o, [&reader](std::string_view line, const Place& place) { reader.take(line, place); }, {});
  return reader.finish(g2o);
}

std::string g2o_text(const PoseGraph& graph) {
  std::string text;
  for (const GraphVertex& vertex : graph.vertices) {
    if (vertex.kind != VertexKind::Se2) {
      throw std::invalid_argument("g2o has no vertices with a scale: write rigid ones only");
    }
    text += "VERTEX_SE2 ";
    append_number(text, vertex.id);
    append_pose(text, vertex.frame_from_body);
    text += '\n';
  }
  for (const GraphVertex& vertex : graph.vertices) {
    if (vertex.is_fixed) {
      text += "FIX " + std::to_string(vertex.id) + "\n";
    }
  }
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::Between && edge.kind != EdgeKind::Prior) {
      throw std::invalid_argument("g2o has no such edges: write relative poses and priors only");
    }
    append_edge(text, graph, edge);
  }
  return text;
}

void write_g2o(const std::filesystem::path& g2o, const PoseGraph& graph) {
  write_atomically(g2o, g2o_text(graph));
}

}  // namespace sketchloc
