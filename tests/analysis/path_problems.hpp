// Paths of small mechanisms, as the engine sees them.
#pragma once

#include <gtest/gtest.h>

#include "analysis/path_problem.hpp"
#include "command_mechanisms.hpp"

namespace springfold::analysis {

/// The tool pushed by lambda along a direction, or moved where `held`.
inline PathProblem problem_of(const model::SpringLaw& knee, bool held) {
  const statics::System system = statics::prepare(orthoglide(knee));
  const Vector along = Vector{{1, -0.3}}.normalized(), none = Vector::Zero(2);
  PathRule rule{.t_start = none, .t_rate = held ? along : none};
  rule.N = held ? Matrix(Vector{{-along[1], along[0]}}) : Matrix(Matrix::Identity(2, 2));
  rule.rho_start = system.commands;
  rule.rho_rate = none;
  rule.W_start = none;
  rule.W_rate = held ? none : along;
  return {system, rule};
}

/// The piece on whose side of all switches a point lies.
inline Piece piece_at(const PathProblem& problem, const Vector& y) {
  Vector g;
  Piece piece;
  EXPECT_TRUE(problem.switches(y, 0, g));
  for (const double value : g) piece.push_back(static_cast<std::int8_t>(value > 0 ? 1 : -1));
  return piece;
}

/// A straight column of links with springs between them, pushed askew. In space they turn about x, y and z one after
/// the other.
inline PathProblem column(int links, model::TaskSpace space = model::TaskSpace::xy) {
  using namespace model;
  const Index d = dimension(space);
  Mechanism m;
  m.bodies.push_back({"tip", space, Vector::Unit(d, 0)});
  Chain chain{.name = "column"};
  for (int i = 0; i < links; ++i) {
    Joint joint{
        .name = "j" + std::to_string(i + 1), .role = JointRole::preloaded, .spring = linear(links)};
    if (space == TaskSpace::spatial) joint.axis = Vec3<double>::Unit(i % 3);
    chain.elements.push_back(joint);
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX() / links}});
  }
  m.chains.push_back(chain);
  const statics::System system = statics::prepare(m);
  const Vector none = Vector::Zero(d);
  PathRule rule{.t_start = none, .t_rate = none};
  rule.N = Matrix::Identity(d, d);
  rule.rho_start = rule.rho_rate = system.commands;
  rule.W_start = none;
  rule.W_rate = -Vector::Unit(d, 0) - 0.1 * Vector::Unit(d, 1);
  return {system, rule};
}

/// A chain bent into a bow, from the origin to (1, 0); headings change by `bend` all in all.
inline model::Chain bow(int links, double bend) {
  using namespace model;
  const auto turn = [](double angle) {
    return RigidLink{{rotation_about<double>(Vec3<double>::UnitZ(), angle), Vec3<double>::Zero()}};
  };
  const double between = -bend / links, first = (bend + between) / 2;
  double span = 0;
  for (int i = 0; i < links; ++i) span += std::cos(first + i * between);
  Chain chain{.name = "bow", .elements = {turn(first)}};
  for (int i = 0; i < links; ++i) {
    chain.elements.push_back(Joint{.name = "j" + std::to_string(i + 1),
                                   .role = JointRole::preloaded,
                                   .spring = linear(links)});
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX() / span}});
    chain.elements.push_back(turn(between));
  }
  chain.elements.push_back(turn(first - between));
  return chain;
}

/// Bows that meet in a planar body, which is pushed against one of them, or moved across it where `held`.
inline PathProblem bows(int links, int fewer, bool held) {
  model::Mechanism m;
  m.bodies.push_back({"joint", model::TaskSpace::planar, Vector{{1, 0, 0}}});
  m.chains = {bow(links, 1), bow(fewer, -1), bow(links, 2)};
  for (std::size_t i = 0; i < m.chains.size(); ++i) m.chains[i].name += std::to_string(i + 1);
  const statics::System system = statics::prepare(m);
  const Vector none = Vector::Zero(3);
  PathRule rule{.t_start = none, .t_rate = none, .N = Matrix::Identity(3, 3)};
  rule.rho_start = rule.rho_rate = system.commands;
  rule.W_start = rule.W_rate = none;
  if (held) {
    rule.t_rate[1] = 1;
    rule.N = Matrix{{1, 0}, {0, 0}, {0, 1}};
  } else {
    rule.W_rate = Vector{{-1, -0.1, 0}};
  }
  return {system, rule};
}

}  // namespace springfold::analysis
