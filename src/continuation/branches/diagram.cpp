#include "springfold/continuation/diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "continuation/branches/junction_ways.hpp"
#include "continuation/branches/known_junctions.hpp"
#include "continuation/branches/piece_before.hpp"
#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Something that waits to be traced.
struct Task {
  int start = -1, junction = -1, way = -1;
  CurvePoint from{};
  int depth = 0;
  int kink = -1;  ///< junction of an ordinary kink at a start, of which this is way number `way`
};

class Tracer {
 public:
  Tracer(const Walker& walker, const std::vector<Event>& events, const DiagramOptions& options,
         const StepObserver& observer)
      : walker_{walker}, events_{events}, options_{options}, observer_{observer} {}

  /// The branches of a start and of all that they meet.
  void trace_from(const DiagramStart& start, int number);
  Diagram take();

 private:
  void add_start(const DiagramStart& start, int number);
  void run();
  void give_up(const Task& task);
  int junction_at(const Hit& hit) const {
    return junction_where(walker_, diagram_.junctions, hit.point, met_, options_.same_place);
  }
  int add_junction(const Hit& hit);
  void add_ordinary_start(const CurvePoint& point, const Rays& rays, int number);
  void queue_ways(int junction);
  bool at_hit(const Hit& hit, bool ends = false);
  bool ends_at_once(const Task& task, Curve& curve);
  std::optional<Curve> end_of(PieceBefore& piece);
  void note_junctions(std::size_t first_met, std::vector<Hit>& hits) const;
  bool is_wanted(const Task& task);
  void follow(const Task& task);
  /// The two curves that leave a start count as one branch.
  bool too_many(int start = -1) const {
    std::map<int, int> of_start;
    int count = 0;
    for (const Branch& branch : diagram_.branches)
      if (branch.start < 0 || of_start[branch.start]++ % 2 == 0) ++count;
    return of_start[start] % 2 == 0 && count >= options_.maximum_branches;
  }
  void doubt(DoubtKind kind, std::string what, const CurvePoint& where, int junction = -1) {
    diagram_.doubts.push_back({kind, std::move(what), where, junction, current_});
  }
  Junction& at(int junction) { return diagram_.junctions[static_cast<std::size_t>(junction)]; }
  /// Of its junction, or of the ordinary kink at its start.
  Way& way_of(const Task& task) {
    return at(task.junction >= 0 ? task.junction : task.kink)
        .ways[static_cast<std::size_t>(task.way)];
  }
  void note_early_end();

  const Walker& walker_;
  const std::vector<Event>& events_;
  const DiagramOptions& options_;
  const StepObserver& observer_;
  Diagram diagram_{};
  std::deque<Task> queue_{};
  int current_ = -1;        ///< branch that is being traced
  std::vector<Met> met_{};  ///< junctions that it has met
  int depth_ = 0;           ///< its depth
  bool interrupted_ = false;
};

/// Finds the ways out of a special point. A touch may have no more than the curve itself.
int Tracer::add_junction(const Hit& hit) {
  Junction junction{
      .kind = hit.kind, .point = hit.point, .multiplicity = hit.multiplicity, .depth = depth_};
  try {
    find_ways(walker_, options_, hit, junction);
  } catch (const Interrupted&) {
    interrupted_ = true;
    junction.ways.clear();
    junction.complete = false;
    junction.why = "interrupted";
  }
  const auto number = static_cast<int>(diagram_.junctions.size());
  if (!junction.complete)
    doubt(DoubtKind::ways_missing, "branches may be missing: " + junction.why, junction.point,
          number);
  diagram_.junctions.push_back(std::move(junction));
  return number;
}

void Tracer::queue_ways(int number) {
  const Junction& junction = diagram_.junctions[static_cast<std::size_t>(number)];
  for (std::size_t w = 0; w < junction.ways.size(); ++w)
    if (junction.ways[w].branch < 0)
      queue_.push_back(
          {-1, number, static_cast<int>(w), junction.ways[w].start, junction.depth + 1});
}

