#include "springfold/continuation/verification.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/following/tube_test.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Neighbouring steps that differ by more than this factor make no common model.
constexpr double most_uneven = 16;

/// A window is halved so many times at most.
constexpr int most_halvings = 7;

/// A branch that crosses under a small angle is left by at least an eighth of its distance: less is the model's own
/// error.
constexpr double own_branch = small_share;

/// One arc after the other, each cut into windows as the test needs them.
class Verifier {
 public:
  Verifier(const Walker& walker, const Stretch& stretch, std::vector<Arc>& arcs)
      : walker_{walker}, points_{stretch}, test_{walker, stretch.front().piece}, arcs_{arcs} {}

  void verify(std::size_t k) {
    arc_ = k;
    passes_.reset();
    way_ = way_to(walker_.weights, points_[k], points_[k + 1]);
    if (make_model(k))
      window({0, way_}, 0);
    else
      record({0, way_}, ArcEvidence::sampled, 0);
  }

 private:
  double length(std::size_t k) const { return points_[k + 1].s - points_[k].s; }

  bool is_even(std::size_t a, std::size_t b) const {
    const double ratio = length(a) / length(b);
    return ratio <= most_uneven && ratio >= 1 / most_uneven;
  }

  /// Through the arc's ends and their neighbours; where those bend away, through the ends alone.
  bool make_model(std::size_t k) {
    std::vector<const CurvePoint*> nodes;
    if (k > 0 && is_even(k - 1, k)) nodes.push_back(&points_[k - 1]);
    nodes.insert(nodes.end(), {&points_[k], &points_[k + 1]});
    if (k + 2 < points_.size() && is_even(k + 1, k)) nodes.push_back(&points_[k + 2]);
    if (model_.go_through(walker_.weights, points_[k], nodes)) return true;
    nodes = {&points_[k], &points_[k + 1]};
    return model_.go_through(walker_.weights, points_[k], nodes);
  }

  void window(const Window& w, int halvings) {
    if (const auto radius = test_.regular(model_, w))
      return record(w, ArcEvidence::regular, *radius);
    if (const auto radius = test_.crossing(model_, w); radius && on_its_own_branch())
      return record(w, ArcEvidence::crossing, *radius);
    if (halvings == most_halvings) return record(w, ArcEvidence::sampled, 0);
    window({w.begin, w.middle()}, halvings + 1);
    window({w.middle(), w.end}, halvings + 1);
  }

  void record(const Window& w, ArcEvidence evidence, double radius) {
    const double s = points_[arc_].s, step = length(arc_);
    const double from = w.begin == 0 ? s : s + step * (w.begin / way_);
    const double to = w.end == way_ ? points_[arc_ + 1].s : s + step * (w.end / way_);
    if (!arcs_.empty() && arcs_.back().evidence == evidence && arcs_.back().s_end == from &&
        from > s) {
      arcs_.back().s_end = to;
      arcs_.back().radius = std::min(arcs_.back().radius, radius);
    } else {
      arcs_.push_back({from, to, evidence, radius});
    }
  }

  /// Do the points behind the arc lead to its end, and those ahead to its begin, and to no branch that crosses?
  bool on_its_own_branch() {
    if (!passes_) passes_ = leads(arc_, -1) && leads(arc_ + 1, 1);
    return *passes_;
  }

  /// @param side  -1: the points up to `from` lead to the next one; 1: those from it on lead to the one before
  bool leads(std::size_t from, int side) {
    constexpr std::size_t most = 3;
    std::vector<const CurvePoint*> nodes;
    for (auto i = static_cast<std::ptrdiff_t>(from);
         i >= 0 && i < std::ssize(points_) && nodes.size() < most; i += side)
      nodes.push_back(&points_[static_cast<std::size_t>(i)]);
    if (nodes.size() < 2) return false;
    if (side < 0) std::reverse(nodes.begin(), nodes.end());
    const CurvePoint& to = points_[side < 0 ? from + 1 : from - 1];
    ArcModel model;
    if (!model.go_through(walker_.weights, points_[from], nodes)) return false;
    const TestedStep step(walker_, to, length(arc_));
    const auto other = separation_at(step, to);
    const double off = distance_of(walker_, model, points_[from], to);
    return other && std::isfinite(other->blur) && off <= own_branch * other->distance;
  }

  const Walker& walker_;
  const Stretch& points_;
  TubeTest test_;
  ArcModel model_{};
  std::vector<Arc>& arcs_;
  std::size_t arc_ = 0;
  double way_ = 0;  ///< of the arc, along the tangent where it begins
  std::optional<bool> passes_{};
};

}  // namespace

std::string_view to_string(ArcEvidence evidence) {
  switch (evidence) {
    case ArcEvidence::sampled:
      return "sampled";
    case ArcEvidence::regular:
      return "regular";
    case ArcEvidence::crossing:
      return "crossing";
  }
  return "unknown";
}

std::vector<Arc> verified_arcs(ProblemView problem, const Curve& curve,
                               const TraceOptions& options) {
  std::vector<Arc> arcs;
  check_curve(problem, curve);
  if (curve.points.empty()) return arcs;
  const CurvePoint& start = curve.points.front();
  const Normalised own(problem, start.x, start.lambda, start.piece);
  const Walker walker{own, own.metric(), options};
  double end = start.s;
  for (const Stretch& stretch : smooth_stretches(walker, own, curve)) {
    // Between pieces, without a kink that was found.
    if (end < stretch.front().s) arcs.push_back({.s_begin = end, .s_end = stretch.front().s});
    end = stretch.back().s;
    if (stretch.size() < 2) continue;
    if (problem.structured()) {
      arcs.push_back({stretch.front().s, end});
      continue;
    }
    Verifier verifier(walker, stretch, arcs);
    for (std::size_t k = 0; k + 1 < stretch.size(); ++k) verifier.verify(k);
  }
  return arcs;
}

ArcLengths lengths_of(const std::vector<Arc>& arcs) {
  ArcLengths lengths;
  for (const Arc& arc : arcs) {
    lengths.all += arc.s_end - arc.s_begin;
    if (arc.evidence != ArcEvidence::sampled) lengths.verified += arc.s_end - arc.s_begin;
  }
  return lengths;
}

}  // namespace springfold::continuation
