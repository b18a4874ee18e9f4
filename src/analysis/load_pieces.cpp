#include "load_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "analysis/undefined.hpp"
#include "critical_rows.hpp"
#include "critical_starts.hpp"
#include "cut_curve.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/number_text.hpp"
#include "switching_starts.hpp"

namespace springfold::analysis {
namespace {

constexpr double tenth = 0.1;

constexpr const char* in_next_piece = "goes on in the next piece";

/// Pieces are cut where their loads differ by `same_load`: as far from their meeting as they are slow to part. The
/// difference of two smooth loads is a straight line there.
void end_where_equal(const CaseCurves& curves, LoadPiece& last, LoadPiece& next, double room) {
  using Points = std::pair<std::optional<continuation::CriticalPoint>,
                           std::optional<continuation::CriticalPoint>>;
  const auto points_at = [&](double mu) {
    return Points{point_of_curve(curves, last.start, last.growing.curve, mu, room),
                  point_of_curve(curves, next.start, next.falling.curve, mu, room)};
  };
  const auto difference = [](const Points& at) {
    return at.first && at.second ? at.first->lambda - at.second->lambda : undefined;
  };
  const double mu = last.growing.end, aside = mu - tenth * room;
  const double here = difference(points_at(mu)), there = difference(points_at(aside));
  const double meeting = mu - here * (aside - mu) / (there - here);
  if (!(std::abs(meeting - mu) <= room)) return;
  const Points both = points_at(meeting);
  if (!(std::abs(difference(both)) <= tenth * std::abs(here))) return;
  // Both are the points that were followed: where branches cross another one may be found.
  if (!is_same_load_at_ends(both.first->lambda, load_at_end(last.growing)) ||
      !is_same_load_at_ends(both.second->lambda, load_at_end(next.falling)))
    return;
  end_curve_at(*both.first, another_is_first, last.growing.curve);
  end_curve_at(*both.second, another_is_first, next.falling.curve);
  last.growing.end = next.falling.end = meeting;
}

constexpr const char* at_this_value = "at this value alone: it does not move with the parameter";

/// Two pieces meet: both sides of the jump, unless the load is the same.
void say_jump(const LoadPiece& last, const LoadPiece& next, Branch& before, Branch& behind) {
  const auto lambda = [](const Sample& sample) { return sample.values[1]; };
  const double from = lambda(before.samples.back()), to = lambda(behind.samples.front());
  if (std::abs(to - from) <= std::sqrt(same_load) * std::max(std::abs(from), std::abs(to))) return;
  const Side &end = last.growing, &begin = next.falling;
  const std::string cause = begin.decides ? name_of_degeneracy(*begin.decides, next.of)
                            : end.decides ? name_of_degeneracy(*end.decides, last.of)
                                          : "another critical point comes first";
  const std::string text = "jumps from " + rounded(from) + " to " + rounded(to) + ": " + cause;
  mark_jump(before, true, text);
  mark_jump(behind, false, text);
}

}  // namespace

std::optional<bool> is_of_piece(const SpecialPoint& first, EventKind of, bool alone,
                                double lambda) {
  const double there = first.hit.point.lambda, size = 1 + std::abs(there);
  const double off = std::abs(lambda - there);
  if (first.kind == EventKind::unresolved && off <= continuation::told_apart * size)
    return std::nullopt;
  return (first.kind == of || alone) && off <= same_load * size;
}

std::string why_hidden(const SpecialPoint& first) {
  return first.label + " is unresolved, and may hide the point that is followed";
}

bool may_decide(const continuation::CriticalHit& hit) {
  return hit.kind != continuation::Degeneracy::user &&
         hit.kind != continuation::Degeneracy::extremum;
}

bool is_same_load_at_ends(double a, double b) {
  return std::abs(b - a) <= same_load + std::sqrt(same_load) * std::max(std::abs(a), std::abs(b));
}

bool ends_at_start(const std::vector<LoadPiece>& pieces, double mu) {
  const auto behind = std::find_if(pieces.begin(), pieces.end(),
                                   [&](const LoadPiece& p) { return p.falling.end >= mu; });
  const auto comes = [](const Side& side) { return ends_at_start_of_path(side.curve); };
  return (behind != pieces.end() && comes(behind->falling)) ||
         (behind != pieces.begin() && comes(std::prev(behind)->growing));
}

Side side_without_way(const continuation::CriticalStart& at, const std::string& what) {
  Side side{.end = at.mu};
  side.curve.points = {
      {.x = at.x, .lambda = at.lambda, .mu = at.mu, .dx = Vector::Zero(at.x.size())}};
  side.curve.stop = continuation::StopReason::event;
  side.curve.stop_detail = what;
  return side;
}

double load_at_end(const Side& side) {
  const continuation::CriticalCurve& curve = side.curve;
  const bool at_hit = curve.stop == continuation::StopReason::event && !curve.hits.empty();
  return at_hit ? curve.hits.back().point.lambda : curve.points.back().lambda;
}

std::pair<double, double> room_beside(const std::vector<LoadPiece>& pieces, double mu, double low,
                                      double high) {
  for (const LoadPiece& piece : pieces) {
    if (piece.growing.end <= mu) low = std::max(low, piece.growing.end);
    if (piece.falling.end >= mu) high = std::min(high, piece.falling.end);
  }
  return {low, high};
}

void insert_in_order(LoadPiece piece, std::vector<LoadPiece>& pieces) {
  const auto behind = std::find_if(pieces.begin(), pieces.end(), [&](const LoadPiece& other) {
    return other.start.mu > piece.start.mu;
  });
  pieces.insert(behind, std::move(piece));
}

void end_at(Side& side, EventKind of, std::size_t hit) {
  continuation::CriticalCurve& curve = side.curve;
  curve.hits.resize(hit + 1);
  const continuation::CriticalPoint& last = curve.hits.back().point;
  std::erase_if(curve.points, [&](const continuation::CriticalPoint& p) { return p.s > last.s; });
  curve.stop = continuation::StopReason::event;
  curve.stop_detail = name_of_degeneracy(curve.hits.back().kind, of);
  side.end = last.mu;
}

void say_jumps(const std::vector<LoadPiece>& pieces, double room, std::vector<Branch>& branches) {
  const auto meet = [room](double a, double b) { return std::abs(a - b) <= room; };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Side &begin = pieces[i].falling, &end = pieces[i].growing;
    if (i + 1 < pieces.size() && meet(pieces[i + 1].falling.end, end.end))
      say_jump(pieces[i], pieces[i + 1], branches[i], branches[i + 1]);
    else if (end.jumps)
      mark_jump(branches[i], true, "ends: there is no critical point behind" + end.limit);
    if (begin.jumps && !(i > 0 && meet(begin.end, pieces[i - 1].growing.end)))
      mark_jump(branches[i], false, "begins: there is no critical point before" + begin.limit);
  }
}

