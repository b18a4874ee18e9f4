// The test of Newton and Kantorovich on a window of a model of the curve. Private to the engine.
#pragma once

#include <array>
#include <optional>

#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// A part of a model, by the way along the tangent at its origin.
struct Window {
  double begin = 0, end = 0;
  double middle() const { return 0.5 * (begin + end); }
  double length() const { return end - begin; }
};

/// The test as verification.hpp states it. Lengths are those of the metric; unknowns of weight zero have their own
/// unit.
class TubeTest {
 public:
  TubeTest(const Walker& walker, const Piece& piece);

  /// Radius of a tube around the window of the model that holds no other solution; nothing: none is shown.
  std::optional<double> regular(const ArcModel& model, const Window& window);

  /// The same for the bordered equations; sigma must be rounding on the window.
  std::optional<double> crossing(const ArcModel& model, const Window& window);

 private:
  bool derivatives(const Vector& u, Matrix& J);
  bool residual(const Vector& u, Vector& F);
  bool begin(const ArcModel& model, const Window& window);
  std::optional<double> radius(double longest);
  double change(const Vector& u, const Matrix& J);
  bool sigma_is_rounding(const ArcModel& model, const Window& window);

  const Walker& walker_;
  const Piece& piece_;
  Index n_ = 0;
  Vector scale_{};              ///< n + 1: lengths of the unknowns' units
  Vector row_{};                ///< n + 1: the tangent at the middle, (w tau)^T in scaled unknowns
  Matrix S_{};                  ///< first n columns of M^-1
  Vector weakest_{};            ///< n + 1: the direction in which M is weakest, unit length
  Vector border_{};             ///< n: b
  std::array<Vector, 3> at_{};  ///< the model's ends and its middle
  std::array<Matrix, 3> J_{};   ///< [F_x F_lambda] there, in scaled unknowns
  Matrix trial_{};
  Linearisation linearisation_{};
  Vector x_{}, F_{}, rate_{};
};

}  // namespace springfold::continuation
