#include <cmath>
#include <limits>

#include "flow.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Rate at which gaps of closures fade [1/time]: faster than what moves, slow for the integrator.
constexpr double fading = 50;
/// A motion whose mass or damping is below this part of the largest has none.
constexpr double none_part = 1e-9;

/// Pi's gradient, the closures and their derivatives, without second order.
struct First {
  Vector gradient{}, gap{};
  Matrix closing{};
};

struct Evaluated {
  Vector r{};
  Matrix A{};
};

std::optional<Evaluated> evaluate(const Landscape& landscape, const Vector& x, const Piece& piece) {
  Evaluated at;
  Vector b;
  const Terrain& terrain = landscape.terrain();
  if (!terrain.problem.equations(x, terrain.lambda, piece, at.r, at.A, b)) return std::nullopt;
  return at;
}

std::optional<First> first_order(const Landscape& landscape, const Vector& x, const Piece& piece) {
  Vector plain = x;
  plain(landscape.multipliers()).setZero();
  const auto at = evaluate(landscape, plain, piece);
  if (!at) return std::nullopt;
  return First{at->r(landscape.moving()), at->r(landscape.multipliers()),
               at->A(landscape.multipliers(), landscape.moving())};
}

Matrix damping_of(const Motion& motion) {
  const Matrix& D = motion.landscape.terrain().damping;
  const auto n = static_cast<Index>(motion.landscape.moving().size());
  return motion.damping_factor * (D.size() > 0 ? D : Matrix(Matrix::Identity(n, n)));
}

/// Solves W a + J^T nu = p, J a = q for symmetric W, positive on the kernel of J.
struct Balanced {
  Vector a{}, nu{};
};
std::optional<Balanced> balance(const Matrix& W, const Closings& closings, const Vector& p,
                                const Vector& q) {
  Balanced result{closings.least_norm(q), {}};
  const Matrix Z = closings.motions();
  if (Z.cols() > 0) {
    const Matrix reduced = Z.transpose() * W * Z;
    const Vector values = symmetric_eigenvalues(reduced);
    if (!(values.minCoeff() > none_part * values.maxCoeff())) return std::nullopt;
    result.a += Z * solve_definite(reduced, Vector(Z.transpose() * (p - W * result.a)));
  }
  result.nu = closings.multipliers(p - W * result.a);
  return result;
}

/// Rates of the closures' derivatives along directions of the moving unknowns, one matrix each: second derivatives of
/// every closure, since the matrix is linear in the multipliers.
/// @param plain  that matrix without multipliers
template <class... Directions>
std::optional<std::vector<Matrix>> bends(const Landscape& landscape, const Vector& x,
                                         const Piece& piece, const Matrix& plain,
                                         const Directions&... along) {
  const auto& multipliers = landscape.multipliers();
  const auto m = static_cast<Index>(multipliers.size());
  std::vector<Matrix> rates(sizeof...(along), Matrix(m, plain.cols()));
  Vector state = x;
  for (Index i = 0; i < m; ++i) {
    state(multipliers).setZero();
    state[multipliers[static_cast<std::size_t>(i)]] = 1;
    const auto one = evaluate(landscape, state, piece);
    if (!one) return std::nullopt;
    const Matrix second = one->A(landscape.moving(), landscape.moving()) - plain;
    std::size_t k = 0;
    ((rates[k++].row(i) = (second * along).transpose()), ...);
  }
  return rates;
}

///     ┌ W  J^T ┐
///     └ J   0  ┘
Matrix bordered(const Matrix& W, const Matrix& J) {
  const Index n = W.rows(), m = J.rows();
  Matrix left = Matrix::Zero(n + m, n + m);
  left.topLeftCorner(n, n) = W;
  left.topRightCorner(n, m) = J.transpose();
  left.bottomLeftCorner(m, n) = J;
  return left;
}

