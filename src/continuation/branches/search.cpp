#include "springfold/continuation/search.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "continuation/points/step.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::continuation {
namespace {

/// What does not change during a search.
struct SearchTask {
  ProblemView problem;
  double lambda = 0;
  const SearchOptions& options;
  Vector middle{}, side{}, periods{};  ///< of the box, and of the problem
  std::vector<Index> double_covers{};
};

/// x - y, taken the short way round where there is a period, with the copy of y nearest to x.
Vector between_solutions(const SearchTask& task, const Vector& x, const Vector& y) {
  Vector d = x - y;
  if (!task.double_covers.empty()) d = x - y.cwiseProduct(nearest_signs(task.double_covers, y, x));
  for (Index i = 0; i < d.size(); ++i)
    if (task.periods[i] > 0) d[i] -= task.periods[i] * std::round(d[i] / task.periods[i]);
  return d;
}

/// Length as a part of the box.
double length(const SearchTask& task, const Vector& d) { return d.cwiseQuotient(task.side).norm(); }

double largest(const SearchTask& task, const Vector& d) {
  return d.cwiseQuotient(task.side).lpNorm<Eigen::Infinity>();
}

Piece piece_at(const SearchTask& task, const Vector& x) {
  Vector g;
  Piece piece;
  if (!task.problem.switches(x, task.lambda, g)) return piece;
  for (const double value : g) piece.push_back(value < 0 ? -1 : 1);
  return piece;
}

/// F at x, on the piece on which x lies.
bool residual_at(const SearchTask& task, const Vector& x, Piece& piece, Vector& F) {
  if (!x.allFinite()) return false;
  piece = piece_at(task, x);
  return static_cast<Index>(piece.size()) == task.problem.switch_count() &&
         task.problem.residual(x, task.lambda, piece, F) && F.allFinite();
}

/// dF/dx, factorised; nothing where it is singular to working precision or not defined.
std::optional<Lu> factorised(const SearchTask& task, const Vector& x, const Piece& piece,
                             Linearisation& at) {
  if (!linearise_densely(task.problem, x, task.lambda, piece, at)) return std::nullopt;
  Lu lu(at.dF_dx);
  if (!(lu.smallest_pivot() > few_roundings * lu.largest_pivot())) return std::nullopt;
  return lu;
}

/// ln M and its gradient.
struct Deflation {
  double log = 0;
  Vector gradient{};
};

std::optional<Deflation> deflation_at(const SearchTask& task, const Vector& x,
                                      const std::vector<Vector>& away_from) {
  Deflation result{0, Vector::Zero(x.size())};
  const double p = task.options.power, shift = task.options.shift;
  for (const Vector& solution : away_from) {
    const Vector d = between_solutions(task, x, solution);
    const double r = length(task, d);
    if (!(r > negligible_share * task.options.same)) return std::nullopt;  // on a known solution
    const double r_p = std::pow(r, p);
    result.log += std::log(1 / r_p + shift);
    result.gradient -=
        p / (r * r * (1 + shift * r_p)) * d.cwiseQuotient(task.side.cwiseProduct(task.side));
  }
  return result;
}

/// Newton's method on G = M F, damped. With dx the Newton step of F, the one of G solves
///
///     (dF/dx + F grad^T) d = -F,   grad: gradient of ln M,
///
/// and is dx / (1 - grad . dx) by the formula of Sherman and Morrison.
/// @param shortest  part of a step that may be taken; 1: no damping, every step is taken, but none
///                  longer than the box
/// @returns a point within about 1e-8 of the box from a solution, or nothing
std::optional<Vector> deflated_newton(const SearchTask& task, Vector x,
                                      const std::vector<Vector>& away_from, double shortest) {
  constexpr double close = root_of_rounding;
  Piece piece;
  Vector F;
  Linearisation at;
  if (!residual_at(task, x, piece, F)) return std::nullopt;
  auto deflation = deflation_at(task, x, away_from);
  for (int k = 0; k < task.options.iterations && deflation; ++k) {
    if (F.lpNorm<Eigen::Infinity>() == 0) return x;
    const auto lu = factorised(task, x, piece, at);
    if (!lu) return std::nullopt;
    const Vector dx = lu->solve(-F);
    const double denominator = 1 - deflation->gradient.dot(dx);
    const Vector step = dx / denominator;
    const double size = length(task, step);
    if (length(task, dx) <= close && size <= close) return x;
    if (!std::isfinite(size)) return std::nullopt;

    bool accepted = false;
    for (double t = std::min(1.0, 1 / size); t >= std::min(shortest, 1 / size) && !accepted;
         t *= 0.5) {
      const Vector trial = x + t * step;
      Piece trial_piece;
      Vector trial_F;
      if (!residual_at(task, trial, trial_piece, trial_F)) continue;
      const auto there = deflation_at(task, trial, away_from);
      if (!there) continue;
      const Vector w = lu->solve(-trial_F);
      const Vector next = std::exp(there->log - deflation->log) *
                          (w + dx * (deflation->gradient.dot(w) / denominator));
      accepted = shortest == 1 || length(task, next) <= (1 - t / 4) * size;
      if (!accepted) continue;
      x = trial;
      piece = trial_piece;
      F = trial_F;
      deflation = there;
    }
    if (!accepted) return std::nullopt;
  }
  return std::nullopt;
}

struct Polished {
  Vector x{};
  bool solved = false;
  double uncertain = 0;  ///< how far the solution may be off, as a part of the box
};

/// The change of x, as a part of the box, that changes F by rounding errors only.
double rounding_of(const SearchTask& task, const Lu& lu, const Vector& rounding) {
  const Matrix inverse = task.side.cwiseInverse().asDiagonal() * lu.inverse();
  return (inverse.cwiseAbs() * rounding).maxCoeff();
}

/// Newton's method without deflation, on one piece.
Polished polish(const SearchTask& task, const Vector& from, const Piece& piece) {
  constexpr double wander = tiny_share;
  Polished result{.x = from};
  Vector F;
  Linearisation at;
  const Vector weights = task.problem.metric();
  double before = 0;
  for (int k = 0;; ++k) {
    if (!task.problem.residual(result.x, task.lambda, piece, F) || !F.allFinite()) return result;
    const double scale = std::max({1.0, result.x.lpNorm<Eigen::Infinity>(), std::abs(task.lambda)});
    const double most = task.options.newton.residual_tolerance * scale;
    result.solved = F.lpNorm<Eigen::Infinity>() <= most;
    const auto lu = factorised(task, result.x, piece, at);
    if (!lu) {
      result.uncertain = std::max(result.uncertain, poor);
      return result;
    }
    // Stiff springs leave their rounding, which is no reason to leave out an equilibrium where rounding still places
    // it.
    const Vector rounding = rounding_of_rows(at, weights, result.x, task.lambda);
    if (!result.solved)
      result.solved = (F.array().abs() <= rounding.array().max(most)).all() &&
                      rounding_of(task, *lu, rounding) <= poor;
    const Vector dx = lu->solve(-F);
    result.uncertain = largest(task, dx);
    const bool stalls = k > 0 && result.uncertain > (1 - small_share) * before;
    const bool done = result.solved && (result.uncertain <= refined_step || stalls);
    if (done || k == task.options.newton.maximum_iterations) {
      result.uncertain = std::max(result.uncertain,
                                  rounding_of(task, *lu, rounding.cwiseMax(few_roundings * scale)));
      return result;
    }
    before = result.uncertain;
    result.x += dx;
    if (!(largest(task, result.x - from) <= wander)) {
      result.solved = false;
      return result;
    }
  }
}

struct Solution {
  Vector x{};
  Piece piece{};
  std::string note{};
  double uncertain = 0;
};

/// Names of the switches that are zero, and whether the others are on the sides of the piece.
struct Sides {
  bool match = false;
  std::string zero{};
};

Sides compare_sides(const SearchTask& task, const Vector& x, const Piece& piece) {
  Sides result;
  Vector g;
  if (!task.problem.switches(x, task.lambda, g)) return result;
  result.match = true;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= task.options.switch_tolerance)
      result.zero += (result.zero.empty() ? "" : ", ") + task.problem.switch_name(j);
    else
      result.match = result.match && (g[j] < 0) == (piece[static_cast<std::size_t>(j)] < 0);
  return result;
}

