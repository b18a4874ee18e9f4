// Members of a family whose numbers lie on a line in the parameter, so that the equations do.
#include <algorithm>
#include <array>
#include <limits>
#include <span>

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

/// Numbers that the equations of a path on one piece are linear in, all that differ from member to member; commands are
/// the last ones. Nothing where they are not linear in all that may differ.
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

/// Are these on a line in equal steps, as far as rounding tells?
bool lie_on_line(std::span<const Vector> values) {
  const Vector& low = values.front();
  const Vector slope = (values.back() - low) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const Vector off = values[i] - low - static_cast<double>(i) * slope;
    const Vector size = low.cwiseAbs().cwiseMax(values.back().cwiseAbs()).cwiseMax(1.0);
    if (!(off.cwiseQuotient(size).lpNorm<Eigen::Infinity>() <= off_line)) return false;
  }
  return true;
}

bool is_of_grid(double mu) { return std::floor(mu / grid_step) * grid_step == mu; }

Vector between(const Vector& first, const Vector& last, double share) {
  return first + share * (last - first);
}

}  // namespace

CaseCurves::Line CaseCurves::line_through(double first, double step) const {
  constexpr std::size_t places = 4;
  std::array<Vector, places> values;
  Line line;
  bool one_start = true;
  Vector pose;  // the unknowns are measured from it
  for (std::size_t i = 0; i < places; ++i) {
    const Member* member = member_at(first + static_cast<double>(i) * step);
    if (member == nullptr) return {};
    const bool is_counted = member->report.found || member->pose_is_known;
    if (i == 0) {
      pose = member->setup.rule.t_start;
      line.first = member->first.inputs;
      line.counted = start_pose_of(member->setup.rule);
    }
    if (member->setup.rule.t_start != pose) return {};
    one_start = one_start && is_counted && start_pose_of(member->setup.rule) == line.counted;
    auto found = linear_numbers(member->setup, pattern_->places);
    if (!found) return {};
    values[i] = std::move(*found);
    line.last = member->first.inputs;
  }
  const Setup& one = pattern_->setup;
  if (!is_linear_in_commands(one.system)) {
    const Index commands = one.system.commands.size();
    for (const Vector& v : values)
      if (v.tail(commands) != values.front().tail(commands)) return {};
  }
  line.holds = lie_on_line(values);
  if (!one_start) line.counted.resize(0);
  return line;
}

double CaseCurves::first_on_line(double mu) { return (std::floor(mu / grid_step) - 1) * grid_step; }

/// Two of the four members are on each side of mu. Where the numbers that the equations are linear in lie on a line
/// there, the equations do too, at any state: two members tell the derivative.
std::optional<double> CaseCurves::line(double mu) const {
  constexpr std::size_t most = 4096;
  if (!pattern_) return std::nullopt;
  const double first = first_on_line(mu);
  if (!lines_.contains(first)) {
    if (lines_.size() >= most) lines_.clear();
    const Line& found =
        lines_.insert_or_assign(first, line_through(first, grid_step)).first->second;
    starts_lie_on_lines_ = found.holds && found.counted.size() > 0;
  }
  if (known_line(mu) == nullptr) return std::nullopt;
  const double last = first + 3 * grid_step;
  return mu - first > last - mu ? first : last;
}

/// The one that was asked for by line(), if it is one.
const CaseCurves::Line* CaseCurves::known_line(double mu) const {
  const auto known = lines_.find(first_on_line(mu));
  return known != lines_.end() && known->second.holds ? &known->second : nullptr;
}

/// Where starts have been on lines they are expected to go on so: four of them tell all that lie between.
void CaseCurves::look_for_line(double mu) const {
  if (starts_lie_on_lines_ && !is_of_grid(mu)) line(mu);
}

/// Commands and loads at starts are among the numbers on a line: between the members that tell it, whose starts are
/// looked for, none is needed.
std::optional<statics::Inputs> CaseCurves::inputs_on_line(const Member& member) const {
  const bool may_be = counts_from_one_origin(member.study) && !is_of_grid(member.mu);
  const Line* line = may_be ? known_line(member.mu) : nullptr;
  if (line == nullptr) return std::nullopt;
  const double share = (member.mu - first_on_line(member.mu)) / (3 * grid_step);
  return statics::Inputs{between(line->first.rho, line->last.rho, share),
                         between(line->first.W, line->last.W, share), line->first.loads};
}

}  // namespace springfold::analysis
