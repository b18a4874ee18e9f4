#include "springfold/model/spring_law.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/overloaded.hpp"

namespace springfold::model {
namespace {

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

/// A law of one segment that follows a curve.
CompiledSpring from_curve(SpringCurve curve, double anchor) {
  const Jet<double> there = torque_of(curve, anchor);
  CompiledSpring spring;
  spring.segments = {{anchor, there.value, there.slope, 0, 0}};
  spring.curves.push_back(std::move(curve));
  return spring;
}

CompiledSpring from_contact(const PowerSpring& law) {
  CompiledSpring spring = from_curve(law, law.from);
  spring.breakpoints = {law.from};
  const CompiledSpring::Segment apart{law.from};
  spring.segments.insert(law.below ? spring.segments.end() : spring.segments.begin(), apart);
  if (law.force == 0) spring.segments = {apart, apart};
  return spring;
}

/// Slope in a node between two cubics, from the straight lines on both sides: their weighted harmonic
/// mean, 0 where one is flat or they go against each other (Fritsch and Butland, as weighted by Brodlie).
double inner_slope(double h0, double h1, double rise0, double rise1) {
  if (rise0 == 0 || rise1 == 0 || (rise0 < 0) != (rise1 < 0)) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / rise0 + w1 / rise1);
}

/// Slope in an end node: of the parabola through three nodes, limited so that the shape is kept.
double end_slope(double h0, double h1, double rise0, double rise1) {
  const double slope = ((2 * h0 + h1) * rise0 - h0 * rise1) / (h0 + h1);
  if ((slope < 0) != (rise0 < 0) || rise0 == 0) return 0;
  const bool turns = (rise0 < 0) != (rise1 < 0);
  return turns && std::abs(slope) > 3 * std::abs(rise0) ? 3 * rise0 : slope;
}

std::vector<double> slopes_of(const std::vector<double>& h, const std::vector<double>& rise) {
  const std::size_t n = h.size();
  if (n == 1) return {rise[0], rise[0]};
  std::vector<double> slopes{end_slope(h[0], h[1], rise[0], rise[1])};
  for (std::size_t i = 1; i < n; ++i)
    slopes.push_back(inner_slope(h[i - 1], h[i], rise[i - 1], rise[i]));
  slopes.push_back(end_slope(h[n - 1], h[n - 2], rise[n - 1], rise[n - 2]));
  return slopes;
}

CubicPieces pieces_of(const TableSpring& table) {
  const auto& u = table.deformations;
  const auto& t = table.torques;
  std::vector<double> h, rise;
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    h.push_back(u[i + 1] - u[i]);
    rise.push_back((t[i + 1] - t[i]) / h[i]);
  }
  const std::vector<double> slopes = slopes_of(h, rise);
  CubicPieces curve{.free = table.free};
  double energy = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    CubicPieces::Piece piece{.at = u[i], .value = t[i], .slope = slopes[i], .energy = energy};
    if (i < h.size()) {
      piece.quadratic = (3 * rise[i] - 2 * slopes[i] - slopes[i + 1]) / h[i];
      piece.cubic = (slopes[i] + slopes[i + 1] - 2 * rise[i]) / (h[i] * h[i]);
      energy += h[i] * ((t[i] + t[i + 1]) / 2 + h[i] * (slopes[i] - slopes[i + 1]) / 12);
    }
    curve.pieces.push_back(piece);
  }
  const double at_zero = energy_of<double>(curve, table.free);
  for (CubicPieces::Piece& piece : curve.pieces) piece.energy -= at_zero;
  return curve;
}

/// A number with the sign of the stiffness far out on one side (-1, 1); 0 where that is not known or where the
/// law ends.
double stiffness_far_out(const SpringCurve& curve, double side) {
  return std::visit(
      Overloaded{[side](const PolynomialSpring& s) {
                   const double end = side < 0 ? s.range.low : s.range.high;
                   if (std::isfinite(end)) return torque_of<double>(s, s.free + end).slope;
                   auto a = s.coefficients;
                   while (!a.empty() && a.back() == 0) a.pop_back();
                   if (a.size() < 2) return 0.0;
                   return a.size() % 2 == 0 || side > 0 ? a.back() : -a.back();
                 },
                 [side](const FormulaSpring& s) {
                   const double end = side < 0 ? s.range.low : s.range.high;
                   return std::isfinite(end)
                              ? torque_of<double>(s, s.free + end / s.coordinate_unit).slope
                              : 0.0;
                 },
                 [](const LogarithmicSpring&) { return 0.0; },
                 [side](const PowerSpring& s) { return s.below == (side < 0) ? s.force : 0.0; },
                 [side](const CubicPieces& s) {
                   return side < 0 ? s.pieces.front().slope : s.pieces.back().slope;
                 }},
      curve);
}

}  // namespace

std::size_t CompiledSpring::segment_at(double c) const {
  const auto above = std::upper_bound(breakpoints.begin(), breakpoints.end(), c);
  return static_cast<std::size_t>(above - breakpoints.begin());
}

CompiledSpring compile(const SpringLaw& law) {
  return std::visit(
      Overloaded{
          [](const LinearSpring& s) {
            CompiledSpring spring;
            spring.segments.front() = {s.free, 0, s.stiffness};
            return spring;
          },
          [](const OneSidedSpring& s) {
            const bool above = s.side == OneSidedSpring::Side::above;
            return from_slopes(
                {{s.from}, {above ? 0.0 : s.stiffness, above ? s.stiffness : 0.0}, s.from, 0});
          },
          [](const PiecewiseLinearSpring& s) { return from_slopes(s); },
          [](const TableSpring& s) { return from_curve(pieces_of(s), s.free); },
          [](const PowerSpring& s) { return from_contact(s); },
          [](const auto& s) { return from_curve(s, s.free); }},
      law);
}

bool holds_both_ways(const CompiledSpring& spring) {
  const auto first = std::size_t{0}, last = spring.segments.size() - 1;
  const auto holds = [&spring](std::size_t i, double side) {
    if (spring.is_straight(i)) return spring.segments[i].stiffness > 0;
    return stiffness_far_out(spring.curves[static_cast<std::size_t>(spring.segments[i].curve)],
                             side) > 0;
  };
  return holds(first, -1) && holds(last, 1);
}

std::vector<double> typical_stiffnesses(const CompiledSpring& spring, double width) {
  std::vector<double> list;
  for (std::size_t i = 0; i < spring.segments.size(); ++i) {
    const CompiledSpring::Segment& segment = spring.segments[i];
    double stiffness = std::abs(segment.stiffness);
    if (!spring.is_straight(i) && !(std::isfinite(stiffness) && stiffness > 0)) {
      stiffness = 0;
      for (const double part : {-1.0, -0.5, 0.5, 1.0}) {
        const double there = std::abs(spring.stiffness(i, segment.anchor + part * width));
        if (std::isfinite(there)) stiffness = std::max(stiffness, there);
      }
    }
    if (stiffness > 0) list.push_back(stiffness);
  }
  return list;
}

}  // namespace springfold::model
