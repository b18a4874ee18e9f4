// Eigenvalues of a linear map from its images of a few vectors, in storage that is used again.
#pragma once

#include "springfold/core/rounding.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// Arnoldi's method from a fixed, irregular vector: an orthonormal basis of it and of its images one after the other,
/// and what the map does in that basis.
class Arnoldi {
 public:
  static constexpr Index most_steps = 16;

  /// Begins with a map of R^n, n > 0.
  void begin(Index n);
  auto newest() const { return basis_.col(size_); }  ///< vector of the basis
  Vector& image() { return image_; }                 ///< to be filled with what the map makes of it
  /// Takes the image. @returns false when no more are wanted: the basis holds them all, or is as large as allowed
  bool add();

  Index size() const { return size_; }  ///< images so far
  Matrix map() const { return H_.topLeftCorner(size_, size_); }
  /// Largest magnitude of its eigenvalues; infinity where it is not finite.
  double largest() const;

 private:
  Vector start_{}, image_{};
  Matrix basis_{};  ///< n x most_steps + 1
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_steps + 1, most_steps> H_;
  Index size_ = 0, steps_ = 0;
};

/// Largest magnitude of an eigenvalue of a map, as Arnoldi's method shows it: what is small needs to be known only
/// roughly.
/// @param put_image  bool(v, Vector& image); @returns infinity when it returns false
template <class PutImage>
double largest_eigenvalue(Arnoldi& arnoldi, Index n, const PutImage& put_image) {
  constexpr double roughly = 0.01;
  double before = infinity;
  arnoldi.begin(n);
  for (;;) {
    if (!put_image(arnoldi.newest(), arnoldi.image())) return infinity;
    const bool more = arnoldi.add();
    if (more && arnoldi.size() < 3) continue;
    const double now = arnoldi.largest();
    if (!more || std::abs(now - before) <= roughly * (2 * now + 1)) return now;
    before = now;
  }
}

}  // namespace springfold
