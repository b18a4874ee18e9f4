// Known-answer campaign: known_answers [N] [seed] [family]. Reports by bins of gap.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "family.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::known_answers {
namespace {

using continuation::Curve;
using continuation::HitKind;

struct Tally {
  long draws = 0, expected = 0, missed = 0, wrong = 0, jumps = 0, bad_index = 0, refused = 0;
  double worst_place = 0;
  std::string example{};
};

bool same_kind(AnswerKind a, HitKind b) {
  return (a == AnswerKind::fold && b == HitKind::limit_point) ||
         (a == AnswerKind::branch_point && b == HitKind::branch_point) ||
         (a == AnswerKind::touch && b == HitKind::touch) ||
         (a == AnswerKind::corner && b == HitKind::corner);
}

Index negative_count(const Base& base, const Vector& z, double lambda) {
  Vector F, F_lambda;
  Matrix H;
  base.at(z, lambda, F, H, F_lambda);
  const auto values = H.eigenvalues().real().eval();
  Index count = 0;
  for (const double v : values) count += v < 0;
  return count;
}

void run(const Draw& draw, Index n, std::mt19937_64& random, long number, Tally& tally) {
  const Embedded problem(draw.base, n, random);
  continuation::TraceOptions options;
  std::vector<continuation::Event> events;
  const auto limit = [&](const char* name, auto value) {
    events.push_back({name, value, continuation::EventAction::stop});
  };
  limit("low", [&](const auto& p) { return p.lambda - draw.lambda_low; });
  limit("high", [&](const auto& p) { return draw.lambda_high - p.lambda; });
  const double zl = std::max(draw.z_low, draw.z_start[0] - 1e6), zh = draw.z_high;
  limit("left", [&](const auto& p) { return problem.base_point(p.x)[0] - zl; });
  limit("right", [&](const auto& p) { return zh - problem.base_point(p.x)[0]; });
  if (draw.base.size == 3 || draw.family == "von Mises with sway") {
    const Index axis = draw.base.size - 1;
    const double end = 1.2 * std::abs(draw.z_start[axis]);
    limit("up", [&, axis, end](const auto& p) { return end - problem.base_point(p.x)[axis]; });
    limit("down", [&, axis, end](const auto& p) { return end + problem.base_point(p.x)[axis]; });
  }
  const Vector x = problem.embed(draw.z_start);
  const auto rays = rays_from(problem, x, draw.lambda_start, {}, options);
  ++tally.draws;
  std::vector<bool> found(draw.answers.size(), false);
  long refused = 0, jumps = 0, wrong = 0, bad_index = 0;
  if (rays.rays.size() != 2) ++refused;
  for (const auto& ray : rays.rays) {
    const Curve curve = trace(problem, x, draw.lambda_start, ray, events, options);
    if (curve.stop != continuation::StopReason::event) ++refused;
    if (std::getenv("KA_VERBOSE")) {
      std::printf("stop %s %s points %zu\n", std::string(to_string(curve.stop)).c_str(),
                  curve.stop_detail.c_str(), curve.points.size());
      for (const auto& hit : curve.hits) {
        const Vector z = problem.base_point(hit.point.x);
        std::printf("  hit %d %s m=%d s=%.10g lambda=%.12g z=%.12g %.3g\n", (int)hit.kind,
                    hit.name.c_str(), hit.multiplicity, hit.point.s, hit.point.lambda, z[0],
                    z.norm());
      }
      for (std::size_t i =
               std::getenv("KA_ALL") ? 0 : (curve.log.size() > 12 ? curve.log.size() - 12 : 0);
           i < curve.log.size(); ++i)
        std::printf("  log s=%.8g ds=%.3g %s\n", curve.log[i].s, curve.log[i].step,
                    curve.log[i].reason.c_str());
      for (const auto& a : draw.answers)
        std::printf("  answer %d m=%d lambda=%.12g z=%.12g\n", (int)a.kind, a.multiplicity,
                    a.lambda, a.z[0]);
    }
    for (const auto& p : curve.points) {
      const Vector z = problem.base_point(p.x);
      if (draw.on_curve && !draw.on_curve(z, p.lambda)) ++jumps;
      if (p.negative &&
          *p.negative - problem.negative_extra() != negative_count(draw.base, z, p.lambda))
        ++bad_index;
    }
    for (const auto& hit : curve.hits) {
      if (hit.kind == HitKind::user) continue;
      if (hit.kind == HitKind::unresolved) {
        ++refused;
        continue;
      }
      const Vector z = problem.base_point(hit.point.x);
      bool matched = false;
      for (std::size_t i = 0; i < draw.answers.size() && !matched; ++i) {
        const Answer& a = draw.answers[i];
        const double off = std::max((z - a.z).norm(), std::abs(hit.point.lambda - a.lambda));
        if (found[i] || !same_kind(a.kind, hit.kind) || off > 1e-4 * draw.size ||
            hit.multiplicity != a.multiplicity)
          continue;
        found[i] = matched = true;
        tally.worst_place = std::max(tally.worst_place, off / draw.size);
      }
      if (!matched) ++wrong;
    }
  }
  long missed = 0;
  for (std::size_t i = 0; i < found.size(); ++i) missed += !found[i];
  tally.expected += static_cast<long>(found.size());
  tally.missed += missed;
  tally.wrong += wrong;
  tally.jumps += jumps > 0;
  tally.bad_index += bad_index > 0;
  tally.refused += refused > 0;
  if (tally.example.empty() && (missed || wrong || jumps || bad_index || refused))
    tally.example = "draw " + std::to_string(number) + " n " + std::to_string(n) + " missed " +
                    std::to_string(missed) + " wrong " + std::to_string(wrong) + " jumps " +
                    std::to_string(jumps) + " index " + std::to_string(bad_index) + " refused " +
                    std::to_string(refused);
}

}  // namespace
}  // namespace springfold::known_answers

int main(int argc, char** argv) {
  using namespace springfold::known_answers;
  const long count = argc > 1 ? std::atol(argv[1]) : 1000;
  const unsigned long long seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const std::string only = argc > 3 ? argv[3] : "";
  Draw (*families[])(std::mt19937_64&) = {fold_ladder, strands,        pitchfork,   two_mode,
                                          n_pod_dome,  von_mises_sway, link_column, trammel};
  std::map<std::pair<std::string, int>, Tally> tallies;
  for (long i = 0; i < count; ++i) {
    std::mt19937_64 random(seed * 1000003ull + static_cast<unsigned long long>(i));
    const auto f = static_cast<std::size_t>(i) % std::size(families);
    const Draw draw = families[f](random);
    if (!only.empty() && draw.family != only) continue;
    if (std::getenv("KA_DRAW") && std::atol(std::getenv("KA_DRAW")) != i) continue;
    const auto n = static_cast<springfold::Index>(1 + random() % 30);
    const int bin = std::min(0, static_cast<int>(std::floor(std::log10(draw.gap))));
    run(draw, n, random, i, tallies[{draw.family, bin}]);
  }
  std::printf("%-20s %5s %6s %8s %7s %6s %6s %6s %8s %10s\n", "family", "gap", "draws", "expected",
              "missed", "wrong", "jumps", "index", "refused", "place");
  for (const auto& [key, t] : tallies)
    std::printf("%-20s 1e%-3d %6ld %8ld %7ld %6ld %6ld %6ld %8ld %10.1e  %s\n", key.first.c_str(),
                key.second, t.draws, t.expected, t.missed, t.wrong, t.jumps, t.bad_index, t.refused,
                t.worst_place, t.example.c_str());
}
