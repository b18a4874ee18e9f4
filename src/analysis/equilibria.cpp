#include "equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/undefined.hpp"
#include "branch_rows.hpp"
#include "degenerate_state.hpp"
#include "equilibrium_families.hpp"
#include "equilibrium_search.hpp"
#include "frozen.hpp"
#include "limits.hpp"
#include "locked_chains.hpp"
#include "morse.hpp"
#include "springfold/analysis/equilibrium_notes.hpp"
#include "springfold/model/rotation_vector.hpp"
#include "start.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// Spring energy less the work of the dead load, dimensionless; NaN where it is not defined.
double potential_of(const PathProblem& problem, const Vector& z) {
  const statics::System& system = problem.system(0);
  if (!problem.symmetric()) return std::numeric_limits<double>::quiet_NaN();
  const statics::Inputs inputs = problem.inputs(0);
  return spring_energy(system, z, inputs.rho) + load_potential(system, z, inputs);
}

/// Lowest potential first; rounding does not decide.
void sort(std::vector<FoundEquilibrium>& found, const PathProblem& problem) {
  const auto key = [&problem](const FoundEquilibrium& f) {
    const double v = potential_of(problem, f.z);
    return std::round((std::isnan(v) ? spring_energy(problem.system(0), f.z) : v) * 1e9);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const FoundEquilibrium& a, const FoundEquilibrium& b) {
                     const double va = key(a), vb = key(b);
                     if (va != vb) return va < vb;
                     for (Index i = problem.system(0).first_pose; i < a.z.size(); ++i) {
                       const double p = std::round(a.z[i] * 1e7), q = std::round(b.z[i] * 1e7);
                       if (p != q) return p < q;
                     }
                     return false;
                   });
}

CurvePoint point_at(const PathProblem& problem, const FoundEquilibrium& found) {
  CurvePoint point;
  point.x = found.z;
  point.piece = found.piece;
  count_negative(problem, point);
  return point;
}

CountedEquilibrium counted(const PathProblem& problem, const FoundEquilibrium& found,
                           bool is_locked) {
  const CurvePoint point = point_at(problem, found);
  CountedEquilibrium result{found.z, std::nullopt, is_locked};
  if (point.negative && !is_degenerate(problem, point))
    result.index = *point.negative - problem.closures();
  return result;
}

/// Where the count is one of rounding none is told.
void take_back_counts(const std::vector<QuantityDefinition>& quantities, Equilibrium& state) {
  using Kind = QuantityDefinition::Kind;
  for (std::size_t q = 0; q < quantities.size(); ++q)
    if (quantities[q].kind == Kind::index || quantities[q].kind == Kind::index_force)
      state.sample.values[q] = undefined;
  state.note += (state.note.empty() ? "" : "; ") + std::string(degenerate_note);
}

/// Singular equilibria that fill lines: of each line one stays, with a note.
struct LinesOfEquilibria {
  std::vector<bool> is_left_out{};
  std::vector<std::string> notes{};  ///< empty: no family
};

LinesOfEquilibria lines_among(const PathProblem& problem, const Evaluator& evaluator,
                              const std::vector<FoundEquilibrium>& found, const Vector* start,
                              const std::function<bool()>& goes_on) {
  LinesOfEquilibria lines{std::vector<bool>(found.size(), false),
                          std::vector<std::string>(found.size())};
  std::vector<std::size_t> singular;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!is_index_untold(evaluator, point_at(problem, found[i]))) continue;
    const bool is_start =
        start != nullptr && same_equilibrium(problem.system(0), found[i].z, *start);
    singular.insert(is_start ? singular.begin() : singular.end(), i);
  }
  for (const EquilibriumFamily& family : equilibrium_families(problem, found, singular, goes_on)) {
    for (const std::size_t i : family.others) lines.is_left_out[i] = true;
    const std::size_t met = family.others.size() + 1;
    lines.notes[family.shown] =
        std::string(family_note) + " that fill a line through it" +
        (met > 1 ? ", " + std::to_string(met) + " of which the search met" : "") +
        "; its stability is not told";
  }
  return lines;
}

/// The same state with rotation vectors of at most half a turn.
FoundEquilibrium with_short_rotations(const statics::System& system, FoundEquilibrium found) {
  for (std::size_t i = 0; i < system.body_slices.size(); ++i) {
    if (system.mechanism.bodies[i].task_space != model::TaskSpace::spatial) continue;
    auto v = found.z.segment(system.body_slices[i].t + 3, 3);
    const double angle = v.norm();
    if (angle > std::numbers::pi) v *= std::remainder(angle, 2 * std::numbers::pi) / angle;
  }
  return found;
}

struct SearchContext {
  const PathProblem& problem;
  const Evaluator& evaluator;
  const std::vector<QuantityDefinition>& quantities;
  EquilibriumStart start{};
  InRange in_range{};
  const Observer& observer;
};

/// What one search found, each equilibrium once, and what the count says of it.
struct Candidates {
  EquilibriumSearch search{};
  std::vector<Index> full{};  ///< rank of every chain's closure
  std::vector<FoundEquilibrium> distinct{};
  MorseCount morse{};

  bool misses_some() const { return morse.applies && morse.found != morse.expected; }
};

