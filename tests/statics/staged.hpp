// Random mechanisms of all kinds, and one state of them in stages and densely. Fixed seeds only.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "model/random_chain.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/statics/stages.hpp"
#include "statics/examples.hpp"

namespace springfold::statics {

using model::JointKind;
using model::JointRole;
using model::random_pose;
using model::random_unit;
using model::random_vector;
using model::TaskSpace;

inline double number(std::mt19937& random, double size) {
  return random_vector(random, 1, size)[0];
}
inline int choice(std::mt19937& random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(random);
}

inline model::SpringLaw random_law(std::mt19937& random) {
  const double k = 0.2 + std::abs(number(random, 3)), at = number(random, 1);
  switch (choice(random, 4)) {
    case 3:
      return model::PolynomialSpring{{0, k, 0.1, 0.2}, at, {}, true};
    case 0:
      return model::LinearSpring{k, at};
    case 1:
      return model::OneSidedSpring{.stiffness = k, .from = at};
    default:
      return model::PiecewiseLinearSpring{.breakpoints = {at, at + 0.5},
                                          .stiffnesses = {k, 0, 2 * k}};
  }
}

inline model::Joint random_joint(std::mt19937& random, bool in_plane) {
  model::Joint joint{.axis = random_unit(random)};
  joint.kind = choice(random, 4) == 0 ? JointKind::prismatic : JointKind::revolute;
  if (in_plane && joint.kind == JointKind::revolute)
    joint.axis = (choice(random, 2) ? -1 : 1) * Vec3::UnitZ();
  if (in_plane && joint.kind == JointKind::prismatic)
    joint.axis = Vec3(joint.axis[0], joint.axis[1], 0).normalized();
  const int role = choice(random, 10);
  joint.role = role < 2   ? JointRole::passive
               : role < 3 ? JointRole::actuated
               : role < 6 ? JointRole::preloaded
                          : JointRole::compliant;
  if (role >= 3 || choice(random, 2) == 0)
    if (joint.role != JointRole::passive) joint.spring = random_law(random);
  joint.command = number(random, 0.5);
  return joint;
}

struct Sort {
  bool in_plane = false;
  int joints = 5;
  bool elastic = false;  ///< coupled springs of several neighbouring joints
  bool loaded = false;   ///< masses and forces along the chain
};

inline model::Chain random_chain(std::mt19937& random, const Sort& sort, const std::string& name,
                                 Index from, Index to) {
  model::Chain chain{.name = name, .from = from, .to = to};
  chain.from_attachment = random_pose(random, sort.in_plane);
  chain.to_attachment = random_pose(random, sort.in_plane);
  for (int j = 0; j < sort.joints; ++j) {
    model::Joint joint = random_joint(random, sort.in_plane);
    joint.name = "j" + std::to_string(j);
    chain.elements.push_back(joint);
    if (choice(random, 3) > 0)
      chain.elements.push_back(model::RigidLink{random_pose(random, sort.in_plane)});
    if (!sort.loaded) continue;
    model::ChainPoint point{.name = "p" + std::to_string(j),
                            .elements_before = chain.elements.size()};
    point.at = random_vector(random, 3, 1);
    point.mass = choice(random, 2) * std::abs(number(random, 0.3));
    chain.points.push_back(point);
  }
  if (sort.elastic)
    for (int g = 0; g < 3; ++g) {
      const int size = sort.in_plane ? 3 : 6;
      model::CoupledSpring spring{.name = "g" + std::to_string(g)};
      const Matrix half = random_vector(random, size * size, 1).reshaped(size, size);
      spring.stiffness = half * half.transpose() + Matrix::Identity(size, size);
      spring.stiffness = Matrix(0.5 * (spring.stiffness + spring.stiffness.transpose()));
      spring.free = random_vector(random, size, 0.3);
      for (int i = 0; i < size; ++i) {
        model::Joint joint = random_joint(random, sort.in_plane);
        joint.name = "g" + std::to_string(g) + std::to_string(i);
        joint.role = JointRole::compliant;
        joint.spring.reset();
        spring.elements.push_back(chain.elements.size());
        chain.elements.push_back(joint);
      }
      chain.elements.push_back(model::RigidLink{random_pose(random, sort.in_plane)});
      chain.coupled_springs.push_back(spring);
    }
  return chain;
}

inline model::Mechanism random_mechanism(std::mt19937& random, const Sort& sort,
                                         const std::vector<TaskSpace>& bodies,
                                         const std::vector<std::pair<Index, Index>>& chains) {
  model::Mechanism m;
  for (const TaskSpace space : bodies)
    m.bodies.push_back({"b" + std::to_string(m.bodies.size()), space,
                        random_vector(random, dimension(space), 0.7)});
  for (const auto& [from, to] : chains)
    m.chains.push_back(random_chain(random, sort, "c" + std::to_string(m.chains.size()), from, to));
  if (!sort.loaded) return m;
  m.gravity = random_vector(random, 3, 2);
  for (std::size_t i = 0; i < m.chains.size(); ++i) {
    model::Load load{.name = "f" + std::to_string(i), .vector = random_vector(random, 3, 2)};
    load.on.chain = static_cast<Index>(i);
    load.on.point = m.chains[i].points.size() / 2;
    m.loads.push_back(load);
  }
  return m;
}

/// A state, not an equilibrium, and everything of it both ways.
struct Both {
  System system;
  Inputs inputs{};
  Piece piece{};
  Vector z{}, residual{}, dense_residual{};
  Matrix A{}, dR_drho{};
  StagePlan plan{};
  StageMatrix matrix{};

