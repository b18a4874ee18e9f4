#include "start_trouble.hpp"

#include <algorithm>
#include <cmath>

#include "shape_units.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/statics/kinematics.hpp"
#include "springfold/statics/shapes.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::analysis {
namespace {

using statics::StartStatus;
using statics::StartUnknowns;

/// Systems with more unknowns are not looked into: their chains are long, and matrices of them large.
constexpr Index most_looked_into = 600;

bool of_body(const statics::System& system, Index body, Index i) {
  const statics::BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  return i >= b.t && i < b.t + b.count;
}

/// Entries of z that the start may move. @param holds_body  the study's body stays where it is
std::vector<Index> moving_of(const statics::System& system, const statics::StartProblem& problem,
                             bool holds_body) {
  std::vector<Index> moving;
  for (Index i = 0; i < system.size; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)] &&
        !(holds_body && of_body(system, problem.body, i)))
      moving.push_back(i);
  return moving;
}

std::vector<Index> commands_of(const statics::StartProblem& problem) {
  std::vector<Index> list;
  if (problem.unknowns == StartUnknowns::commands)
    for (Index i = 0; i < problem.inputs.rho.size(); ++i) list.push_back(i);
  return list;
}

std::string pose_text(const Setup& setup, const Vector& z, Index body) {
  const auto b = static_cast<std::size_t>(body - 1);
  const statics::BodySlice& slice = setup.system.body_slices[b];
  const Vector scale = pose_scales(setup.system.mechanism.bodies[b].task_space, setup.scales);
  std::string text;
  for (Index i = 0; i < slice.count; ++i)
    text += (i == 0 ? "[" : ", ") + rounded(scale[i] * z[slice.t + i]);
  return text + "]";
}

std::string gap_text(const Setup& setup, const statics::ChainGap& gap) {
  const std::string name = setup.system.mechanism.chains[gap.chain].name;
  const bool misses = gap.length > 1e-9;
  std::string text = "chain " + name;
  if (misses) text += " is short by " + rounded(setup.scales.length * gap.length);
  if (gap.angle > 1e-9)
    text += (misses ? " and turned by " : " is turned by ") + rounded(gap.angle) + " rad";
  return text;
}

std::string gaps_text(const Setup& setup, const std::vector<statics::ChainGap>& gaps) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, gaps.size()); ++i)
    text += (i == 0 ? "" : ", ") + gap_text(setup, gaps[i]);
  if (gaps.size() > most) text += " and " + std::to_string(gaps.size() - most) + " more";
  return text;
}

std::string pose_key(const Setup& setup, const Study& study) {
  if (study.start.pose.size() > 0) return "start.pose";
  return "body." + setup.system.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].name;
}

void explain_gap(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                 StartReport& report) {
  const statics::System& system = setup.system;
  const bool held = problem.unknowns != StartUnknowns::pose;
  const auto at = nearest_approach(system, moving_of(system, problem, held), commands_of(problem),
                                   problem.z, problem.inputs.rho);
  report.where = pose_key(setup, study);
  if (at.closed || at.gaps.empty()) {
    report.message = "the chains could not be closed from this guess";
    report.advice = "give the joints better initial coordinates (initial), or another pose";
    return;
  }
  const std::string gaps = gaps_text(setup, at.gaps);
  if (!held) {
    report.where = "chain." + system.mechanism.chains[at.gaps.front().chain].name;
    report.message = "the chains cannot be closed from this guess: " + gaps +
                     " where they come nearest to closing";
    report.advice = "look at lengths, attachments and axes of this chain, and at the guessed pose";
    return;
  }
  report.message =
      "the pose " + pose_text(setup, problem.z, problem.body) + " cannot be reached: " + gaps;
  const auto beside = nearest_approach(system, moving_of(system, problem, false),
                                       commands_of(problem), at.z, at.rho);
  report.advice =
      beside.closed
          ? "a pose near it that the chains reach is " + pose_text(setup, beside.z, problem.body)
          : "look at lengths, attachments and axes of this chain: no pose near it can "
            "be reached either";
}

/// The force or moment that misses most, and at which coordinate.
std::string rest_text(const Setup& setup, const statics::StartProblem& problem,
                      const statics::FirstEquilibrium& first) {
  statics::Workspace work;
  Vector r;
  const statics::System& system = setup.system;
  if (first.z.size() != system.size || !first.z.allFinite() ||
      !equilibrium_residual(system, piece_at(system, first.z), first.z, first.inputs, work, r))
    return {};
  Index worst = -1;
  for (Index i = 0; i < system.size; ++i) {
    const bool counts =
        !system.is_wrench[static_cast<std::size_t>(i)] &&
        !(problem.unknowns == StartUnknowns::wrench && of_body(system, problem.body, i));
    if (counts && (worst < 0 || std::abs(r[i]) > std::abs(r[worst]))) worst = i;
  }
  if (worst < 0) return {};
  const auto k = static_cast<std::size_t>(worst);
  const bool force = system.is_length[k];
  const double size = force ? setup.scales.force : setup.scales.moment();
  return std::string("a ") + (force ? "force" : "moment") + " of " +
         rounded(size * std::abs(r[worst])) + " is left at " + system.coordinate_names[k];
}

