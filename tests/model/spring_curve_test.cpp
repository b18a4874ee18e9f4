#include "springfold/model/spring_curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "springfold/model/spring_law.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using Operation = FormulaStep::Operation;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// k u + k3 u^3.
Formula cubic_formula(double k, double k3) {
  return {{{Operation::variable},
           {Operation::number, 0, 0, k},
           {Operation::multiply, 1, 0},
           {Operation::number, 0, 0, 3},
           {Operation::power, 0, 3},
           {Operation::number, 0, 0, k3},
           {Operation::multiply, 5, 4},
           {Operation::add, 2, 6}}};
}

TableSpring some_table() {
  return {.deformations = {-0.5, -0.2, 0.1, 0.4, 0.6, 1.2},
          .torques = {-1, -0.8, 0.05, 0.05, 1.3, 1.4},
          .free = 0.15};
}

std::vector<SpringLaw> all_curves() {
  return {PolynomialSpring{{0.2, 1, 0, 50}, 0.1},
          PolynomialSpring{{0, 2.5, -3, 1}, -0.2, {}, true},
          PolynomialSpring{{0, 1, 0, -2}, 0.1, {-0.3, 0.25}},
          PolynomialSpring{{0.3, 1, 0.5}, 0.1, {0.05, 0.25}},
          FormulaSpring{cubic_formula(1, -20), 0.1, {}, true},
          FormulaSpring{cubic_formula(1, -20), 0.1, {-0.1, 0.05}},
          FormulaSpring{{{{Operation::variable}, {Operation::sinh, 0}}}, 0.2},
          LogarithmicSpring{3, 1.5, 0.1},
          LogarithmicSpring{3, 1.5, 1.5},
          PowerSpring{2, 0.5, 1, 0.1},
          PowerSpring{2, 0.5, 1.5, 0.1},
          PowerSpring{2, 0.5, 3, 0.1, true},
          PowerSpring{2, 0.5, 2.5, -0.1, true},
          some_table()};
}

/// Coordinates where all of the laws are defined, away from kinks and nodes.
std::vector<double> places() {
  std::mt19937 random(7);
  std::vector<double> list;
  for (int i = 0; i < 60; ++i) list.push_back(-0.9 + 2.7 * double(random()) / 0x1p32);
  return list;
}

TEST(SpringCurve, StiffnessAndItsSlopeAreThoseOfComplexSteps) {
  constexpr double step = 1e-30;
  for (const SpringLaw& law : all_curves()) {
    const CompiledSpring spring = compile(law);
    for (std::size_t i = 0; i < spring.segments.size(); ++i)
      for (const double c : places()) {
        const double k = spring.stiffness(i, c), rate = spring.stiffness_rate(i, c);
        if (!std::isfinite(spring.torque(i, c))) continue;  // beyond the end of a logarithm
        const Complex off(c, step);
        EXPECT_NEAR(k, spring.torque(i, off).imag() / step, 1e-10 * (1 + std::abs(k)))
            << "law " << law.index() << ", c = " << c;
        EXPECT_NEAR(rate, spring.stiffness(i, off).imag() / step, 1e-10 * (1 + std::abs(rate)))
            << "law " << law.index() << ", c = " << c;
      }
  }
}

TEST(SpringCurve, EnergyByComplexStepIsTheTorque) {
  constexpr double step = 1e-30;
  for (const SpringLaw& law : all_curves()) {
    const CompiledSpring spring = compile(law);
    for (std::size_t i = 0; i < spring.segments.size(); ++i)
      for (const double c : places()) {
        const double torque = spring.torque(i, c);
        if (!std::isfinite(torque)) continue;
        EXPECT_NEAR(torque, spring.energy(i, Complex(c, step)).imag() / step,
                    1e-10 * (1 + std::abs(torque)))
            << "law " << law.index() << ", c = " << c;
      }
  }
}

TEST(SpringCurve, UnitsByPowersOfTwoChangeNoDigit) {
  const double length = 0x1p-3, torque = 0x1p5;
  for (const SpringLaw& law : all_curves()) {
    const CompiledSpring spring = compile(law), other = compile(scaled(law, length, torque));
    ASSERT_EQ(spring.segments.size(), other.segments.size());
    for (std::size_t i = 0; i < spring.segments.size(); ++i)
      for (const double c : places()) {
        if (!std::isfinite(spring.torque(i, c))) continue;
        EXPECT_EQ(spring.torque(i, c), other.torque(i, c / length) * torque) << law.index();
        EXPECT_EQ(spring.stiffness(i, c), other.stiffness(i, c / length) * torque / length);
        EXPECT_EQ(spring.energy(i, c), other.energy(i, c / length) * torque * length);
      }
    for (std::size_t i = 0; i < spring.breakpoints.size(); ++i)
      EXPECT_EQ(spring.breakpoints[i], other.breakpoints[i] * length);
  }
}

