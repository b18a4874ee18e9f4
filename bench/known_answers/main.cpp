// Known-answer campaign: random problems whose special points are known in closed form, followed by
// the engine at its default options.
//
//     known_answers [N] [seed] [--check] [--threads n] [--family name] [--draw i] [--steps f]
//         [--verbose] [--named file] [--failures file]
//
// Draw i of a seed is always the same problem, whatever N and the number of threads are. Problems
// in few unknowns are embedded in up to 30 (embedded.hpp). The families:
//
//   fold ladder          lambda = p(x), p' = c prod (x - a_i)^m_i: folds (m = 1) and touches (m = 2)
//     blurred            some of them so close that double precision cannot tell them apart: jumps and
//                        index are judged as everywhere, the events are only reported
//   strands              parallel branches that do not meet, a gap apart
//   pitchfork            perfect (both branches) and with an imperfection (main, detached branch)
//   two mode             two interacting modes: trivial, X, Y and mixed branches; double points
//   n-pod dome           folds and double branch points of a symmetric dome under its axis load
//   von Mises with sway  folds and simple branch points of the truss with two springs
//   link column          n buckling loads on the straight branch
//   trammel              two folds between two asymptotes
//   one-sided            springs that act on one side of a threshold: kinks, corners, several at once
//
// With --wide the embedding has 1 to 12 unknowns and stiffnesses of 1e-2 to 1e2, and there are two families more:
//
//   crossing             two branches that cross under 1e-4 to 1e-1, or pass each other there
//   opposite             two eigenvalues that pass zero in opposite senses, together or near each other
//
// Two tables of the same columns: by the gap to the nearest other branch or arm and by the
// separation of an event to the next one on its curve, both relative to the size of the curve; a
// bin begins at the value given. Draws, jumps, index and refused count draws, the rest events.
//
//   jumps     draws with a point on another branch, or where the curve went back
//   expected  events that are there
//   missed    passed in silence
//   false     found, but there is nothing
//   label     right place, but another kind or multiplicity
//   count     in an unresolved interval that gives another total multiplicity
//   cluster   in an unresolved interval with the right one, events closer than 1e-4 of the size
//   ev.ref.   beyond the place where the trace gave up, or in an unresolved interval elsewhere
//   index     draws with a stored point whose number of negative eigenvalues is wrong
//   place     largest error of a found event, over max(1, size)
//   refused   draws whose curve ended early, or is unresolved where it should not be
//
// Every tenth draw is repeated backwards, from another point, with other step limits, in rotated
// and mirrored unknowns and in other units (x and the metric scaled, F not); the events must be the
// same to 1e-8. "close": draws with gaps below 1e-3 or separations below 1e-4.
//
// A touch has multiplicity two and may stand for two folds or branch points closer than 1e-4 of the
// size.
// Places may be off by 1e-10 and by what rounding of dF/dq explains (from the eigenvalue's slope
// between the stored points around, and by its root at touches, where that is zero); among others
// closer than 1e-4, by a tenth of their separation.
//
// With --check the exit code is 1 if a requirement is not met; known gaps are printed as such, but
// do not count: exact places and counts within such clusters. With --named the draws of that file are
// followed too and judged apart: none may break a requirement. --failures keeps what fails as such a file.
#include <CLI/CLI.hpp>
#include <Eigen/SVD>
#include <atomic>
#include <cstdio>
#include <exception>
#include <optional>
#include <thread>

#include "families.hpp"
#include "named.hpp"
#include "report.hpp"

