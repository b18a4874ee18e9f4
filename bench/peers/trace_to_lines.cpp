// One curve as the comparison with AUTO-07p wants it: no case file, no result files, one line of
// lambda and two measures per point or nothing at all. Special points are listed on standard error.
//
//     springfold_trace PROBLEM STEP SPACING POINTS STOP line|nothing
//
// PROBLEM is orthoglide (at Q2), orthoglide-q1, column:N (N links, skew load) or straight:N. STEP is
// the longest step of the engine and POINTS the largest number of steps; SPACING > 0: points also at
// all multiples of this arc length. The curve ends at lambda = STOP.
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "load_path.hpp"
#include "problems.hpp"
#include "springfold/continuation/between.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace {

using namespace springfold;
using continuation::CurvePoint;

/// Text in one piece, written when it is large.
class Lines {
 public:
  ~Lines() { flush(); }
  void add(double a, double b, double c) {
    put(a, ' ');
    put(b, ' ');
    put(c, '\n');
    if (used_ + 128 > text_.size()) flush();
  }

 private:
  void put(double value, char after) {
    char* const begin = text_.data() + used_;
    char* end = std::to_chars(begin, text_.data() + text_.size(), value).ptr;
    *end++ = after;
    used_ += static_cast<std::size_t>(end - begin);
  }
  void flush() {
    std::fwrite(text_.data(), 1, used_, stdout);
    used_ = 0;
  }

  std::array<char, 1 << 16> text_{};
  std::size_t used_ = 0;
};

std::optional<bench::Problem> problem_named(std::string_view name) {
  constexpr double p = 0.454;
  if (name == "orthoglide") return bench::commanded_orthoglide(p);
  if (name == "orthoglide-q1") return bench::commanded_orthoglide(-p);
  const auto colon = name.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const int links = std::atoi(std::string(name.substr(colon + 1)).c_str());
  if (links < 1) return std::nullopt;
  if (name.substr(0, colon) == "column") return bench::column(links, 0.01);
  if (name.substr(0, colon) == "straight") return bench::column(links, 0);
  return std::nullopt;
}

struct Wishes {
  double step = 0, spacing = 0;
  int points = 0;
  double stop = 0;
  bool lines = false;
};

void list_special_points(const continuation::Curve& curve, double force) {
  for (const continuation::Hit& hit : curve.hits) {
    const char* label = hit.kind == continuation::HitKind::limit_point    ? "LP"
                        : hit.kind == continuation::HitKind::branch_point ? "BP"
                        : hit.kind == continuation::HitKind::user         ? "END"
                                                                          : "UR";
    std::fprintf(stderr, "%s %.17g %.17g\n", label, force * hit.point.lambda,
                 hit.point.x.tail(2).norm());
  }
}

/// Points of the curve and between them, in the order of s.
std::size_t write(const bench::LoadPath& path, const bench::Problem& problem,
                  const continuation::Curve& curve, const Wishes& wishes,
                  const continuation::TraceOptions& options) {
  continuation::Between between;
  if (wishes.spacing > 0)
    between = continuation::points_between(path, curve, wishes.spacing, options);
  if (wishes.lines) {
    Lines text;
    const auto line = [&](const CurvePoint& p) {
      text.add(problem.force * p.lambda, p.x.norm(), p.x[p.x.size() - 1]);
    };
    auto next = between.points.begin();
    for (const CurvePoint& p : curve.points) {
      while (next != between.points.end() && next->s < p.s) line(*next++);
      line(p);
    }
    while (next != between.points.end()) line(*next++);
  }
  return curve.points.size() + between.points.size();
}

int run(const bench::Problem& problem, const Wishes& wishes) {
  const bench::LoadPath path(problem.mechanism, problem.direction);
  const auto start = statics::first_equilibrium(
      path.system, {.z = statics::guess(path.system), .inputs = path.inputs(0)});
  if (start.status != statics::StartStatus::found) return 4;
  continuation::TraceOptions options;
  options.step.initial = options.step.maximum = wishes.step;
  options.maximum_points = wishes.points;
  const auto rays = continuation::rays_from(path, start.z, 0, {}, options);
  for (const continuation::Ray& ray : rays.rays) {
    if (ray.tangent.dlambda < 0) continue;
    const double end = wishes.stop / problem.force;
    const auto beyond = [end](const CurvePoint& p) { return p.lambda - end; };
    const auto curve = continuation::trace(
        path, start.z, 0, ray, {{"end", beyond, continuation::EventAction::stop}}, options);
    list_special_points(curve, problem.force);
    const std::size_t points = write(path, problem, curve, wishes, options);
    std::fprintf(stderr, "points %zu, length %.17g\n", points, curve.points.back().s);
    return 0;
  }
  return 4;
}

}  // namespace

int main(int count, char** words) {
  const auto problem = count == 7 ? problem_named(words[1]) : std::nullopt;
  if (!problem) {
    std::fprintf(stderr, "usage: %s PROBLEM STEP SPACING POINTS STOP line|nothing\n", words[0]);
    return 2;
  }
  return run(*problem, {.step = std::atof(words[2]),
                        .spacing = std::atof(words[3]),
                        .points = std::atoi(words[4]),
                        .stop = std::atof(words[5]),
                        .lines = std::strcmp(words[6], "line") == 0});
}
