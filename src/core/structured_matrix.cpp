#include "springfold/core/structured_matrix.hpp"

#include <cassert>
#include <utility>

namespace springfold {

/// One matrix with its factors, and storage for what is asked of it.
struct ScaledMatrices::Slot {
  StructuredMatrix J{};
  Vector rows{}, columns{};
  Vector v{};
  FrontalBorders borders{};

  void product(const Vector& given, Vector& result) {
    v = columns.cwiseProduct(given);
    J.product(v, result);
    result.array() *= rows.array();
  }
  void magnitudes(const Vector& given, Vector& result) {
    v = columns.cwiseProduct(given);
    J.magnitudes(v, result);
    result.array() *= rows.array();
  }
  ///  | rows J columns   B |   | rows   0 | | J               rows^-1 B | | columns  0 |
  ///  | C^T              D | = | 0      I | | C^T columns^-1          D | | 0        I |
  bool solve(const FrontalBorders& given, Matrix& X, bool transposed) {
    const Index n = rows.size();
    borders.B = given.B;
    borders.C = given.C;
    borders.D = given.D;
    borders.B.array().colwise() /= rows.array();
    borders.C.array().colwise() /= columns.array();
    X.topRows(n).array().colwise() /= (transposed ? columns : rows).array();
    if (!J.solve(borders, X, transposed)) return false;
    X.topRows(n).array().colwise() /= (transposed ? rows : columns).array();
    return true;
  }
};

StructuredMatrix& ScaledMatrices::next() {
  next_.reset();
  for (const auto& slot : slots_)
    if (!next_ && slot.use_count() == 1) next_ = slot;
  if (!next_) next_ = slots_.emplace_back(std::make_shared<Slot>());
  next_->J = {};
  return next_->J;
}

void ScaledMatrices::put(const Vector& rows, const Vector& columns, StructuredMatrix& result) {
  assert(next_ != nullptr);
  Slot* const slot = next_.get();
  slot->rows = rows;
  slot->columns = columns;
  result.largest = slot->J.largest * rows.maxCoeff() * columns.maxCoeff();
  result.product = [slot](const Vector& v, Vector& Jv) { slot->product(v, Jv); };
  result.magnitudes = [slot](const Vector& v, Vector& sizes) { slot->magnitudes(v, sizes); };
  result.solve = [slot](const FrontalBorders& borders, Matrix& X, bool transposed) {
    return slot->solve(borders, X, transposed);
  };
  result.inertia = [slot] { return slot->J.inertia(); };
  result.owner = std::move(next_);
}

StructuredMatrix scaled(StructuredMatrix J, const Vector& rows, const Vector& columns) {
  ScaledMatrices matrices;
  matrices.next() = std::move(J);
  StructuredMatrix result;
  matrices.put(rows, columns, result);
  return result;
}

Vector product(const StructuredMatrix& J, const Vector& v) {
  Vector Jv;
  J.product(v, Jv);
  return Jv;
}

Vector magnitudes(const StructuredMatrix& J, const Vector& v) {
  Vector sizes;
  J.magnitudes(v, sizes);
  return sizes;
}

}  // namespace springfold
