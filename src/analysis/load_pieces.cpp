#include "load_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "cut_curve.hpp"

namespace springfold::analysis {
namespace {

constexpr const char* in_next_piece = "goes on in the next piece";

/// Loads at ends of pieces, where the parameter of one may differ a little from that of the other.
bool is_same_load_at_ends(double a, double b) {
  return std::abs(b - a) <= std::sqrt(same_load) * (1 + std::abs(a));
}

}  // namespace

bool stands_alone(const CaseCurves& curves, const Member& member, const SpecialPoint& point) {
  if (point.kind != EventKind::branch_point) return false;
  std::string why;
  const auto start = critical_start(curves, member, point, why);
  return start && !critical_rate(curves.family(), *start);
}

bool is_reached(const CaseCurves& curves, const std::vector<LoadPiece>& pieces, double mu,
                double lambda, double room) {
  const auto comes = [&](const LoadPiece& piece, const Side& side) {
    if (side.curve.points.empty()) return false;
    if (std::abs(side.end - mu) <= room)
      return is_same_load_at_ends(lambda, side.curve.points.back().lambda);
    const auto here = point_of_curve(curves, piece.start, side.curve, mu, room);
    return here && is_same_load_at_ends(lambda, here->lambda);
  };
  return std::any_of(pieces.begin(), pieces.end(), [&](const LoadPiece& piece) {
    return comes(piece, piece.falling) || comes(piece, piece.growing);
  });
}

void leave_out_points(std::vector<LoadPiece>& pieces, double room) {
  const auto meets = [room](double a, double b) { return std::abs(a - b) <= room; };
  for (std::size_t i = 0; i < pieces.size();) {
    const double from = pieces[i].falling.end, to = pieces[i].growing.end;
    const bool goes_on = (i > 0 && meets(pieces[i - 1].growing.end, from)) ||
                         (i + 1 < pieces.size() && meets(pieces[i + 1].falling.end, to));
    if (goes_on && meets(from, to))
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

void say_what_goes_on(std::vector<LoadPiece>& pieces, double room) {
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    Side &before = pieces[i].growing, &behind = pieces[i + 1].falling;
    const auto &points = before.curve.points, &next = behind.curve.points;
    if (std::abs(behind.end - before.end) > room || points.empty() || next.empty()) continue;
    if (!is_same_load_at_ends(points.back().lambda, next.back().lambda)) continue;
    for (Side* side : {&before, &behind})
      if (side->another_first) side->curve.stop_detail = in_next_piece;
  }
}

}  // namespace springfold::analysis
