#include "elimination_order.hpp"

#include <algorithm>

namespace springfold {
namespace {

constexpr Index unseen = -1;

/// Nodes that can be reached from `start`, layer by layer; `layer` is written for these.
std::vector<Index> by_breadth(const Graph& graph, Index start, std::vector<Index>& layer) {
  std::vector<Index> order{start}, next;
  layer[static_cast<std::size_t>(start)] = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    next.clear();
    const auto here = static_cast<std::size_t>(order[k]);
    for (const Index node : graph[here])
      if (layer[static_cast<std::size_t>(node)] == unseen) {
        layer[static_cast<std::size_t>(node)] = layer[here] + 1;
        next.push_back(node);
      }
    std::sort(next.begin(), next.end(), [&graph](Index a, Index b) {
      const std::size_t of_a = graph[static_cast<std::size_t>(a)].size();
      const std::size_t of_b = graph[static_cast<std::size_t>(b)].size();
      return of_a != of_b ? of_a < of_b : a < b;
    });
    order.insert(order.end(), next.begin(), next.end());
  }
  return order;
}

/// A node at the edge of its part: of the last layer, as long as that brings more layers.
Index at_the_edge(const Graph& graph, Index start, std::vector<Index>& layer) {
  Index depth = -1;
  for (;;) {
    const std::vector<Index> order = by_breadth(graph, start, layer);
    const Index last = layer[static_cast<std::size_t>(order.back())];
    Index edge = order.back();
    for (const Index node : order)
      if (layer[static_cast<std::size_t>(node)] == last &&
          graph[static_cast<std::size_t>(node)].size() <
              graph[static_cast<std::size_t>(edge)].size())
        edge = node;
    for (const Index node : order) layer[static_cast<std::size_t>(node)] = unseen;
    if (last <= depth) return start;
    depth = last;
    start = edge;
  }
}

}  // namespace

std::vector<Index> order_by_breadth(const Graph& graph) {
  std::vector<Index> order, layer(graph.size(), unseen);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (layer[i] != unseen) continue;
    const Index start = at_the_edge(graph, static_cast<Index>(i), layer);
    const std::vector<Index> part = by_breadth(graph, start, layer);
    order.insert(order.end(), part.begin(), part.end());
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace springfold