  Both(std::mt19937& random, const model::Mechanism& m, const StageOptions& options = {},
       double wrench = 2)
      : system{prepare(m)} {
    EXPECT_TRUE(problems_in(m).empty()) << problems_in(m).front();
    z = random_vector(random, system.size, 0.8);
    for (Index i = 0; i < system.size; ++i)
      if (system.is_wrench[static_cast<std::size_t>(i)]) z[i] *= wrench;
    inputs = {random_vector(random, system.commands.size(), 0.5),
              random_vector(random, system.load_size, 1)};
    evaluate(options);
  }
  Both(const model::Mechanism& m, const Vector& state, const StageOptions& options = {})
      : system{prepare(m)}, z{state} {
    inputs = {system.commands, Vector::Zero(system.load_size)};
    evaluate(options);
  }
  void evaluate(const StageOptions& options) {
    piece = piece_at(system, z);
    Workspace work;
    EXPECT_TRUE(equilibrium_matrix(system, piece, z, inputs, work, dense_residual, A, &dR_drho));
    plan = plan_stages(system, {}, options);
    EXPECT_TRUE(equilibrium_stages(plan, system, piece, z, inputs, {}, {}, residual, matrix));
  }
  /// The expanded matrix without its scales, auxiliary variables eliminated.
  Matrix schur() const {
    const Index n = plan.size(), all = plan.pattern.size;
    const Matrix unit = matrix.scale.cwiseInverse().asDiagonal();
    const Matrix M = unit * product(plan.pattern, matrix.values, matrix.root, {}, unit);
    if (all == n) return M;
    return M.topLeftCorner(n, n) -
           M.topRightCorner(n, all - n) * M.bottomRightCorner(all - n, all - n)
                                              .fullPivLu()
                                              .solve(M.bottomLeftCorner(all - n, n));
  }
};

inline void expect_equal(const Both& both, std::mt19937& random) {
  const double size = both.A.cwiseAbs().maxCoeff();
  const double loads = both.dense_residual.cwiseAbs().maxCoeff();
  EXPECT_LT((both.residual - both.dense_residual).cwiseAbs().maxCoeff(), 1e-12 * (1 + loads));
  EXPECT_LT((both.schur() - both.A).cwiseAbs().maxCoeff(), 1e-12 * size);
  const Vector dz = random_vector(random, both.system.size, 1);
  const Vector drho = random_vector(random, both.inputs.rho.size(), 1);
  const Vector product = stage_product(both.plan, both.system, both.matrix, dz, drho);
  EXPECT_LT((product - both.A * dz - both.dR_drho * drho).cwiseAbs().maxCoeff(), 1e-11 * size);
}

inline Matrix with_borders(const Matrix& A, const FrontalBorders& borders) {
  const Index n = A.rows(), k = borders.B.cols();
  Matrix M(n + k, n + k);
  if (k == 0) return A;
  M << A, borders.B, borders.C.transpose(), borders.D;
  return M;
}

inline FrontalBorders random_borders(std::mt19937& random, Index n, Index k) {
  return {random_vector(random, n * k, 1).reshaped(n, k),
          random_vector(random, n * k, 1).reshaped(n, k),
          random_vector(random, k * k, 1).reshaped(k, k)};
}

inline void expect_solved(const Both& both, const FrontalBorders& borders, std::mt19937& random) {
  StageSolver solver(both.plan);
  ASSERT_TRUE(solver.factorise(both.matrix, borders));
  const Matrix M = with_borders(both.A, borders);
  const Matrix R = random_vector(random, 2 * M.rows(), 1).reshaped(M.rows(), 2);
  const double size = M.cwiseAbs().rowwise().sum().maxCoeff();
  for (const bool transposed : {false, true}) {
    Matrix X = R;
    ASSERT_TRUE(transposed ? solver.solve_transposed(X) : solver.solve(X));
    const Matrix miss = (transposed ? Matrix(M.transpose()) : M) * X - R;
    EXPECT_LT(miss.cwiseAbs().maxCoeff(), 1e-13 * (size * X.cwiseAbs().maxCoeff() + 1));
  }
}

inline const std::vector<std::pair<std::vector<TaskSpace>, std::vector<std::pair<Index, Index>>>>
    kinds{{{TaskSpace::xy}, {{0, 1}, {0, 1}}},
          {{TaskSpace::planar}, {{0, 1}, {0, 1}, {1, 0}}},
          {{TaskSpace::xyz}, {{0, 1}, {0, 1}}},
          {{TaskSpace::spatial}, {{0, 1}, {1, 0}}},
          {{TaskSpace::planar, TaskSpace::planar}, {{0, 1}, {1, 2}, {2, 0}}},
          {{TaskSpace::spatial, TaskSpace::spatial}, {{0, 1}, {1, 2}, {0, 2}}},
          {{TaskSpace::spatial, TaskSpace::planar}, {{0, 1}, {1, 2}, {2, 1}}},
          {{TaskSpace::xy, TaskSpace::spatial}, {{0, 1}, {1, 2}, {2, 0}}}};

inline bool in_plane(const std::vector<TaskSpace>& bodies) {
  for (const TaskSpace space : bodies)
    if (space == TaskSpace::xyz || space == TaskSpace::spatial) return false;
  return true;
}

}  // namespace springfold::statics