/// Second derivatives of the derivatives of closures and masses along v, by differences of fourth order.
struct Third {
  Matrix closing{};
  std::vector<Matrix> jacobians{};
};
std::optional<Third> third_along(const Motion& motion, const Vector& x, const Vector& v,
                                 const Piece& piece, const First& at,
                                 const std::vector<MassPoint>& masses) {
  Third third{Matrix::Zero(at.closing.rows(), at.closing.cols()), {}};
  for (const MassPoint& mass : masses)
    third.jacobians.push_back(Matrix::Zero(mass.jacobian.rows(), mass.jacobian.cols()));
  const double speed = v.lpNorm<Eigen::Infinity>();
  if (!(speed > 0)) return third;
  const double h = 1e-3 / speed;
  const auto add = [&](double weight, const Matrix& closing, const std::vector<MassPoint>& beside) {
    third.closing += weight / (h * h) * closing;
    for (std::size_t i = 0; i < beside.size(); ++i)
      third.jacobians[i] += weight / (h * h) * beside[i].jacobian;
  };
  add(-30.0 / 12, at.closing, masses);
  for (const auto& [steps, weight] :
       {std::pair{-2.0, -1.0 / 12}, {-1.0, 16.0 / 12}, {1.0, 16.0 / 12}, {2.0, -1.0 / 12}}) {
    Vector beside = x;
    beside(motion.landscape.moving()) += steps * h * v;
    const auto there = first_order(motion.landscape, beside, piece);
    if (!there) return std::nullopt;
    add(weight, there->closing, motion.masses(beside));
  }
  return third;
}

}  // namespace

std::optional<FlowRate> overdamped_rate(const Motion& motion, const Vector& x, const Piece& piece) {
  const auto at = first_order(motion.landscape, x, piece);
  if (!at) return std::nullopt;
  const Matrix D = damping_of(motion);
  const Closings closings(at->closing, motion.landscape.terrain().redundant);
  const auto solved = balance(D, closings, -at->gradient, -fading * at->gap);
  if (!solved) return std::nullopt;
  return FlowRate{solved->a, solved->nu, solved->a.dot(D * solved->a)};
}

std::optional<Closings> put_on_closures(const Landscape& landscape, Vector& x, const Piece& piece) {
  if (!landscape.close(x)) return std::nullopt;
  const auto at = first_order(landscape, x, piece);
  if (!at) return std::nullopt;
  return Closings(at->closing, landscape.terrain().redundant);
}

std::optional<Matrix> overdamped_jacobian(const Motion& motion, const Vector& x, const Piece& piece,
                                          const FlowRate& at) {
  const auto& moving = motion.landscape.moving();
  const auto& multipliers = motion.landscape.multipliers();
  const auto n = static_cast<Index>(moving.size()), m = static_cast<Index>(multipliers.size());
  Vector state = x;
  state(multipliers).setZero();
  const auto plain = evaluate(motion.landscape, state, piece);
  state(multipliers) = at.multipliers;
  const auto loaded = evaluate(motion.landscape, state, piece);
  if (!plain || !loaded) return std::nullopt;
  const Matrix J = plain->A(multipliers, moving);
  const auto bent = bends(motion.landscape, x, piece, plain->A(moving, moving), at.rate);
  if (!bent) return std::nullopt;
  Matrix right(n + m, n);
  right.topRows(n) = -loaded->A(moving, moving);
  right.bottomRows(m) = -fading * J - bent->front();
  return Matrix(least_squares_of_columns(bordered(damping_of(motion), J), right).topRows(n));
}

std::optional<FlowRate> inertial_rate(const Motion& motion, const Vector& x, const Vector& v,
                                      const Piece& piece) {
  const Landscape& landscape = motion.landscape;
  const auto at = first_order(landscape, x, piece);
  if (!at) return std::nullopt;
  const std::vector<MassPoint> masses = motion.masses(x);
  const Matrix D = damping_of(motion);
  const auto n = static_cast<Index>(v.size());
  Matrix M = Matrix::Zero(n, n);
  Vector p = -at->gradient - D * v;
  Vector bend = Vector::Zero(at->gap.size());
  for (const MassPoint& mass : masses) M += mass.mass * mass.jacobian.transpose() * mass.jacobian;
  // d/dt of J v and of every mass's velocity along the motion, by differences of fourth order.
  const double speed = v.lpNorm<Eigen::Infinity>();
  if (speed > 0) {
    const double h = 1e-3 / speed;
    std::vector<Vector> curved(masses.size());
    for (std::size_t i = 0; i < masses.size(); ++i)
      curved[i] = Vector::Zero(masses[i].jacobian.rows());
    for (const auto& [steps, weight] :
         {std::pair{-2.0, 1.0 / 12}, {-1.0, -8.0 / 12}, {1.0, 8.0 / 12}, {2.0, -1.0 / 12}}) {
      Vector beside = x;
      beside(landscape.moving()) += steps * h * v;
      const auto there = first_order(landscape, beside, piece);
      if (!there) return std::nullopt;
      const std::vector<MassPoint> moved = motion.masses(beside);
      bend += weight / h * (there->closing * v);
      for (std::size_t i = 0; i < masses.size(); ++i)
        curved[i] += weight / h * (moved[i].jacobian * v);
    }
    for (std::size_t i = 0; i < masses.size(); ++i)
      p -= masses[i].mass * (masses[i].jacobian.transpose() * curved[i]);
  }
  const Vector q = -bend - 2 * fading * (at->closing * v) - fading * fading * at->gap;
  const auto solved = balance(M, Closings(at->closing, landscape.terrain().redundant), p, q);
  if (!solved) return std::nullopt;
  return FlowRate{solved->a, solved->nu, v.dot(D * v)};
}