TEST(SpringCurve, MovedLawsAreTheSameFurtherOn) {
  for (const SpringLaw& law : all_curves()) {
    const CompiledSpring spring = compile(law), further = compile(moved(law, 0.5));
    for (const double c : places()) {
      const std::size_t i = spring.segment_at(c);
      if (std::isfinite(spring.torque(i, c))) {
        EXPECT_NEAR(spring.torque(i, c), further.torque(further.segment_at(c + 0.5), c + 0.5),
                    1e-13);
      }
    }
  }
}

TEST(PolynomialSpring, IsThePolynomialAndItsIntegral) {
  const CompiledSpring spring = compile(PolynomialSpring{{0.5, 1, 0, 50}, 0.25});
  EXPECT_DOUBLE_EQ(spring.torque(0, 0.45), 0.5 + 0.2 + 50 * 0.008);
  EXPECT_DOUBLE_EQ(spring.energy(0, 0.45), 0.5 * 0.2 + 0.5 * 0.04 + 12.5 * 0.0016);
  EXPECT_EQ(spring.energy(0, 0.25), 0);
}

TEST(PolynomialSpring, GoesOnStraightOutsideItsRange) {
  const CompiledSpring spring = compile(PolynomialSpring{{0, 0, 0, 1}, 0, {-1, 2}});
  EXPECT_EQ(spring.torque(0, 3.0), 8 + 12 * 1);
  EXPECT_EQ(spring.stiffness(0, 3.0), 12);
  EXPECT_EQ(spring.torque(0, -2.0), -1 - 3);
  EXPECT_DOUBLE_EQ(spring.energy(0, 3.0), 4 + 8 + 6);
}

TEST(FormulaSpring, HasTheEnergyOfThePolynomialThatItIs) {
  for (const DeformationRange range : {DeformationRange{}, {-0.4, 0.3}, {0.1, 0.6}}) {
    const CompiledSpring formula = compile(FormulaSpring{cubic_formula(1, 50), 0.1, range}),
                         polynomial = compile(PolynomialSpring{{0, 1, 0, 50}, 0.1, range});
    for (const double c : places())
      EXPECT_NEAR(formula.energy(0, c), polynomial.energy(0, c),
                  1e-14 * (1 + std::abs(polynomial.energy(0, c))));
  }
}

TEST(LogarithmicSpring, FollowsTheLogarithmicStrainOfABar) {
  const double L0 = 1.2, L = 1.5;
  const CompiledSpring spring = compile(LogarithmicSpring{7, L0, L0});
  EXPECT_NEAR(spring.torque(0, L), 7 * L0 * std::log(L / L0), 1e-14);
  EXPECT_NEAR(spring.stiffness(0, L), 7 * L0 / L, 1e-14);
  EXPECT_NEAR(spring.energy(0, L), 7 * L0 * (L * std::log(L / L0) - L + L0), 1e-14);
  EXPECT_FALSE(std::isfinite(spring.torque(0, 0.0)));
  EXPECT_FALSE(std::isfinite(spring.torque(0, -1.0)));
}

TEST(PowerSpring, PushesOnItsSideOnly) {
  const CompiledSpring above = compile(PowerSpring{50, 2, 3, 0.1});
  ASSERT_THAT(above.breakpoints, ElementsAre(0.1));
  EXPECT_TRUE(above.is_free(0));
  EXPECT_DOUBLE_EQ(above.torque(1, 0.5), 50 * 0.008);
  EXPECT_DOUBLE_EQ(above.stiffness(1, 0.5), 50 * 3 * 0.04 / 2);
  const CompiledSpring below = compile(PowerSpring{50, 2, 1.5, 0.1, true});
  EXPECT_TRUE(below.is_free(1));
  EXPECT_DOUBLE_EQ(below.torque(0, -0.3), -50 * std::pow(0.2, 1.5));
  EXPECT_DOUBLE_EQ(below.energy(0, -0.3), 50 * 2 * std::pow(0.2, 2.5) / 2.5);
}

TEST(PowerSpring, IsAStraightOneSidedSpringWithExponentOne) {
  const CompiledSpring power = compile(PowerSpring{3, 0.5, 1, 0.2}),
                       straight = compile(OneSidedSpring{6, 0.2});
  for (const double c : places()) {
    EXPECT_NEAR(power.torque(1, c), straight.torque(1, c), 1e-14);
    EXPECT_NEAR(power.energy(1, c), straight.energy(1, c), 1e-14);
  }
}

