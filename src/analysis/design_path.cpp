#include "design_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/undefined.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {
namespace {

/// A mark this near to the value at the start is the start, in units of the column.
constexpr double at_start_itself = 1e-12;
/// Part of a limit by which it is moved away from a mark that lies on it: both are then met.
constexpr double beyond_mark = 1e-3;

/// Marks on a limit of the study would end the path before they are located.
void make_room(Study& study) {
  for (Limit& limit : study.until)
    for (const Mark& mark : study.marks) {
      if (mark.quantity != limit.quantity) continue;
      const double width = limit.high - limit.low;
      const double room = beyond_mark * (std::isfinite(width) ? width : std::abs(mark.value) + 1);
      if (std::abs(mark.value - limit.high) <= room) limit.high = mark.value + room;
      if (std::abs(mark.value - limit.low) <= room) limit.low = mark.value - room;
    }
}

/// The family of the design's neighbours: other parameters are those of the design.
std::shared_ptr<const CaseFamily> neighbours(const DesignCase& of, const Vector& values,
                                             const Vector& pose) {
  const std::shared_ptr<const CaseFamily>& all = of.study.critical.cases;
  auto family = std::make_shared<CaseFamily>();
  family->names = all->names;
  family->values = all->values;
  for (std::size_t i = 0; i < of.numbers.size(); ++i)
    family->values[of.numbers[i]] = values[static_cast<Index>(i)];
  family->at = [all, numbers = of.numbers, values, pose, marks = of.study.marks](
                   const std::vector<std::pair<std::size_t, double>>& changes) {
    std::vector<std::pair<std::size_t, double>> together;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      together.emplace_back(numbers[i], values[static_cast<Index>(i)]);
    for (const auto& [number, value] : changes) {
      const auto same = std::find_if(together.begin(), together.end(),
                                     [n = number](const auto& one) { return one.first == n; });
      if (same != together.end())
        same->second = value;
      else
        together.emplace_back(number, value);
    }
    Variant variant = all->at(together);
    variant.study.marks = marks;
    if (pose.size() > 0) variant.study.start.pose = pose;
    make_room(variant.study);
    return variant;
  };
  return family;
}

/// The family of the cases between the case itself, at 0, and a design, at 1.
std::shared_ptr<const CaseFamily> way_to(const DesignCase& of, const Vector& values) {
  const std::shared_ptr<const CaseFamily>& all = of.study.critical.cases;
  auto family = std::make_shared<CaseFamily>();
  family->names = {"way"};
  family->values = {0};
  family->at = [all, numbers = of.numbers,
                values](const std::vector<std::pair<std::size_t, double>>& changes) {
    const double part = changes.empty() ? 0 : changes.front().second;
    std::vector<std::pair<std::size_t, double>> together;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double from = all->values[numbers[i]], to = values[static_cast<Index>(i)];
      together.emplace_back(numbers[i], part == 1 ? to : from + part * (to - from));
    }
    return all->at(together);
  };
  return family;
}

/// Do both begin in one state? In the units of the case: their own may differ.
bool begin_alike(const Member& a, const Member& b) {
  for (std::size_t i = 0; i < a.quantities().size(); ++i) {
    const QuantityDefinition &one = a.quantities()[i], &other = b.quantities()[i];
    if (one.kind != QuantityDefinition::Kind::unknown) continue;
    const double here = a.evaluator().value(one, a.start()),
                 there = b.evaluator().value(other, b.start());
    const double size = std::max({one.scale, std::abs(here), std::abs(there)});
    if (std::abs(here - there) > continuation::told_apart * size) return false;
  }
  return true;
}

}  // namespace

std::optional<double> jump_of_start(const DesignCase& of, const Vector& values, const Member& at) {
  constexpr int halvings = 30;
  constexpr double just_beyond = 1e-6;  // an answer lies on the limit that decides it
  // A start that vanishes moves like the root of what is left of the way; where it goes on it moves like that itself.
  constexpr double far = 100;
  Study study = of.study;
  if (of.study.critical.cases->at({}).is_in_state) return std::nullopt;
  study.critical.cases = way_to(of, values);
  study.critical.parameter = "way";
  study.critical.low = 0;
  study.critical.high = 1;
  const CaseCurves way(study, 0);
  if (!way.has_base() || !way.base().report.found) return std::nullopt;
  const auto start = [&](double part) -> std::optional<Vector> {
    const Member* const member = way.at(part / way.scale());
    if (member == nullptr) return std::nullopt;
    return member->start_pose();
  };
  const auto is_followed = [&](double part) {
    const Member* const member = way.at(part / way.scale());
    return member != nullptr && member->sheet == way.base().sheet;
  };
  // The start that is followed there need not be the one with which the design begins.
  if (is_followed(1) && !begin_alike(*way.at(1 / way.scale()), at)) return 1;
  double low = 0, high = 1 + just_beyond;
  if (is_followed(high)) return std::nullopt;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (is_followed(middle) ? low : high) = middle;
  }
  const double width = high - low;
  const auto last = start(low), before = start(low - width), behind = start(high);
  if (!last || !before || !behind) return std::nullopt;
  const double jump = (*behind - *last).norm();
  const bool jumps = jump > far * (*last - *before).norm() && jump > continuation::promised_place;
  return jumps ? std::optional(std::min(high, 1.0)) : std::nullopt;
}

