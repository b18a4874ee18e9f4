// How the parameters of the case, as imperfections, lower the critical loads of a branch. Private to analysis.
#pragma once

#include <string>
#include <vector>

#include "base_path.hpp"
#include "springfold/parameters/imperfection.hpp"

namespace springfold::analysis {

/// The laws of one special point; parameters are entered one after the other.
class PointLaws {
 public:
  explicit PointLaws(const SpecialPoint& point) : point_{&point} {}

  /// @param rate  d(lambda)/d(parameter); NaN where the point is not followed
  /// @returns false where lambda has no rate although the point has one to first order
  bool enter(const CaseCurves& curves, double rate);
  /// Per parameter exponent, coefficient and sign; then, if `with_worst`, exponent, coefficient and shape of the
  /// worst combination. In the order of law_columns(); NaN where the terms do not decide.
  std::vector<double> values(bool with_worst) const;
  /// Is there a parameter that breaks the branch point, or may, and whose law the form does not give?
  bool lacks_law() const;

 private:
  bool breaks(std::size_t i) const;
  /// Of a parameter that keeps the branch point to first order.
  bool enter_second_order(const CaseCurves& curves);
  double towards() const;
  void put_worst(std::vector<double>& values) const;

  const SpecialPoint* point_;
  bool tried_ = false;
  std::optional<continuation::ReducedForm> form_{};  ///< of limit and branch points
  std::vector<Vector> gammas_{};                     ///< per parameter; empty: not known
  std::vector<std::optional<continuation::ImperfectionLaw>>
      laws_{};  ///< per parameter that breaks the branch; nothing: the form gives none, or it does not break it
  std::vector<bool>
      known_{};  ///< per parameter: its part that breaks the branch is known, or not needed
  std::vector<double> rates_{};
  std::vector<bool> squares_{};  ///< per parameter: its square breaks the branch
  double lambda_scale_ = 1;
};

/// "exponent(e)", "coefficient(e)", "sign(e)", ...; with `with_worst` "worst.exponent", "worst.coefficient",
/// "worst.shape(e)", ...
std::vector<std::string> law_columns(const std::vector<std::string>& parameters, bool with_worst);

}  // namespace springfold::analysis
