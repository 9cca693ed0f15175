#include "lib/order/vertex_cut.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace sg::order {
namespace {

struct Band {
  std::vector<Index> vertices;
  std::vector<Index> number;  // of an inner vertex of the piece; -1 outside the band
};

// The separator, and breadth first around it what there is room for.
Band band(const Piece& piece, const Separation& side, std::array<std::int64_t, 2> room) {
  Band result;
  result.number.assign(side.size(), -1);
  const auto take = [&](Index v) {
    result.number[v] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(v);
  };
  for (Index v = 0; v < piece.size(); ++v) {
    if (side[v] == in_separator) take(v);
  }
  for (std::size_t at = 0; at < result.vertices.size(); ++at) {
    for (const Index u : piece.inside[result.vertices[at]]) {
      if (result.number[u] >= 0) continue;
      std::int64_t& left = room.at(static_cast<std::size_t>(side[u]));
      if (left < piece.inner_weight[u]) continue;
      left -= piece.inner_weight[u];
      take(u);
    }
  }
  return result;
}

// Every vertex k of the band is two nodes, in (2k) and out (2k + 1), joined by an arc of its weight.
struct Network {
  struct Arc {
    Index to;
    Index back;  // the same arc the other way
    Index room;  // for more flow
  };
  std::vector<Index> begin;  // of every node's arcs; and the end
  std::vector<Arc> arcs;
  Index source, sink;
};
constexpr Index no_limit = std::numeric_limits<Index>::max() / 2;

// Calls add(from, to, room) for every arc.
template <class Function>
void for_arcs(const Piece& piece, const Separation& side, const Band& band, Index source,
              Index sink, Function add) {
  for (Index k = 0; k < static_cast<Index>(band.vertices.size()); ++k) {
    const Index v = band.vertices[k];
    add(2 * k, 2 * k + 1, piece.inner_weight[v]);
    std::array<bool, 2> ends{};
    for (const Index u : piece.inside[v]) {
      if (band.number[u] >= 0) {
        add(2 * k + 1, 2 * band.number[u], no_limit);
      } else {
        ends.at(static_cast<std::size_t>(side[u])) = true;
      }
    }
    if (ends[0]) add(source, 2 * k, no_limit);
    if (ends[1]) add(2 * k + 1, sink, no_limit);
  }
}

Network network(const Piece& piece, const Separation& side, const Band& band) {
  const auto size = static_cast<Index>(band.vertices.size());
  Network net;
  net.source = 2 * size;
  net.sink = 2 * size + 1;
  net.begin.assign(static_cast<std::size_t>(2 * size) + 4, 0);
  for_arcs(piece, side, band, net.source, net.sink, [&](Index from, Index to, Index) {
    ++net.begin[from + 2];
    ++net.begin[to + 2];
  });
  std::partial_sum(net.begin.begin(), net.begin.end(), net.begin.begin());
  net.arcs.resize(net.begin.back());
  for_arcs(piece, side, band, net.source, net.sink, [&](Index from, Index to, Index room) {
    const Index there = net.begin[from + 1]++;
    const Index back = net.begin[to + 1]++;
    net.arcs[there] = {to, back, room};
    net.arcs[back] = {from, there, 0};
  });
  net.begin.pop_back();
  return net;
}

// How far from the sink every node is along arcs with room; -1 where no path leads there. Not beyond the source, if that is reached.
void find_distances(const Network& net, std::vector<Index>& distance, std::vector<Index>& queue) {
  distance.assign(net.begin.size() - 1, -1);
  distance[net.sink] = 0;
  queue.assign(1, net.sink);
  for (std::size_t at = 0; at < queue.size() && distance[net.source] < 0; ++at) {
    const Index v = queue[at];
    for (Index a = net.begin[v]; a < net.begin[v + 1]; ++a) {
      const Network::Arc& arc = net.arcs[a];
      if (distance[arc.to] >= 0 || net.arcs[arc.back].room == 0) continue;
      distance[arc.to] = distance[v] + 1;
      queue.push_back(arc.to);
    }
  }
}

// Sends what fits along the path, and cuts it back to the first arc that is full.
void augment(Network& net, std::vector<Index>& path) {
  Index most = no_limit;
  for (const Index a : path) most = std::min(most, net.arcs[a].room);
  std::size_t full = path.size();
  for (std::size_t k = path.size(); k-- > 0;) {
    Network::Arc& arc = net.arcs[path[k]];
    arc.room -= most;
    net.arcs[arc.back].room += most;
    if (arc.room == 0) full = k;
  }
  path.resize(full);
}

// Blocks all shortest paths.
void blocking_flow(Network& net, std::vector<Index>& distance, std::vector<Index>& next,
                   std::vector<Index>& path) {
  next.assign(net.begin.begin(), net.begin.end() - 1);
  path.clear();
  for (;;) {
    const Index v = path.empty() ? net.source : net.arcs[path.back()].to;
    if (v == net.sink) {
      augment(net, path);
      continue;
    }
    Index& a = next[v];
    while (a < net.begin[v + 1] &&
           (net.arcs[a].room == 0 || distance[net.arcs[a].to] != distance[v] - 1)) {
      ++a;
    }
    if (a < net.begin[v + 1]) {
      path.push_back(a);
    } else if (v == net.source) {
      return;
    } else {
      distance[v] = -2;  // a dead end
      path.pop_back();
    }
  }
}

// Distances from the sink once the flow is at its maximum: -1 where it is not reached.
std::vector<Index> maximum_flow(Network& net) {
  std::vector<Index> distance, queue, next, path;
  for (;;) {
    find_distances(net, distance, queue);
    if (distance[net.source] < 0) return distance;
    blocking_flow(net, distance, next, path);
  }
}

// Of every node: does the source still reach it?
std::vector<char> reached(const Network& net) {
  std::vector<char> result(net.begin.size() - 1, false);
  result[net.source] = true;
  std::vector<Index> queue{net.source};
  for (std::size_t at = 0; at < queue.size(); ++at) {
    for (Index a = net.begin[queue[at]]; a < net.begin[queue[at] + 1]; ++a) {
      const Network::Arc& arc = net.arcs[a];
      if (arc.room == 0 || result[arc.to]) continue;
      result[arc.to] = true;
      queue.push_back(arc.to);
    }
  }
  return result;
}

}  // namespace

std::array<Separation, 2> minimum_separations(const Piece& piece, const Separation& side,
                                              const std::array<std::int64_t, 2>& room) {
  const Band around = band(piece, side, room);
  Network net = network(piece, side, around);
  const std::vector<Index> to_sink = maximum_flow(net);
  const std::vector<char> from_source = reached(net);
  std::array<Separation, 2> result{side, side};
  for (Index k = 0; k < static_cast<Index>(around.vertices.size()); ++k) {
    const Index v = around.vertices[k];
    const Index in = 2 * k, out = 2 * k + 1;
    result[0][v] = from_source[out] ? 0 : from_source[in] ? in_separator : 1;
    result[1][v] = to_sink[in] >= 0 ? 1 : to_sink[out] >= 0 ? in_separator : 0;
  }
  return result;
}

}  // namespace sg::order
