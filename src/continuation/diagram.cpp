#include "springfold/continuation/diagram.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "coincide.hpp"
#include "kink_passage.hpp"
#include "normalised.hpp"
#include "springfold/continuation/evidence.hpp"
#include "springfold/continuation/locate.hpp"
#include "words.hpp"

namespace springfold::continuation {
namespace {

/// Something that waits to be traced.
struct Task {
  int start = -1, junction = -1, way = -1;
  CurvePoint from{};
  int depth = 0;
};

class Tracer {
 public:
  Tracer(const Walker& walker, const std::vector<Event>& events, const DiagramOptions& options,
         const StepObserver& observer)
      : walker_{walker}, events_{events}, options_{options}, observer_{observer} {}

  void add_start(const DiagramStart& start, int number);
  void run();
  Diagram take();

 private:
  int junction_at(const Hit& hit);
  int add_junction(const Hit& hit);
  void add_exits(const Hit& hit, Junction& junction);
  Way* way_along(int junction, const Direction& direction, const Piece* piece);
  void queue_ways(int junction);
  bool at_hit(const Hit& hit, bool ends = false);
  void follow(const Task& task);
  void attach_to_junction(const Task& task, Branch& branch);
  std::optional<double> rest_of_way_back(const Way& way, const Curve& back, double gap) const;
  /// The two curves that leave a start count as one branch.
  bool too_many(int start = -1) const {
    int count = 0, twins = 0;
    for (const Branch& branch : diagram_.branches) {
      const bool second = branch.start >= 0 && branch.start == start;
      twins += second ? 1 : 0;
      count += branch.start < 0 || first_of_pair(branch) ? 1 : 0;
    }
    return twins % 2 == 0 && count >= options_.maximum_branches;
  }
  bool first_of_pair(const Branch& branch) const {
    int before = 0;
    for (const Branch* other = diagram_.branches.data(); other != &branch; ++other)
      before += other->start == branch.start ? 1 : 0;
    return before % 2 == 0;
  }
  void doubt(const std::string& what, const CurvePoint& where) {
    diagram_.doubts.push_back(what + " at lambda = " + rounded(where.lambda));
  }