TEST(TableSpring, GoesThroughItsPointsAndKeepsTheirShape) {
  const TableSpring table = some_table();
  const CompiledSpring spring = compile(table);
  for (std::size_t i = 0; i < table.torques.size(); ++i)
    EXPECT_NEAR(spring.torque(0, table.free + table.deformations[i]), table.torques[i], 1e-15);
  for (double c = -1; c < 2; c += 0.003) EXPECT_GE(spring.stiffness(0, c), -1e-14) << c;
  for (double u = 0.1; u < 0.4; u += 0.01)  // flat where the points are
    EXPECT_NEAR(spring.torque(0, table.free + u), 0.05, 1e-15);
}

TEST(TableSpring, HasContinuousTorqueStiffnessAndEnergyAtItsNodes) {
  const TableSpring table = some_table();
  const CompiledSpring spring = compile(table);
  for (const double u : table.deformations) {
    const double c = table.free + u, before = std::nextafter(c, -9), after = std::nextafter(c, 9);
    EXPECT_NEAR(spring.torque(0, before), spring.torque(0, after), 1e-14);
    EXPECT_NEAR(spring.stiffness(0, before), spring.stiffness(0, after), 1e-13);
    EXPECT_NEAR(spring.energy(0, before), spring.energy(0, after), 1e-15);
  }
  EXPECT_NEAR(spring.energy(0, table.free), 0, 1e-16);
}

TEST(TableSpring, IsTheStraightLineThroughPointsOnOne) {
  const CompiledSpring spring = compile(TableSpring{{0, 1, 3}, {1, 3, 7}});
  for (double c = -1; c < 5; c += 0.1) EXPECT_NEAR(spring.torque(0, c), 1 + 2 * c, 1e-14);
}

TEST(FallingLaws, ArePolynomialsThatFallSomewhereInTheirRange) {
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 1, 0, -20}}),
              ElementsAre(HasSubstr("falls below a deformation of -0.129099,")));
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 1, 0, -20}, 0, {}, true}), IsEmpty());
  const double turn = std::sqrt(1 / 60.0);
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 1, 0, -20}, 0, {-turn, turn}}), IsEmpty());
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 1, 0, -20}, 0, {-turn, turn + 1e-6}}),
              testing::SizeIs(1));
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 0, 0, 1}}), IsEmpty());
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 0, 1}}), testing::SizeIs(1));
  EXPECT_THAT(problems_in(PolynomialSpring{{0, -1}}), testing::SizeIs(1));
  EXPECT_THAT(problems_in(PolynomialSpring{{3}}), IsEmpty());
  // (u - 0.1)^3 touches, 2.5 u - 3 u^2 + u^3 falls between its turns.
  EXPECT_THAT(problems_in(PolynomialSpring{{-0.001, 0.03, -0.3, 1}}), IsEmpty());
  EXPECT_THAT(problems_in(PolynomialSpring{{0, 2.5, -3, 1}}), testing::SizeIs(1));
}

TEST(FallingLaws, AreFormulasWithANegativeStiffnessWithinTheirRange) {
  EXPECT_THAT(problems_in(FormulaSpring{cubic_formula(1, 50)}), IsEmpty());
  EXPECT_THAT(problems_in(FormulaSpring{cubic_formula(1, -20)}),
              ElementsAre(HasSubstr("falls below a deformation of -0.129099,")));
  EXPECT_THAT(problems_in(FormulaSpring{cubic_formula(1, -20), 0, {-0.1, 0.1}}), IsEmpty());
  EXPECT_THAT(problems_in(FormulaSpring{cubic_formula(0, 1)}), IsEmpty());
}

TEST(FallingLaws, AreToldWithTheStretchOnWhichTheyFall) {
  const auto text = [](const model::SpringLaw& law) { return problems_in(law).front(); };
  // c1 u + c3 u^3 turns at u = sqrt(-c1 / (3 c3)).
  EXPECT_THAT(text(PolynomialSpring{{0, -1, 0, 1}}),
              HasSubstr("falls between deformations of -0.57735 and 0.57735,"));
  EXPECT_THAT(text(FormulaSpring{cubic_formula(-1, 1)}),
              HasSubstr("falls between deformations of -0.57735 and 0.57735,"));
  EXPECT_THAT(text(PolynomialSpring{{0, 1, 0, -1}, 0, {0, 2}}),
              HasSubstr("falls between deformations of 0.57735 and 2,"));
  EXPECT_THAT(text(PolynomialSpring{{0, 0, 1}}), HasSubstr("falls below a deformation of 0,"));
  EXPECT_THAT(text(PolynomialSpring{{0, 1, -0.5}}), HasSubstr("falls above a deformation of 1,"));
  EXPECT_THAT(text(PolynomialSpring{{0, -1}}), HasSubstr("falls at every deformation,"));
}