DesignPath::DesignPath(const DesignCase& of, const Vector& values, const Vector& pose)
    : of_{of}, study_{of.study} {
  study_.critical.cases = neighbours(of, values, pose);
  begin(1);
}

void DesignPath::begin(double lambda_unit) {
  families_.clear();
  for (std::size_t i = 0; i < of_.numbers.size(); ++i) {
    // The family's unit of the parameter is that on which the case varies with it.
    study_.critical.parameter = study_.critical.cases->names[of_.numbers[i]];
    study_.critical.low = 0;
    study_.critical.high = of_.sizes[i];
    families_.push_back(std::make_unique<CaseCurves>(study_, of_.numbers[i], lambda_unit));
    if (!families_.back()->base().report.found) break;
  }
}

/// Where designs lie on a limit, the start of the path is beside a limit point, and its response no measure.
void DesignPath::trace(const Observer& observer) {
  double unit = 1;
  for (;;) {
    path_ = base_path(base(), observer, {.largest_unit = growth_of_lambda_unit(base(), unit)});
    if (!(path_.lambda_unit > 1)) return;
    unit *= path_.lambda_unit;
    begin(unit);
    if (!has_start()) return;
  }
}

std::string doubt_of(const BasePath& path) {
  if (!path.problem.empty()) return path.problem;
  return path.branch.forward.complete ? "" : path.branch.forward.reason;
}

std::size_t DesignPath::column(const std::string& name) const {
  return static_cast<std::size_t>(base().quantity(name) - base().quantities().data());
}

Measure DesignPath::with_rates(
    double value, const std::function<std::optional<Vector>(const CaseCurves&)>& of) const {
  Measure measure{value, Vector(static_cast<Index>(families_.size()))};
  for (std::size_t i = 0; i < families_.size(); ++i) {
    const auto rate = of(*families_[i]);
    measure.rates[static_cast<Index>(i)] = rate ? (*rate)[0] : undefined;
  }
  return measure;
}

std::optional<Measure> DesignPath::at_start(const std::string& name) const {
  const StateValues values = column_values({column(name)});
  const auto value = values(base(), base().start());
  if (!value || std::isnan((*value)[0])) return std::nullopt;
  return with_rates((*value)[0],
                    [&](const CaseCurves& curves) { return rates_at_start(curves, values); });
}

std::optional<Measure> DesignPath::at_point(const SpecialPoint& point,
                                            const std::string& name) const {
  const StateValues values = column_values({column(name)});
  const auto value = values(base(), point.hit.point);
  if (!value || std::isnan((*value)[0])) return std::nullopt;
  return with_rates((*value)[0], [&](const CaseCurves& curves) {
    return rates_at_special(curves, curves.base(), point, values);
  });
}

std::optional<Measure> DesignPath::at_value(const std::string& name, const std::string& along,
                                            double value) const {
  const QuantityDefinition& quantity = base().quantities()[column(along)];
  const double at_start = base().evaluator().value(quantity, base().start());
  if (std::abs(at_start - value) <= at_start_itself * std::max(quantity.scale, std::abs(value)))
    return this->at_start(name);
  for (const SpecialPoint& point : path_.points) {
    if (point.kind != EventKind::user_value || point.hit.name != along) continue;
    const double there = base().evaluator().value(quantity, point.hit.point);
    constexpr double same = 1e-8;  // marks are located far better, and lie farther apart
    if (std::abs(there - value) <= same * std::max(quantity.scale, std::abs(value)))
      return at_point(point, name);
  }
  return std::nullopt;
}

std::optional<Measure> DesignPath::least_slope(const BasePath& path, const std::string& quantity,
                                               double end, Climb climb) const {
  const auto least = analysis::least_slope(base(), path, quantity, end, of_.slope_units, climb);
  if (!least) return std::nullopt;
  return with_rates(least->value, [&](const CaseCurves& curves) -> std::optional<Vector> {
    const auto rate = rate_of(curves, curves.base(), *least);
    return rate ? std::optional<Vector>{Vector::Constant(1, *rate)} : std::nullopt;
  });
}

}  // namespace springfold::analysis
