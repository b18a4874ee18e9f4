// What the engine wants to know: F(x, lambda) = 0 with F : R^n x R -> R^n, and its derivatives.
// Nothing else: no robots here.
#pragma once

#include <concepts>
#include <limits>
#include <string>

#include "springfold/core/structured_matrix.hpp"
#include "springfold/core/types.hpp"

namespace springfold::continuation {

/// A curve of solutions of a smooth F(x, lambda) = 0. Both evaluations return false outside the
/// domain of F (the engine then shortens the step); they never throw.
template <class P>
concept SmoothProblem = requires(const P& problem, const Vector& x, double lambda, Vector& v,
                                 Matrix& M) {
  { problem.size() } -> std::convertible_to<Index>;                // n
  { problem.residual(x, lambda, v) } -> std::same_as<bool>;        // v = F
  { problem.derivatives(x, lambda, M, v) } -> std::same_as<bool>;  // M = dF/dx, v = dF/dlambda
};

/// A continuous F that is smooth on both sides of switching surfaces g_j(x, lambda) = 0. Each
/// evaluation is told which piece is meant and continues it smoothly beyond its surfaces:
/// piece[j] = +1 is the side g_j > 0.
template <class P>
concept PiecewiseSmoothProblem = requires(const P& problem, const Vector& x, double lambda,
                                          const Piece& piece, Vector& v, Matrix& M, Index j) {
  { problem.size() } -> std::convertible_to<Index>;
  { problem.residual(x, lambda, piece, v) } -> std::same_as<bool>;
  { problem.derivatives(x, lambda, piece, M, v) } -> std::same_as<bool>;
  { problem.switch_count() } -> std::convertible_to<Index>;  // m
  { problem.switches(x, lambda, v) } -> std::same_as<bool>;  // v = g, m entries
  {
    problem.switch_gradients(x, lambda, M, v)
    } -> std::same_as<bool>;  // M = dg/dx (m x n), v = dg/dlambda
};

/// A problem that also gives dF/dx without its entries, see ProblemView.
template <class P>
concept StructuredProblem = requires(const P& problem, const Vector& x, double lambda,
                                     const Piece& piece, StructuredMatrix& J, Vector& v) {
  problem.structured_derivatives(x, lambda, J, v);
}
|| requires(const P& problem, const Vector& x, double lambda, const Piece& piece,
            StructuredMatrix& J, Vector& v) {
  problem.structured_derivatives(x, lambda, piece, J, v);
};

/// A problem that gives F and its derivatives in one evaluation, see ProblemView.
template <class P>
concept ProblemWithEquations = requires(const P& problem, const Vector& x, double lambda,
                                        const Piece& piece, Vector& F, Matrix& J, Vector& v) {
  problem.equations(x, lambda, F, J, v);
}
|| requires(const P& problem, const Vector& x, double lambda, const Piece& piece, Vector& F,
            Matrix& J, Vector& v) {
  problem.equations(x, lambda, piece, F, J, v);
};

/// A problem that gives second derivatives, see ProblemView.
template <class P>
concept ProblemWithSecondDerivatives = requires(const P& problem, const Vector& x, double lambda,
                                                const Piece& piece, const Vector& w, Vector& v) {
  problem.second_along(x, lambda, w, w, v);
}
|| requires(const P& problem, const Vector& x, double lambda, const Piece& piece, const Vector& w,
            Vector& v) {
  problem.second_along(x, lambda, piece, w, w, v);
};

/// How the arc length measures lambda: as it is up to `linear` from `centre`, beyond in parts of its distance from
/// there,
///
///     lambda = centre + linear sinh((mu - centre) / linear),   mu enters the arc length.
///
/// For curves on which what happens lies at lambdas of very different size. Unknowns of weight zero are measured in a
/// unit that grows with lambda then; row i of F belongs to unknown i.
struct LambdaMeasure {
  double centre = 0;
  double linear = std::numeric_limits<double>::infinity();
};

/// The copy of x that is nearest to `near` among those with changed signs: -1 for the unknowns of
/// double covers that must change theirs, otherwise 1. The same factors belong to a tangent at x.
Vector nearest_signs(const std::vector<Index>& double_covers, const Vector& x, const Vector& near);

/// Non-owning view of any problem: lets the engine live in .cpp files. The problem must outlive it.
///
/// Optional members of a problem are used where they exist:
///     bool symmetric() const          dF/dx is symmetric; inertia is then counted
///     Vector metric() const           n weights >= 0 of the arc length (0: does not enter)
///     Vector periods() const          n periods: x and x + period are the same point (0: none)
///     std::vector<Index> double_covers() const
///                                     first of four unknowns that are the same point with all their
///                                     signs changed, for every such group: rotations as quaternions
///     std::string switch_name(Index) const
///     bool equations(x, lambda, [piece,] Vector& F, Matrix& dF_dx, Vector& dF_dlambda) const
///                                     `residual` and `derivatives` at once, with the same numbers, where
///                                     that costs less than both
///     bool structured_derivatives(x, lambda, [piece,] StructuredMatrix&, Vector& dF_dlambda) const
///                                     the same as `derivatives`, for large systems of which more is
///                                     known than entries. Points, special points and their places
///                                     are then found without dF/dx ever being formed; where
///                                     curves cross or meet kinks `derivatives` is still asked
///     bool structured() const         is that to be used? Without this member: yes
///     bool second_along(x, lambda, [piece,] const Vector& w, const Vector& V, Vector& value) const
///                                     exact second derivatives, where it has them: value = the
///                                     derivative of w^T [dF/dx dF/dlambda], n + 1 entries, along V
///                                     (n + 1 entries: x, then lambda). False: not known; callers
///                                     take differences of the first derivatives
///     double growth(const Piece&) const
///                                     how many times larger the terms of F are on this piece than at
///                                     the start, at least 1: stiff springs that act there. Residuals
///                                     may then be as many times the rounding of terms of size one.
///                                     Without this member: 1
///     LambdaMeasure lambda_measure() const
///                                     without this member: lambda as it is
class ProblemView {
 public:
  template <class P>
  requires(!std::same_as<P, ProblemView> && (SmoothProblem<P> || PiecewiseSmoothProblem<P>))
      ProblemView(const P& problem)  // NOLINT: implicit on purpose, like std::string_view
      : problem_{&problem}, calls_{&calls_of<P>} {}

