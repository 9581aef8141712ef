#include "motion/graph/detail/neighbourhood.hpp"

#include <utility>

#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

}  // namespace

std::size_t LinkedGraph::add(const GraphVertex& vertex) {
  graph_.vertices.push_back(vertex);
  edges_of_.emplace_back();
  places_.push_back(kNowhere);
  return graph_.vertices.size() - 1;
}

std::size_t LinkedGraph::add(const GraphEdge& edge) {
  check(edge.first < edges_of_.size() && edge.second < edges_of_.size(),
        "vertices before their edges");
  const std::size_t index = graph_.edges.size();
  graph_.edges.push_back(edge);
  edges_of_[edge.first].push_back(index);
  if (edge.second != edge.first) {
    edges_of_[edge.second].push_back(index);
  }
  return index;
}

void LinkedGraph::place(std::vector<GraphPose> poses) {
  check(poses.size() == graph_.vertices.size(), "one pose per vertex");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph_.vertices[i].frame_from_body = poses[i];
  }
}

/// Breadth first. Their places are left in places_.
std::vector<std::size_t> LinkedGraph::nearest(std::span<const std::size_t> seeds,
                                              std::size_t count) const {
  std::vector<std::size_t> found;
  const auto take = [&](std::size_t vertex) {
    if (places_[vertex] == kNowhere && found.size() < count) {
      places_[vertex] = found.size();
      found.push_back(vertex);
    }
  };
  for (const std::size_t seed : seeds) {
    take(seed);
  }
  for (std::size_t i = 0; i < found.size() && found.size() < count; ++i) {
    for (const std::size_t edge : edges_of_[found[i]]) {
      take(graph_.edges[edge].first);
      take(graph_.edges[edge].second);
    }
  }
  return found;
}

LinkedGraph::Part LinkedGraph::around(std::span<const std::size_t> seeds, std::size_t count) const {
  Part part;
  part.vertices = nearest(seeds, count);
  part.moving = part.vertices.size();
  const auto place_of = [&](std::size_t vertex) {
    if (places_[vertex] == kNowhere) {
      places_[vertex] = part.vertices.size();
      part.vertices.push_back(vertex);
    }
    return places_[vertex];
  };
  for (std::size_t i = 0; i < part.moving; ++i) {
    for (const std::size_t index : edges_of_[part.vertices[i]]) {
      const GraphEdge& edge = graph_.edges[index];
      const std::size_t first = place_of(edge.first);
      const std::size_t second = place_of(edge.second);
      const std::size_t other = first == i ? second : first;
      if (other < i) {
        continue;  // taken with the other vertex
      }
      GraphEdge& taken = part.graph.edges.emplace_back(edge);
      taken.first = first;
      taken.second = second;
    }
  }
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    GraphVertex& vertex = part.graph.vertices.emplace_back(graph_.vertices[part.vertices[i]]);
    vertex.is_fixed = vertex.is_fixed || i >= part.moving;
    places_[part.vertices[i]] = kNowhere;
  }
  return part;
}

}  // namespace sketchloc::detail
