#include "equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "branch_rows.hpp"
#include "equilibrium_search.hpp"
#include "limits.hpp"
#include "morse.hpp"
#include "springfold/model/rotation_vector.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// Poses with rotation vectors as rotation matrices, so that turns do not count.
bool same_poses(const statics::System& system, const Vector& a, const Vector& b, double near) {
  for (std::size_t i = 0; i < system.body_slices.size(); ++i) {
    const auto& slice = system.body_slices[i];
    const model::TaskSpace space = system.mechanism.bodies[i].task_space;
    const Index lengths = translations(space);
    const Vector p = a.segment(slice.t, slice.count), q = b.segment(slice.t, slice.count);
    if ((p - q).head(lengths).lpNorm<Eigen::Infinity>() > near) return false;
    if (space == model::TaskSpace::planar &&
        std::abs(std::remainder(p[2] - q[2], 2 * std::numbers::pi)) > near)
      return false;
    if (space == model::TaskSpace::spatial) {
      const model::Vec3<double> u = p.tail(3), v = q.tail(3);
      if ((model::exp_rotation(u) - model::exp_rotation(v)).cwiseAbs().maxCoeff() > near)
        return false;
    }
  }
  return true;
}

/// The same bodies, spring deflections and forces: other coordinates of joints without springs,
/// like those of a universal joint turned over, make no other equilibrium.
bool same_equilibrium(const statics::System& system, const Vector& a, const Vector& b) {
  constexpr double near = 1e-7;
  for (const statics::CoordinateSpring& spring : system.springs)
    if (std::abs(a[spring.coordinate] - b[spring.coordinate]) > near) return false;
  for (const statics::CoordinateGroup& group : system.coupled)
    for (const Index i : group.coordinates)
      if (std::abs(a[i] - b[i]) > near) return false;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)] &&
        std::abs(a[i] - b[i]) > near * std::max(1.0, std::abs(a[i])))
      return false;
  return same_poses(system, a, b, near);
}

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

/// The rank that the closure of every chain has anywhere.
std::vector<Index> full_ranks(const PathProblem& problem, const Evaluator& evaluator,
                              const std::vector<FoundEquilibrium>& found) {
  std::vector<Index> full;
  for (const FoundEquilibrium& f : found) {
    const auto ranks = evaluator.closure_ranks(point_at(problem, f));
    full.resize(std::max(full.size(), ranks.size()), 0);
    for (std::size_t i = 0; i < ranks.size(); ++i) full[i] = std::max(full[i], ranks[i]);
  }
  return full;
}

/// Chains whose joints cannot move their end in all directions in which they can elsewhere: a bar
/// along the first axis of its universal joint, a bar of no length.
std::string locked_chains(const PathProblem& problem, const Evaluator& evaluator,
                          const FoundEquilibrium& found, const std::vector<Index>& full) {
  const auto ranks = evaluator.closure_ranks(point_at(problem, found));
  std::string names;
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (ranks[i] < full[i])
      names += (names.empty() ? "" : ", ") + problem.system(0).mechanism.chains[i].name;
  return names;
}

CountedEquilibrium counted(const PathProblem& problem, const FoundEquilibrium& found,
                           bool is_locked) {
  const CurvePoint point = point_at(problem, found);
  CountedEquilibrium result{found.z, std::nullopt, is_locked};
  if (point.negative) result.index = *point.negative - problem.closures();
  return result;
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

}  // namespace

void find_equilibria(const Setup& setup, const Study& study, const statics::FirstEquilibrium& first,
                     StudyResult& result) {
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
  const EquilibriumSearch search = search_equilibria(
      problem, study, quantities, {from, first.piece, result.start.found}, in_range);

  EquilibriaReport report;
  report.starts = search.starts;
  report.limit_reached = search.limit_reached;
  const std::vector<Index> full = full_ranks(problem, evaluator, search.found);
  std::vector<FoundEquilibrium> distinct;
  std::vector<CountedEquilibrium> raw, once;
  for (const FoundEquilibrium& f : search.found) {
    raw.push_back(counted(problem, f, !locked_chains(problem, evaluator, f, full).empty()));
    const bool is_known =
        std::any_of(distinct.begin(), distinct.end(), [&](const FoundEquilibrium& other) {
          return same_equilibrium(problem.system(0), f.z, other.z);
        });
    if (is_known) continue;
    distinct.push_back(with_short_rotations(problem.system(0), f));
    once.push_back(raw.back());
  }
  report.morse = morse_count(problem, raw, once);
  sort(distinct, problem);
  for (const FoundEquilibrium& f : distinct) {
    const CurvePoint point = point_at(problem, f);
    if (limit_passed(study, evaluator, quantities, point)) {
      ++report.out_of_range;
      continue;
    }
    Equilibrium equilibrium{.label = "EQ" + std::to_string(report.list.size() + 1)};
    equilibrium.sample = single_point(point, evaluator, quantities, problem).samples.front();
    equilibrium.potential = setup.scales.moment() * potential_of(problem, f.z);
    equilibrium.stiffness = evaluator.platform_stiffness(point);
    equilibrium.note = f.note;
    equilibrium.is_start = result.start.found && same_equilibrium(problem.system(0), f.z, first.z);
    if (const std::string locked = locked_chains(problem, evaluator, f, full); !locked.empty()) {
      if (!equilibrium.is_start) {
        ++report.locked;
        continue;
      }
      equilibrium.note += (f.note.empty() ? "" : "; ") +
                          ("the joints of " + locked + " are locked here: they lose rank");
    }
    report.list.push_back(std::move(equilibrium));
  }
  if (!result.start.found && !report.list.empty()) {
    result.start.found = true;
    result.start.method =
        "none near the guess (" + result.start.message + "); the search found some";
    result.start.message.clear();
  }
  if (report.morse.applies && report.morse.found != report.morse.expected)
    result.doubts.push_back("the search missed equilibria: the sum of (-1)^index is " +
                            std::to_string(report.morse.found) + ", it must be " +
                            std::to_string(report.morse.expected));
  result.equilibria = std::move(report);
}

}  // namespace springfold::analysis
