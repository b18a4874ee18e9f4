#include "grow_diagram.hpp"

#include <algorithm>
#include <cmath>

#include "closure_rank.hpp"
#include "infinite_force.hpp"
#include "limits.hpp"
#include "search_box.hpp"
#include "springfold/continuation/between.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/search.hpp"
#include "springfold/core/number_text.hpp"
#include "within_limits.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::DiagramStart;
using continuation::Hit;
using continuation::StopReason;

class Grower {
 public:
  explicit Grower(const Tracing& tracing)
      : t_{tracing}, events_{events_of(t_.study, t_.evaluator, t_.quantities)} {
    options_.trace = options_of(t_.study.trace);
    options_.maximum_depth = t_.study.branches.depth;
    options_.left_out = [this](const CurvePoint& point) {
      return kinematic_singularity(t_.problem, point).value_or("");
    };
    options_.ends_at = [this](const CurvePoint& point) {
      const auto end = ended_at_start(t_.study, t_.evaluator, t_.quantities, point,
                                      {point.piece, point.tangent});
      return end ? end->stop_detail : "";
    };
    options_.outside = [this](const CurvePoint& point) {
      return limit_passed(t_.study, t_.evaluator, t_.quantities, point).has_value();
    };
  }

  Grown grow(const CurvePoint& start, const std::vector<DiagramStart>& further) {
    grown_.starts = {{start.x, start.lambda, start.piece}};
    grown_.starts.insert(grown_.starts.end(), further.begin(), further.end());
    run();
    for (const double lambda : t_.study.branches.search_at)
      if (wants_more()) search(lambda);
    if (!stopped_by_observer()) count_traced();
    say_what_is_missing();
    return std::move(grown_);
  }

 private:
  bool stopped_by_observer() const { return t_.asking.was_stopped(); }
  bool wants_more() const { return !stopped_ && !stopped_by_observer(); }

  void say_what_is_missing() {
    if (!stopped_by_observer()) return;
    const int ways = grown_.diagram.not_followed;
    if (ways > 0)
      grown_.doubts.push_back("interrupted: " + std::to_string(ways) +
                              (ways == 1 ? " branch was not traced" : " branches were not traced"));
    const std::size_t all = t_.study.branches.search_at.size(), done = grown_.searches.size();
    if (done < all)
      grown_.doubts.push_back("interrupted: " + std::to_string(done) + " of " +
                              std::to_string(all) + " searches for further branches were made");
  }

  void run() {
    options_.maximum_branches = t_.study.branches.maximum;
    int points = 0;
    std::vector<CurvePoint> away;  // where lambda grows without bound
    InfiniteForceWatch forces(t_.problem, events_);
    const auto observe = [&](const CurvePoint& point) {
      ++points;
      if (limit_passed(t_.study, t_.evaluator, t_.quantities, point)) return false;
      if (forces.sees(point)) return false;
      const Crawl crawl = t_.crawl.sees(point);
      if (crawl == Crawl::without_bound) away.push_back(point);
      stopped_ = stopped_ || crawl == Crawl::unit_too_small ||
                 (t_.observer && !t_.observer(points, point.s));
      return !stopped_ && crawl == Crawl::none;
    };
    grown_.diagram = trace_diagram(asked_, grown_.starts, events_, options_, observe);
    for (continuation::Branch& branch : grown_.diagram.branches)
      if (std::any_of(away.begin(), away.end(),
                      [&](const CurvePoint& p) { return was_ended_at(branch.curve, p); }))
        end_without_bound(branch.curve);
    for (continuation::Branch& branch : grown_.diagram.branches)
      forces.end(branch.curve, options_.trace);
    for (continuation::Branch& branch : grown_.diagram.branches)
      cut_to_range(t_.study, t_.evaluator, t_.quantities, branch.curve);
  }

  bool lies_on_a_branch(const DiagramStart& at) const {
    const auto rays = rays_from(t_.problem, at.x, at.lambda, at.piece, options_.trace);
    return std::any_of(rays.rays.begin(), rays.rays.end(), [&](const continuation::Ray& ray) {
      const CurvePoint point{
          .x = at.x, .lambda = at.lambda, .tangent = ray.tangent, .piece = ray.piece};
      return std::any_of(grown_.diagram.branches.begin(), grown_.diagram.branches.end(),
                         [&](const auto& branch) {
                           return passes_through(t_.problem, branch.curve, point, options_.trace);
                         });
    });
  }