  Index size() const { return calls_->size(problem_); }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    return calls_->residual(problem_, x, lambda, piece, F);
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    return calls_->derivatives(problem_, x, lambda, piece, dF_dx, dF_dlambda);
  }
  bool equations(const Vector& x, double lambda, const Piece& piece, Vector& F, Matrix& dF_dx,
                 Vector& dF_dlambda) const {
    return calls_->equations(problem_, x, lambda, piece, F, dF_dx, dF_dlambda);
  }
  bool second_along(const Vector& x, double lambda, const Piece& piece, const Vector& w,
                    const Vector& V, Vector& value) const {
    return calls_->second_along(problem_, x, lambda, piece, w, V, value);
  }
  bool structured() const { return calls_->structured(problem_); }
  bool structured_derivatives(const Vector& x, double lambda, const Piece& piece,
                              StructuredMatrix& dF_dx, Vector& dF_dlambda) const {
    return calls_->structured_derivatives(problem_, x, lambda, piece, dF_dx, dF_dlambda);
  }
  Index switch_count() const { return calls_->switch_count(problem_); }
  bool switches(const Vector& x, double lambda, Vector& g) const {
    return calls_->switches(problem_, x, lambda, g);
  }
  bool switch_gradients(const Vector& x, double lambda, Matrix& dg_dx, Vector& dg_dlambda) const {
    return calls_->switch_gradients(problem_, x, lambda, dg_dx, dg_dlambda);
  }
  bool symmetric() const { return calls_->symmetric(problem_); }
  Vector metric() const { return calls_->metric(problem_); }
  Vector periods() const { return calls_->periods(problem_); }
  std::vector<Index> double_covers() const { return calls_->double_covers(problem_); }
  std::string switch_name(Index j) const { return calls_->switch_name(problem_, j); }
  double growth(const Piece& piece) const { return calls_->growth(problem_, piece); }
  LambdaMeasure lambda_measure() const { return calls_->lambda_measure(problem_); }

 private:
  struct Calls {
    Index (*size)(const void*);
    bool (*residual)(const void*, const Vector&, double, const Piece&, Vector&);
    bool (*derivatives)(const void*, const Vector&, double, const Piece&, Matrix&, Vector&);
    bool (*equations)(const void*, const Vector&, double, const Piece&, Vector&, Matrix&, Vector&);
    bool (*second_along)(const void*, const Vector&, double, const Piece&, const Vector&,
                         const Vector&, Vector&);
    bool (*structured)(const void*);
    bool (*structured_derivatives)(const void*, const Vector&, double, const Piece&,
                                   StructuredMatrix&, Vector&);
    Index (*switch_count)(const void*);
    bool (*switches)(const void*, const Vector&, double, Vector&);
    bool (*switch_gradients)(const void*, const Vector&, double, Matrix&, Vector&);
    bool (*symmetric)(const void*);
    Vector (*metric)(const void*);
    Vector (*periods)(const void*);
    std::vector<Index> (*double_covers)(const void*);
    std::string (*switch_name)(const void*, Index);
    double (*growth)(const void*, const Piece&);
    LambdaMeasure (*lambda_measure)(const void*);
  };

