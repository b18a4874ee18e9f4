// Where the numbers of contour lines stand.
#include <algorithm>
#include <cmath>

#include "map_figure.hpp"

namespace springfold::io {
namespace {

// In parts of the panel's sides.
constexpr double from_frame = 0.06;       // a number within is not cut off
constexpr double from_each_other = 0.13;  // about the width of a number

using Spot = std::pair<double, double>;

double spot_distance(const Spot& a, const Spot& b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

/// How much room there is round a place: the distance to the nearest number, at most one side.
double room_at(const Spot& at, const std::vector<Spot>& taken) {
  double room = 1;
  for (const Spot& other : taken) room = std::min(room, spot_distance(at, other));
  return room;
}

}  // namespace

std::vector<LineNumber> numbers_of(const std::vector<std::vector<Segment>>& lines,
                                   const std::vector<double>& levels, const GridField& field) {
  const auto [x_low, x_high] = std::minmax(field.xs.front(), field.xs.back());
  const auto [y_low, y_high] = std::minmax(field.ys.front(), field.ys.back());
  std::vector<LineNumber> numbers;
  std::vector<Spot> taken;
  for (std::size_t i = 0; i < levels.size() && i < lines.size(); ++i) {
    double best = from_each_other;
    Spot spot;
    LineNumber number{.level = levels[i]};
    for (const auto& [a, b] : lines[i]) {
      const Spot middle{(a.first + b.first) / 2, (a.second + b.second) / 2};
      const Spot part{(middle.first - x_low) / (x_high - x_low),
                      (middle.second - y_low) / (y_high - y_low)};
      const double to_frame = std::min({part.first, 1 - part.first, part.second, 1 - part.second});
      const double room = room_at(part, taken);
      if (to_frame < from_frame || room <= best) continue;
      best = room, spot = part, number.at = middle;
    }
    if (best <= from_each_other) continue;
    taken.push_back(spot);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace springfold::io
