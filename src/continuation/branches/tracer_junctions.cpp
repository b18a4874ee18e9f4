#include <algorithm>
#include <utility>

#include "continuation/branches/close_modes.hpp"
#include "continuation/branches/junction_ways.hpp"
#include "continuation/branches/known_junctions.hpp"
#include "continuation/branches/tracer.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

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

/// Says why ways may be missing at a junction.
void Tracer::note_missing(int number, std::string why) {
  Junction& junction = at(number);
  junction.complete = false;
  junction.why = std::move(why);
  doubt(DoubtKind::ways_missing, "branches may be missing: " + junction.why, junction.point,
        number);
}

void Tracer::note_untold(int number) {
  note_missing(number,
               "another mode vanishes beside this point, nearer than their ways are told apart");
}

/// A branch point at which the diagram begins may have another one beside it.
void Tracer::look_beside_start(int number) {
  try {
    if (take_in_beside_start(walker_, options_, at(number)) == TakenIn::untold &&
        at(number).complete)
      note_untold(number);
  } catch (const Interrupted&) {
    interrupted_ = true;
  }
}

/// Does a special point belong to the junction that the branch has passed right before it, or at which it begins? Where
/// that one takes it in its ways are queued anew.
bool Tracer::belongs_to_last(const Hit& hit) {
  const int origin = diagram_.branches[static_cast<std::size_t>(current_)].junction;
  if (met_.empty())
    return origin >= 0 && hit.point.s <= blurred && belongs_to(walker_, at(origin), hit);
  if (hit.point.s - met_.back().s > blurred) return false;
  const int last = met_.back().junction;
  if (belongs_to(walker_, at(last), hit)) return true;
  if (!is_fresh(last)) return false;
  TakenIn taken = TakenIn::no;
  try {
    taken = take_in(walker_, options_, hit, at(last));
  } catch (const Interrupted&) {
    interrupted_ = true;
  }
  if (taken == TakenIn::untold && at(last).complete) note_untold(last);
  if (taken != TakenIn::yes) return false;
  std::erase_if(diagram_.doubts, [last](const Doubt& doubt) {
    return doubt.junction == last &&
           (doubt.kind == DoubtKind::ways_missing || doubt.kind == DoubtKind::no_such_way);
  });
  const double s = met_.back().s;
  met_.back() = passage_of(hit, last, false);
  met_.back().s = s;
  if (met_.back().way_on >= 0) take_way(last, met_.back().way_on);
  std::erase_if(queue_, [last](const Task& task) { return task.junction == last; });
  queue_ways(last);
  return true;
}

/// Is it the junction at which the branch begins, seen once more where places are not told apart?
bool Tracer::is_its_begin(const Hit& hit) const {
  const int origin = diagram_.branches[static_cast<std::size_t>(current_)].junction;
  if (origin < 0 || !met_.empty()) return false;
  const Junction& junction = diagram_.junctions[static_cast<std::size_t>(origin)];
  const double near = options_.same_place * scale_of(junction.point);
  return length_of(walker_, between(walker_, junction.point, hit.point)) <= near &&
         hit.point.s <= near && hit.kind == junction.kind;
}

/// Has this junction been found by the branch that is traced, no other one running along its ways, and no other one
/// within the spheres on which ways of close modes are told?
bool Tracer::is_fresh(int number) const {
  const auto& junctions = diagram_.junctions;
  const Junction& own = junctions[static_cast<std::size_t>(number)];
  const bool is_own = std::all_of(own.ways.begin(), own.ways.end(), [this](const Way& way) {
    return way.branch < 0 || way.branch == current_;
  });
  return is_own && own.start < 0 &&
         std::none_of(junctions.begin(), junctions.end(), [&](const Junction& other) {
           return &other != &own &&
                  length_of(walker_, between(walker_, own.point, other.point)) <= 4 * told_apart;
         });
}

/// By which ways of its junction the branch comes to a special point and leaves it; the first one is its own now.
/// @param ends  it does not leave it
Met Tracer::passage_of(const Hit& hit, int number, bool ends) {
  const Direction along = direction_seen_from(walker_, at(number).point.x, hit.point);
  Met met{hit.point.s, number, way_along(walker_, at(number), opposite(along), hit.point.piece),
          ends ? -1 : way_along(walker_, at(number), along, hit.point.piece)};
  const bool is_way = met.way_back >= 0 && (met.way_on >= 0 || ends);
  if (!is_way && !interrupted_)
    doubt(DoubtKind::no_such_way,
          "a branch passes a special point in a direction that is none of its ways", hit.point,
          number);
  if (met.way_back >= 0) take_way(number, met.way_back);
  return met;
}

/// The branch that is being traced runs along this way, unless another one does.
bool Tracer::take_way(int junction, int number) {
  Way& way = at(junction).ways[static_cast<std::size_t>(number)];
  const bool is_free = way.branch < 0;
  if (is_free) way.branch = current_;
  return is_free;
}

/// The branch that is being traced meets a special point.
/// @param ends  it does not leave it: a kink with several ways out
AtHit Tracer::at_hit(const Hit& hit, bool ends) {
  if (options_.outside && options_.outside(hit.point)) return AtHit::ends;
  if (!is_junction(hit)) return AtHit::goes_on;
  // No other curve leaves an ordinary start: a touch in whose interval it lies is no junction.
  const Branch& own = diagram_.branches[static_cast<std::size_t>(current_)];
  if (hit.kind == HitKind::touch && own.start >= 0 && hit.s_before <= 0) return AtHit::goes_on;
  if (is_its_begin(hit)) return AtHit::nothing_new;
  if (hit.kind == HitKind::branching_kink && !options_.through_kinks) return AtHit::goes_on;
  if (belongs_to_last(hit)) return AtHit::goes_on;
  int number = junction_at(hit);
  const bool known = number >= 0;
  if (!known) number = add_junction(hit);
  if (known && at(number).complete && !lies_on(walker_, at(number).point, hit.switches))
    note_missing(number, names_of(walker_.problem, hit.switches) +
                             " acts beside this point, nearer than points are told apart");
  const Met met = passage_of(hit, number, ends);
  const bool go_on = met.way_on < 0 || take_way(number, met.way_on);
  met_.push_back(met);
  if (!known) queue_ways(number);
  return go_on ? AtHit::goes_on : AtHit::ends;
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

}  // namespace springfold::continuation
