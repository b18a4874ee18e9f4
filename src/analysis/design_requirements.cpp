#include "design_requirements.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "analysis/undefined.hpp"
#include "constant_nodes.hpp"
#include "first_unwanted.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// What a requirement is measured in.
double scale_of(double wanted) {
  return std::isfinite(wanted) && wanted != 0 ? std::abs(wanted) : 1;
}

/// Weights of the places at which a range is judged: rows of its interpolation, those at local maxima moved there.
std::vector<Vector> peaks(const RangeNodes& range, const Vector& values) {
  const Vector inside = range.inside * values;
  std::vector<Vector> all;
  for (Index i = 0; i < inside.size(); ++i) {
    all.emplace_back(range.inside.row(i).transpose());
    const bool is_peak =
        i > 0 && i + 1 < inside.size() && inside[i] > inside[i - 1] && inside[i] >= inside[i + 1];
    if (!is_peak) continue;
    const auto below = [&](double row) { return -range_weights(row).dot(values); };
    constexpr int bits = 26;  // half of the digits: a maximum is not better known from values
    const auto place = static_cast<double>(i);
    const auto [row, value] =
        boost::math::tools::brent_find_minima(below, place - 1, place + 1, bits);
    if (-value > inside[i]) all.back() = range_weights(row);
  }
  return all;
}

/// A start that is unstable itself has lost its stability before the path begins. No parameter is known to mend it by
/// its rate: the search comes to stable ones from elsewhere.
bool is_lost_at_start(const DesignPath& path, const CriticalRequirement& wanted) {
  if (wanted.unwanted != Unwanted::loss_of_stability) return false;
  const auto modes = unstable_at_start(path.base(), settings_of(wanted));
  return modes && *modes > 0;
}

}  // namespace

/// Inequalities as they come.
struct Requirements::Sheet {
  std::vector<FoundRequirement> requirements{};
  std::vector<double> g{};
  std::vector<Vector> dg{};
  std::vector<std::size_t> of{};
  std::string why{};

  /// An inequality of the requirement that was added last.
  void add(double value, Vector rates) {
    g.push_back(value);
    dg.push_back(std::move(rates));
    of.push_back(requirements.size() - 1);
    requirements.back().holds = requirements.back().holds && value <= design_tolerance;
  }
  void begin(FoundRequirement requirement, double reached) {
    requirement.after = reached;
    requirement.holds = true;
    requirements.push_back(std::move(requirement));
  }
};

Requirements::Requirements(const Study& study) : settings_{study.design} {
  case_.study = study;
  case_.study.marks.clear();
  const CaseFamily& cases = *study.critical.cases;
  for (const DesignParameter& parameter : settings_.parameters) {
    const auto at = std::find(cases.names.begin(), cases.names.end(), parameter.name);
    case_.numbers.push_back(static_cast<std::size_t>(at - cases.names.begin()));
    const double value = std::abs(cases.values[case_.numbers.back()]);
    const double width = parameter.high - parameter.low;
    case_.sizes.push_back(value > 0 ? std::min(value, width) : width);
  }
  if (!settings_.critical.empty()) {
    const CaseCurves own(case_.study, case_.numbers.front());
    case_.slope_units = {own.base().setup.lambda_scale, own.base().setup.scales.force};
  }
  auto& marks = case_.study.marks;
  if (settings_.curve)
    for (const auto& [x, y] : settings_.curve->points) marks.push_back({settings_.curve->x, x});
  if (settings_.constant)
    for (const double x : range_nodes(settings_.constant->from, settings_.constant->to).nodes)
      marks.push_back({settings_.constant->along, x});
  for (const StiffnessRequirement& one : settings_.stiffness)
    if (one.at) marks.push_back({one.at->first, one.at->second});
  needs_path_ = !settings_.critical.empty() || !marks.empty();
}

std::vector<FoundRequirement> Requirements::unknown() const {
  std::vector<FoundRequirement> all;
  const auto add = [&](std::string name, double wanted, bool upper = false, double tolerance = 0) {
    all.push_back({.name = std::move(name),
                   .wanted = wanted,
                   .before = undefined,
                   .after = undefined,
                   .is_upper = upper,
                   .tolerance = tolerance});
  };
  for (const CriticalRequirement& one : settings_.critical) add(one.name, one.at_least);
  if (settings_.curve)
    for (std::size_t i = 0; i < settings_.curve->points.size(); ++i)
      add("curve." + std::to_string(i + 1), settings_.curve->points[i].second, false,
          settings_.curve->tolerance);
  if (settings_.constant) {
    add("constant.mean", settings_.constant->mean_at_least);
    add("constant.deviation", settings_.constant->within, true);
  }
  for (std::size_t i = 0; i < settings_.stiffness.size(); ++i)
    add("stiffness." + std::to_string(i + 1), settings_.stiffness[i].at_least);
  return all;
}