TEST(SpringCurveProblems, AreToldInWords) {
  EXPECT_THAT(problems_in(LogarithmicSpring{1, 0, 0}), ElementsAre(HasSubstr("length: need")));
  EXPECT_THAT(problems_in(PowerSpring{1, 1, 0.5, 0}), ElementsAre(HasSubstr("exponent: need")));
  EXPECT_THAT(problems_in(PowerSpring{-1, 0, 2, 0}), testing::SizeIs(2));
  EXPECT_THAT(problems_in(TableSpring{{0, 1}, {1, 0}}), ElementsAre(HasSubstr("falling = true")));
  EXPECT_THAT(problems_in(TableSpring{{0, 1}, {1, 0}, 0, true}), IsEmpty());
  EXPECT_THAT(problems_in(TableSpring{{0}, {1}}), ElementsAre(HasSubstr("two or more")));
  EXPECT_THAT(problems_in(LinearSpring{-1, 0, true}), IsEmpty());
  EXPECT_THAT(problems_in(FormulaSpring{{{{Operation::variable}, {Operation::log, 0}}}}),
              ElementsAre(HasSubstr("finite torque at c = free")));
}

TEST(HoldsBothWays, IsTrueOfLawsWhoseEnergyGrowsWithoutBound) {
  EXPECT_TRUE(holds_both_ways(compile(LinearSpring{1, 0})));
  EXPECT_TRUE(holds_both_ways(compile(PolynomialSpring{{0, 1, 0, 50}})));
  EXPECT_FALSE(holds_both_ways(compile(PolynomialSpring{{0, 1, 0, -50}, 0, {}, true})));
  EXPECT_FALSE(holds_both_ways(compile(PolynomialSpring{{0, 1, 1}, 0, {}, true})));
  EXPECT_FALSE(holds_both_ways(compile(PowerSpring{1, 1, 2, 0})));
  EXPECT_TRUE(holds_both_ways(compile(TableSpring{{0, 1, 3}, {0, 1, 4}})));
  EXPECT_FALSE(holds_both_ways(compile(TableSpring{{0, 1, 3}, {0, 1, 1}})));
}

TEST(PartsOfACurve, AreTheCurveUpToItsBendsAndSmoothBeyond) {
  for (const SpringLaw& law : all_curves()) {
    const CompiledSpring spring = compile(law);
    for (const SpringCurve& curve : spring.curves) {
      const std::vector<double> bends = bends_of(curve);
      for (std::size_t part = 0; part <= bends.size(); ++part) {
        const SpringCurve held = part_of(curve, part);
        const double low = part > 0 ? bends[part - 1] : bends.empty() ? -0.1 : bends[0] - 1;
        const double high = part < bends.size() ? bends[part] : low + 1;
        for (const double share : {0.01, 0.5, 0.99}) {
          const double c = low + share * (high - low);
          const Jet<double> own = torque_of<double>(curve, c), there = torque_of<double>(held, c);
          if (std::isnan(own.value)) continue;  // outside of its domain
          EXPECT_NEAR(there.value, own.value, 1e-14);
          EXPECT_NEAR(there.slope, own.slope, 1e-13);
          EXPECT_NEAR(there.bend, own.bend, 1e-11);
          EXPECT_NEAR(energy_of<double>(held, c), energy_of<double>(curve, c), 1e-13);
        }
        if (part < bends.size()) {
          constexpr double beside = 1e-6, of_slope = 1e-3;
          const double below = torque_of<double>(held, high - beside).bend,
                       above = torque_of<double>(held, high + beside).bend;
          EXPECT_NEAR(above, below, of_slope * std::max(1.0, std::abs(below)));
        }
      }
    }
  }
}

TEST(PartsOfACurve, MeetAtBendsWithOneTorqueAndOneSlope) {
  for (const SpringLaw& law : all_curves())
    for (const SpringCurve& curve : compile(law).curves) {
      const std::vector<double> bends = bends_of(curve);
      for (std::size_t k = 0; k < bends.size(); ++k) {
        const Jet<double> below = torque_of<double>(part_of(curve, k), bends[k]),
                          above = torque_of<double>(part_of(curve, k + 1), bends[k]);
        EXPECT_NEAR(below.value, above.value, 1e-13);
        EXPECT_NEAR(below.slope, above.slope, 1e-12);
      }
    }
}

}  // namespace
}  // namespace springfold::model
