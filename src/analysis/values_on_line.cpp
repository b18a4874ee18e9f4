// Members of a family whose numbers lie on a line in the parameter, so that the equations do.
#include <algorithm>
#include <array>
#include <limits>

#include "case_curves.hpp"

namespace springfold::analysis {
namespace {

/// Numbers no farther off a line than by this share of them lie on it: starts are solved to a few roundings.
constexpr double off_line = 32 * std::numeric_limits<double>::epsilon();

/// A line on each segment, as constant and slope; nothing of laws that follow curves.
bool add_lines(const model::CompiledSpring& law, std::vector<double>& numbers) {
  for (std::size_t i = 0; i < law.segments.size(); ++i) {
    if (!law.is_straight(i)) return false;
    const model::CompiledSpring::Segment& s = law.segments[i];
    numbers.push_back(s.torque - s.stiffness * s.anchor);
    numbers.push_back(s.stiffness);
  }
  return true;
}

void add_all(const Vector& more, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), more.begin(), more.end());
}

/// Numbers that the equations of a path on one piece are linear in, all that differ from member to member; commands are the
/// last ones. Nothing where they are not linear in all that may differ.
std::optional<Vector> linear_numbers(const Setup& setup, const statics::MovedPlaces& places) {
  const statics::System& system = setup.system;
  std::vector<double> numbers;
  for (const std::size_t i : places.springs)
    if (!add_lines(system.springs[i].law, numbers)) return std::nullopt;
  for (const std::size_t i : places.parts.shape_laws)
    if (system.shapes[i].gas || !add_lines(system.shapes[i].law, numbers)) return std::nullopt;
  for (const std::size_t i : places.groups) {
    const statics::CoordinateGroup& group = system.coupled[i];
    for (const auto& column : group.stiffness.colwise()) add_all(column, numbers);
    add_all(group.stiffness * group.free, numbers);
  }
  for (const std::size_t i : places.parts.lines) {
    const statics::PointSpring& line = system.line_springs[i];
    numbers.push_back(line.stiffness);
    numbers.push_back(line.stiffness * line.free);
  }
  for (const std::size_t i : places.parts.loads) add_all(system.mechanism.loads[i].vector, numbers);
  add_all(setup.rule.W_start, numbers);
  add_all(setup.rule.rho_start, numbers);
  return Eigen::Map<const Vector>(numbers.data(), std::ssize(numbers));
}

/// Positions are linear in the commands of slides, forces of springs between points are not; nor are terms of redundant
/// closures.
bool is_linear_in_commands(const statics::System& system) {
  if (!system.line_springs.empty() || !system.shapes.empty() || system.redundant > 0) return false;
  return std::all_of(system.command_is_length.begin(), system.command_is_length.end(),
                     [](bool length) { return length; });
}

}  // namespace

/// Four members in equal steps.
bool CaseCurves::is_line(double first, double step) const {
  constexpr std::size_t places = 4;
  std::array<Vector, places> values;
  Vector pose;  // the unknowns are measured from it
  for (std::size_t i = 0; i < places; ++i) {
    const Member* member = member_at(first + static_cast<double>(i) * step);
    if (member == nullptr) return false;
    if (i == 0) pose = member->setup.rule.t_start;
    if (member->setup.rule.t_start != pose) return false;
    auto found = linear_numbers(member->setup, pattern_->places);
    if (!found) return false;
    values[i] = std::move(*found);
  }
  const Setup& one = pattern_->setup;
  if (!is_linear_in_commands(one.system)) {
    const Index commands = one.system.commands.size();
    for (const Vector& v : values)
      if (v.tail(commands) != values.front().tail(commands)) return false;
  }
  const Vector& low = values.front();
  const Vector slope = (values.back() - low) / (places - 1.0);
  for (std::size_t i = 1; i + 1 < places; ++i) {
    const Vector off = values[i] - low - static_cast<double>(i) * slope;
    const Vector size = low.cwiseAbs().cwiseMax(values.back().cwiseAbs()).cwiseMax(1.0);
    if (!(off.cwiseQuotient(size).lpNorm<Eigen::Infinity>() <= off_line)) return false;
  }
  return true;
}

}  // namespace springfold::analysis
