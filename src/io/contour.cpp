#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "map_figure.hpp"

namespace springfold::io {

std::vector<Segment> contour(const GridField& field, double level,
                             const std::vector<std::string>& pieces) {
  using Point = std::pair<double, double>;
  std::vector<Segment> segments;
  const std::size_t nx = field.xs.size(), ny = field.ys.size();
  const auto value = [&](std::size_t i, std::size_t j) { return field.values[j * nx + i] - level; };
  for (std::size_t j = 0; j + 1 < ny; ++j)
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      // Corners around the cell, and where its edges (from each corner to the next) are crossed.
      const std::array<Point, 4> corner{Point{field.xs[i], field.ys[j]},
                                        {field.xs[i + 1], field.ys[j]},
                                        {field.xs[i + 1], field.ys[j + 1]},
                                        {field.xs[i], field.ys[j + 1]}};
      const std::array<double, 4> v{value(i, j), value(i + 1, j), value(i + 1, j + 1),
                                    value(i, j + 1)};
      const double mean = (v[0] + v[1] + v[2] + v[3]) / 4;
      const std::size_t k0 = j * nx + i;
      const bool jumps =
          !pieces.empty() && (pieces[k0] != pieces[k0 + 1] || pieces[k0] != pieces[k0 + nx] ||
                              pieces[k0] != pieces[k0 + nx + 1]);
      if (!std::isfinite(mean) || jumps) continue;
      std::vector<Point> crossings;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        if ((v[k] > 0) == (v[next] > 0)) continue;
        const double part = v[k] / (v[k] - v[next]);
        crossings.push_back({corner[k].first + part * (corner[next].first - corner[k].first),
                             corner[k].second + part * (corner[next].second - corner[k].second)});
      }
      if (crossings.size() == 2) segments.push_back({crossings[0], crossings[1]});
      if (crossings.size() != 4) continue;
      const bool together = (mean > 0) == (v[0] > 0);  // the corners 0 and 2 are connected
      segments.push_back({crossings[0], crossings[together ? 1 : 3]});
      segments.push_back({crossings[2], crossings[together ? 3 : 1]});
    }
  return segments;
}

void drop_crowded(std::vector<std::vector<Segment>>& lines, const GridField& field,
                  std::size_t most) {
  const auto cell_along = [](const std::vector<double>& nodes, double at) {
    const bool rises = nodes.front() <= nodes.back();
    const auto behind = std::find_if(nodes.begin() + 1, nodes.end() - 1,
                                     [&](double node) { return rises ? node > at : node < at; });
    return static_cast<std::size_t>(behind - nodes.begin()) - 1;
  };
  const auto cell_of = [&](const Segment& s) {
    return cell_along(field.ys, (s.first.second + s.second.second) / 2) * field.xs.size() +
           cell_along(field.xs, (s.first.first + s.second.first) / 2);
  };
  std::map<std::size_t, std::size_t> levels;  // that lead through a cell
  for (const auto& line : lines) {
    std::set<std::size_t> cells;
    for (const Segment& segment : line) cells.insert(cell_of(segment));
    for (const std::size_t cell : cells) ++levels[cell];
  }
  for (auto& line : lines)
    std::erase_if(line, [&](const Segment& segment) { return levels[cell_of(segment)] > most; });
}

}  // namespace springfold::io