void explain_imbalance(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                       const statics::FirstEquilibrium& first, StartReport& report) {
  const statics::System& system = setup.system;
  report.where = pose_key(setup, study);
  report.message = "no equilibrium was found near this guess";
  if (const std::string rest = rest_text(setup, problem, first); !rest.empty())
    report.message += ": " + rest;
  report.advice = "try a guess nearer to the equilibrium you mean, or a smaller load";
  if (problem.unknowns != StartUnknowns::pose) return;
  const auto at = nearest_approach(system, moving_of(system, problem, false), {}, problem.z,
                                   problem.inputs.rho);
  if (!at.closed) return;
  statics::Inputs unloaded = problem.inputs;
  unloaded.W.setZero();
  unloaded.loads.setZero();
  const std::string free = free_motions(system, at.z, unloaded);
  if (free.empty()) return;
  report.message += "; no spring resists a motion of " + free;
  report.advice =
      "give a joint that moves there a spring, hold the body (start.solve = \"wrench\" with "
      "control = \"pose\" or \"mixed\"), or take away the load along it";
}

/// @param volume  or area, as its points are drawn, in `unit`
std::string gas_trouble(const model::Gas& gas, double volume, double unit) {
  if (volume * gas.initial < 0)
    return "its gas is drawn with " + rounded(unit * volume) + " and rests at " +
           rounded(unit * gas.initial) +
           ": the other sign, need its points in the other order, or the other sign of initial";
  return "its gas has no volume there, or a negative one";
}

/// A spring of a shape that has no force in the guess. @returns whether there is one
bool explain_shape(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                   StartReport& report) {
  for (std::size_t i = 0; i < setup.system.shapes.size(); ++i) {
    const statics::PointShape& shape = setup.system.shapes[i];
    const auto at = shape_state(setup.system, i, problem.z, problem.inputs);
    const bool vanishes = shape.shape.kind == model::ShapeKind::path && at.value == 0;
    if (std::isfinite(at.value) && std::isfinite(at.slope) && !vanishes) continue;
    report.where = pose_key(setup, study);
    report.message = "\"" + shape.name + "\" has no force in this guess: " +
                     (shape.gas ? gas_trouble(*shape.gas, at.value,
                                              unit_of_value(shape.shape.kind, setup.scales))
                                : "some of its points coincide there, or lie in line");
    report.advice = "start from another guess";
    return true;
  }
  return false;
}

}  // namespace

std::string free_motions(const statics::System& system, const Vector& z,
                         const statics::Inputs& inputs) {
  constexpr double none = 1e-10, visible = 0.3;
  constexpr Index most_names = 4, most_motions = 3;
  if (system.size > most_looked_into) return {};
  statics::Workspace work;
  Vector r;
  Matrix A;
  if (!equilibrium_matrix(system, piece_at(system, z), z, inputs, work, r, A)) return {};
  A = statics::without_gauge(A, work);
  std::vector<Index> moving, wrenches;
  for (Index i = 0; i < system.size; ++i)
    (system.is_wrench[static_cast<std::size_t>(i)] ? wrenches : moving).push_back(i);
  const Index n = static_cast<Index>(moving.size());
  const Matrix Z = kernel_of(A(moving, wrenches).transpose(), none);
  if (Z.cols() == 0) return {};
  const Matrix H = A(moving, moving), T = Z.transpose() * H * Z;
  const SymmetricEigen modes = symmetric_eigen(0.5 * (T + T.transpose()));
  const double largest = std::max(modes.values.cwiseAbs().maxCoeff(), 1e-300);
  std::string text;
  Index motions = 0;
  for (Index m = 0; m < modes.values.size(); ++m) {
    if (std::abs(modes.values[m]) > none * std::max(1.0, largest)) continue;
    if (++motions > most_motions) continue;
    const Vector v = Z * modes.vectors.col(m);
    std::vector<Index> order(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::abs(v[a]) > std::abs(v[b]) * (1 + 1e-9);
    });
    const double top = std::abs(v[order.front()]);
    std::string names;
    for (Index i = 0; i < std::min(most_names, n); ++i) {
      const Index k = order[static_cast<std::size_t>(i)];
      if (std::abs(v[k]) < visible * top) break;
      names +=
          (i == 0 ? "" : ", ") +
          system.coordinate_names[static_cast<std::size_t>(moving[static_cast<std::size_t>(k)])];
    }
    text += (text.empty() ? "" : "; of ") + names;
  }
  if (motions > most_motions) text += "; and " + std::to_string(motions - most_motions) + " more";
  return text;
}

void explain_origins(const Setup& setup, const Study& study, statics::StartProblem problem,
                     StartReport& report) {
  const std::string from_there =
      "springs with origin = \"start\" are counted from the start pose: ";
  if (problem.unknowns == StartUnknowns::pose) problem.unknowns = StartUnknowns::wrench;
  if (setup.system.size > most_looked_into) {
    report.where = pose_key(setup, study);
    report.message = "the chains cannot be closed there";
    report.advice = "check the poses, lengths and initial coordinates";
  } else {
    explain_gap(setup, study, problem, report);
  }
  report.message = from_there + report.message;
}

void explain_failure(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                     const statics::FirstEquilibrium& first, StartReport& report) {
  switch (first.status) {
    case StartStatus::found:
      return;
    case StartStatus::no_assembly:
    case StartStatus::no_equilibrium:
      break;
    case StartStatus::wrong_count:
      report.message = "as many actuated joints as pose coordinates are needed";
      report.where = "start.solve";
      return;
  }
  if (explain_shape(setup, study, problem, report)) return;
  if (setup.system.size > most_looked_into) {
    report.where = pose_key(setup, study);
    report.message =
        first.status == StartStatus::no_assembly
            ? "the chains cannot be closed from this guess"
            : "no equilibrium was found near this guess; the smallest residual is left";
    report.advice = "try a guess nearer to the equilibrium you mean, or a smaller load";
  } else if (first.status == StartStatus::no_assembly) {
    explain_gap(setup, study, problem, report);
  } else {
    explain_imbalance(setup, study, problem, first, report);
  }
}

}  // namespace springfold::analysis
