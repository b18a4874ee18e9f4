// The equations at a singular point, reduced to the modes that vanish there.
#include <algorithm>
#include <cmath>

#include "parameters/augmented.hpp"
#include "parameters/family_differences.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/parameters/imperfection.hpp"

namespace springfold::continuation {
namespace {

/// Singular values of dF/dx below this, relative to the largest one, vanish at a located point: those that do are its
/// error, at most 1e-10 (the engine's contract), and the root of rounding lies two digits above. Two points whose
/// values are both below lie so near that the located one stands for both.
const double vanishing = std::sqrt(rounding_unit);

/// A singular point of one member of the family.
class ReducedPlace {
 public:
  ReducedPlace(const Family& family, const CriticalStart& at) : family_{family}, at_{at} {}

  std::optional<BaseTerms> terms(const Vector& x, double lambda) const {
    BaseTerms base;
    if (!base_terms(family_, x, lambda, at_.mu, at_.piece, base)) return std::nullopt;
    return base;
  }
  std::optional<BaseTerms> here() const { return terms(at_.x, at_.lambda); }

  /// J(u) columns, one below the other, at the distance t along `along`, n + 1 entries.
  std::optional<Vector> moved(const Vector& along, double t, const Matrix& columns) const {
    const Index n = at_.x.size();
    const auto base = terms(at_.x + t * along.head(n), at_.lambda + t * along[n]);
    if (!base) return std::nullopt;
    const Matrix product = base->J * columns;
    return Vector(product.reshaped());
  }

  /// D^2F[along, columns], n x (columns).
  std::optional<Matrix> second(const Vector& along, const Matrix& columns) const {
    const auto rate = derivative_at_zero([&](double t) { return moved(along, t, columns); },
                                         directional_step / size_of(along));
    if (!rate) return std::nullopt;
    return Matrix(rate->reshaped(at_.x.size(), columns.cols()));
  }

  /// D^3F[along, along, columns].
  std::optional<Matrix> third(const Vector& along, const Matrix& columns) const {
    const auto rate = second_derivative_at_zero([&](double t) { return moved(along, t, columns); },
                                                directional_step / size_of(along));
    if (!rate) return std::nullopt;
    return Matrix(rate->reshaped(at_.x.size(), columns.cols()));
  }