Branch row_alone(const CaseCurves& curves, const Member& member, const SpecialPoint& point) {
  const continuation::CurvePoint& at = point.hit.point;
  FollowedCurve place{.start = {.x = at.x, .lambda = at.lambda, .mu = member.mu, .piece = at.piece},
                      .of = point.kind};
  place.start.kind = continuation::CriticalKind::branch_point;
  place.growing.points = {
      {.x = at.x, .lambda = at.lambda, .mu = member.mu, .dx = Vector::Zero(at.x.size())}};
  place.growing.stop = continuation::StopReason::event;
  place.growing.stop_detail = at_this_value;
  place.falling = place.growing;
  Branch branch = rows_of(curves, place);
  for (Event& event : branch.events) event.kind = point.kind;
  return branch;
}

bool stands_alone(const CaseCurves& curves, const Member& member, const SpecialPoint& point) {
  std::string why;
  const auto start = critical_start(curves, member, point, why);
  const bool is_branch_point =
      start ? start->kind == continuation::CriticalKind::branch_point : false;
  if (point.kind == EventKind::branch_point || is_branch_point)
    return start && !critical_rate(curves.family(), *start);
  // Several springs that switch at once, each with a curve of its own; springs that rest at this value alone.
  return is_at_switching(point.kind) && !start &&
         (point.hit.switches.size() > 1 || way_at_rest(member, point));
}

bool is_reached(const CaseCurves& curves, const std::vector<LoadPiece>& pieces, double mu,
                double lambda, double room) {
  const auto comes = [&](const LoadPiece& piece, const Side& side) {
    if (side.curve.points.empty()) return false;
    if (std::abs(side.end - mu) <= room) return is_same_load_at_ends(lambda, load_at_end(side));
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

void end_stops_where_next_begins(std::vector<LoadPiece>& pieces, double room) {
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    Side &before = pieces[i].growing, &behind = pieces[i + 1].falling;
    const bool have_points = !before.curve.points.empty() && !behind.curve.points.empty();
    if (pieces[i].of != pieces[i + 1].of || before.stops == behind.stops || !have_points ||
        std::abs(behind.end - before.end) > room ||
        !is_same_load_at_ends(load_at_end(before), load_at_end(behind)))
      continue;
    Side& side = before.stops ? before : behind;
    end_curve_at(continuation::CriticalPoint(side.curve.points.back()), another_is_first,
                 side.curve);
    side.stops = false;
    side.another_first = true;
  }
}

bool is_settled(const std::vector<LoadPiece>& pieces, double mu, double room) {
  const auto stops_there = [&](const Side& side) {
    return side.stops && std::abs(side.end - mu) <= room;
  };
  return std::ranges::none_of(pieces,
                              [&](const LoadPiece& piece) {
                                return stops_there(piece.falling) || stops_there(piece.growing);
                              }) &&
         std::ranges::any_of(pieces, [&](const LoadPiece& piece) {
           return piece.falling.end <= mu && mu <= piece.growing.end;
         });
}

void say_what_goes_on(const CaseCurves& curves, const std::vector<double>& alone,
                      std::vector<LoadPiece>& pieces, double room) {
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    Side &before = pieces[i].growing, &behind = pieces[i + 1].falling;
    const bool has_points = !before.curve.points.empty() && !behind.curve.points.empty();
    if (std::abs(behind.end - before.end) > room || !has_points) continue;
    if (!is_same_load_at_ends(load_at_end(before), load_at_end(behind))) continue;
    const bool is_left_out = std::any_of(
        alone.begin(), alone.end(), [&](double mu) { return std::abs(mu - before.end) <= room; });
    if (before.another_first && behind.another_first && !is_left_out)
      end_where_equal(curves, pieces[i], pieces[i + 1], room);
    for (Side* side : {&before, &behind})
      if (side->another_first) side->curve.stop_detail = in_next_piece;
  }
}

}  // namespace springfold::analysis
