// What makes a spring law unusable, in words.
#include <algorithm>
#include <cmath>
#include <functional>
#include <locale>
#include <sstream>

#include "falling.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::model {
namespace {

using Problems = std::vector<std::string>;

const std::string hint = "; give falling = true if it is meant so";

/// "between deformations of -0.5 and 0.5", "at every deformation".
std::string stretch_text(const DeformationRange& stretch) {
  const bool begins = std::isfinite(stretch.low), ends = std::isfinite(stretch.high);
  const std::string low = rounded(stretch.low, 6), high = rounded(stretch.high, 6);
  if (begins && ends) return "between deformations of " + low + " and " + high;
  return begins ? "above a deformation of " + low
         : ends ? "below a deformation of " + high
                : "at every deformation";
}

/// Collects the broken rules of one law.
struct Rules {
  Problems& problems;

  void stiffness(double k, bool falling) const {
    if (!std::isfinite(k) || (k < 0 && !falling))
      problems.push_back("stiffness: need a finite number >= 0, got " + rounded(k, 6) +
                         (k < 0 && std::isfinite(k) ? hint : ""));
  }
  void finite(double value, const std::string& name) const {
    if (!std::isfinite(value)) problems.push_back(name + ": need a finite number");
  }
  void finite(const std::vector<double>& values, const std::string& name) const {
    for (const double value : values) finite(value, name);
  }
  void positive(double value, const std::string& name) const {
    if (!(std::isfinite(value) && value > 0))
      problems.push_back(name + ": need a finite number > 0");
  }
  void increasing(const std::vector<double>& values, const std::string& name) const {
    if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>{}) != values.end())
      problems.push_back(name + ": need strictly increasing numbers");
  }
  void range(const DeformationRange& range) const {
    if (!(range.low < range.high)) problems.push_back("range: need low < high");
  }
  template <class Law>
  void rising(const Law& law) const {
    if (law.falling || !problems.empty()) return;
    if (const auto stretch = falling_stretch(law))
      problems.push_back("falls " + stretch_text(*stretch) + ", need a law that rises" + hint +
                         ", or a range within which it rises");
  }

  void operator()(const LinearSpring& s) const {
    stiffness(s.stiffness, s.falling);
    finite(s.free, "free");
  }
  void operator()(const OneSidedSpring& s) const {
    stiffness(s.stiffness, false);
    finite(s.from, "from");
  }
  void operator()(const PiecewiseLinearSpring& s) const {
    for (const double k : s.stiffnesses) stiffness(k, s.falling);
    finite(s.breakpoints, "breakpoints");
    finite(s.free, "free");
    finite(s.preload, "preload");
    if (s.stiffnesses.size() != s.breakpoints.size() + 1)
      problems.push_back("stiffnesses: need one more than breakpoints");
    increasing(s.breakpoints, "breakpoints");
  }
  void operator()(const TableSpring& s) const {
    finite(s.deformations, "deformations");
    finite(s.torques, "torques");
    finite(s.free, "free");
    if (s.deformations.size() < 2) problems.push_back("deformations: need two or more");
    if (s.torques.size() != s.deformations.size())
      problems.push_back("torques: need as many as deformations");
    increasing(s.deformations, "deformations");
    if (!s.falling && !std::is_sorted(s.torques.begin(), s.torques.end()))
      problems.push_back("torques: need numbers that do not fall" + hint);
  }
  void operator()(const PolynomialSpring& s) const {
    finite(s.coefficients, "coefficients");
    finite(s.free, "free");
    range(s.range);
    rising(s);
  }
  void operator()(const FormulaSpring& s) const {
    finite(s.free, "free");
    range(s.range);
    positive(s.coordinate_unit, "coordinate_unit");
    positive(s.torque_unit, "torque_unit");
    if (problems.empty() && !std::isfinite(compile(s).segments.front().torque))
      problems.push_back(
          "formula: need a finite torque at c = free, from where energy is counted, or a range");
    rising(s);
  }
  void operator()(const LogarithmicSpring& s) const {
    stiffness(s.stiffness, false);
    positive(s.length, "length");
    finite(s.free, "free");
  }
  void operator()(const PowerSpring& s) const {
    if (!(std::isfinite(s.force) && s.force >= 0))
      problems.push_back("force: need a finite number >= 0");
    positive(s.depth, "depth");
    if (!(std::isfinite(s.exponent) && s.exponent >= 1))
      problems.push_back("exponent: need a finite number >= 1");
    finite(s.from, "from");
  }
};

}  // namespace

std::vector<std::string> problems_in(const SpringLaw& law) {
  Problems problems;
  std::visit(Rules{problems}, law);
  return problems;
}

}  // namespace springfold::model
