// Results made by hand from a closed form, so that files, tables and pictures can be tested without
// the engine: the planar Orthoglide pushed along its diagonal (two equal legs of length 1, drive
// stiffness 1, preload stiffness k, command balanced at x = y = p).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io::sample {

/// Force along the diagonal at x = y = c, half the derivative of the springs' energy:
/// F = sqrt(2) [(rho(c) - rho_0) rho'(c) + k asin(c) / sqrt(1 - c^2)], rho(c) = c + sqrt(1 - c^2).
struct Diagonal {
  double k = 0, p = 0.454;

  static double rho(double c) { return c + std::sqrt(1 - c * c); }
  static double drho(double c) { return 1 - c / std::sqrt(1 - c * c); }
  double preload(double c) const { return k * std::asin(c) / std::sqrt(1 - c * c); }
  double command() const { return rho(p) + preload(p) / drho(p); }
  double force(double c) const {
    return std::sqrt(2.0) * ((rho(c) - command()) * drho(c) + preload(c));
  }
  double stiffness(double c) const {
    const double h = 1e-6;
    return (force(c + h) - force(c - h)) / (2 * h) / std::sqrt(2.0);
  }
  /// Where the stiffness changes sign between a and b.
  double fold(double a, double b) const {
    const bool rises = stiffness(a) > 0;
    for (int i = 0; i < 60; ++i) {
      const double middle = (a + b) / 2;
      ((stiffness(middle) > 0) == rises ? a : b) = middle;
    }
    return a;
  }
};

inline std::vector<analysis::Quantity> quantities() {
  using analysis::Unit;
  return {
      {"s", Unit::none},         {"lambda", Unit::lambda},          {"deflection", Unit::length},
      {"force", Unit::force},    {"stiffness", Unit::stiffness},    {"point.x", Unit::length},
      {"point.y", Unit::length}, {"leg_x.drive.rho", Unit::length}, {"index", Unit::none},
      {"energy", Unit::energy}};
}

inline analysis::Sample sample_at(const Diagonal& diagonal, double c) {
  const double deflection = std::sqrt(2.0) * (c - diagonal.p);
  const double stiffness = diagonal.stiffness(c);
  return {.values = {deflection, deflection, deflection, diagonal.force(c), stiffness, c, c,
                     diagonal.command(), stiffness < 0 ? 1.0 : 0.0,
                     std::numeric_limits<double>::quiet_NaN()}};
}

inline analysis::StudyResult result(const std::string& study, int run, const std::string& label,
                                    const Diagonal& diagonal, double from = 0.3, double to = 0.93) {
  analysis::StudyResult result{.study = study, .run = run, .label = label};
  result.lambda_unit = analysis::Unit::length;
  result.quantities = quantities();
  result.start = {.found = true,
                  .method = "Newton",
                  .attempts = 1,
                  .iterations = 4,
                  .residual = 3e-16,
                  .stiffness = Matrix{{1.25, -1.0}, {-1.0, 1.25}},
                  .chain_stiffnesses = {Matrix{{1.0, 0.0}, {0.0, 0.0}}, Matrix{}}};

  std::vector<double> places;
  const int count = 80;
  for (int i = 0; i <= count; ++i) places.push_back(from + (to - from) * i / count);
  places.push_back(diagonal.p);
  std::vector<double> folds;
  for (std::size_t i = 0; i + 1 < places.size() - 1; ++i)
    if ((diagonal.stiffness(places[i]) > 0) != (diagonal.stiffness(places[i + 1]) > 0))
      folds.push_back(diagonal.fold(places[i], places[i + 1]));
  places.insert(places.end(), folds.begin(), folds.end());
  std::sort(places.begin(), places.end());

  analysis::Branch branch;
  branch.backward = {.reason = "deflection reached its lower limit"};
  branch.forward = {.reason = "deflection reached its upper limit"};
  branch.log = {{.s = 0.1, .step = 0.05, .reason = "no convergence, \"too long\""}};
  const auto add_event = [&](analysis::EventKind kind, const std::string& event_label,
                             const std::string& detail) {
    const std::size_t row = branch.samples.size() - 1;
    branch.samples.back().event = event_label;
    analysis::Event event{.kind = kind, .label = event_label, .detail = detail, .row = row};
    event.stiffness = Matrix{{0.5, -0.5}, {-0.5, 0.5}};
    event.rates_before = branch.samples.back().values;
    event.rates_after = branch.samples.back().values;
    branch.events.push_back(event);
  };
  for (const double c : places) {
    branch.samples.push_back(sample_at(diagonal, c));
    if (c == diagonal.p) branch.start_row = branch.samples.size() - 1;
    const auto found = std::find(folds.begin(), folds.end(), c);
    if (found != folds.end())
      add_event(analysis::EventKind::limit_point, "LP" + std::to_string(found - folds.begin() + 1),
                "lambda turns back");
  }
  add_event(analysis::EventKind::end_of_range, "EP1", "deflection reached its upper limit");
  result.branches.push_back(branch);
  result.seconds = 0.004;
  return result;
}

/// A run of the two-legged mechanism without spring data: enough for tables and manifest.
inline PlannedRun planned(const std::string& study, int run, const std::string& label) {
  PlannedRun planned{.study = study, .run = run, .label = label};
  planned.mechanism.bodies.push_back({.name = "point", .task_space = model::TaskSpace::xy});
  planned.mechanism.chains.push_back({.name = "leg_x"});
  planned.mechanism.chains.push_back({.name = "leg_y"});
  planned.plan.name = study;
  planned.plan.control = analysis::ControlMode::mixed;
  planned.plan.direction = Vector::Ones(2);
  planned.parameters = {{"L", 1.0}, {"Kv", 0.01}};
  return planned;
}

inline Case two_runs() {
  Case the_case{.file = "/somewhere/orthoglide/case.toml", .title = "Planar Orthoglide"};
  the_case.hash = "0123";
  the_case.runs = {planned("push from Q2", 1, "Kv = 0"), planned("push from Q2", 2, "Kv = 0.01")};
  the_case.overrides = {{"Kv", "0.01"}};
  return the_case;
}

inline std::vector<analysis::StudyResult> two_results() {
  return {result("push from Q2", 1, "Kv = 0", {.k = 0}, 0.37, 0.9),
          result("push from Q2", 2, "Kv = 0.01", {.k = 0.01}, 0.37, 0.9)};
}

}  // namespace springfold::io::sample
