// Random mechanisms that jump: a point on elastic bars, and rows of bistable units.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "springfold/analysis/study.hpp"

namespace springfold::bench {

struct Draw {
  model::Mechanism mechanism{};
  analysis::Study study{};
};

/// A uniform number. Bits of the generator are used as they are: library distributions differ between libraries.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A point with a mass on three to five bars (a hinge and an elastic slide each, closed chains) under a load in some
/// direction: a truss of von Mises without symmetry.
inline Draw random_truss(std::mt19937_64& random) {
  Draw draw;
  const double height = uniform(random, 0.6, 1.3), side = uniform(random, -0.2, 0.2);
  model::Body apex{.name = "apex", .task_space = model::TaskSpace::xy, .mass = 1};
  apex.pose = Eigen::Vector2d(side, height);
  draw.mechanism.bodies = {apex};
  const int bars = 3 + static_cast<int>(uniform(random, 0, 3));
  for (int i = 0; i < bars; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    const double foot = sign * uniform(random, 0.8, 1.6);
    const double length = std::hypot(side - foot, height);
    model::Chain bar{.name = "bar" + std::to_string(i + 1)};
    bar.from_attachment.p.x() = foot;
    model::Joint hinge{.name = "hinge", .initial = std::atan2(height, side - foot)};
    model::Joint slide{.name = "slide",
                       .kind = model::JointKind::prismatic,
                       .axis = model::Vec3<double>::UnitX(),
                       .role = model::JointRole::compliant,
                       .spring = model::LinearSpring{.stiffness = uniform(random, 0.5, 2)}};
    model::RigidLink link;
    link.transform.p.x() = length;
    bar.elements = {hinge, slide, link};
    draw.mechanism.chains.push_back(std::move(bar));
  }
  draw.study.name = "press";
  const double tilt = uniform(random, -0.3, 0.3);
  draw.study.direction = Eigen::Vector2d(std::sin(tilt), -std::cos(tilt));
  draw.study.until = {{"apex.y", -2.5, 2.5}, {"apex.x", -2.5, 2.5}, {"lambda", -3, 3}};
  return draw;
}

/// One bistable slide: a straight spring, and an oblique one whose foot is beside the line.
struct Unit {
  double straight = 0.3, free = 0;   ///< stiffness, position without force
  double oblique = 1, length = 2;    ///< stiffness, free length
  static constexpr double foot = 1;  ///< distance of the foot from the line
  static constexpr double start = -1.2;
};

inline std::vector<Unit> random_units(std::mt19937_64& random, int count) {
  std::vector<Unit> units(static_cast<std::size_t>(count));
  for (Unit& unit : units) {
    unit.free = uniform(random, -0.2, 0.35);
    unit.length = uniform(random, 1.8, 2.2);
  }
  return units;
}

/// Straight springs of all units with springs of stiffness `coupling` between the coordinates of neighbours, as one.
inline model::CoupledSpring coupled(const std::vector<Unit>& units, double coupling) {
  const auto n = static_cast<Index>(units.size());
  model::CoupledSpring spring{.name = "coupling"};
  spring.stiffness = Matrix::Zero(n, n);
  Vector pull(n);
  for (Index i = 0; i < n; ++i) {
    const Unit& unit = units[static_cast<std::size_t>(i)];
    spring.elements.push_back(static_cast<std::size_t>(i));
    spring.stiffness(i, i) += unit.straight;
    pull[i] = unit.straight * unit.free;
    if (i + 1 == n) continue;
    spring.stiffness.block<2, 2>(i, i) += coupling * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  }
  spring.free = spring.stiffness.ldlt().solve(pull);
  return spring;
}

/// Slides in a row with a mass at the end of each: one coordinate per unit, no loops.
inline Draw row_of(const std::vector<Unit>& units, double coupling) {
  Draw draw;
  model::Chain row{.name = "row"};
  row.points.push_back({.name = "p0"});
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    model::Joint slide{.name = "unit" + number,
                       .kind = model::JointKind::prismatic,
                       .axis = model::Vec3<double>::UnitX(),
                       .role = model::JointRole::compliant,
                       .initial = Unit::start};
    if (coupling == 0)
      slide.spring = model::LinearSpring{.stiffness = units[i].straight, .free = units[i].free};
    row.elements.push_back(slide);
    row.points.push_back({.name = "p" + number, .elements_before = i + 1, .mass = 1});
    draw.mechanism.line_springs.push_back(
        {.name = "oblique" + number,
         .from = {.chain = 0, .point = i, .at = {0, Unit::foot, 0}},
         .to = {.chain = 0, .point = i + 1},
         .stiffness = units[i].oblique,
         .free = units[i].length});
  }
  if (coupling != 0) row.coupled_springs.push_back(coupled(units, coupling));
  model::Body end{.name = "end", .task_space = model::TaskSpace::xy};
  end.pose = Eigen::Vector2d(Unit::start * static_cast<double>(units.size()), 0);
  draw.mechanism.bodies = {end};
  draw.mechanism.chains = {row};
  draw.study.name = "pull";
  draw.study.direction = Eigen::Vector2d(1, 0);
  draw.study.until = {{"lambda", -0.6, 0.6}};
  return draw;
}

}  // namespace springfold::bench
