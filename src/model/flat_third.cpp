#include "springfold/model/flat_third.hpp"

#include <cassert>

namespace springfold::model {
namespace {

/// f . (z x p) of a column p of J: the moment of the force f about the axis on which the point turns.
double lever(const Vector& f, const Matrix& J, Index k) { return f[1] * J(0, k) - f[0] * J(1, k); }

/// Adds H x for H_jk = spin_j lever_k, j <= k, symmetric, of the first `inner` variables.
void add_product(const Vector& spins, const Vector& levers, Index inner, const Vector& x,
                 Vector& sum) {
  double turned = 0;
  for (Index j = 0; j < inner; ++j) {
    sum[j] += levers[j] * turned;
    turned += spins[j] * x[j];
  }
  double moment = 0;
  for (Index j = inner - 1; j >= 0; --j) {
    moment += levers[j] * x[j];
    sum[j] += spins[j] * moment;
  }
}

/// Columns of J turn with all that turns before them and move with all that moves behind:
///
///     D dp_k [b] = z x ((sum over j <= k of spin_j b_j) dp_k + spin_k (sum over j > k of b_j dp_j))
void put_rates(const Matrix& J, const Vector& spins, Index inner, const Vector& b, Matrix& rates) {
  rates.resize(2, J.cols());
  double x = 0, y = 0;  // sum over j > k
  for (Index k = inner - 1; k >= 0; --k) {
    rates(0, k) = -spins[k] * y;
    rates(1, k) = spins[k] * x;
    x += b[k] * J(0, k);
    y += b[k] * J(1, k);
  }
  double turned = 0;
  for (Index k = 0; k < inner; ++k) {
    turned += spins[k] * b[k];
    rates(0, k) -= turned * J(1, k);
    rates(1, k) += turned * J(0, k);
  }
}

}  // namespace

void put_flat_third(const CompiledChain& chain, const Closure<double>& at, const Vector& F,
                    const ClosureVector& a, const ClosureVector& b, ClosureVector& result) {
  const Index n = chain.variable_count(), inner = chain.first_to();
  assert(chain.flat && a.v.size() == n && b.v.size() == n && at.J.cols() == n);
  Matrix rates;
  put_rates(at.J, at.spins, inner, b.v, rates);
  // The end body turns about its own origin: no other variable moves what is fixed in it.
  if (inner < n) rates.rightCols(n - inner).setZero();
  const bool turns = chain.to_moves && chain.to_space == TaskSpace::planar;
  if (turns) {
    rates(0, n - 1) = -b.v[n - 1] * at.J(1, n - 1);
    rates(1, n - 1) = b.v[n - 1] * at.J(0, n - 1);
  }
  Vector changing(n), held(n);  // levers of D H(F) [b], and of H(a.F)
  for (Index k = 0; k < n; ++k) {
    changing[k] = lever(b.F, at.J, k) + lever(F, rates, k);
    held[k] = lever(a.F, at.J, k);
  }
  result.v.setZero(n);
  add_product(at.spins, changing, inner, a.v, result.v);
  add_product(at.spins, held, inner, b.v, result.v);
  if (turns) result.v[n - 1] = changing[n - 1] * a.v[n - 1] + held[n - 1] * b.v[n - 1];
  result.F.setZero(F.size());
  result.F.head(2) = rates * a.v;
}

}  // namespace springfold::model