/// The branch that is being traced meets a special point. May it go on?
/// @param ends  it does not: a kink with several ways out
bool Tracer::at_hit(const Hit& hit, bool ends) {
  if (options_.outside && options_.outside(hit.point)) return false;
  if (!is_junction(hit)) return true;
  // No other curve leaves an ordinary start: a touch in whose interval it lies is no junction.
  const Branch& own = diagram_.branches[static_cast<std::size_t>(current_)];
  if (hit.kind == HitKind::touch && own.start >= 0 && hit.s_before <= 0) return true;
  if (hit.kind == HitKind::branching_kink && !options_.through_kinks) return true;
  int number = junction_at(hit);
  const bool known = number >= 0;
  if (!known) number = add_junction(hit);
  if (known && at(number).complete && !lies_on(walker_, at(number).point, hit.switches)) {
    at(number).complete = false;
    at(number).why = names_of(walker_.problem, hit.switches) +
                     " acts beside this point, nearer than points are told apart";
    doubt(DoubtKind::ways_missing, "branches may be missing: " + at(number).why, at(number).point,
          number);
  }
  const Direction along = direction_seen_from(walker_, at(number).point.x, hit.point);
  Met met{hit.point.s, number, way_along(walker_, at(number), opposite(along), hit.point.piece),
          ends ? -1 : way_along(walker_, at(number), along, hit.point.piece)};
  const bool is_way = met.way_back >= 0 && (met.way_on >= 0 || ends);
  if (!is_way && !interrupted_)
    doubt(DoubtKind::no_such_way,
          "a branch passes a special point in a direction that is none of its ways", hit.point,
          number);
  std::vector<Way>& ways = at(number).ways;
  const auto way = [&ways](int w) -> Way& { return ways[static_cast<std::size_t>(w)]; };
  if (met.way_back >= 0 && way(met.way_back).branch < 0) way(met.way_back).branch = current_;
  bool go_on = true;
  if (met.way_on >= 0) {
    go_on = way(met.way_on).branch < 0;
    if (go_on) way(met.way_on).branch = current_;
  }
  met_.push_back(met);
  if (!known) queue_ways(number);
  return go_on;
}

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
  if (!active.empty()) {
    const Rays rays = rays_at(walker_, start.x, start.lambda, start.piece, active);
    if (is_one_curve(rays)) return add_ordinary_start(point, rays, number);
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
  for (std::size_t i = 0; i < piece.hits.size(); ++i) {
    const bool stops = piece.hits[i].stops;
    if (!stops && at_hit(piece.hits[i])) continue;
    Curve curve =
        springfold::continuation::end_at(piece, i, stops ? StopReason::event : StopReason::joined);
    note_junctions(0, curve.hits);
    return curve;
  }
  note_junctions(0, piece.hits);
  return std::nullopt;
}

/// Which junctions these special points are, among those met from number `first_met` on.
void Tracer::note_junctions(std::size_t first_met, std::vector<Hit>& hits) const {
  for (Hit& hit : hits)
    for (std::size_t i = first_met; i < met_.size(); ++i)
      if (met_[i].s == hit.point.s && is_junction(hit)) {
        hit.junction = met_[i].junction;
        hit.way_back = met_[i].way_back;
        hit.way_on = met_[i].way_on;
      }
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
    if (!begin.attached) before = piece_before(walker_, events_, options_, junction, way);
    if (!before.reached)
      doubt(DoubtKind::not_attached, "a branch could not be traced back to its branch point",
            junction, task.junction);
    if (auto whole = end_of(before)) {
      diagram_.branches[static_cast<std::size_t>(current_)].curve = std::move(*whole);
      return;
    }
  }
  const std::size_t met_before = met_.size();
  Curve curve = trace_in_own_units(
      walker_.problem, begin.from.x, begin.from.lambda, begin.ray, events_, options_.trace,
      observer_, [this](const Hit& hit) { return at_hit(hit); }, IfInterrupted::keep);
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
  constexpr std::array as_asked{StopReason::event, StopReason::closed, StopReason::joined,
                                StopReason::observer};
  if (std::ranges::find(as_asked, curve.stop) != as_asked.end() ||
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

Diagram diagram_inside(ProblemView problem, const std::vector<DiagramStart>& starts,
                       const std::vector<Event>& events, const DiagramOptions& options,
                       const StepObserver& observer) {
  const Walker walker{problem, problem.metric(), options.trace};
  Tracer tracer(walker, events, options, observer);
  for (std::size_t i = 0; i < starts.size(); ++i) tracer.trace_from(starts[i], static_cast<int>(i));
  return tracer.take();
}

}  // namespace

Diagram trace_diagram(ProblemView problem, const std::vector<DiagramStart>& starts,
                      const std::vector<Event>& events, const DiagramOptions& options,
                      const StepObserver& observer) {
  if (starts.empty()) return {};
  check_diagram(options);
  check_events(events);
  try {
    for (const DiagramStart& start : starts)
      check_entry(problem, start.x, start.lambda, start.piece, options.trace);
    const Normalised own(problem, starts.front().x, starts.front().lambda, starts.front().piece);
    std::vector<DiagramStart> inside = starts;
    for (DiagramStart& start : inside) {
      CurvePoint at = own.inside(start.x, start.lambda);
      start = {std::move(at.x), at.lambda, start.piece};
    }
    return own.outside(
        diagram_inside(own, inside, own.inside(events), own.inside(options), own.inside(observer)));
  } catch (const Interrupted&) {  // before anything was traced
    return {};
  }
}

}  // namespace springfold::continuation
