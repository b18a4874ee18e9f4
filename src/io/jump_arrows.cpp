#include "jump_arrows.hpp"

#include <algorithm>
#include <optional>

namespace springfold::io {
namespace {

/// The part of a line inside the frame, from one share of it to another; nothing if it lies outside (Liang and Barsky).
std::optional<std::pair<double, double>> inside(const Figure& figure, const PlotPoint& from,
                                                const PlotPoint& to) {
  double begin = 0, end = 1;
  const auto cut = [&](double at, double way, double low, double high) {
    if (way == 0) return low <= at && at <= high;
    const double a = (low - at) / way, b = (high - at) / way;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    return begin <= end;
  };
  const bool seen =
      cut(from.first, to.first - from.first, figure.low.first, figure.high.first) &&
      cut(from.second, to.second - from.second, figure.low.second, figure.high.second);
  return seen ? std::optional(std::pair{begin, end}) : std::nullopt;
}

}  // namespace

std::vector<ShownArrow> arrows_inside(const Figure& figure) {
  std::vector<ShownArrow> shown;
  for (const auto& [from, to] : figure.arrows) {
    const auto part = inside(figure, from, to);
    if (!part) continue;
    const auto at = [&, from = from, to = to](double t) {
      return PlotPoint{from.first + t * (to.first - from.first),
                       from.second + t * (to.second - from.second)};
    };
    const bool arrives = !(part->second < 1);
    shown.push_back(
        {part->first > 0 ? at(part->first) : from, arrives ? to : at(part->second), arrives});
  }
  return shown;
}

}  // namespace springfold::io
