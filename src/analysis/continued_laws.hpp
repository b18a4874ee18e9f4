// Critical curves across bends of laws of springs: places where curvature jumps, and nothing switches. Private to
// analysis.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "case_curves.hpp"

namespace springfold::analysis {

/// The case's curves with every law in one of its parts, gone on beyond its bends: what is followed in them is smooth
/// up to where a law leaves its part. There the next part takes over, with the same point: torque and slope go on, so
/// that limit points and branch points of both parts agree in it, and the slopes of their curves don't.
class ContinuedLaws {
 public:
  explicit ContinuedLaws(const CaseCurves& curves);
  ~ContinuedLaws();
  ContinuedLaws(const ContinuedLaws&) = delete;
  ContinuedLaws& operator=(const ContinuedLaws&) = delete;

  /// Each law in the part in which it is at the point; on a bend in that above it.
  void hold_at(const continuation::CriticalPoint& point);
  /// Those whose bend is met at the point, in the part on its other side. @returns whether there is one
  bool cross_at(const continuation::CriticalPoint& point);
  /// The equations with the laws as they are held; as the case has them where none bends. Valid as long as this is.
  continuation::Family family() const;
  /// Of a symmetric branch point, with the laws as they are held: how the branch that leaves bends, above zero to one
  /// side of lambda. Nothing at other points.
  std::optional<double> bend_of_branch(const continuation::CriticalStart& point) const;
  /// The ends of the parts, as events that stop the curve there. Valid as long as this is.
  std::vector<continuation::CriticalEvent> ends() const;
  /// Has the event ended a curve on a bend?
  static bool is_end(const continuation::CriticalHit& hit);

 private:
  struct Law {
    bool of_shape = false;
    std::size_t spring = 0, curve = 0;  ///< which one of the system's, and of its curves
    std::size_t part = 0;               ///< number of the bends that lie below it
  };
  struct Held {
    double mu = 0;
    std::shared_ptr<statics::System> system{};
    std::unique_ptr<PathProblem> problem{};
    std::unique_ptr<Evaluator> evaluator{};  ///< made when it is asked for
  };
  template <class System>
  static auto& spring_of(System& system, const Law& law) {
    return law.of_shape ? system.shapes[law.spring].law : system.springs[law.spring].law;
  }
  static std::vector<double> bends_of(const statics::System& system, const Law& law);
  void hold(statics::System& system) const;
  Held* at(double mu) const;
  struct Place {
    double coordinate = 0;
    std::vector<double> bends{};
  };
  std::optional<Place> place_of(const Law& law, const continuation::CriticalPoint& point) const;

  const CaseCurves& curves_;
  std::vector<Law> laws_{};
  mutable std::deque<Held> held_{};  ///< of the last calls
};

}  // namespace springfold::analysis
