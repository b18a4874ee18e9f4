#include "judge.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace springfold::known_answers {
namespace {

using continuation::Curve, continuation::CurvePoint, continuation::Hit, continuation::HitKind;

bool same_label(const Answer& a, const Hit& hit) {
  switch (a.kind) {
    case AnswerKind::fold:
      return hit.kind == HitKind::limit_point;
    case AnswerKind::branch_point:
      return hit.kind == HitKind::branch_point && hit.multiplicity == a.multiplicity;
    case AnswerKind::touch:
      return hit.kind == HitKind::touch;
    case AnswerKind::kink:
      return hit.kind == HitKind::kink && std::ssize(hit.switches) == a.multiplicity;
    case AnswerKind::corner:
      return hit.kind == HitKind::corner && std::ssize(hit.switches) == a.multiplicity;
  }
  return false;
}

/// Eigenvalue of dF/dq nearest to zero, and the error that rounding of dF/dq makes in it.
std::pair<double, double> least_eigenvalue(const Embedded& problem, const CurvePoint& p) {
  Matrix H;
  Vector F_lambda;
  problem.derivatives(p.x, p.lambda, p.piece, H, F_lambda);
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(H).eigenvalues();
  return {values.cwiseAbs().minCoeff(), 4 * std::numeric_limits<double>::epsilon() * H.norm()};
}

struct Pair {
  double off = 0;
  std::size_t answer = 0, hit = 0;
  bool label = false;
};

struct Matching {
  const Embedded& problem;
  const Draw& draw;
  Verdict& verdict;
  std::vector<const Hit*> hits{};
  std::vector<const Curve*> curves{};  ///< of the hits
  std::vector<bool> answered{}, explained{};

  void add(const Hit& hit, const Curve& curve) {
    hits.push_back(&hit);
    curves.push_back(&curve);
  }

  double off(const Answer& a, const Hit& hit) const {
    return std::max((problem.base_point(hit.point.x) - a.z).norm(),
                    std::abs(hit.point.lambda - a.lambda));
  }

  /// Nearest pairs first; those with the right label before the others.
  void match() {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < draw.answers.size(); ++i)
      for (std::size_t j = 0; j < hits.size(); ++j) {
        const double distance = off(draw.answers[i], *hits[j]);
        if (distance <= 1e-4 * std::max(1.0, draw.size))
          pairs.push_back({distance, i, j, same_label(draw.answers[i], *hits[j])});
      }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return a.label != b.label ? a.label : a.off < b.off;
    });
    for (const Pair& pair : pairs) {
      if (answered[pair.answer] || explained[pair.hit]) continue;
      answered[pair.answer] = explained[pair.hit] = true;
      verdict.answers[pair.answer].outcome = pair.label ? Outcome::found : Outcome::mislabelled;
      verdict.answers[pair.answer].place_error = pair.off / std::max(1.0, draw.size);
      verdict.answers[pair.answer].rounding =
          place_rounding(problem, *hits[pair.hit], *curves[pair.hit]) / std::max(1.0, draw.size);
    }
  }

  /// A touch has multiplicity two: it may stand for two folds or branch points in one cluster.
  void pairs_in_touches() {
    for (std::size_t j = 0; j < hits.size(); ++j) {
      if (hits[j]->kind != HitKind::touch) continue;
      std::vector<std::size_t> pair;
      for (std::size_t i = 0; i < draw.answers.size(); ++i) {
        const Answer& a = draw.answers[i];
        const bool open = verdict.answers[i].outcome == Outcome::missed ||
                          verdict.answers[i].outcome == Outcome::mislabelled;
        const bool simple = a.kind == AnswerKind::fold ||
                            (a.kind == AnswerKind::branch_point && a.multiplicity == 1);
        if (simple && open && a.separation < may_be_cluster &&
            off(a, *hits[j]) < may_be_cluster * std::max(1.0, draw.size))
          pair.push_back(i);
      }
      if (pair.size() != 2) continue;
      explained[j] = true;
      for (const std::size_t i : pair) {
        answered[i] = true;
        verdict.answers[i].outcome = Outcome::cluster;
      }
    }
  }

  void false_events() {
    for (std::size_t j = 0; j < hits.size(); ++j) {
      if (explained[j]) continue;
      double nearest = 1e300, separation = 1;
      for (const Answer& a : draw.answers)
        if (off(a, *hits[j]) < nearest) {
          nearest = off(a, *hits[j]);
          separation = a.separation;
        }
      verdict.false_events.push_back(separation);
    }
  }
};

/// Steps of the curve on which an answer lies: arc lengths around it; beyond the last point: from
/// there to infinity. Nothing if it does not lie ahead on this curve.
struct Stretch {
  double from = 0, to = -1;
};