Candidates candidates(const SearchContext& context, const Study& study) {
  const PathProblem& problem = context.problem;
  Candidates all;
  all.search = search_equilibria(problem, study, context.quantities, context.start,
                                 context.in_range, context.observer);
  // A spring of no length pulls nowhere, and an angle that jumps has no moment.
  std::erase_if(all.search.found, [&](const FoundEquilibrium& f) {
    const statics::Inputs inputs = problem.inputs(0);
    return without_direction(problem.system(0), f.z, inputs).has_value() ||
           stands_at_jump(problem.system(0), f.z, inputs);
  });
  all.full = full_ranks(context.evaluator, all.search.found);
  std::vector<CountedEquilibrium> raw, once;
  for (const FoundEquilibrium& f : all.search.found) {
    raw.push_back(
        counted(problem, f, !locked_chains(problem, context.evaluator, f, all.full).empty()));
    const bool is_known =
        std::any_of(all.distinct.begin(), all.distinct.end(), [&](const FoundEquilibrium& other) {
          return same_equilibrium(problem.system(0), f.z, other.z);
        });
    if (is_known) continue;
    all.distinct.push_back(with_short_rotations(problem.system(0), f));
    once.push_back(raw.back());
  }
  if (all.search.interrupted)
    all.morse.why = "the search was interrupted";
  else
    all.morse = morse_count(problem, raw, once);
  return all;
}

}  // namespace

void find_equilibria(const Setup& setup, const Study& study, const statics::FirstEquilibrium& first,
                     const Observer& observer, StudyResult& result) {
  PathRule rule = setup.rule;
  rule.quaternions = false;  // states are drawn and compared as the statics has them
  const PathProblem problem(setup.system, rule);
  const Evaluator evaluator(problem, study, setup.scales);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  const Vector from = result.start.found ? first.z : start_guess(setup, study);
  const auto in_range = [&](const Vector& z) {
    CurvePoint point;
    point.x = z;
    point.piece = statics::piece_at(problem.system(0), z);
    return !limit_passed(study, evaluator, quantities, point);
  };
  const SearchContext context{
      problem, evaluator, quantities, {from, first.piece, result.start.found}, in_range, observer};
  Candidates all = candidates(context, study);
  // Where the count proves that some are missing, more starts may find them.
  Study wider = study;
  constexpr int rounds = 2, more = 4;
  for (int i = 0; i < rounds && all.misses_some() && !all.search.limit_reached; ++i) {
    wider.search.starts *= more;
    all = candidates(context, wider);
  }
  EquilibriaReport report;
  report.starts = all.search.starts;
  report.limit_reached = all.search.limit_reached;
  report.morse = all.morse;
  const std::vector<Index>& full = all.full;
  std::vector<FoundEquilibrium>& distinct = all.distinct;
  sort(distinct, problem);
  bool is_wanted = !all.search.interrupted;
  const auto goes_on = [&] {
    is_wanted = is_wanted && (!observer || observer(report.starts, 0));
    return is_wanted;
  };
  const LinesOfEquilibria lines =
      lines_among(problem, evaluator, distinct, result.start.found ? &first.z : nullptr, goes_on);
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    const FoundEquilibrium& f = distinct[i];
    const CurvePoint point = point_at(problem, f);
    if (lines.is_left_out[i]) continue;
    if (limit_passed(study, evaluator, quantities, point)) {
      ++report.out_of_range;
      continue;
    }
    Equilibrium equilibrium{.label = "EQ" + std::to_string(report.list.size() + 1)};
    const Branch alone = single_point(point, evaluator, quantities, problem);
    equilibrium.sample = alone.samples.front();
    if (!alone.resting.empty()) equilibrium.resting = alone.resting.front();
    equilibrium.potential = setup.scales.moment() * potential_of(problem, f.z);
    equilibrium.stiffness = evaluator.platform_stiffness(point);
    equilibrium.note = f.note;
    if (is_index_untold(evaluator, point)) take_back_counts(quantities, equilibrium);
    if (!lines.notes[i].empty()) equilibrium.note = lines.notes[i];
    equilibrium.is_start = result.start.found && same_equilibrium(problem.system(0), f.z, first.z);
    if (const std::string locked = locked_chains(problem, evaluator, f, full); !locked.empty()) {
      ++report.locked;
      if (equilibrium.is_start)
        result.start.method +=
            ", where the joints of " + locked + " are locked (they lose rank): it is not listed";
      continue;
    }
    report.list.push_back(std::move(equilibrium));
  }
  if (!result.start.found && !report.list.empty()) {
    result.start.found = true;
    result.start.method =
        "none near the guess (" + result.start.message + "); the search found some";
    result.start.message.clear();
  }
  if (all.search.interrupted)
    result.doubts.push_back("interrupted: the search ended after " +
                            std::to_string(all.search.starts) + " starts");
  else if (!is_wanted)
    result.doubts.push_back("interrupted: some of the equilibria may lie on one line");
  if (report.morse.applies && report.morse.found != report.morse.expected)
    result.doubts.push_back("the search missed equilibria: the sum of (-1)^index is " +
                            std::to_string(report.morse.found) + ", it must be " +
                            std::to_string(report.morse.expected));
  result.equilibria = std::move(report);
}

}  // namespace springfold::analysis
