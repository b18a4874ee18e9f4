#include "springfold/model/spring_law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using Side = OneSidedSpring::Side;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A gap with play on both sides, a soft and a hard stop, preloaded in the middle of a segment.
PiecewiseLinearSpring five_segments() {
  return {.breakpoints = {-1.3, -0.4, 0.25, 1.7},
          .stiffnesses = {50, 0.3, 0, 2.7, 8},
          .free = 0.1,
          .preload = -0.35};
}

std::vector<SpringLaw> all_laws() {
  return {LinearSpring{3.7, -0.2},
          LinearSpring{0, 1},
          OneSidedSpring{0.5, 0.26, Side::above},
          OneSidedSpring{0.5, 0.26, Side::below},
          PiecewiseLinearSpring{{}, {1.5}, 0.3, 0.7},
          PiecewiseLinearSpring{{-0.1, 0.2}, {4, 0, 9}, 0, 0},
          PiecewiseLinearSpring{{-0.1, 0.2}, {4, 1, 9}, 0.9, 2},
          PiecewiseLinearSpring{{-0.1, 0.2}, {4, 1, 9}, 0.2, 2},
          PiecewiseLinearSpring{{-0.1, 0.2}, {4, 1, 9}, -3, 2},
          five_segments()};
}

TEST(SpringLaw, HasATorqueAtTheNearestCoordinateWhereItHasItAtAll) {
  const CompiledSpring gap = compile(PiecewiseLinearSpring{{-0.1, 0.2}, {4, 0, 8}, 0, 0});
  EXPECT_EQ(coordinate_of_torque(gap, 4, 0), 0.7);
  EXPECT_EQ(coordinate_of_torque(gap, -4, 3), -1.1);
  EXPECT_EQ(coordinate_of_torque(gap, 0, 3), 0.2);
  EXPECT_EQ(coordinate_of_torque(gap, 0, 0.125), 0.125);
  const CompiledSpring cable = compile(OneSidedSpring{2, 0.5, Side::above});
  EXPECT_EQ(coordinate_of_torque(cable, 1, 0), 1);
  EXPECT_EQ(coordinate_of_torque(cable, -1, 0), std::nullopt);
}

TEST(SpringLaw, TorqueIsTheDerivativeOfTheEnergyInEverySegment) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (const SpringLaw& law : all_laws()) {
    const CompiledSpring spring = compile(law);
    for (int trial = 0; trial < 100; ++trial) {
      const double c = uniform(random);  // also outside the segment: its analytic continuation
      for (std::size_t i = 0; i < spring.segments.size(); ++i) {
        const double rate = spring.energy(i, Complex(c, 1e-30)).imag() / 1e-30;
        EXPECT_NEAR(spring.torque(i, c), rate, 1e-10 * (1 + std::abs(rate))) << "c = " << c;
      }
    }
  }
}

TEST(SpringLaw, StiffnessIsTheDerivativeOfTheTorqueInEverySegment) {
  for (const SpringLaw& law : all_laws()) {
    const CompiledSpring spring = compile(law);
    for (std::size_t i = 0; i < spring.segments.size(); ++i)
      for (const double c : {-3.0, -0.1, 0.0, 0.2, 2.0})
        EXPECT_EQ(spring.torque(i, Complex(c, 1e-30)).imag() / 1e-30, spring.segments[i].stiffness);
  }
}

TEST(SpringLaw, NeighbouringSegmentsAgreeAtTheirBreakpointToTheLastBit) {
  for (const SpringLaw& law : all_laws()) {
    const CompiledSpring spring = compile(law);
    ASSERT_EQ(spring.segments.size(), spring.breakpoints.size() + 1);
    for (std::size_t i = 0; i < spring.breakpoints.size(); ++i) {
      const double b = spring.breakpoints[i];
      EXPECT_EQ(spring.torque(i, b), spring.torque(i + 1, b)) << "breakpoint " << b;
      EXPECT_EQ(spring.energy(i, b), spring.energy(i + 1, b)) << "breakpoint " << b;
    }
  }
}

TEST(SpringLaw, TorqueNeverFallsAlongTheCoordinate) {
  for (const SpringLaw& law : all_laws()) {
    const CompiledSpring spring = compile(law);
    double last = -infinity;
    for (double c = -3; c < 3; c += 0.01) {
      const double torque = spring.torque(spring.segment_at(c), c);
      EXPECT_GE(torque, last - 1e-14) << "c = " << c;
      last = torque;
    }
  }
}

TEST(LinearSpring, IsHookesLawFromItsFreeCoordinate) {
  const CompiledSpring spring = compile(LinearSpring{3, 0.5});
  ASSERT_THAT(spring.breakpoints, IsEmpty());
  EXPECT_EQ(spring.torque(0, 0.5), 0);
  EXPECT_EQ(spring.torque(0, 2.5), 6);
  EXPECT_EQ(spring.energy(0, 2.5), 6);
}

TEST(OneSidedSpring, ActsOnItsSideOnly) {
  const CompiledSpring above = compile(OneSidedSpring{2, 0.25, Side::above});
  EXPECT_EQ(above.torque(above.segment_at(0.2), 0.2), 0);
  EXPECT_EQ(above.torque(above.segment_at(0.75), 0.75), 1);
  const CompiledSpring below = compile(OneSidedSpring{2, 0.25, Side::below});
  EXPECT_EQ(below.torque(below.segment_at(0.3), 0.3), 0);
  EXPECT_EQ(below.torque(below.segment_at(-0.25), -0.25), -1);
}