Stretch stretch_of(const Embedded& problem, const Draw& draw, const Curve& curve,
                   const Answer& answer) {
  const auto parameter = [&](const CurvePoint& p) {
    return draw.parameter(problem.base_point(p.x), p.lambda);
  };
  const double sought = draw.parameter(answer.z, answer.lambda);
  const CurvePoint& first = curve.points.front();
  // Along the tangent's direction, so that one point is enough.
  const double ahead =
      draw.parameter(problem.base_point(first.x + 1e-7 * first.tangent.dx),
                     first.lambda + 1e-7 * first.tangent.dlambda) > parameter(first)
          ? 1
          : -1;
  if ((sought - parameter(first)) * ahead < 0) return {};
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    if ((sought - parameter(curve.points[i])) * ahead <= 0)
      return {curve.points[i - 1].s, curve.points[i].s};
  return {curve.points.back().s, 1e300};
}

/// Answers that were not found, but lie where the engine says that it does not know.
void excuse(const Embedded& problem, const Draw& draw, const Followed& followed,
            std::vector<bool>& answered, Verdict& verdict) {
  const auto within = [&](const Curve& curve, double from, double to) {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < draw.answers.size(); ++i) {
      if (answered[i]) continue;
      const Stretch stretch = stretch_of(problem, draw, curve, draw.answers[i]);
      if (stretch.from < to && from < stretch.to) list.push_back(i);
    }
    return list;
  };
  const auto settle = [&](const std::vector<std::size_t>& list, Outcome outcome) {
    for (const std::size_t i : list) {
      answered[i] = true;
      verdict.answers[i].outcome = outcome;
    }
  };
  for (const Curve& curve : followed.curves) {
    for (const Hit& hit : curve.hits) {
      if (hit.kind != HitKind::unresolved || hit.multiplicity == 0)
        continue;  // 0: a note on a place
      const auto list = within(curve, hit.s_before, hit.s_after);
      int total = 0, touches = 0;
      bool close = !list.empty();
      for (const std::size_t i : list) {
        total += draw.answers[i].multiplicity;
        touches += draw.answers[i].kind == AnswerKind::touch;
        close = close && draw.answers[i].separation < may_be_cluster;
      }
      // A touch is two folds in one; either count is right.
      const bool counted = hit.multiplicity >= total && hit.multiplicity <= total + touches;
      verdict.refused = verdict.refused || !close;
      settle(list, !close ? Outcome::refused : counted ? Outcome::cluster : Outcome::miscounted);
    }
    if (reached_end(curve)) continue;
    verdict.refused = true;
    settle(within(curve, curve.points.back().s, 1e300), Outcome::refused);
  }
  if (followed.curves.empty()) {  // no point was claimed at all
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < draw.answers.size(); ++i) all.push_back(i);
    settle(all, Outcome::refused);
  }
}

}  // namespace

double place_rounding(const Embedded& problem, const Hit& hit, const Curve& curve) {
  const auto after = std::find_if(curve.points.begin(), curve.points.end(),
                                  [&](const CurvePoint& p) { return p.s > hit.point.s; });
  if (after == curve.points.end() || after == curve.points.begin()) return 0;
  double worst = 0;
  for (const CurvePoint* p : {&*after, &*(after - 1)}) {
    const auto [eigenvalue, error] = least_eigenvalue(problem, *p);
    const double way = (problem.base_point(p->x) - problem.base_point(hit.point.x)).norm();
    const double share = eigenvalue > 0 ? error / eigenvalue : 1;
    worst = std::max(worst, hit.kind == HitKind::touch ? std::sqrt(share) * way : share * way);
  }
  return worst;
}

Verdict judge(const Embedded& problem, const Draw& draw, const Followed& followed) {
  Verdict verdict{.family = draw.family, .gap = draw.gap, .separation = smallest_separation(draw)};
  verdict.blurred = draw.blurred;
  for (const Answer& a : draw.answers) verdict.answers.push_back({.separation = a.separation});
  verdict.refused = !followed.refusal.empty();
  Matching matching{problem, draw, verdict};
  for (const Curve& curve : followed.curves) {
    check_points(problem, draw, curve, verdict);
    for (const Hit& hit : curve.hits)
      if (hit.kind != HitKind::user && hit.kind != HitKind::unresolved &&
          hit.kind != HitKind::inexact)
        matching.add(hit, curve);
  }
  matching.answered.resize(draw.answers.size());
  matching.explained.resize(matching.hits.size());
  matching.match();
  matching.pairs_in_touches();
  matching.false_events();
  excuse(problem, draw, followed, matching.answered, verdict);
  return verdict;
}

}  // namespace springfold::known_answers
