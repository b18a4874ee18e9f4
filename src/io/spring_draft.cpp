#include "spring_draft.hpp"

#include <algorithm>

namespace springfold::io {
namespace {

using model::SpringLaw;

/// Torque of the stops alone, so that the law's torque at `free` is that of both springs there.
double stop_torque(double c, double stiffness, double low, double high) {
  if (c > high) return stiffness * (c - high);
  return c < low ? stiffness * (c - low) : 0;
}

/// Straight lines from point to point, the outer ones going on.
model::PiecewiseLinearSpring straight_table(const std::vector<double>& u,
                                            const std::vector<double>& t, double free,
                                            bool falling) {
  model::PiecewiseLinearSpring law{.free = free, .falling = falling};
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    law.stiffnesses.push_back((t[i + 1] - t[i]) / (u[i + 1] - u[i]));
    if (i > 0) law.breakpoints.push_back(free + u[i]);
  }
  const auto after = std::upper_bound(u.begin() + 1, u.end() - 1, 0.0) - u.begin();
  const auto home = static_cast<std::size_t>(after - 1);
  law.preload = t[home] - law.stiffnesses[home] * u[home];
  return law;
}

/// Builds the law of each draft from the numbers.
struct LawBuilder {
  const std::vector<double>& n;
  const double length;

  std::vector<double> values(const std::vector<NumberId>& ids) const {
    std::vector<double> list;
    for (const NumberId id : ids) list.push_back(n[id]);
    return list;
  }

  SpringLaw operator()(const LinearDraft& s) const {
    return model::LinearSpring{n[s.stiffness], n[s.free], s.falling};
  }
  SpringLaw operator()(const OneSidedDraft& s) const {
    return model::OneSidedSpring{n[s.stiffness], n[s.from], s.side};
  }
  SpringLaw operator()(const PiecewiseLinearDraft& s) const {
    return model::PiecewiseLinearSpring{values(s.breakpoints), values(s.stiffnesses), n[s.free],
                                        n[s.preload], s.falling};
  }
  SpringLaw operator()(const GapDraft& s) const {
    const double k = n[s.stiffness], low = n[s.low], high = n[s.high];
    return model::PiecewiseLinearSpring{{low, high}, {k, 0, k}, low + 0.5 * (high - low), 0};
  }
  SpringLaw operator()(const StopsDraft& s) const {
    const double k = n[s.stiffness], stop = n[s.stop_stiffness], free = n[s.free];
    const double low = n[s.low], high = n[s.high];
    return model::PiecewiseLinearSpring{
        {low, high}, {k + stop, k, k + stop}, free, stop_torque(free, stop, low, high)};
  }
  SpringLaw operator()(const TableDraft& s) const {
    auto deformations = values(s.deformations), torques = values(s.torques);
    if (s.straight) return straight_table(deformations, torques, n[s.free], s.falling);
    return model::TableSpring{std::move(deformations), std::move(torques), n[s.free], s.falling};
  }
  SpringLaw operator()(const PolynomialDraft& s) const {
    return model::PolynomialSpring{
        values(s.coefficients), n[s.free], {n[s.low], n[s.high]}, s.falling};
  }
  SpringLaw operator()(const FormulaDraft& s) const {
    model::FormulaSpring law{s.formula, n[s.free], {n[s.low], n[s.high]}, s.falling};
    for (const auto& [step, id] : s.numbers) law.formula.steps[step].number = n[id];
    return law;
  }
  SpringLaw operator()(const LogarithmicDraft& s) const {
    return model::LogarithmicSpring{n[s.stiffness], s.length ? n[*s.length] : length, n[s.free]};
  }
  SpringLaw operator()(const PowerDraft& s) const {
    return model::PowerSpring{n[s.force], n[s.depth], n[s.exponent], n[s.from], s.below};
  }
};

}  // namespace

SpringLaw law_of(const SpringDraft& spring, const std::vector<double>& numbers, double length) {
  return std::visit(LawBuilder{numbers, length}, spring);
}

}  // namespace springfold::io
