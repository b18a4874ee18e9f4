// How fast switching functions change along a curve, and how well that and their values are known. Private to the
// engine.
#pragma once

#include <memory>

#include "continuation/points/step.hpp"
#include "continuation/points/workspace.hpp"

namespace springfold::continuation {

struct EquilibratedJacobian;

/// Rate of g_j along a direction.
double switch_rate(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& along);

/// Values and gradients of all switches at a point.
/// @returns false outside the domain
bool read_switches(const Walker& walker, const CurvePoint& p, Workspace::Switches& at);

/// Rate of g_j along the tangent of the point at which they were read.
double rate_along(const Workspace::Switches& at, Index j, const CurvePoint& p);

struct KnownRate {
  double value = 0;
  double error = 0;  ///< what rounding may have made of it; infinity where that is not known
  bool has_sign() const;
};

/// Rates along the tangents of a regular piece at a point of its curve, as well as its equations determine them. These
/// are brought to one size, y = D_c^-1 (dx, dlambda), and bordered by the tangent that is known:
///
///     | D_r [dF/dx dF/dlambda] D_c |       | 0 |
///     |                            | y  =  |   |
///     |           y0^T             |       | 1 |
///
/// Every entry of the equations may be off by rounding of size one, and the point by what that is over their least
/// singular value, along its vector, which changes the entries; what both make of a rate follows from the adjoint of
/// this system: stiff members beside soft ones make nothing uncertain by that alone. Computed where it is asked for
/// first.
class SwitchRates {
 public:
  SwitchRates(const Walker& walker, const CurvePoint& at);
  SwitchRates(const SwitchRates&) = delete;
  SwitchRates& operator=(const SwitchRates&) = delete;
  ~SwitchRates();
  KnownRate of(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& tangent);

 private:
  struct Solved;
  const Solved* solve_along(const Vector& along);

  const Walker& walker_;
  const CurvePoint& at_;
  bool asked_ = false;
  std::unique_ptr<EquilibratedJacobian> equations_{};
  std::unique_ptr<Solved> solved_{};  ///< along the last tangent
};

/// The same of one switch at one point.
KnownRate known_rate(const Walker& walker, const CurvePoint& at, const Matrix& dg_dx,
                     const Vector& dg_dlambda, Index j, const Direction& tangent);

/// Rate of g_j along the curve at one of its points, where it is clear of what rounding makes of it; otherwise 0.
double sure_rate(const Walker& walker, const CurvePoint& p, const Matrix& dg_dx,
                 const Vector& dg_dlambda, Index j);

double sure_rate(const Walker& walker, const Workspace::Switches& at, Index j, const CurvePoint& p);

/// What rounding makes of g_j at a corrected point of the curve; infinity where that is not known.
double error_of_value(const Walker& walker, const CurvePoint& at, const Matrix& dg_dx,
                      const Vector& dg_dlambda, Index j);

}  // namespace springfold::continuation