namespace springfold::known_answers {
namespace {

struct Settings {
  long count = 1000;
  unsigned long long seed = 1;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  long draw = -1;  ///< only this one
  std::string family{};
  double steps = 1;  ///< factor of the step limits
  bool verbose = false, check = false, wide = false;
  std::string named{}, failures{};
};

using Family = Draw (*)(Random&);
constexpr Family families[] = {fold_ladder, strands,        pitchfork,   two_mode,
                               n_pod_dome,  von_mises_sway, link_column, trammel,
                               one_sided,   crossing,       opposite};
constexpr std::size_t wide_only = 2;  // the last ones

struct Result {
  Verdict verdict{};
  std::optional<Invariance> invariance{};
};

/// dlambda/dz of a curve in one unknown z, as the derivatives at q tell it.
double slope_at(const Embedded& problem, const Vector& q, double lambda) {
  Matrix dF_dq;
  Vector dF_dlambda;
  problem.derivatives(q, lambda, {}, dF_dq, dF_dlambda);
  Matrix A(dF_dq.rows(), dF_dq.cols() + 1);
  A << dF_dq, dF_dlambda;
  const Vector tangent = Eigen::JacobiSVD<Matrix>(A, Eigen::ComputeFullV).matrixV().rightCols(1);
  return tangent.tail(1)[0] / problem.base_point(tangent.head(q.size()))[0];
}

/// What the rounding of dF/dq, a few units in the last place of its norm, means for dlambda/dz; and what it is seen to
/// make of it where it is zero, at the answers, since entries are sums of larger terms.
double slope_error(const Embedded& problem, const Draw& draw) {
  constexpr double step = 1e-6;
  const Vector q = problem.embed(draw.z_start);
  const double stretch =
      (problem.embed(draw.z_start + Vector::Constant(draw.z_start.size(), step)) - q).norm() / step;
  Matrix dF_dq;
  Vector dF_dlambda;
  problem.derivatives(q, draw.lambda_start, {}, dF_dq, dF_dlambda);
  double seen = 0;
  for (const Answer& answer : draw.answers)
    seen = std::max(seen, std::abs(slope_at(problem, problem.embed(answer.z), answer.lambda)));
  return 4 *
         std::max(seen, std::numeric_limits<double>::epsilon() * dF_dq.norm() * stretch * stretch);
}

std::optional<Result> run(const Settings& settings, long number) {
  Random random(settings.seed * 1000003ull + static_cast<unsigned long long>(number));
  const std::size_t count = std::size(families) - (settings.wide ? 0 : wide_only);
  Draw draw = families[static_cast<std::size_t>(number) % count](random);
  if (!settings.family.empty() && draw.family != settings.family) return std::nullopt;
  const int most = settings.wide ? 12 : 30;
  const Embedded problem(draw.base, 1 + choice(random, most), settings.wide, random);
  if (draw.blurs && draw.blurs(slope_error(problem, draw))) {
    draw.blurred = true;
    draw.family += ", blurred";
  }
  continuation::TraceOptions options;
  options.step.initial *= settings.steps;
  options.step.maximum *= settings.steps;
  options.step.minimum *= settings.steps;
  options.maximum_points =
      static_cast<int>(options.maximum_points * std::max(1.0, 1 / settings.steps));
  const Followed followed = follow(problem, draw, options);
  if (settings.draw == number) print(problem, draw, followed, settings.verbose);
  Result result{.verdict = judge(problem, draw, followed)};
  result.verdict.number = number;
  if (number % 10 == 0) {
    result.invariance = check_invariance(problem, draw, followed, random, settings.draw == number);
    result.invariance->number = number;
  }
  return result;
}

/// Draws are dealt to the threads as they come and collected in their order.
Campaign run_all(const Settings& settings) {
  const long first = settings.draw >= 0 ? settings.draw : 0;
  const long last = settings.draw >= 0 ? settings.draw + 1 : settings.count;
  std::vector<std::optional<Result>> results(static_cast<std::size_t>(std::max(0L, last - first)));
  std::atomic<long> next{first};
  const auto work = [&] {
    for (long i = next++; i < last; i = next++)
      results[static_cast<std::size_t>(i - first)] = run(settings, i);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 1; t < settings.threads; ++t) threads.emplace_back(work);
    work();
  }
  Campaign campaign;
  for (const auto& result : results) {
    if (!result) continue;
    campaign.verdicts.push_back(result->verdict);
    if (result->invariance) campaign.invariance.push_back(*result->invariance);
  }
  return campaign;
}

/// The draws that are kept, all of them judged as one campaign.
bool named_draws_hold(const Settings& settings) {
  Campaign campaign;
  bool same_problems = true;
  for (const NamedDraw& named : read_named(settings.named)) {
    Settings own = settings;
    own.seed = named.seed;
    own.wide = named.wide;
    own.family.clear();
    const auto result = run(own, named.number);
    if (result->verdict.family != named.family) {
      std::printf("%s: draw %ld of seed %llu is another problem now: %s\n", settings.named.c_str(),
                  named.number, named.seed, result->verdict.family.c_str());
      same_problems = false;
    }
    campaign.verdicts.push_back(result->verdict);
    if (result->invariance) campaign.invariance.push_back(*result->invariance);
  }
  std::printf("\nNamed draws: %zu\n\n", campaign.verdicts.size());
  return report(campaign).met && same_problems;
}

}  // namespace
}  // namespace springfold::known_answers

int main(int argc, char** argv) {
  using namespace springfold::known_answers;
  Settings settings;
  CLI::App app("Random problems with known special points: how many are found?");
  app.add_option("N", settings.count, "number of draws")->check(CLI::NonNegativeNumber);
  app.add_option("seed", settings.seed, "the same seed gives the same draws");
  app.add_option("--threads", settings.threads, "default: all there are")
      ->check(CLI::Range(1, 256));
  app.add_option("--draw", settings.draw, "only this draw, with all that was found");
  app.add_option("--family", settings.family, "only this family");
  app.add_option("--steps", settings.steps, "factor of the default step limits")
      ->check(CLI::PositiveNumber);
  app.add_flag("--wide", settings.wide, "stiffness ratios of 1e-2 to 1e2, and two families more");
  app.add_flag("--verbose", settings.verbose, "with --draw: the whole step log and all points");
  app.add_flag("--check", settings.check, "exit code 1 if a requirement is not met");
  app.add_option("--named", settings.named, "file of draws that are followed and judged too");
  app.add_option("--failures", settings.failures, "file for the draws that fail, if any does");
  CLI11_PARSE(app, argc, argv);
  try {
    const Outcomes outcomes = report(run_all(settings));
    if (!settings.failures.empty())
      write_failures(settings.failures, settings.seed, settings.wide, outcomes.failures);
    const bool named_hold = settings.named.empty() || named_draws_hold(settings);
    return settings.check && !(outcomes.met && named_hold) ? 1 : 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "known_answers: %s\n", e.what());
    return 2;
  }
}