std::unique_ptr<TracedDesign> Requirements::trace(const Vector& values, const Observer& observer,
                                                  std::string& why) const {
  auto design = std::make_unique<TracedDesign>(TracedDesign{values, DesignPath(case_, values)});
  DesignPath& path = design->path;
  if (!path.has_start()) {
    why = "no start: " + path.base().report.message;
    return nullptr;
  }
  if (needs_path_) path.trace(observer);
  for (const CriticalRequirement& wanted : settings_.critical)
    if (is_lost_at_start(path, wanted))
      design->modes.emplace_back();
    else
      design->modes.emplace_back(first_modes(case_, values, path, wanted, observer));
  return design;
}

std::optional<Assessment> Requirements::assess(const TracedDesign& design,
                                               const std::vector<Way>& ways,
                                               std::string& why) const {
  const DesignPath& path = design.path;
  const Vector& values = design.values;
  Sheet sheet;
  const bool known = add_critical(design, ways, sheet) && add_curve(path, sheet) &&
                     add_constant(path, sheet) && add_stiffness(path, values, sheet);
  if (!known) {
    why = sheet.why;
    return std::nullopt;
  }
  Assessment result{.requirements = std::move(sheet.requirements),
                    .g = Vector(std::ssize(sheet.g)),
                    .dg = Matrix(std::ssize(sheet.g), values.size()),
                    .of = std::move(sheet.of)};
  for (std::size_t i = 0; i < sheet.g.size(); ++i) {
    result.g[static_cast<Index>(i)] = sheet.g[i];
    result.dg.row(static_cast<Index>(i)) = sheet.dg[i].transpose();
  }
  if (!result.g.allFinite()) {
    why = "a requirement is not defined there";
    return std::nullopt;
  }
  return result;
}

/// Inequalities for every requirement: the climb, where it is wanted, and the modes of the first unwanted point that it
/// does not rule out. What does not occur is far from its limit.
bool Requirements::add_critical(const TracedDesign& design, const std::vector<Way>& ways,
                                Sheet& sheet) const {
  const DesignPath& path = design.path;
  const Vector still = Vector::Zero(std::ssize(case_.numbers));
  const auto blank = unknown();
  for (std::size_t i = 0; i < settings_.critical.size(); ++i) {
    const CriticalRequirement& wanted = settings_.critical[i];
    if (!design.modes[i]) {
      sheet.begin(blank[i], undefined);
      const std::size_t count = modes_together + (ways[i] == Way::climbing ? 1 : 0);
      for (std::size_t k = 0; k < count; ++k) sheet.add(k == 0 ? 1 : -1, still);
      continue;
    }
    const FirstModes& found = *design.modes[i];
    const std::optional<SpecialPoint>& first = found.first;
    if (!first && !doubt_of(found.path).empty()) {
      sheet.why = doubt_of(found.path);
      return false;
    }
    if (first && found.modes.empty()) {
      sheet.why = wanted.quantity + " is not defined at " + first->label;
      return false;
    }
    const double reached = first ? found.modes.front().value : infinite;
    sheet.begin(blank[i], reached);
    const bool climbs = ways[i] == Way::climbing;
    const bool turns = first && turns_back(path.base(), settings_of(wanted), found.path, *first);
    if (climbs) {
      const auto slope = path.least_slope(found.path, wanted.quantity, wanted.at_least,
                                          climb_of(path.base(), settings_of(wanted)));
      if (!slope) {
        sheet.why = "the slope of the path is not known";
        return false;
      }
      sheet.add(-slope->value, -slope->rates);
    }
    // A limit point is what the climb rules out, also one at which equal parts lose their stiffness together.
    const double scale = scale_of(wanted.at_least);
    const bool counts = first && !(climbs && turns) && std::isfinite(wanted.at_least);
    for (std::size_t k = 0; k < modes_together; ++k)
      if (counts && k < found.modes.size())
        sheet.add((wanted.at_least - found.modes[k].value) / scale, -found.modes[k].rates / scale);
      else
        sheet.add(k == 0 && first && !climbs && !counts ? 1 : -1, still);
    // With the slope at its limit two limit points merge: whether they are seen is rounding.
    sheet.requirements.back().holds = reached >= wanted.at_least - design_tolerance * scale;
  }
  return true;
}

