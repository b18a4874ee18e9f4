#include "springfold/core/structured_matrix.hpp"

#include <memory>
#include <utility>

namespace springfold {
namespace {

struct Factors {
  Vector rows{}, columns{};
};

}  // namespace

StructuredMatrix scaled(StructuredMatrix J, const Vector& rows, const Vector& columns) {
  const auto by = std::make_shared<const Factors>(Factors{rows, columns});
  StructuredMatrix result;
  result.largest = J.largest * rows.maxCoeff() * columns.maxCoeff();
  result.inertia = std::move(J.inertia);
  result.product = [product = std::move(J.product), by](const Vector& v) -> Vector {
    return by->rows.cwiseProduct(product(by->columns.cwiseProduct(v)));
  };
  result.magnitudes = [sizes = std::move(J.magnitudes), by](const Vector& v) -> Vector {
    return by->rows.cwiseProduct(sizes(by->columns.cwiseProduct(v)));
  };
  //  | rows J columns   B |   | rows   0 | | J               rows^-1 B | | columns  0 |
  //  | C^T              D | = | 0      I | | C^T columns^-1          D | | 0        I |
  result.solve = [solve = std::move(J.solve), by](const FrontalBorders& given, Matrix& X,
                                                  bool transposed) {
    const Index n = by->rows.size();
    FrontalBorders borders{given.B, given.C, given.D};
    borders.B.array().colwise() /= by->rows.array();
    borders.C.array().colwise() /= by->columns.array();
    X.topRows(n).array().colwise() /= (transposed ? by->columns : by->rows).array();
    if (!solve(borders, X, transposed)) return false;
    X.topRows(n).array().colwise() /= (transposed ? by->rows : by->columns).array();
    return true;
  };
  return result;
}

}  // namespace springfold