  template <class P>
  static const P& as(const void* problem) {
    return *static_cast<const P*>(problem);
  }

  template <class P>
  static constexpr Calls calls_of{
      [](const void* p) { return static_cast<Index>(as<P>(p).size()); },
      [](const void* p, const Vector& x, double lambda, const Piece& piece, Vector& F) {
        if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).residual(x, lambda, piece, F);
        else
          return as<P>(p).residual(x, lambda, F);
      },
      [](const void* p, const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
         Vector& dF_dlambda) {
        if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).derivatives(x, lambda, piece, dF_dx, dF_dlambda);
        else
          return as<P>(p).derivatives(x, lambda, dF_dx, dF_dlambda);
      },
      [](const void* p, const Vector& x, double lambda, const Piece& piece, Vector& F,
         Matrix& dF_dx, Vector& dF_dlambda) {
        if constexpr (ProblemWithEquations<P> && PiecewiseSmoothProblem<P>)
          return as<P>(p).equations(x, lambda, piece, F, dF_dx, dF_dlambda);
        else if constexpr (ProblemWithEquations<P>)
          return as<P>(p).equations(x, lambda, F, dF_dx, dF_dlambda);
        else if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).residual(x, lambda, piece, F) &&
                 as<P>(p).derivatives(x, lambda, piece, dF_dx, dF_dlambda);
        else
          return as<P>(p).residual(x, lambda, F) &&
                 as<P>(p).derivatives(x, lambda, dF_dx, dF_dlambda);
      },
      [](const void* p, const Vector& x, double lambda, const Piece& piece, const Vector& w,
         const Vector& V, Vector& value) {
        if constexpr (!ProblemWithSecondDerivatives<P>)
          return false;
        else if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).second_along(x, lambda, piece, w, V, value);
        else
          return as<P>(p).second_along(x, lambda, w, V, value);
      },
      [](const void* p) {
        if constexpr (requires { as<P>(p).structured(); })
          return static_cast<bool>(as<P>(p).structured());
        else
          return StructuredProblem<P>;
      },
      [](const void* p, const Vector& x, double lambda, const Piece& piece, StructuredMatrix& dF_dx,
         Vector& dF_dlambda) {
        if constexpr (!StructuredProblem<P>)
          return false;
        else if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).structured_derivatives(x, lambda, piece, dF_dx, dF_dlambda);
        else
          return as<P>(p).structured_derivatives(x, lambda, dF_dx, dF_dlambda);
      },
      [](const void* p) {
        if constexpr (PiecewiseSmoothProblem<P>)
          return static_cast<Index>(as<P>(p).switch_count());
        else
          return Index{0};
      },
      [](const void* p, const Vector& x, double lambda, Vector& g) {
        if constexpr (PiecewiseSmoothProblem<P>) return as<P>(p).switches(x, lambda, g);
        g.resize(0);
        return true;
      },
      [](const void* p, const Vector& x, double lambda, Matrix& dg_dx, Vector& dg_dlambda) {
        if constexpr (PiecewiseSmoothProblem<P>)
          return as<P>(p).switch_gradients(x, lambda, dg_dx, dg_dlambda);
        dg_dx.resize(0, x.size());
        dg_dlambda.resize(0);
        return true;
      },
      [](const void* p) {
        if constexpr (requires { as<P>(p).symmetric(); })
          return static_cast<bool>(as<P>(p).symmetric());
        else
          return false;
      },
      [](const void* p) -> Vector {
        if constexpr (requires { as<P>(p).metric(); })
          return as<P>(p).metric();
        else
          return Vector::Ones(static_cast<Index>(as<P>(p).size()));
      },
      [](const void* p) -> Vector {
        if constexpr (requires { as<P>(p).periods(); })
          return as<P>(p).periods();
        else
          return Vector::Zero(static_cast<Index>(as<P>(p).size()));
      },
      [](const void* p) -> std::vector<Index> {
        if constexpr (requires { as<P>(p).double_covers(); })
          return as<P>(p).double_covers();
        else
          return {};
      },
      [](const void* p, Index j) -> std::string {
        if constexpr (requires { as<P>(p).switch_name(j); })
          return as<P>(p).switch_name(j);
        else
          return "switch " + std::to_string(j + 1);
      },
      [](const void* p, const Piece& piece) -> double {
        if constexpr (requires { as<P>(p).growth(piece); })
          return as<P>(p).growth(piece);
        else
          return 1;
      },
      [](const void* p) -> LambdaMeasure {
        if constexpr (requires { as<P>(p).lambda_measure(); })
          return as<P>(p).lambda_measure();
        else
          return {};
      }};

  const void* problem_;
  const Calls* calls_;
};

}  // namespace springfold::continuation
