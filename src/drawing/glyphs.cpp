#include "glyphs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace springfold::drawing {
namespace {

constexpr double pi = std::numbers::pi;

Place polar(Place centre, double radius, double angle) {
  return {centre.x + radius * std::cos(angle), centre.y - radius * std::sin(angle)};
}

/// On the screen y runs down; angles are counted as on paper.
double angle_of(Place a) { return std::atan2(-a.y, a.x); }

Path arrow_head(Place tip, Place along, const Ink& ink) {
  constexpr double longness = 9, half_width = 4;
  const Place back = tip - longness * along;
  return {{tip, back + half_width * across(along), back - half_width * across(along)},
          true,
          {"", ink.stroke, 0, {}},
          ""};
}

}  // namespace

Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
Place operator*(double s, Place a) { return {s * a.x, s * a.y}; }
double length(Place a) { return std::hypot(a.x, a.y); }
Place direction(Place a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : Place{1, 0};
}
Place across(Place a) { return {-a.y, a.x}; }

std::vector<Place> coil(Place from, Place to, double half_width) {
  constexpr int windings = 6;
  constexpr double straight = 0.18;  // of the length, at each end
  const Place way = to - from, side = half_width * across(direction(way));
  std::vector<Place> places{from, from + straight * way};
  for (int i = 0; i < 2 * windings; ++i) {
    const double t = straight + (1 - 2 * straight) * (i + 0.5) / (2 * windings);
    places.push_back(from + t * way + (i % 2 == 0 ? 1.0 : -1.0) * side);
  }
  places.push_back(from + (1 - straight) * way);
  places.push_back(to);
  return places;
}

std::vector<Place> spiral(Place centre, Place begin, Place end, double inner, double outer) {
  constexpr int pieces = 40;
  const double from = angle_of(begin);
  double sweep = std::remainder(angle_of(end) - from, 2 * pi);
  sweep += sweep < 0 ? -2 * pi : 2 * pi;
  std::vector<Place> places;
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    places.push_back(polar(centre, inner + t * (outer - inner), from + t * sweep));
  }
  return places;
}

std::vector<Path> arrow(Place from, Place to, const Ink& ink) {
  const Place along = direction(to - from);
  Ink shaft = ink;
  shaft.fill.clear();
  return {{{from, to - 7 * along}, false, shaft, ""}, arrow_head(to, along, ink)};
}

std::vector<Path> turning_arrow(Place centre, double radius, double sign, const Ink& ink) {
  constexpr int pieces = 24;
  constexpr double begin = pi / 4;
  Path arc{{}, false, ink, ""};
  arc.ink.fill.clear();
  for (int i = 0; i <= pieces; ++i)
    arc.places.push_back(polar(centre, radius, begin + sign * 1.5 * pi * i / pieces));
  const Place tip = arc.places.back();
  const Place out = direction(tip - centre);
  // Counterclockwise on the screen is to the left of the way out.
  const Place along = sign > 0 ? Place{out.y, -out.x} : Place{-out.y, out.x};
  return {arc, arrow_head(tip + 5 * along, along, ink)};
}

std::vector<Path> ground(Place at, Place away, double size, const Ink& ink) {
  constexpr int hatches = 4;
  const Place along = across(away);
  std::vector<Path> paths;
  Ink line = ink;
  line.width = 1.5 * ink.width;
  paths.push_back({{at - size * along, at + size * along}, false, line, ""});
  for (int i = 0; i < hatches; ++i) {
    const Place root = at + size * (-1 + 2.0 * (i + 0.7) / hatches) * along;
    paths.push_back({{root, root + 0.55 * size * (away - 0.8 * along)}, false, ink, ""});
  }
  return paths;
}

std::vector<Place> hull(std::vector<Place> places) {
  std::sort(places.begin(), places.end(),
            [](Place a, Place b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  if (places.size() < 3) return places;
  const auto turn = [](Place o, Place a, Place b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::vector<Place> around;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = around.size();
    for (const Place place : places) {
      while (around.size() >= first + 2 &&
             turn(around[around.size() - 2], around.back(), place) <= 0)
        around.pop_back();
      around.push_back(place);
    }
    around.pop_back();
    std::reverse(places.begin(), places.end());
  }
  return around;
}

}  // namespace springfold::drawing
