#include "continuation/branches/tracer.hpp"

#include <algorithm>
#include <utility>

#include "continuation/branches/close_modes.hpp"
#include "continuation/branches/junction_ways.hpp"
#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// An ordinary point of a curve, perhaps with a kink there: its two curves belong to the start.
void Tracer::add_ordinary_start(const CurvePoint& point, const Rays& rays, int number) {
  const bool is_kink = rays.rays.size() == 2 && rays.rays[0].resting.empty() &&
                       rays.rays[0].piece != rays.rays[1].piece;
  const int kink = is_kink ? static_cast<int>(diagram_.junctions.size()) : -1;
  if (is_kink)
    diagram_.junctions.push_back(
        {.kind = HitKind::kink, .point = point, .depth = depth_, .start = number});
  for (const Ray& ray : rays.rays) {
    const CurvePoint leaving = point_on_ray(walker_, point, ray);
    const int way = is_kink ? static_cast<int>(at(kink).ways.size()) : -1;
    if (is_kink) at(kink).ways.push_back({leaving, leaving});
    queue_.push_back({number, -1, way, leaving, 0, kink});
  }
}

void Tracer::add_start(const DiagramStart& start, int number) {
  CurvePoint point;
  point.x = start.x;
  point.lambda = start.lambda;
  point.piece = start.piece;
  depth_ = current_ = -1;  // branches of a junction here have depth 0
  const std::vector<Index> active = active_switches(walker_, start.x, start.lambda);
  if (active.size() > most_active)
    return doubt(DoubtKind::ways_missing,
                 "directions at the start may be missing: " + too_many_act(active.size()), point);
  const int corank = active.empty() ? corank_of(walker_, point, located_rank) : 0;
  Hit hit{.kind = HitKind::branch_point, .point = point};
  hit.multiplicity = std::max(corank, 1);
  std::string missing;
  if (!active.empty()) {
    const Rays rays = rays_at(walker_, start.x, start.lambda, start.piece, active);
    if (is_one_curve(rays)) return add_ordinary_start(point, rays, number);
    if (!rays.complete) missing = rays.why;
    hit.kind = HitKind::branching_kink;
    hit.switches = active;
  } else if (corank <= 0) {
    const Rays rays = rays_at(walker_, start.x, start.lambda, start.piece, active);
    if (!rays.complete)
      doubt(DoubtKind::ways_missing, "directions at the start may be missing: " + rays.why, point);
    return add_ordinary_start(point, rays, number);
  }
  if (junction_at(hit) >= 0) return;
  const int junction = add_junction(hit);
  at(junction).start = number;
  if (!missing.empty() && at(junction).complete) note_missing(junction, missing);
  look_beside_start(junction);
  queue_ways(junction);
}

/// A curve that ends where it begins, if its way leads out of the range there.
bool Tracer::ends_at_once(const Task& task, Curve& curve) {
  CurvePoint begin = task.junction >= 0 ? way_of(task).point : task.from;
  begin.s = 0;
  const std::string reason = options_.ends_at ? options_.ends_at(begin) : "";
  if (!reason.empty()) curve = {{begin}, {}, StopReason::event, reason, {}};
  return !reason.empty();
}

/// The special points of a piece between a junction and the first point of the trace are met as those of the trace are.
/// @returns the whole branch, if it ends at one of them
std::optional<Curve> Tracer::end_of(PieceBefore& piece) {
  const int junction = diagram_.branches[static_cast<std::size_t>(current_)].junction;
  std::erase_if(piece.hits, [&](const Hit& hit) {
    return junction >= 0 && belongs_to(walker_, at(junction), hit);
  });
  for (std::size_t i = 0; i < piece.hits.size(); ++i) {
    const bool stops = piece.hits[i].stops;
    if (!stops && at_hit(piece.hits[i]) != AtHit::ends) continue;
    Curve curve =
        springfold::continuation::end_at(piece, i, stops ? StopReason::event : StopReason::joined);
    note_junctions(0, curve.hits);
    return curve;
  }
  note_junctions(0, piece.hits);
  return std::nullopt;
}

/// May the way be followed, or does a branch run along it already, or are there enough?
bool Tracer::is_wanted(const Task& task) {
  bool wanted = true;
  if (task.junction >= 0) {
    if (way_of(task).branch >= 0) return false;
    wanted = task.depth <= options_.maximum_depth && !too_many();
  } else {
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i) {
      const Branch& branch = diagram_.branches[i];
      const bool own = branch.start == task.start, closed = branch.curve.stop == StopReason::closed;
      if (own && closed && task.kink >= 0) {  // it came back along this way, on another piece
        way_of(task).branch = static_cast<int>(i);
        return false;
      }
      const bool twin = own && !closed;
      if (!twin && passes_through(walker_.problem, branch.curve, task.from, options_.trace))
        return false;
    }
    wanted = !too_many(task.start);
  }
  if (!wanted) ++diagram_.not_followed;
  return wanted;
}