TEST(OneSidedSpring, SidesAreMirrorImages) {
  const CompiledSpring above = compile(OneSidedSpring{2.3, 0.4, Side::above});
  const CompiledSpring below = compile(OneSidedSpring{2.3, -0.4, Side::below});
  for (double c = -2; c < 2; c += 0.037) {
    const std::size_t i = above.segment_at(c), j = below.segment_at(-c);
    EXPECT_EQ(above.torque(i, c), -below.torque(j, -c)) << "c = " << c;
    EXPECT_EQ(above.energy(i, c), below.energy(j, -c)) << "c = " << c;
  }
}

TEST(PiecewiseLinearSpring, HasNoTorqueInItsGap) {
  const CompiledSpring gap = compile(PiecewiseLinearSpring{{-0.1, 0.2}, {4, 0, 9}, 0, 0});
  for (double c = -0.1; c <= 0.2; c += 0.01) EXPECT_EQ(gap.torque(gap.segment_at(c), c), 0);
  EXPECT_DOUBLE_EQ(gap.torque(gap.segment_at(0.5), 0.5), 9 * 0.3);
  EXPECT_DOUBLE_EQ(gap.torque(gap.segment_at(-0.5), -0.5), -4 * 0.4);
  EXPECT_DOUBLE_EQ(gap.energy(gap.segment_at(0.5), 0.5), 0.5 * 9 * 0.3 * 0.3);
}

TEST(PiecewiseLinearSpring, CarriesThePreloadAtItsFreeCoordinate) {
  for (const double free : {-5.0, -1.3, -0.7, 0.1, 0.25, 1.0, 3.0}) {
    PiecewiseLinearSpring law = five_segments();
    law.free = free;
    const CompiledSpring spring = compile(law);
    const std::size_t home = spring.segment_at(free);
    EXPECT_EQ(spring.torque(home, free), -0.35) << "free = " << free;
    EXPECT_EQ(spring.energy(home, free), 0) << "free = " << free;
  }
}

TEST(PiecewiseLinearSpring, AddsUpItsSlopes) {
  const CompiledSpring spring = compile(five_segments());
  const auto torque = [&](double c) { return spring.torque(spring.segment_at(c), c); };
  EXPECT_NEAR(torque(2.0), -0.35 + 2.7 * (1.7 - 0.25) + 8 * (2.0 - 1.7), 1e-14);
  EXPECT_NEAR(torque(-2.0), -0.35 - 0.3 * (1.3 - 0.4) - 50 * (2.0 - 1.3), 1e-13);
}

TEST(CompiledSpring, ABreakpointBelongsToTheUpperSegment) {
  const CompiledSpring spring = compile(five_segments());
  for (std::size_t i = 0; i < spring.breakpoints.size(); ++i) {
    const double b = spring.breakpoints[i];
    EXPECT_EQ(spring.segment_at(std::nextafter(b, -10)), i);
    EXPECT_EQ(spring.segment_at(b), i + 1);
    EXPECT_EQ(spring.segment_at(std::nextafter(b, 10)), i + 1);
  }
  EXPECT_EQ(spring.segment_at(-infinity), 0u);
  EXPECT_EQ(spring.segment_at(infinity), 4u);
}

TEST(SpringLawProblems, AreNoneForUsableLaws) {
  for (const SpringLaw& law : all_laws()) EXPECT_THAT(problems_in(law), IsEmpty());
}

TEST(SpringLawProblems, NameTheStiffnessThatIsNegativeOrNotFinite) {
  for (const double bad : {-1.0, not_a_number, infinity}) {
    const auto sentence = ElementsAre(HasSubstr("stiffness: need a finite number >= 0, got "));
    EXPECT_THAT(problems_in(LinearSpring{bad, 0}), sentence);
    EXPECT_THAT(problems_in(OneSidedSpring{bad, 0, Side::above}), sentence);
    EXPECT_THAT(problems_in(PiecewiseLinearSpring{{0}, {1, bad}, 0, 0}), sentence);
  }
}

TEST(SpringLawProblems, NameTheCoordinateThatIsNotFinite) {
  EXPECT_THAT(problems_in(LinearSpring{1, not_a_number}),
              ElementsAre("free: need a finite number"));
  EXPECT_THAT(problems_in(OneSidedSpring{1, infinity, Side::below}),
              ElementsAre("from: need a finite number"));
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{infinity}, {1, 1}, 0, 0}),
              ElementsAre("breakpoints: need a finite number"));
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{0}, {1, 1}, not_a_number, not_a_number}),
              ElementsAre("free: need a finite number", "preload: need a finite number"));
}

TEST(SpringLawProblems, CountTheSegments) {
  const auto sentence = ElementsAre("stiffnesses: need one more than breakpoints");
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{0, 1}, {1, 1}, 0, 0}), sentence);
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{}, {}, 0, 0}), sentence);
}

TEST(SpringLawProblems, WantBreakpointsInStrictlyIncreasingOrder) {
  const auto sentence = ElementsAre("breakpoints: need strictly increasing numbers");
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{0, 0}, {1, 1, 1}, 0, 0}), sentence);
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{1, -1}, {1, 1, 1}, 0, 0}), sentence);
}

TEST(SpringLawProblems, AreAllToldAtOnce) {
  EXPECT_THAT(problems_in(PiecewiseLinearSpring{{1, 0}, {-1, 1}, not_a_number, infinity}),
              testing::SizeIs(5));
}

}  // namespace
}  // namespace springfold::model
