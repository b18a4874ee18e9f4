// Springs of shapes in other units: what is traced is dimensionless, and the same to the last bit.
#include <gtest/gtest.h>

#include "analysis/scales.hpp"
#include "analysis/shape_units.hpp"

namespace springfold::analysis {
namespace {

using model::ShapeKind;

const std::vector<ShapeKind> kinds{ShapeKind::path, ShapeKind::angle,  ShapeKind::dihedral,
                                   ShapeKind::area, ShapeKind::volume, ShapeKind::line,
                                   ShapeKind::plane};

/// All shapes with a bent law, a gas and a pressure, in units of length 1/L and of force 1/F.
model::Mechanism in_units(double L, double F) {
  model::Mechanism m;
  m.bodies = {{"a", model::TaskSpace::xyz, (Vector(3) << 0.3 * L, 0, 0.9 * L).finished()}};
  model::Chain chain{.name = "c"};
  for (const auto& axis :
       {model::Vec3<double>::UnitX().eval(), model::Vec3<double>::UnitY().eval()})
    chain.elements.push_back(model::Joint{
        .name = "j", .kind = model::JointKind::prismatic, .axis = axis, .initial = 0.1 * L});
  m.chains = {chain};
  const std::vector<model::Anchor> points{
      {.body = 1}, {.at = {0.7 * L, 0, 0}}, {.at = {0, 1.3 * L, 0}}, {.at = {0, 0, 0.4 * L}}};
  for (const ShapeKind kind : kinds) {
    const double unit = std::pow(L, length_power(kind)), torque = F * L / unit;
    m.shape_springs.push_back(
        {"s",
         {.kind = kind, .points = points},
         model::PiecewiseLinearSpring{
             {0.7 * unit}, {1.1 * torque / unit, 3 * torque / unit}, 0.2 * unit, 0.3 * torque}});
  }
  m.shape_springs.push_back({"gas",
                             {.kind = ShapeKind::volume, .points = points},
                             {},
                             model::Gas{0.3 * F * L, 0.1 * L * L * L, 1.4}});
  for (const ShapeKind kind : {ShapeKind::area, ShapeKind::volume})
    m.loads.push_back({.kind = model::LoadKind::pressure,
                       .vector = {0.9 * F * L / std::pow(L, length_power(kind)), 0, 0},
                       .shape = {.kind = kind, .points = points}});
  return m;
}

TEST(ShapeScales, DoNotChangeWithUnitsThatArePowersOfTwo) {
  const auto scaled = [](double L, double F) {
    const model::Mechanism m = in_units(L, F);
    return dimensionless(m, scales_for(m, {}));
  };
  const model::Mechanism a = scaled(1, 1), b = scaled(0x1p7, 0x1p-5);
  for (std::size_t i = 0; i < a.shape_springs.size(); ++i) {
    const auto &s = a.shape_springs[i], &t = b.shape_springs[i];
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(s.shape.points[k].at, t.shape.points[k].at);
    if (s.gas) {
      EXPECT_EQ(s.gas->nRT, t.gas->nRT);
      EXPECT_EQ(s.gas->initial, t.gas->initial);
      continue;
    }
    const model::CompiledSpring p = compile(s.law), q = compile(t.law);
    EXPECT_EQ(p.breakpoints, q.breakpoints);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(p.torque(k, 0.9), q.torque(k, 0.9));
      EXPECT_EQ(p.stiffness(k, 0.9), q.stiffness(k, 0.9));
    }
  }
  for (std::size_t i = 0; i < a.loads.size(); ++i) EXPECT_EQ(a.loads[i].vector, b.loads[i].vector);
}

}  // namespace
}  // namespace springfold::analysis