  const Walker& walker_;
  const std::vector<Event>& events_;
  const DiagramOptions& options_;
  const StepObserver& observer_;
  Diagram diagram_{};
  std::deque<Task> queue_{};
  int current_ = -1;  ///< branch that is being traced
  int depth_ = 0;     ///< its depth
};

bool is_junction(const Hit& hit) {
  return hit.kind == HitKind::branch_point || hit.kind == HitKind::touch ||
         hit.kind == HitKind::branching_kink;
}

int Tracer::junction_at(const Hit& hit) {
  const double scale = std::max({1.0, hit.point.x.norm(), std::abs(hit.point.lambda)});
  for (std::size_t i = 0; i < diagram_.junctions.size(); ++i) {
    const Junction& junction = diagram_.junctions[i];
    if (length_of(walker_, between(walker_, junction.point, hit.point)) <=
        options_.same_place * scale)
      return static_cast<int>(i);
  }
  return -1;
}

/// Where to begin along a way out of a kink: a little further where lambda turns at the kink itself,
/// because a trace that begins there would find a turn at its own start.
CurvePoint clear_of_turn(const Walker& walker, const CurvePoint& leaving) {
  constexpr double level = 1e-8, far_enough = 1e-3;
  if (std::abs(leaving.tangent.dlambda) > level) return leaving;
  const auto point = point_at(walker, leaving, far_enough);
  return point ? *point : leaving;
}

/// Ways out of a singular point: of the reduced equation there, or only those along the curve.
void Tracer::add_exits(const Hit& hit, Junction& junction) {
  const std::string reason = options_.left_out ? options_.left_out(hit.point) : "";
  if (!reason.empty()) {
    junction.complete = false;
    junction.why = reason;
    if (hit.point.tangent.dx.size() == 0) return;
    CurvePoint back = hit.point;
    back.tangent.dx *= -1;
    back.tangent.dlambda *= -1;
    junction.ways = {{hit.point, hit.point}, {back, back}};
    return;
  }
  const int corank = hit.kind == HitKind::touch ? corank_of(walker_, hit.point) : hit.multiplicity;
  const Exits exits = exits_at(walker_, hit.point, corank);
  junction.complete = exits.complete;
  junction.why = exits.why;
  for (const Exit& exit : exits.exits) {
    CurvePoint point = hit.point;
    point.tangent = exit.tangent;
    point.negative.reset();
    junction.ways.push_back({point, exit.start});
  }
}

/// Finds the ways out of a special point. A touch may have no more than the curve itself.
int Tracer::add_junction(const Hit& hit) {
  Junction junction{
      .kind = hit.kind, .point = hit.point, .multiplicity = hit.multiplicity, .depth = depth_};
  if (hit.kind == HitKind::branching_kink) {
    for (const CurvePoint& leaving : hit.leaving)
      junction.ways.push_back({leaving, clear_of_turn(walker_, leaving)});
    CurvePoint back = hit.point;
    back.tangent.dx *= -1;
    back.tangent.dlambda *= -1;
    junction.ways.push_back({back, back});
  } else {
    add_exits(hit, junction);
  }
  if (!junction.complete) doubt("branches may be missing: " + junction.why, junction.point);
  diagram_.junctions.push_back(std::move(junction));
  return static_cast<int>(diagram_.junctions.size()) - 1;
}

/// The way that leads most nearly into this direction, if one does.
Way* Tracer::way_along(int junction, const Direction& direction, const Piece* piece) {
  Way* best = nullptr;
  double nearest = 0.98;
  for (Way& way : diagram_.junctions[static_cast<std::size_t>(junction)].ways) {
    const double c = cosine(walker_, way.point.tangent, direction) -
                     (piece && way.point.piece != *piece ? 1e-3 : 0.0);
    if (c > nearest) {
      nearest = c;
      best = &way;
    }
  }
  return best;
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
  if (!is_junction(hit)) return true;
  if (hit.kind == HitKind::branching_kink && !options_.through_kinks) return true;
  int number = junction_at(hit);
  const bool known = number >= 0;
  if (!known) number = add_junction(hit);
  const Direction along = direction_seen_from(
      walker_, diagram_.junctions[static_cast<std::size_t>(number)].point.x, hit.point);
  const Direction back{-along.dx, -along.dlambda};
  Way* arrived = way_along(number, back, &hit.point.piece);
  Way* ahead = ends ? nullptr : way_along(number, along, &hit.point.piece);
  if (arrived == nullptr || (ahead == nullptr && !ends))
    doubt("a branch passes a special point in a direction that is none of its ways", hit.point);
  if (arrived != nullptr && arrived->branch < 0) arrived->branch = current_;
  bool go_on = true;
  if (ahead != nullptr) {
    if (ahead->branch >= 0)
      go_on = false;
    else
      ahead->branch = current_;
  }
  if (!known) queue_ways(number);
  return go_on;
}

void Tracer::add_start(const DiagramStart& start, int number) {
  CurvePoint point;
  point.x = start.x;
  point.lambda = start.lambda;
  point.piece = start.piece;
  const std::vector<Index> active = active_switches(walker_, start.x, start.lambda);
  const int corank = active.empty() ? corank_of(walker_, point) : 0;
  if (corank > 0) {
    Hit hit{.kind = HitKind::branch_point, .point = point};
    hit.multiplicity = corank;
    depth_ = -1;  // its branches have depth 0
    if (junction_at(hit) < 0) queue_ways(add_junction(hit));
    return;
  }
  const Rays rays = rays_at(walker_, start.x, start.lambda, start.piece, active);
  if (!rays.complete) doubt("directions at the start may be missing: " + rays.why, point);
  for (const Ray& ray : rays.rays)
    queue_.push_back({number, -1, -1, point_on_ray(walker_, point, ray), 0});
}

/// Where a point is nearly as symmetric as a circle, branches are hard to tell from each other beside it,
/// and a trace back ends before it. It has arrived all the same if most of the way lies behind it, nothing
/// singular was met, and the rest leads straight to the junction along the way's own tangent.
/// @returns length of the rest
std::optional<double> Tracer::rest_of_way_back(const Way& way, const Curve& back,
                                               double gap) const {
  constexpr double most = 0.5, straight = 0.99;
  const CurvePoint& last = back.points.back();
  const Direction rest = between(walker_, way.point, last);
  const double length = length_of(walker_, rest);
  const bool met = std::any_of(back.hits.begin(), back.hits.end(),
                               [](const Hit& hit) { return hit.kind != HitKind::unresolved; });
  if (met || back.stop == StopReason::observer || !(length > 0) || length > most * gap ||
      cosine(walker_, rest, way.point.tangent) < straight)
    return std::nullopt;
  return length;
}

/// Puts the junction itself before the first point of a branch that begins beside it. The piece in
/// between is traced back: it must lead to the junction without passing anything else.
void Tracer::attach_to_junction(const Task& task, Branch& branch) {
  const Junction& junction = diagram_.junctions[static_cast<std::size_t>(task.junction)];
  const Way& way = junction.ways[static_cast<std::size_t>(task.way)];
  const double gap = length_of(walker_, between(walker_, junction.point, way.start));
  if (!(gap > 0)) return;
  CurvePoint back = way.start;
  back.s = 0;
  back.tangent.dx *= -1;
  back.tangent.dlambda *= -1;
  DiagramOptions near = options_;
  near.trace.maximum_points = 500;
  bool reached = false;
  std::vector<Hit> between_them;
  // Rounding blurs the place of a multiple point, and beside a degenerate one lambda is flat to
  // rounding; nothing else can be as near.
  const auto is_junction_itself = [&](const Hit& hit) {
    const double scale = std::max({1.0, hit.point.x.norm(), std::abs(hit.point.lambda)});
    const double distance = length_of(walker_, between(walker_, junction.point, hit.point));
    const bool level = std::abs(hit.point.lambda - junction.point.lambda) <= 1e-12 * scale;
    const double blur = level ? 0.2 : hit.kind == HitKind::unresolved ? 0.1 : 1e-3;
    return distance <= std::max(options_.same_place * scale, blur * gap);
  };
  const auto hit_on_the_way = [&](const Hit& hit) {
    reached = is_junction_itself(hit);
    if (!reached) between_them.push_back(hit);
    return !reached;
  };
  const auto not_too_far = [&](const CurvePoint& p) { return p.s < 3 * gap; };
  const Curve way_back =
      trace_in_own_units(walker_.problem, back.x, back.lambda, {back.piece, back.tangent}, {},
                         near.trace, not_too_far, hit_on_the_way);
  // A kink ends the trace by itself.
  if (!reached && !way_back.hits.empty()) reached = is_junction_itself(way_back.hits.back());
  double length = 0;
  if (reached) {
    length = way_back.hits.back().point.s;
  } else if (const auto rest = rest_of_way_back(way, way_back, gap)) {
    length = way_back.points.back().s + *rest;
    std::erase_if(between_them, [](const Hit& hit) { return hit.kind == HitKind::unresolved; });
  } else {
    doubt("a branch could not be traced back to its branch point", junction.point);
    return;
  }
  std::vector<CurvePoint> points{way.point};
  points.front().s = 0;
  const auto turned = [&](CurvePoint p) {
    p.s = length - p.s;
    p.tangent.dx *= -1;
    p.tangent.dlambda *= -1;
    return p;
  };
  for (auto p = way_back.points.rbegin(); p != way_back.points.rend(); ++p)
    if (p->s > 0 && p->s < length) points.push_back(turned(*p));
  std::vector<Hit> hits;
  for (auto h = between_them.rbegin(); h != between_them.rend(); ++h) {
    Hit hit = *h;
    hit.point = turned(hit.point);
    std::swap(hit.s_before, hit.s_after);
    hit.s_before = length - hit.s_before;
    hit.s_after = length - hit.s_after;
    hits.push_back(std::move(hit));
  }
  Curve& curve = branch.curve;
  for (CurvePoint& p : curve.points) p.s += length;
  for (Hit& h : curve.hits) {
    h.point.s += length;
    for (CurvePoint& p : h.leaving) p.s += length;
    h.s_before += length;
    h.s_after += length;
  }
  for (StepNote& note : curve.log) note.s += length;
  curve.points.insert(curve.points.begin(), points.begin(), points.end());
  curve.hits.insert(curve.hits.begin(), hits.begin(), hits.end());
}

void Tracer::follow(const Task& task) {
  if (task.junction >= 0) {
    Way& way = diagram_.junctions[static_cast<std::size_t>(task.junction)]
                   .ways[static_cast<std::size_t>(task.way)];
    if (way.branch >= 0) return;
    if (task.depth > options_.maximum_depth || too_many()) {
      ++diagram_.not_followed;
      return;
    }
    way.branch = static_cast<int>(diagram_.branches.size());
  } else {
    for (const Branch& branch : diagram_.branches) {
      const bool twin = branch.start == task.start && branch.curve.stop != StopReason::closed;
      if (!twin && passes_through(walker_.problem, branch.curve, task.from, options_.trace)) return;
    }
    if (too_many(task.start)) {
      ++diagram_.not_followed;
      return;
    }
  }
  current_ = static_cast<int>(diagram_.branches.size());
  depth_ = task.depth;
  diagram_.branches.push_back(
      {.start = task.start, .junction = task.junction, .depth = task.depth});
  Curve curve = trace_in_own_units(walker_.problem, task.from.x, task.from.lambda,
                                   {task.from.piece, task.from.tangent}, events_, options_.trace,
                                   observer_, [this](const Hit& hit) { return at_hit(hit); });
  // A kink with several ways out ends the trace by itself.
  Branch& branch = diagram_.branches[static_cast<std::size_t>(current_)];
  branch.curve = std::move(curve);
  if (branch.curve.stop == StopReason::several_ways && options_.through_kinks &&
      !branch.curve.hits.empty() && branch.curve.hits.back().kind == HitKind::branching_kink)
    at_hit(branch.curve.hits.back(), true);
  if (task.junction >= 0) attach_to_junction(task, branch);
}

void Tracer::run() {
  while (!queue_.empty()) {
    const Task task = std::move(queue_.front());
    queue_.pop_front();
    follow(task);
  }
}

Diagram Tracer::take() {
  if (diagram_.not_followed > 0)
    diagram_.doubts.push_back(std::to_string(diagram_.not_followed) +
                              " branches were not traced: bounds of depth or number reached");
  return std::move(diagram_);
}

}  // namespace

bool passes_through(ProblemView problem, const Curve& curve, const CurvePoint& point,
                    const TraceOptions& options) {
  const Walker walker{problem, problem.metric(), options};
  if (!curve.points.empty() && coincide(walker, curve.points.front(), point)) return true;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
    if (passes(walker, point, curve.points[i], curve.points[i + 1])) return true;
  return false;
}

Diagram trace_diagram(ProblemView problem, const std::vector<DiagramStart>& starts,
                      const std::vector<Event>& events, const DiagramOptions& options,
                      const StepObserver& observer) {
  assert(problems_in(options.trace).empty());
  if (starts.empty()) return {};
  const Normalised own(problem, starts.front().x, starts.front().lambda, starts.front().piece);
  if (!own.trivial()) {
    std::vector<DiagramStart> inside = starts;
    for (DiagramStart& start : inside) start.x = own.inside(start.x);
    DiagramOptions within = options;
    if (options.left_out)
      within.left_out = [&](const CurvePoint& at) { return options.left_out(own.outside(at)); };
    return own.outside(
        trace_diagram(own, inside, own.inside(events), within, own.inside(observer)));
  }
  const Walker walker{problem, problem.metric(), options.trace};
  Tracer tracer(walker, events, options, observer);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    tracer.add_start(starts[i], static_cast<int>(i));
    tracer.run();
  }
  return tracer.take();
}

}  // namespace springfold::continuation
