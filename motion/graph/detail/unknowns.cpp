#include "motion/graph/detail/unknowns.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

using BlockPair = std::pair<std::size_t, std::size_t>;

/// Which vertices hang together.
class Parts {
 public:
  explicit Parts(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  std::size_t root(std::size_t vertex) {
    while (parents_[vertex] != vertex) {
      vertex = parents_[vertex] = parents_[parents_[vertex]];
    }
    return vertex;
  }
  void join(std::size_t a, std::size_t b) { parents_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parents_;
};

/// Every pair of moving vertices that an edge or the prior joins.
std::vector<BlockPair> joined_pairs(const PoseGraph& graph, const std::vector<bool>& held,
                                    const DensePrior* prior, const std::vector<bool>& joins) {
  std::vector<BlockPair> pairs;
  pairs.reserve(graph.edges.size());
  const auto add = [&](std::size_t a, std::size_t b) {
    if (a != b && !held[a] && !held[b]) {
      pairs.emplace_back(a, b);
    }
  };
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (joins.empty() || joins[i]) {
      add(graph.edges[i].first, graph.edges[i].second);
    }
  }
  for (std::size_t i = 0; prior != nullptr && i < prior->vertices.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      add(prior->vertices[i], prior->vertices[j]);
    }
  }
  return pairs;
}

/// The lower triangle of the pattern of blocks, once the vertices stand at these positions.
LowerPattern block_pattern(const std::vector<BlockPair>& pairs, const std::vector<int>& positions,
                           std::size_t count) {
  std::vector<std::uint64_t> entries;  // column, row
  entries.reserve(pairs.size() + count);
  const auto entry = [](std::uint64_t column, std::uint64_t row) { return column << 32U | row; };
  for (std::uint64_t i = 0; i < count; ++i) {
    entries.push_back(entry(i, i));
  }
  for (const auto& [a, b] : pairs) {
    const auto [low, high] = std::minmax(positions[a], positions[b]);
    entries.push_back(entry(static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high)));
  }
  std::ranges::sort(entries);
  entries.erase(std::ranges::unique(entries).begin(), entries.end());
  LowerPattern pattern;
  pattern.column_starts.assign(count + 1, 0);
  pattern.rows.reserve(entries.size());
  for (const std::uint64_t both : entries) {
    ++pattern.column_starts[(both >> 32U) + 1];
    pattern.rows.push_back(static_cast<int>(both & 0xffffffffU));
  }
  std::partial_sum(pattern.column_starts.begin(), pattern.column_starts.end(),
                   pattern.column_starts.begin());
  return pattern;
}

}  // namespace

std::vector<bool> held_vertices(const PoseGraph& graph, const DensePrior* prior) {
  const std::size_t count = graph.vertices.size();
  Parts parts(count);
  std::vector<bool> held(count, false);
  std::vector<bool> placed(count, false);
  for (const GraphEdge& edge : graph.edges) {
    parts.join(edge.first, edge.second);
  }
  for (std::size_t i = 0; prior != nullptr && i < prior->vertices.size(); ++i) {
    parts.join(prior->vertices.front(), prior->vertices[i]);
    placed[prior->vertices[i]] = true;
  }
  for (const GraphEdge& edge : graph.edges) {
    placed[edge.first] = placed[edge.first] || edge.kind == EdgeKind::Prior;
  }
  std::vector<bool> part_is_placed(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    held[i] = graph.vertices[i].is_fixed;
    if (held[i] || placed[i]) {
      part_is_placed[parts.root(i)] = true;
    }
  }
  for (const VertexKind kind : {VertexKind::Se2, VertexKind::Sim2}) {
    for (std::size_t i = 0; i < count; ++i) {
      if (graph.vertices[i].kind == kind && !part_is_placed[parts.root(i)]) {
        held[i] = part_is_placed[parts.root(i)] = true;
      }
    }
  }
  return held;
}

std::vector<int> block_sizes(const PoseGraph& graph) {
  std::vector<int> sizes;
  sizes.reserve(graph.vertices.size());
  for (const GraphVertex& vertex : graph.vertices) {
    sizes.push_back(size_of(vertex.kind));
  }
  return sizes;
}

Unknowns::Unknowns(const PoseGraph& graph, const std::vector<bool>& held, const DensePrior* prior,
                   std::vector<int> sizes, const std::vector<bool>& joins)
    : offsets_(graph.vertices.size(), -1), sizes_(std::move(sizes)) {
  std::vector<std::size_t> moving;
  std::vector<int> positions(graph.vertices.size(), -1);
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    if (!held[i]) {
      positions[i] = static_cast<int>(moving.size());
      moving.push_back(i);
    }
  }
  const std::vector<BlockPair> pairs = joined_pairs(graph, held, prior, joins);
  const std::vector<int> order = elimination_order(block_pattern(pairs, positions, moving.size()));
  std::vector<std::size_t> ordered;
  ordered.reserve(order.size());
  for (const int index : order) {
    positions[moving[static_cast<std::size_t>(index)]] = static_cast<int>(ordered.size());
    ordered.push_back(moving[static_cast<std::size_t>(index)]);
  }
  lay_out(ordered, block_pattern(pairs, positions, moving.size()));
}

/// From blocks to numbers.
void Unknowns::lay_out(const std::vector<std::size_t>& moving, const LowerPattern& blocks) {
  int total = 0;
  for (const std::size_t vertex : moving) {
    offsets_[vertex] = total;
    total += sizes_[vertex];
  }
  pattern_.column_starts.reserve(static_cast<std::size_t>(total) + 1);
  pattern_.column_starts.push_back(0);
  for (std::size_t block = 0; block < moving.size(); ++block) {
    for (int column = 0; column < sizes_[moving[block]]; ++column) {
      for (int i = blocks.column_starts[block]; i < blocks.column_starts[block + 1]; ++i) {
        const auto row_block = static_cast<std::size_t>(blocks.rows[static_cast<std::size_t>(i)]);
        const std::size_t vertex = moving[row_block];
        for (int row = row_block == block ? column : 0; row < sizes_[vertex]; ++row) {
          pattern_.rows.push_back(offsets_[vertex] + row);
        }
      }
      pattern_.column_starts.push_back(static_cast<int>(pattern_.rows.size()));
    }
  }
}

Unknowns::Slot Unknowns::slot(std::size_t first, std::size_t second) const {
  const auto [low, high] = std::minmax(offsets_[first], offsets_[second]);
  check(low >= 0, "both vertices move");
  const auto start = pattern_.rows.begin() + pattern_.column_starts[static_cast<std::size_t>(low)];
  const auto end =
      pattern_.rows.begin() + pattern_.column_starts[static_cast<std::size_t>(low) + 1];
  const auto found = std::lower_bound(start, end, high);
  check(found != end && *found == high, "the vertices share a block");
  return {.base = static_cast<int>(found - pattern_.rows.begin()),
          .length = static_cast<int>(end - start)};
}

}  // namespace sketchloc::detail
