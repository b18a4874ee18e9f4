#include "springfold/model/spring_law.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::model {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};

void check_stiffness(double k, std::vector<std::string>& problems) {
  if (!(std::isfinite(k) && k >= 0))
    problems.push_back("stiffness: need a finite number >= 0, got " + std::to_string(k));
}

CompiledSpring from_slopes(const PiecewiseLinearSpring& law) {
  CompiledSpring spring;
  spring.breakpoints = law.breakpoints;
  spring.segments.assign(law.stiffnesses.size(), {});
  const auto above = std::upper_bound(law.breakpoints.begin(), law.breakpoints.end(), law.free);
  const auto home = static_cast<std::size_t>(above - law.breakpoints.begin());
  for (std::size_t i = 0; i < law.stiffnesses.size(); ++i)
    spring.segments[i].stiffness = law.stiffnesses[i];
  spring.segments[home].anchor = law.free;
  spring.segments[home].torque = law.preload;
  const auto join = [&spring](std::size_t to, std::size_t from, double at) {
    spring.segments[to].anchor = at;
    spring.segments[to].torque = spring.torque(from, at);
    spring.segments[to].energy = spring.energy(from, at);
  };
  for (std::size_t i = home; i < law.breakpoints.size(); ++i) join(i + 1, i, law.breakpoints[i]);
  for (std::size_t i = home; i > 0; --i) join(i - 1, i, law.breakpoints[i - 1]);
  return spring;
}

}  // namespace

std::vector<std::string> problems_in(const SpringLaw& law) {
  std::vector<std::string> problems;
  const auto need_finite = [&problems](double value, const std::string& name) {
    if (!std::isfinite(value)) problems.push_back(name + ": need a finite number");
  };
  std::visit(Overloaded{[&](const LinearSpring& s) {
                          check_stiffness(s.stiffness, problems);
                          need_finite(s.free, "free");
                        },
                        [&](const OneSidedSpring& s) {
                          check_stiffness(s.stiffness, problems);
                          need_finite(s.from, "from");
                        },
                        [&](const PiecewiseLinearSpring& s) {
                          for (const double k : s.stiffnesses) check_stiffness(k, problems);
                          for (const double b : s.breakpoints) need_finite(b, "breakpoints");
                          need_finite(s.free, "free");
                          need_finite(s.preload, "preload");
                          if (s.stiffnesses.size() != s.breakpoints.size() + 1)
                            problems.push_back("stiffnesses: need one more than breakpoints");
                          if (std::adjacent_find(s.breakpoints.begin(), s.breakpoints.end(),
                                                 std::greater_equal<>{}) != s.breakpoints.end())
                            problems.push_back("breakpoints: need strictly increasing numbers");
                        }},
             law);
  return problems;
}

std::size_t CompiledSpring::segment_at(double c) const {
  const auto above = std::upper_bound(breakpoints.begin(), breakpoints.end(), c);
  return static_cast<std::size_t>(above - breakpoints.begin());
}

CompiledSpring compile(const SpringLaw& law) {
  return std::visit(
      Overloaded{
          [](const LinearSpring& s) {
            return from_slopes({{}, {s.stiffness}, s.free, 0});
          },
          [](const OneSidedSpring& s) {
            const bool above = s.side == OneSidedSpring::Side::above;
            return from_slopes(
                {{s.from}, {above ? 0.0 : s.stiffness, above ? s.stiffness : 0.0}, s.from, 0});
          },
          [](const PiecewiseLinearSpring& s) { return from_slopes(s); }},
      law);
}

}  // namespace springfold::model