  void search(double lambda) {
    const BranchSettings& settings = t_.study.branches;
    const double scaled = lambda / t_.lambda_scale;
    const auto known = known_at(t_.problem, grown_.diagram, scaled);
    const auto [low, high] = search_box(t_.problem, grown_.diagram, grown_.starts.front().x);
    continuation::SearchResult found;
    try {
      found = continuation::search_at(
          asked_, scaled, known,
          {.low = low, .high = high, .starts = settings.starts, .seed = settings.seed});
    } catch (const continuation::Interrupted&) {
      return;
    }
    Search report{.lambda = lambda, .starts = found.starts_used};
    report.limit_reached = found.limit_reached;
    std::vector<int> numbers;
    for (std::size_t i = 0; i < found.solutions.size(); ++i) {
      const DiagramStart start{found.solutions[i], scaled, found.pieces[i]};
      const CurvePoint point{.x = start.x, .lambda = scaled, .piece = start.piece};
      if (closures_contradict(t_.problem, point) || lies_on_a_branch(start)) continue;
      if (limit_passed(t_.study, t_.evaluator, t_.quantities, point)) {
        ++report.out_of_range;
        continue;
      }
      ++report.found;
      numbers.push_back(static_cast<int>(grown_.starts.size()));
      grown_.starts.push_back(start);
    }
    grown_.searches.push_back(report);
    found_.push_back(std::move(numbers));
    if (report.found > 0) run();
  }

  void count_traced() {
    for (std::size_t i = 0; i < found_.size(); ++i)
      for (const int number : found_[i]) {
        const bool own = std::any_of(grown_.diagram.branches.begin(), grown_.diagram.branches.end(),
                                     [number](const auto& b) { return b.start == number; });
        if (own || lies_on_a_branch(grown_.starts[static_cast<std::size_t>(number)]))
          ++grown_.searches[i].traced;
      }
  }

  const Tracing& t_;
  const AskedProblem asked_{t_.problem, t_.asking};
  std::vector<continuation::Event> events_;
  continuation::DiagramOptions options_{};
  Grown grown_{};
  std::vector<std::vector<int>> found_{};  ///< per search: numbers of its starts
  bool stopped_ = false;                   ///< the observer wants no more
};

}  // namespace

namespace {

double length_of(const Curve& curve) {
  return curve.points.empty() ? 0 : std::abs(curve.points.back().s - curve.points.front().s);
}

/// Do the rows over a curve so long fit beside those before? Otherwise says what to change.
bool has_room(const Tracing& tracing, double length) {
  const double spacing = tracing.study.trace.spacing;
  const double row = bytes_of_traced_row(tracing.quantities.size(),
                                         static_cast<std::size_t>(tracing.problem.size()));
  const double bytes = length / spacing * row;
  RowBudget& budget = tracing.budget;
  if (bytes <= budget.bytes) {
    budget.bytes -= bytes;
    return true;
  }
  const double all = most_memory - budget.bytes + bytes;
  constexpr double some_more = 1.1;  // so that rounding does not bring it back below
  if (budget.refused.empty())
    budget.refused = "trace.spacing: got " + rounded(spacing) + ", which makes about " +
                     rounded(length / spacing) + " rows of a branch of length " + rounded(length) +
                     ", with those before about " + rounded(all / 1e9) +
                     " GB of memory, need at most " + rounded(most_memory / 1e9) +
                     " GB: a spacing of " + rounded(some_more * spacing * all / most_memory, 2) +
                     " or more; the branch has the rows of its steps only";
  return false;
}

}  // namespace

continuation::TraceOptions options_of(const TraceSettings& settings) {
  continuation::TraceOptions options;
  options.step.initial = settings.initial_step;
  options.step.minimum = settings.minimum_step;
  options.step.maximum = settings.maximum_step;
  options.maximum_points = settings.maximum_points;
  options.verify_arcs = settings.verify_arcs;
  return options;
}

void add_between(const Tracing& tracing, BranchSource& source) {
  const double spacing = tracing.study.trace.spacing;
  if (spacing == 0 || !has_room(tracing, length_of(source.backward) + length_of(source.forward)))
    return;
  const auto options = options_of(tracing.study.trace);
  const AskedProblem asked(tracing.problem, tracing.asking);
  const auto fill = [&](Curve& curve, std::vector<CurvePoint>& between) {
    auto found = continuation::points_between(asked, curve, spacing, options);
    between = std::move(found.points);
    if (found.missed > 0)
      curve.log.push_back(
          {curve.points.back().s, spacing,
           std::to_string(found.missed) + " rows beside special points could not be computed"});
  };
  for (auto [curve, between] : {std::pair{&source.backward, &source.backward_between},
                                {&source.forward, &source.forward_between}}) {
    if (tracing.asking.goes_on()) fill(*curve, *between);
  }
  if (!tracing.asking.was_stopped()) return;
  source.is_thinned = true;
  source.backward_between.clear();
  source.forward_between.clear();
}

Grown grow_diagram(const Tracing& tracing, const CurvePoint& start,
                   const std::vector<DiagramStart>& further) {
  return Grower(tracing).grow(start, further);
}

}  // namespace springfold::analysis
