#include "continuation/locating/features.hpp"

#include <algorithm>

namespace springfold::continuation {
namespace {

double grid_place(const Interpolant& p, int i) {
  return i == feature_cells ? p.b : p.a + (p.b - p.a) * i / feature_cells;
}

/// An extremum that reaches the level beside a cell of the grid in which the interpolant crosses zero: the values there
/// do not show it, one being on the other side of zero, and the next one small already; the slopes do.
void add_extrema_beside(const Interpolant& p, int crossed, double level,
                        std::vector<double>& places) {
  constexpr int hidden = 3;
  const int first = std::max(0, crossed - hidden),
            last = std::min(feature_cells, crossed + 1 + hidden);
  double before = p.first_slope(grid_place(p, first));
  for (int i = first; i < last; ++i) {
    const double next = p.first_slope(grid_place(p, i + 1));
    const double place = grid_place(p, i) + (p.b - p.a) / feature_cells *
                                                std::clamp(before / (before - next), 0.0, 1.0);
    if (i != crossed && (before < 0) != (next < 0) && std::abs(p.first(place)) <= level)
      places.push_back(place);
    before = next;
  }
}

}  // namespace

std::vector<double> features_of(const Interpolant& p, double level) {
  std::vector<double> places;
  std::vector<int> crossed;
  const auto t = [&](int i) { return grid_place(p, i); };
  double before = p.first(t(0)), here = p.first(t(1));
  if ((before < 0) != (here < 0)) crossed.push_back(0);
  for (int i = 1; i < feature_cells; ++i) {
    const double next = p.first(t(i + 1));
    const bool crosses = (here < 0) != (next < 0);
    const bool turns = std::abs(here) <= std::abs(before) && std::abs(here) <= std::abs(next) &&
                       (before < 0) == (next < 0);
    // A parabola that touches zero half-way between two points is an eighth of its second difference
    // off at them.
    const double reach = std::max(level, std::abs(before - 2 * here + next) / 4);
    if (crosses) crossed.push_back(i);
    if (turns && std::abs(here) <= reach) places.push_back(t(i));
    before = here;
    here = next;
  }
  for (const int i : crossed) {
    places.push_back(t(i));
    add_extrema_beside(p, i, level, places);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  // A turn between an end and its neighbour does not show on the grid.
  if (places.empty() || places.front() > t(1))
    if (std::abs(p.first(t(0))) <= level) places.insert(places.begin(), t(0));
  if (places.empty() || places.back() < t(feature_cells - 1))
    if (std::abs(p.first(t(feature_cells))) <= level) places.push_back(t(feature_cells));
  return places;
}

std::vector<double> extrema_of(const Interpolant& p, double a, double b, double spacing) {
  const int pieces = std::max(24, static_cast<int>((b - a) / spacing));
  const auto slope = [&](double t) { return p.first_slope(t); };
  std::vector<double> knots{a};
  for (int i = 0; i < pieces; ++i) {
    const double l = a + (b - a) * i / pieces, r = a + (b - a) * (i + 1) / pieces;
    if ((slope(l) < 0) != (slope(r) < 0)) knots.push_back(bisect(slope, l, r));
  }
  knots.push_back(b);
  return knots;
}

}  // namespace springfold::continuation