/// Brings a point to the residual tolerance, on the piece on which it then lies.
std::optional<Solution> solution_near(const SearchTask& task, const Vector& near,
                                      SearchResult& result) {
  Piece piece = piece_at(task, near);
  Vector x = near;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Polished polished = polish(task, x, piece);
    if (!polished.solved) return std::nullopt;
    x = polished.x;
    const Sides sides = compare_sides(task, x, piece);
    if (sides.match) {
      const Vector here = x.cwiseProduct(nearest_signs(task.double_covers, x, task.middle));
      Solution solution{task.middle + between_solutions(task, here, task.middle), piece, "",
                        polished.uncertain};
      if (!sides.zero.empty()) solution.note = "at a switching surface: " + sides.zero;
      if (polished.uncertain > one_place)
        solution.note += (solution.note.empty() ? "" : "; ") +
                         ("nearly singular, exact to about " + rounded(polished.uncertain, 1)) +
                         " of the box";
      return solution;
    }
    piece = piece_at(task, x);
  }
  ++result.wrong_pieces;
  return std::nullopt;
}

bool is_new(const SearchTask& task, const Solution& solution, const std::vector<Vector>& others) {
  const double same = std::max(task.options.same, 10 * solution.uncertain);
  return std::none_of(others.begin(), others.end(), [&](const Vector& other) {
    return largest(task, between_solutions(task, solution.x, other)) <= same;
  });
}