 private:
  static double size_of(const Vector& along) {
    return std::max(smallest_number, along.lpNorm<Eigen::Infinity>());
  }
  const Family& family_;
  const CriticalStart& at_;
};

Matrix with_lambda(const Matrix& x, double lambda) {
  Matrix extended(x.rows() + 1, x.cols());
  extended.topRows(x.rows()) = x;
  extended.row(x.rows()).setConstant(lambda);
  return extended;
}

/// G_i[v_j, v_l, v_m] = w_i (F_xxx[v_j, v_l, v_m] + F_xx[v_j, y_lm] + F_xx[v_l, y_jm] + F_xx[v_m, y_jl]),
/// where y_jl is what the other equations ask for: F_x y = -F_xx[v_j, v_l] up to W, orthogonal to V.
bool put_cubic(const ReducedPlace& place, const Lu& bordered, const std::vector<Matrix>& second,
               ReducedForm& form) {
  const Index n = form.V.rows(), k = form.V.cols();
  const Matrix V = with_lambda(form.V, 0);
  Matrix Y = Matrix::Zero(n + 1, k * k);
  for (Index j = 0; j < k; ++j) {
    Matrix right = Matrix::Zero(n + k, k);
    right.topRows(n) = -second[static_cast<std::size_t>(j)].leftCols(k);
    Y.block(0, j * k, n, k) = bordered.solve(right).topRows(n);
  }
  std::vector<Matrix> own, bent;  // F_xxx[v_j, v_j, .] and F_xx[v_j, y]
  for (Index j = 0; j < k; ++j) {
    auto twice = place.third(V.col(j), V);
    auto with_y = place.second(V.col(j), Y);
    if (!twice || !with_y) return false;
    own.push_back(form.W.transpose() * *twice);
    bent.push_back(form.W.transpose() * *with_y);
  }
  form.cubic.assign(static_cast<std::size_t>(k * k), Matrix::Zero(k, k));
  for (Index j = 0; j < k; ++j)
    for (Index l = 0; l < k; ++l) {
      Matrix straight = own[static_cast<std::size_t>(j)];  // k equations x k directions
      if (l != j) {
        const auto both = place.third(V.col(j) + V.col(l), V);
        if (!both) return false;
        straight = (form.W.transpose() * *both - own[static_cast<std::size_t>(j)] -
                    own[static_cast<std::size_t>(l)]) /
                   2;
      }
      for (Index i = 0; i < k; ++i)
        for (Index m = 0; m < k; ++m)
          form.cubic[static_cast<std::size_t>(i * k + j)](l, m) =
              straight(i, m) + bent[static_cast<std::size_t>(j)](i, l * k + m) +
              bent[static_cast<std::size_t>(l)](i, j * k + m) +
              bent[static_cast<std::size_t>(m)](i, j * k + l);
    }
  return true;
}

/// How many singular values vanish; at least as many as the engine located, whose own errors decided that.
Index corank_of(const Matrix& A, int located) {
  const Vector values = jacobi_svd(A).values;
  Index k = std::min<Index>(located, values.size());
  while (k < values.size() && values[values.size() - 1 - k] <= vanishing * values[0]) ++k;
  return k;
}

}  // namespace

std::optional<ReducedForm> reduced_form(const Family& family, const CriticalStart& start,
                                        const Direction& tangent) {
  const ReducedPlace place(family, start);
  const auto base = place.here();
  if (!base) return std::nullopt;
  const Index n = start.x.size();
  const Index k = corank_of(base->J.leftCols(n), start.corank);
  if (k == 0) return std::nullopt;
  auto null = null_vectors(family, start, static_cast<int>(k));
  if (!null) return std::nullopt;
  ReducedForm form{.V = std::move(null->right), .W = std::move(null->left)};
  form.by_lambda = form.W.transpose() * base->J.col(n);
  form.tangent = {form.V.transpose() * tangent.dx, tangent.dlambda};
  const Lu bordered(springfold::bordered(base->J.leftCols(n), {form.W, form.V}));
  Vector right = Vector::Zero(n + k);
  right.head(n) = -base->J.col(n);
  const Vector z = bordered.solve(right).head(n);
  Matrix columns(n + 1, k + 1);
  columns.leftCols(k) = with_lambda(form.V, 0);
  columns.col(k).head(n) = z;
  columns(n, k) = 1;
  std::vector<Matrix> second;
  for (Index j = 0; j <= k; ++j) {
    auto part = place.second(columns.col(j), columns);
    if (!part || !part->allFinite()) return std::nullopt;
    second.push_back(std::move(*part));
  }
  form.mixed.resize(k, k);
  form.curvature = form.W.transpose() * second.back().col(k);
  for (Index i = 0; i < k; ++i) {
    form.quadratic.emplace_back(k, k);
    for (Index j = 0; j < k; ++j) {
      const Matrix& along = second[static_cast<std::size_t>(j)];
      form.quadratic.back().row(j) = form.W.col(i).transpose() * along.leftCols(k);
      form.mixed(i, j) = form.W.col(i).dot(along.col(k));
    }
  }
  if (!put_cubic(place, bordered, second, form)) return std::nullopt;
  return form;
}

std::optional<Vector> imperfection_part(const Family& family, const CriticalStart& start,
                                        const ReducedForm& form) {
  const auto rate_with = [&](double step) {
    return six_point_derivative(
        [&](double mu) -> std::optional<Vector> {
          BaseTerms base;
          if (!base_terms(family, start.x, start.lambda, mu, start.piece, base))
            return std::nullopt;
          return base.F;
        },
        start.mu, step);
  };
  const auto rate = rate_with(family.step), again = rate_with(0.5 * family.step);
  if (!rate || !again) return std::nullopt;
  Vector gamma = form.W.transpose() * *rate;
  // What does not act on the modes is zero but for rounding: of the differences, which another step does not repeat,
  // beside what acts elsewhere, and beside what the load does to the modes.
  constexpr double repeated = tiny_share, beside_others = one_place, beside_load = residual_level;
  const double change = (form.W.transpose() * *again - gamma).norm();
  if (gamma.norm() <=
      std::max({change / repeated, beside_others * rate->norm(), beside_load * form.mixed.norm()}))
    gamma.setZero();
  return gamma;
}

}  // namespace springfold::continuation