/// With a = v', w = J_m a + (J_m)' v of every mass and dots along the motion, from the equations of inertial_rate:
///
///     ┌ M  J^T ┐ ┌ a_x  a_v ┐   ┌ -H - sum m [w . C_m + J_m^T (a . C_m + (J_m)'')]   -D - 2 sum m J_m^T (J_m)' ┐
///     └ J   0  ┘ └  :    :  ┘ = └ -(a . C) - J'' - 2 gamma J' - gamma^2 J             -2 J' - 2 gamma J          ┘
///
/// with the second derivatives C of closures and masses, and H that of the energy with the closures' forces.
std::optional<Matrix> inertial_jacobian(const Motion& motion, const Vector& x, const Vector& v,
                                        const Piece& piece, const FlowRate& at) {
  const Landscape& landscape = motion.landscape;
  const auto &moving = landscape.moving(), &multipliers = landscape.multipliers();
  const Index n = v.size(), m = static_cast<Index>(multipliers.size());
  Vector state = x;
  state(multipliers) = at.multipliers;
  const auto loaded = evaluate(landscape, state, piece);
  state(multipliers).setZero();
  const auto plain = evaluate(landscape, state, piece);
  const auto first = first_order(landscape, x, piece);
  if (!loaded || !plain || !first) return std::nullopt;
  const std::vector<MassPoint> masses = motion.masses(x);
  const auto curvatures = motion.curvatures(x);
  const auto third = third_along(motion, x, v, piece, *first, masses);
  const auto bent = bends(landscape, x, piece, plain->A(moving, moving), at.rate, v);
  if (!third || !bent) return std::nullopt;
  const Matrix &J = first->closing, &along_a = bent->front(), &along_v = bent->back();
  Matrix M = Matrix::Zero(n, n), right = Matrix::Zero(n + m, 2 * n);
  right.topLeftCorner(n, n) = -loaded->A(moving, moving);
  right.topRightCorner(n, n) = -damping_of(motion);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Matrix& Jm = masses[i].jacobian;
    const double mass = masses[i].mass;
    Matrix rate_a(Jm.rows(), n), rate_v(Jm.rows(), n);
    for (Index r = 0; r < Jm.rows(); ++r) {
      const Matrix& C = curvatures[i][static_cast<std::size_t>(r)];
      rate_a.row(r) = (C * at.rate).transpose();
      rate_v.row(r) = (C * v).transpose();
    }
    const Vector w = Jm * at.rate + rate_v * v;
    M += mass * Jm.transpose() * Jm;
    for (Index r = 0; r < Jm.rows(); ++r)
      right.topLeftCorner(n, n) -= mass * w[r] * curvatures[i][static_cast<std::size_t>(r)];
    right.topLeftCorner(n, n) -= mass * Jm.transpose() * (rate_a + third->jacobians[i]);
    right.topRightCorner(n, n) -= 2 * mass * Jm.transpose() * rate_v;
  }
  right.bottomLeftCorner(m, n) =
      -along_a - third->closing - 2 * fading * along_v - fading * fading * J;
  right.bottomRightCorner(m, n) = -2 * along_v - 2 * fading * J;
  return Matrix(least_squares_of_columns(bordered(M, J), right).topRows(n));
}

}  // namespace springfold::analysis
