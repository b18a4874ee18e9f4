#include "critical_bends.hpp"

#include <cmath>

#include "critical_pieces.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalPoint;
using continuation::CriticalStart;

Vector state_of(const CriticalPoint& point) {
  Vector state(point.x.size() + 1);
  state << point.x, point.lambda;
  return state;
}

/// Two points of a curve, a step apart, and what its state changes by from the first to the second.
struct Chord {
  CriticalPoint from{}, to{};
  Vector change{};
};

std::optional<Chord> chord(const CaseCurves& curves, const CriticalStart& start,
                           const CriticalPoint& guess, double mu, double step) {
  const auto from = point_at(curves, start, guess, mu);
  const auto to = from ? point_at(curves, start, *from, mu + step) : std::nullopt;
  if (!to) return std::nullopt;
  return Chord{*from, *to, state_of(*to) - state_of(*from)};
}

}  // namespace

std::optional<double> bend_near_end(const CaseCurves& curves, const CriticalStart& start,
                                    const CriticalCurve& curve) {
  // Points are taken nearer and nearer, so often. Where slopes jump their difference stays; of a smooth curve it falls
  // like the distance.
  constexpr int halvings = 12;
  constexpr double stays = 0.25;
  if (curve.points.empty() || curve.points.back().dmu == 0) return std::nullopt;
  CriticalPoint guess = curve.points.back();
  double place = guess.mu, step = std::copysign(2 * step_of_family, guess.dmu), first = 0;
  for (int k = 0; k < halvings; ++k, step /= 2) {
    // Both chords lead towards the place.
    const auto before = chord(curves, start, guess, place - 2 * step, step);
    const auto behind =
        before ? chord(curves, start, before->to, place + 2 * step, -step) : std::nullopt;
    if (!behind || !is_on_piece(curves, start, behind->to)) return std::nullopt;
    // before->to + t change = behind->to + (2 - t) change behind it, t in steps
    const Vector jump = before->change + behind->change,
                 gap = state_of(behind->to) - state_of(before->to);
    const double t = jump.dot(gap + 2 * behind->change) / jump.squaredNorm();
    const double slopes = jump.norm() / std::abs(step);
    if (k == 0) first = slopes;
    if (!(t > 0 && t < 2) || !(slopes > stays * first)) return std::nullopt;
    place += (t - 1) * step;
    guess = before->to;
  }
  return place;
}

}  // namespace springfold::analysis
