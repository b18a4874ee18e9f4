// Traces the branches of a diagram, one after the other, and keeps its junctions. Private to the engine.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "continuation/branches/known_junctions.hpp"
#include "continuation/branches/piece_before.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// Something that waits to be traced.
struct Task {
  int start = -1, junction = -1, way = -1;
  CurvePoint from{};
  int depth = 0;
  int kink = -1;  ///< junction of an ordinary kink at a start, of which this is way number `way`
};

/// What a branch does at a special point.
enum class AtHit {
  goes_on,
  ends,         ///< another branch runs along its way on
  nothing_new,  ///< it goes on: the point is the junction at which it begins, seen once more
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
    return junction_where(walker_, diagram_.junctions, hit, met_, options_.same_place);
  }
  int add_junction(const Hit& hit);
  void add_ordinary_start(const CurvePoint& point, const Rays& rays, int number);
  void queue_ways(int junction);
  void note_missing(int number, std::string why);
  void note_untold(int number);
  void look_beside_start(int number);
  bool belongs_to_last(const Hit& hit);
  bool is_its_begin(const Hit& hit) const;
  bool is_fresh(int junction) const;
  Met passage_of(const Hit& hit, int junction, bool ends);
  bool take_way(int junction, int way);
  AtHit at_hit(const Hit& hit, bool ends = false);
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

}  // namespace springfold::continuation