bool Requirements::add_curve(const DesignPath& path, Sheet& sheet) const {
  if (!settings_.curve) return true;
  const CurveRequirement& curve = *settings_.curve;
  const auto all = unknown();
  const std::size_t first = sheet.requirements.size();
  // Rows are as exact as residuals: no finer than that is a requirement held, however narrow its tolerance.
  constexpr double known = continuation::NewtonOptions{}.residual_tolerance;
  double largest = 0;
  for (const auto& [x, y] : curve.points) largest = std::max(largest, std::abs(y));
  const double unit = std::max(curve.tolerance, largest * (known / design_tolerance));
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const auto& [x, y] = curve.points[i];
    const auto found = path.at_value(curve.y, curve.x, x);
    if (!found) {
      sheet.why = "the path does not reach " + curve.x + " = " + rounded(x);
      return false;
    }
    sheet.begin(all[first + i], found->value);
    for (const double side : {1.0, -1.0})
      sheet.add((side * (found->value - y) - curve.tolerance) / unit, side * found->rates / unit);
  }
  return true;
}

bool Requirements::add_constant(const DesignPath& path, Sheet& sheet) const {
  if (!settings_.constant) return true;
  const ConstantRequirement& constant = *settings_.constant;
  const RangeNodes range = range_nodes(constant.from, constant.to);
  const Index n = range.nodes.size();
  Vector values(n);
  Matrix rates(n, std::ssize(case_.numbers));
  for (Index k = 0; k < n; ++k) {
    const auto found = path.at_value(constant.quantity, constant.along, range.nodes[k]);
    if (!found) {
      sheet.why = "the path does not reach " + constant.along + " = " + rounded(range.nodes[k]);
      return false;
    }
    values[k] = found->value;
    rates.row(k) = found->rates.transpose();
  }
  const auto blank = unknown();
  const std::size_t at = sheet.requirements.size();
  const double mean = range.mean.dot(values);
  const Vector dmean = rates.transpose() * range.mean;
  const double wanted = constant.mean_at_least;
  sheet.begin(blank[at], mean);
  if (std::isfinite(wanted))
    sheet.add((wanted - mean) / scale_of(wanted), -dmean / scale_of(wanted));

  const double size = std::abs(mean);
  const Vector dsize = (mean < 0 ? -1.0 : 1.0) * dmean;
  sheet.begin(blank[at + 1], 0);
  for (const double side : {1.0, -1.0})
    for (const Vector& weights : peaks(range, side * values)) {
      const double off = side * (weights.dot(values) - mean) / size;
      const Vector doff = (side * (rates.transpose() * weights - dmean) - off * dsize) / size;
      sheet.add(off / constant.within - 1, doff / constant.within);
      double& deviation = sheet.requirements.back().after;
      deviation = std::max(deviation, off);
    }
  return true;
}

bool Requirements::add_stiffness(const DesignPath& path, const Vector& values, Sheet& sheet) const {
  const auto blank = unknown();
  const std::size_t first = sheet.requirements.size();
  for (std::size_t i = 0; i < settings_.stiffness.size(); ++i) {
    const StiffnessRequirement& wanted = settings_.stiffness[i];
    std::optional<Measure> found;
    if (wanted.at) {
      found = path.at_value(wanted.quantity, wanted.at->first, wanted.at->second);
    } else if (wanted.pose.size() > 0) {
      const DesignPath other(case_, values, wanted.pose);
      if (other.has_start()) found = other.at_start(wanted.quantity);
    } else {
      found = path.at_start(wanted.quantity);
    }
    if (!found) {
      sheet.why = blank[first + i].name + ": " + wanted.quantity + " is not known there";
      return false;
    }
    sheet.begin(blank[first + i], found->value);
    const double scale = scale_of(wanted.at_least);
    sheet.add((wanted.at_least - found->value) / scale, -found->rates / scale);
  }
  return true;
}

}  // namespace springfold::analysis
