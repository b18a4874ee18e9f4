#include "follow.hpp"

#include <cstdio>

namespace springfold::known_answers {

using continuation::Curve, continuation::CurvePoint, continuation::HitKind;

namespace {

const char* name_of(HitKind kind) {
  switch (kind) {
    case HitKind::limit_point:
      return "limit point";
    case HitKind::branch_point:
      return "branch point";
    case HitKind::kink:
      return "kink";
    case HitKind::corner:
      return "corner";
    case HitKind::branching_kink:
      return "branching kink";
    case HitKind::touch:
      return "touch";
    case HitKind::user:
      return "limit";
    case HitKind::family:
      return "family";
    case HitKind::unresolved:
      return "unresolved";
    case HitKind::inexact:
      return "inexact";
  }
  return "?";
}

const char* name_of(AnswerKind kind) {
  switch (kind) {
    case AnswerKind::fold:
      return "limit point";
    case AnswerKind::branch_point:
      return "branch point";
    case AnswerKind::touch:
      return "touch";
    case AnswerKind::kink:
      return "kink";
    case AnswerKind::corner:
      return "corner";
  }
  return "?";
}

void print_z(const Vector& z) {
  for (const double value : z) std::printf(" %.15g", value);
  std::printf("\n");
}

}  // namespace

Curve follow_ray(const Embedded& problem, const Draw& draw, const Vector& x, double lambda,
                 const continuation::Ray& ray, const continuation::TraceOptions& options) {
  std::vector<continuation::Event> events;
  for (const Limit& limit : draw.limits)
    events.push_back(
        {limit.name,
         [&](const CurvePoint& p) { return limit.inside(problem.base_point(p.x), p.lambda); },
         continuation::EventAction::stop});
  return continuation::trace(problem, x, lambda, ray, events, options);
}

Followed follow(const Embedded& problem, const Draw& draw, const Vector& x, double lambda,
                const Piece& piece, const continuation::TraceOptions& options) {
  const auto rays = continuation::rays_from(problem, x, lambda, piece, options);
  Followed followed;
  if (!rays.complete || rays.rays.size() != 2)
    followed.refusal = std::to_string(rays.rays.size()) + " rays: " + rays.why;
  for (const auto& ray : rays.rays)
    followed.curves.push_back(follow_ray(problem, draw, x, lambda, ray, options));
  return followed;
}

Followed follow(const Embedded& problem, const Draw& draw,
                const continuation::TraceOptions& options) {
  return follow(problem, draw, problem.embed(draw.z_start), draw.lambda_start,
                problem.piece_at(draw.z_start), options);
}

void print(const Embedded& problem, const Draw& draw, const Followed& followed, bool whole_log) {
  std::printf("%s: n %td, gap %.2g, separation %.2g, size %.3g\n", draw.family.c_str(),
              problem.size(), draw.gap, smallest_separation(draw), draw.size);
  for (const Answer& a : draw.answers) {
    std::printf("  answer %s (%d) lambda %.15g z", name_of(a.kind), a.multiplicity, a.lambda);
    print_z(a.z);
  }
  if (!followed.refusal.empty()) std::printf("  start refused: %s\n", followed.refusal.c_str());
  for (const Curve& curve : followed.curves) {
    std::printf("ray: %zu points, %zu notes, stop: %s %s\n", curve.points.size(), curve.log.size(),
                std::string(to_string(curve.stop)).c_str(), curve.stop_detail.c_str());
    for (const auto& hit : curve.hits) {
      const int count =
          hit.switches.empty() ? hit.multiplicity : static_cast<int>(hit.switches.size());
      std::printf("  %s (%d) %s: s %.12g in [%.12g, %.12g], lambda %.15g z", name_of(hit.kind),
                  count, hit.name.c_str(), hit.point.s, hit.s_before, hit.s_after,
                  hit.point.lambda);
      print_z(problem.base_point(hit.point.x));
    }
    const std::size_t first = whole_log || curve.log.size() < 12 ? 0 : curve.log.size() - 12;
    for (std::size_t i = first; i < curve.log.size(); ++i)
      std::printf("  log s %.8g step %.3g: %s\n", curve.log[i].s, curve.log[i].step,
                  curve.log[i].reason.c_str());
    if (!whole_log) continue;
    for (const CurvePoint& p : curve.points) {
      const Vector z = problem.base_point(p.x);
      std::printf("  point s %.8g lambda %.12g negative %td %s z", p.s, p.lambda,
                  p.negative.value_or(-1),
                  !draw.on_curve               ? ""
                  : draw.on_curve(z, p.lambda) ? "on"
                                               : "OFF");
      print_z(z);
    }
  }
}

}  // namespace springfold::known_answers
