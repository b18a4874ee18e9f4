// Is a computation still wanted? Private to analysis.
#pragma once

#include <chrono>

#include "path_problem.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::analysis {

/// Asks the observer of a study after every step and, in between, several times a second. Once it said no, it is asked
/// no more, and the answer stays.
class Asking {
 public:
  /// @param observer  may be empty; must outlive this
  explicit Asking(const Observer& observer) : observer_{observer} {}

  /// After an accepted step.
  bool step(int points, double s) const;
  /// Between steps, as often as one likes. Does not stop anything that was accepted.
  bool goes_on() const;
  /// The same, and still true a moment after a no: for what is small and worth keeping.
  bool has_a_moment() const;
  bool was_stopped() const { return stopped_.has_value(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool ask(Clock::time_point now) const;

  const Observer& observer_;
  mutable int points_ = 0;
  mutable double s_ = 0;
  mutable Clock::time_point asked_{};
  mutable std::optional<Clock::time_point> stopped_{};
};

/// A path problem that gives up what the engine computes, also in the middle of a step or of a search.
class AskedProblem {
 public:
  AskedProblem(const PathProblem& problem, const Asking& asking)
      : problem_{problem}, asking_{asking} {}

  Index size() const { return problem_.size(); }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    go_on();
    return problem_.residual(x, lambda, piece, F);
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    go_on();
    return problem_.derivatives(x, lambda, piece, dF_dx, dF_dlambda);
  }
  bool equations(const Vector& x, double lambda, const Piece& piece, Vector& F, Matrix& dF_dx,
                 Vector& dF_dlambda) const {
    go_on();
    return problem_.equations(x, lambda, piece, F, dF_dx, dF_dlambda);
  }
  bool second_along(const Vector& x, double lambda, const Piece& piece, const Vector& w,
                    const Vector& V, Vector& value) const {
    return problem_.second_along(x, lambda, piece, w, V, value);
  }
  bool structured() const { return problem_.structured(); }
  bool structured_derivatives(const Vector& x, double lambda, const Piece& piece,
                              StructuredMatrix& dF_dx, Vector& dF_dlambda) const {
    go_on();
    return problem_.structured_derivatives(x, lambda, piece, dF_dx, dF_dlambda);
  }
  Index switch_count() const { return problem_.switch_count(); }
  bool switches(const Vector& x, double lambda, Vector& g) const {
    return problem_.switches(x, lambda, g);
  }
  bool switch_gradients(const Vector& x, double lambda, Matrix& dg_dx, Vector& dg_dlambda) const {
    return problem_.switch_gradients(x, lambda, dg_dx, dg_dlambda);
  }
  bool symmetric() const { return problem_.symmetric(); }
  Vector metric() const { return problem_.metric(); }
  Vector periods() const { return problem_.periods(); }
  std::vector<Index> double_covers() const { return problem_.double_covers(); }
  std::string switch_name(Index j) const { return problem_.switch_name(j); }
  double growth(const Piece& piece) const { return problem_.growth(piece); }
  continuation::LambdaMeasure lambda_measure() const { return problem_.lambda_measure(); }

 private:
  /// @throws continuation::Interrupted
  void go_on() const;

  continuation::ProblemView problem_;
  const Asking& asking_;
};

}  // namespace springfold::analysis
