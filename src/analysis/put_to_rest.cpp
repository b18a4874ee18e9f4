#include "put_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "shape_units.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/core/scaling.hpp"
#include "springfold/statics/shapes.hpp"
#include "start.hpp"
#include "units.hpp"

namespace springfold::analysis {
namespace {

/// A breakpoint that is to be moved, dimensionless.
struct Shift {
  double from = 0, by = 0;
};

/// Per spring of joints and of shapes, in the order of the system; by 0: none.
struct Shifts {
  std::vector<Shift> joints{}, shapes{};
  double largest = 0;
};

/// A threshold is exactly where the coordinate is, but for the rounding of both.
bool is_upon(double g, double breakpoint) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  return std::abs(g) <= rounding * std::max(1.0, std::abs(breakpoint));
}

/// What is pressed by a force that counts stands apart from its threshold, however near that is beside a stiff stop. In
/// the softer segment a threshold that moves changes no force here.
bool may_be_moved(const model::CompiledSpring& law, double breakpoint, double g) {
  const auto nearest = std::ranges::min_element(
      law.breakpoints, {}, [breakpoint](double place) { return std::abs(place - breakpoint); });
  const auto i = static_cast<std::size_t>(nearest - law.breakpoints.begin());
  const double below = std::abs(law.stiffness(i, breakpoint)),
               above = std::abs(law.stiffness(i + 1, breakpoint));
  const bool is_softer_side = g < 0 ? below <= above : above <= below;
  constexpr double counts = continuation::TraceOptions{}.simultaneous;
  return is_softer_side || std::abs((above - below) * g) <= counts;
}

Shifts shifts_of(const statics::System& system, const statics::FirstEquilibrium& first) {
  Shifts shifts{std::vector<Shift>(system.springs.size()), std::vector<Shift>(system.shapes.size()),
                0};
  const double near = continuation::TraceOptions{}.simultaneous;
  for (std::size_t j = 0; j < system.switches.size(); ++j) {
    const statics::Switch& at = system.switches[j];
    const double g = switch_value(system, j, first.z, first.inputs.rho);
    if (!(std::abs(g) <= near) || is_upon(g, at.breakpoint)) continue;
    const model::CompiledSpring& law =
        at.of_shape() ? system.shapes[at.spring].law : system.springs[at.spring].law;
    if (!may_be_moved(law, at.breakpoint, g)) continue;
    Shift& shift = (at.of_shape() ? shifts.shapes : shifts.joints)[at.spring];
    if (shift.by == 0 || std::abs(g) < std::abs(shift.by)) shift = {at.breakpoint, g};
    shifts.largest = std::max(shifts.largest, std::abs(g));
  }
  return shifts;
}

void move(const Shift& shift, double unit, model::SpringLaw& law) {
  if (shift.by == 0) return;
  const double from = shift.from * unit;
  law = model::with_breakpoint(law, from, from + shift.by * unit);
}

void move_springs(const Shifts& shifts, const Scales& scales, model::Mechanism& mechanism) {
  std::size_t spring = 0;
  for (model::Chain& chain : mechanism.chains)
    for (model::Element& element : chain.elements) {
      auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr || !joint->spring || !has_coordinate(*joint)) continue;
      const double unit = joint->kind == model::JointKind::prismatic ? scales.length : 1;
      move(shifts.joints[spring++], unit, *joint->spring);
    }
  for (std::size_t i = 0; i < mechanism.shape_springs.size(); ++i) {
    model::ShapeSpring& own = mechanism.shape_springs[i];
    const double unit = unit_of_value(own.shape.kind, scales);
    for (model::SeriesSpring& inner : own.before) move(shifts.joints[spring++], unit, inner.law);
    move(shifts.shapes[i], unit, own.law);
  }
}

/// The first unit of force is the middle one of the springs'. Where it is stiff, what a soft spring leaves may count as
/// nothing, and a start that it decides may not be found: then it is looked for in the unit of the softest one.
void solve_in_softest_units(const Study& study, const ParameterFamily* family, Begin& begin,
                            StartReport& report) {
  const double before = begin.setup.scales.force;
  const double softest =
      power_of_two_near(range_of_springs(begin.mechanism, begin.setup.scales.length).softest);
  if (!(softest < before) || !(softest > 0)) return;
  Begin soft{begin.mechanism, set_up(begin.mechanism, study, family, Units{softest, {}}),
             begin.first};
  const auto solves = [&] {
    return solves_by_rows(soft.setup.system, start_problem(soft.setup, study), soft.first);
  };
  change_force_unit(soft.setup.system, softest / before, soft.first);
  if (report.found && solves()) return;
  if (report.found &&
      correct_by_rows(soft.setup.system, start_problem(soft.setup, study), soft.first)) {
    begin = std::move(soft);
    return;
  }
  StartReport again;
  soft.first = find_start(soft.setup, study, again);
  if (!again.found || !solves()) return;
  begin = std::move(soft);
  report = std::move(again);
}

}  // namespace

Begin begin_study(const model::Mechanism& mechanism, const Study& study,
                  const ParameterFamily* family, StartReport& report) {
  // Springs that no longer pull let the equilibrium move by as little again, and less each time.
  constexpr int rounds = 3;
  Begin begin{mechanism, set_up(mechanism, study, family), {}};
  begin.first = find_start(begin.setup, study, report);
  solve_in_softest_units(study, family, begin, report);
  if (family != nullptr || study.kind != StudyKind::force_deflection) return begin;
  for (int round = 0; round < rounds && report.found; ++round) {
    const Shifts shifts = shifts_of(begin.setup.system, begin.first);
    if (shifts.largest == 0) break;
    Begin moved{begin.mechanism, {}, {}};
    move_springs(shifts, begin.setup.scales, moved.mechanism);
    moved.setup = set_up(moved.mechanism, study, family);
    StartReport again;
    moved.first = find_start(moved.setup, study, again);
    constexpr double clearly_less = 0.9;  // what is pressed against a stop stays as near
    if (!again.found ||
        !(shifts_of(moved.setup.system, moved.first).largest <= clearly_less * shifts.largest))
      break;
    begin = std::move(moved);
    report = std::move(again);
  }
  return begin;
}

}  // namespace springfold::analysis
