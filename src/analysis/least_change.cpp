#include "least_change.hpp"

#include <nlopt.h>

#include <cmath>
#include <compare>
#include <exception>
#include <memory>
#include <vector>

namespace springfold::analysis {
namespace {

/// Where steps or violations are as small as this, nothing but rounding is left.
constexpr double least_step = 1e-13;
constexpr double allowed_violation = 1e-11;
/// Steps of a rough search end there; minima that are told apart differ by far more.
constexpr double rough = 1e-4;
/// Evaluations of one search; a smooth problem takes a few dozen.
constexpr int most_evaluations = 250, most_rough_evaluations = 40;
/// A search that so many evaluations bring no further is at its end, or at a jump, along which it would creep: where
/// all is smooth each of a few steps halves what is left.
constexpr int most_without_progress = 40;
constexpr double progress_of_violation = 0.5, progress_of_objective = 1e-3;

/// What a search has got at a point: first of all it has to meet the inequalities, then the objective counts.
struct Reached {
  double violation = HUGE_VAL, f = HUGE_VAL;
  auto operator<=>(const Reached&) const = default;
};

/// Is `now` so much better than `before` that the search is getting on?
bool is_progress(const Reached& now, const Reached& before) {
  if (now.violation > 0) return now.violation < progress_of_violation * before.violation;
  return before.violation > 0 || now.f < before.f - progress_of_objective * std::abs(before.f);
}

/// The best point of a search, and how many evaluations have brought no progress since the last one that did.
struct Progress {
  Vector x{};
  Reached best{}, known{};
  int without = 0;

  void note(const Vector& at, const InequalityValues& values) {
    const double largest = values.g.size() > 0 ? values.g.maxCoeff() : 0;
    const Reached here{largest > allowed_violation ? largest : 0, values.f};
    if (here < best) {
      x = at;
      best = here;
    }
    if (!is_progress(best, known)) return;
    known = best;
    without = 0;
  }
};

/// Objective and inequalities are asked for one after the other at the same place.
struct Memory {
  const InequalityProblem& problem;
  nlopt_opt search;
  Vector x{};
  std::optional<InequalityValues> values{};
  Progress progress{};
  std::exception_ptr thrown{};  ///< C code is left before it goes on

  const std::optional<InequalityValues>& at(unsigned n, const double* where) {
    const Vector wanted = Eigen::Map<const Vector>(where, static_cast<Index>(n));
    if (x.size() == wanted.size() && x == wanted) return values;
    x = wanted;
    values.reset();
    try {
      if (++progress.without > most_without_progress || (problem.stopped && problem.stopped())) {
        nlopt_force_stop(search);
      } else {
        values = problem.at(x);
        if (values) progress.note(x, *values);
      }
    } catch (...) {
      thrown = std::current_exception();
      nlopt_force_stop(search);
    }
    return values;
  }
};

double objective(unsigned n, const double* x, double* gradient, void* data) {
  const auto& values = static_cast<Memory*>(data)->at(n, x);
  if (!values) return HUGE_VAL;
  if (gradient != nullptr) Eigen::Map<Vector>(gradient, static_cast<Index>(n)) = values->df;
  return values->f;
}

void inequalities(unsigned m, double* result, unsigned n, const double* x, double* gradient,
                  void* data) {
  const auto& values = static_cast<Memory*>(data)->at(n, x);
  const auto rows = static_cast<Index>(m);
  Eigen::Map<Vector> g(result, rows);
  if (!values) {
    g.setOnes();
    return;
  }
  g = values->g;
  if (gradient != nullptr)  // row by row
    Eigen::Map<Matrix>(gradient, static_cast<Index>(n), rows) = values->dg.transpose();
}

}  // namespace

Vector search_minimum(const InequalityProblem& problem, const Vector& start, Depth how) {
  const bool to_the_end = how == Depth::to_the_end;
  const auto n = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> search{nlopt_create(NLOPT_LD_SLSQP, n),
                                                                 &nlopt_destroy};
  Memory memory{problem, search.get()};
  nlopt_set_lower_bounds(search.get(), problem.low.data());
  nlopt_set_upper_bounds(search.get(), problem.high.data());
  nlopt_set_min_objective(search.get(), objective, &memory);
  const std::vector<double> tolerances(static_cast<std::size_t>(problem.inequalities),
                                       allowed_violation);
  if (problem.inequalities > 0)
    nlopt_add_inequality_mconstraint(search.get(), static_cast<unsigned>(problem.inequalities),
                                     inequalities, &memory, tolerances.data());
  nlopt_set_xtol_rel(search.get(), to_the_end ? least_step : rough);
  nlopt_set_xtol_abs1(search.get(), to_the_end ? least_step : rough);
  nlopt_set_maxeval(search.get(), to_the_end ? most_evaluations : most_rough_evaluations);
  Vector x = start;
  double f = 0;
  // What it returns says why it stopped, not whether the point is a minimum.
  static_cast<void>(nlopt_optimize(search.get(), x.data(), &f));
  if (memory.thrown) std::rethrow_exception(memory.thrown);
  return memory.progress.without > most_without_progress && memory.progress.x.size() > 0
             ? memory.progress.x
             : x;
}

Vector multipliers(const Vector& df, const Matrix& active) {
  const Index n = active.rows();
  if (n == 0) return {};
  InequalityProblem nearest{.low = Vector::Zero(n), .high = Vector::Constant(n, HUGE_VAL)};
  nearest.at = [&](const Vector& m) {
    const Vector rest = df + active.transpose() * m;
    return InequalityValues{0.5 * rest.squaredNorm(), active * rest, Vector{}, Matrix{}};
  };
  return search_minimum(nearest, Vector::Zero(n));
}

}  // namespace springfold::analysis