/// The damped method first, which is surer; where it gets stuck the plain one, which is bolder.
std::optional<Solution> new_solution(const SearchTask& task, const Vector& start,
                                     const std::vector<Vector>& away_from, SearchResult& result) {
  for (const double shortest : {told_apart, 1.0}) {
    const auto near = deflated_newton(task, start, away_from, shortest);
    auto solution = near ? solution_near(task, *near, result) : std::nullopt;
    if (solution && is_new(task, *solution, away_from)) return solution;
  }
  return std::nullopt;
}

/// Bits of the generator are used as they are: library distributions differ between libraries.
double random_fraction(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// The middle of the box first, then in turn a random point of the box and one beside a solution.
Vector start_point(const SearchTask& task, int number, const std::vector<Vector>& solutions,
                   std::mt19937_64& random) {
  if (number == 0) return task.middle;
  const bool beside = number % 2 == 0 && !solutions.empty();
  const auto which =
      static_cast<std::size_t>(number / 2) % std::max<std::size_t>(1, solutions.size());
  const double reach = beside ? std::pow(10, -0.5 - 2 * random_fraction(random)) : 1;
  Vector x = beside ? solutions[which] : task.middle;
  const Vector box = task.options.high - task.options.low;
  for (Index i = 0; i < x.size(); ++i) x[i] += reach * (random_fraction(random) - 0.5) * box[i];
  return x;
}

/// By their entries, rounded so that rounding errors do not decide.
void sort(const SearchTask& task, std::vector<Solution>& solutions) {
  const double grid = task.options.same;
  const auto before = [&](const Solution& a, const Solution& b) {
    for (Index i = 0; i < a.x.size(); ++i) {
      const double p = std::round((a.x[i] - task.middle[i]) / task.side[i] / grid);
      const double q = std::round((b.x[i] - task.middle[i]) / task.side[i] / grid);
      if (p != q) return p < q;
    }
    return false;
  };
  std::stable_sort(solutions.begin(), solutions.end(), before);
}

}  // namespace

std::vector<std::string> problems_in(const SearchOptions& options, Index size) {
  std::vector<std::string> problems;
  if (options.low.size() != size || options.high.size() != size)
    problems.push_back("low, high: need as many entries as there are unknowns");
  else if (!options.low.allFinite() || !options.high.allFinite() ||
           !(options.low.array() <= options.high.array()).all())
    problems.push_back("low, high: need finite numbers with low <= high");
  if (options.starts < 1) problems.push_back("starts: must be at least 1");
  if (!(options.shift >= 0)) problems.push_back("shift: must not be negative");
  if (!(options.power >= 1)) problems.push_back("power: must be at least 1");
  if (options.iterations < 1) problems.push_back("iterations: must be at least 1");
  if (options.maximum_solutions < 1) problems.push_back("maximum_solutions: must be at least 1");
  if (!(options.same > 0)) problems.push_back("same: must be positive");
  if (!(options.switch_tolerance >= 0))
    problems.push_back("switch_tolerance: must not be negative");
  if (!(options.newton.residual_tolerance > 0))
    problems.push_back("newton.residual_tolerance: must be positive");
  if (options.newton.maximum_iterations < 1)
    problems.push_back("newton.maximum_iterations: must be at least 1");
  return problems;
}

SearchResult search_at(ProblemView problem, double lambda, const std::vector<Vector>& known,
                       const SearchOptions& options) {
  check_search(problem, lambda, known, options);
  SearchTask task{problem,
                  lambda,
                  options,
                  0.5 * (options.low + options.high),
                  options.high - options.low,
                  problem.periods(),
                  problem.double_covers()};
  for (double& side : task.side)
    if (!(side > 0)) side = 1;
  SearchResult result;
  std::vector<Vector> away_from = known;
  std::vector<Solution> found;
  std::mt19937_64 random(options.seed);
  while (result.starts_used < options.starts && !result.limit_reached) {
    const Vector start = start_point(task, result.starts_used++, away_from, random);
    while (auto solution = new_solution(task, start, away_from, result)) {
      away_from.push_back(solution->x);
      found.push_back(std::move(*solution));
      result.limit_reached = static_cast<int>(found.size()) == options.maximum_solutions;
      if (result.limit_reached) break;
    }
    if (!result.limit_reached) ++result.dead_ends;
  }
  sort(task, found);
  for (Solution& solution : found) {
    result.solutions.push_back(std::move(solution.x));
    result.pieces.push_back(std::move(solution.piece));
    result.notes.push_back(std::move(solution.note));
  }
  return result;
}

}  // namespace springfold::continuation