void Tracer::follow(const Task& task) {
  if (!is_wanted(task)) return;
  current_ = static_cast<int>(diagram_.branches.size());
  if (task.junction >= 0 || task.kink >= 0) way_of(task).branch = current_;
  met_.clear();
  depth_ = task.depth;
  diagram_.branches.push_back(
      {.start = task.start, .junction = task.junction, .depth = task.depth});
  if (ends_at_once(task, diagram_.branches.back().curve)) return;
  Begin begin{.from = task.from, .ray = {task.from.piece, task.from.tangent, {}, {}, {}}};
  PieceBefore before;
  if (task.junction >= 0) {
    const CurvePoint junction = at(task.junction).point;
    const Way way = way_of(task);
    begin = begin_along(walker_, junction, way);
    if (!begin.attached) before = piece_before(walker_, events_, options_, at(task.junction), way);
    if (!before.reached)
      doubt(DoubtKind::not_attached, "a branch could not be traced back to its branch point",
            junction, task.junction);
    if (auto whole = end_of(before)) {
      diagram_.branches[static_cast<std::size_t>(current_)].curve = std::move(*whole);
      return;
    }
  }
  const std::size_t met_before = met_.size();
  std::vector<double> begins;  // where it begins, told once more
  const auto at_hit_of_trace = [&](const Hit& hit) {
    const AtHit answer = at_hit(hit);
    if (answer == AtHit::nothing_new) begins.push_back(hit.point.s);
    return answer != AtHit::ends;
  };
  Curve curve =
      trace_in_own_units(walker_.problem, begin.from.x, begin.from.lambda, begin.ray, events_,
                         options_.trace, observer_, at_hit_of_trace, IfInterrupted::keep);
  std::erase_if(curve.hits, [&](const Hit& hit) {
    return is_junction(hit) && std::ranges::find(begins, hit.point.s) != begins.end();
  });
  // A kink with several ways out ends the trace by itself.
  if (curve.stop == StopReason::several_ways && options_.through_kinks && !curve.hits.empty() &&
      curve.hits.back().kind == HitKind::branching_kink)
    at_hit(curve.hits.back(), true);
  note_junctions(met_before, curve.hits);
  if (!begin.attached && before.reached) prepend(way_of(task).point, std::move(before), curve);
  diagram_.branches[static_cast<std::size_t>(current_)].curve = std::move(curve);
  note_early_end();
}

/// A branch that ended where nothing asked it to is a doubt.
void Tracer::note_early_end() {
  const Curve& curve = diagram_.branches[static_cast<std::size_t>(current_)].curve;
  const bool at_junction = !curve.hits.empty() && curve.hits.back().junction >= 0;
  const bool by_caller = curve.stop == StopReason::joined || curve.stop == StopReason::observer;
  if (ended_as_asked(curve.stop) || by_caller ||
      (curve.stop == StopReason::several_ways && (at_junction || !options_.through_kinks)))
    return;
  std::string text = "a branch stopped early: " + std::string(to_string(curve.stop));
  if (!curve.stop_detail.empty()) text += ": " + curve.stop_detail;
  doubt(DoubtKind::stopped_early, std::move(text), curve.points.back());
}

/// A branch that has not left its first point is none, one that is not traced back to its junction is not finished.
void Tracer::give_up(const Task& task) {
  interrupted_ = true;
  if (current_ >= 0 && !diagram_.branches.back().curve.points.empty()) {
    diagram_.branches.back().curve.stop = StopReason::observer;
    return;
  }
  queue_.push_front(task);
  if (current_ < 0) return;
  diagram_.branches.pop_back();
  for (Junction& junction : diagram_.junctions)
    for (Way& way : junction.ways)
      if (way.branch == current_) way.branch = -1;
}

void Tracer::run() {
  while (!queue_.empty() && !interrupted_) {
    const Task task = std::move(queue_.front());
    queue_.pop_front();
    current_ = -1;
    try {
      follow(task);
    } catch (const Interrupted&) {
      give_up(task);
    }
  }
}

void Tracer::trace_from(const DiagramStart& start, int number) {
  if (interrupted_) return;
  try {
    add_start(start, number);
  } catch (const Interrupted&) {
    interrupted_ = true;
  }
  run();
}

Diagram Tracer::take() {
  const auto say = [&](int count, const std::string& why) {
    if (count > 0)
      diagram_.doubts.push_back(
          {DoubtKind::bounds, std::to_string(count) + " branches were not traced: " + why});
  };
  say(diagram_.not_followed, "bounds of depth or number reached");
  say(static_cast<int>(queue_.size()), "interrupted");
  diagram_.not_followed += static_cast<int>(queue_.size());
  return std::move(diagram_);
}

}  // namespace springfold::continuation
