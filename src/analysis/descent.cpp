#include "descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "near_fold.hpp"
#include "resting.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Longest step, in radians or sizes of the mechanism, and that as a part of the distance from zero.
constexpr double longest_step = 0.1, longest_part = 0.1;
/// A mode is taken as at least so stiff, relative to the stiffest: its step stays bounded.
constexpr double softest_part = 1e-6;
/// Newton's method is tried once the steps are so short.
constexpr double nearly_there = 1e-3;
/// Newton's method must not lead away from the state of rest that it polishes.
constexpr double polishing_reach = 0.05;
/// An eigenvalue this small is zero: at a fold whose load is known to 1e-13 it is the root of that. Relative to
/// the largest one, which counts as 1 to 10 units of the problem without dimensions: beside very stiff modes soft
/// ones are soft, not zero. Their rounding is the last number times the largest one.
constexpr double zero_part = 1e-6, least_unit = 1, largest_unit = 10, rounding_part = 1e-12;

double reach_of(const Landscape& landscape, const Vector& x) {
  double size = 0;
  for (const Index i : landscape.moving())
    if (landscape.periods()[i] == 0) size = std::max(size, std::abs(x[i]));
  return std::max(longest_step, longest_part * size);
}

struct Modes {
  Vector curvatures{};
  Matrix directions{};  ///< k x k, along the motions
  Vector slopes{};
  double floor = 0;
};

Modes modes_of(const Ground& at) {
  SymmetricEigen eigen = symmetric_eigen(at.hessian);
  Modes modes{std::move(eigen.values), std::move(eigen.vectors), {}, 0};
  modes.slopes = modes.directions.transpose() * at.slope;
  modes.floor =
      softest_part * modes.curvatures.cwiseAbs().maxCoeff() + std::numeric_limits<double>::min();
  return modes;
}

/// Is the energy nowhere between two states above `bound`?
bool stays_below(const Landscape& landscape, const Ground& from, const Vector& step, double bound) {
  for (const double part : {0.25, 0.5, 0.75}) {
    const auto x = landscape.moved(from, part * step);
    if (!x || !(landscape.energy(*x) <= bound)) return false;
  }
  return true;
}

/// Takes a step y along the modes no farther than second order describes the energy, which has a scale of its own in
/// every part of a large mechanism.
/// @param energy  of the state, then of the next one
/// @param reach   longest step that is trusted; grows and shrinks
std::optional<Vector> trusted(const Landscape& landscape, const Ground& at, const Modes& modes,
                              const Vector& y, double& energy, double& reach) {
  constexpr int halvings = 30;
  constexpr double poor = 0.25, good = 0.05;  // errors, relative to the terms of the energy
  const double longest = reach_of(landscape, at.x);
  reach = std::min(reach, longest);
  for (int h = 0; h < halvings; ++h) {
    const double size = y.norm();
    const Vector step = size > reach ? Vector(y * (reach / size)) : y;
    const Vector bent = 0.5 * modes.curvatures.cwiseProduct(step.cwiseAbs2());
    const Vector straight = modes.slopes.cwiseProduct(step);
    const auto x = landscape.moved(at, modes.directions * step);
    const double e = x ? landscape.energy(*x) : std::numeric_limits<double>::quiet_NaN();
    const double error = std::abs(e - energy - straight.sum() - bent.sum());
    const double terms = straight.cwiseAbs().sum() + bent.cwiseAbs().sum();
    const double rounding = 1e-13 * std::max(1.0, std::abs(energy));
    if (error <= poor * terms + rounding) {
      if (error <= good * terms) reach = std::min(longest, 2 * std::max(reach, step.norm()));
      energy = e;
      return x;
    }
    reach = step.norm() / 2;
  }
  return std::nullopt;
}

class Walk {
 public:
  Walk(const Landscape& landscape, Vector x)
      : landscape_{landscape}, from_{x}, reach_{reach_of(landscape, x)} {
    result_.x = std::move(x);
  }

  Descent down() {
    constexpr int most = 4000;
    double energy = landscape_.energy(result_.x);
    for (int k = 0; k < most && std::isfinite(energy); ++k) {
      if (is_away(landscape_, result_.x, from_)) {
        result_.end = Descent::End::runs_away;
        return result_;
      }
      const auto at = landscape_.ground(result_.x);
      if (!at) return result_;
      if (at->motions.cols() == 0) return rests();
      const double before = energy;
      const Modes modes = modes_of(*at);
      const Vector step = step_at(*at, modes);
      const bool is_in_a_pit = modes.curvatures[0] > 0;
      if (is_in_a_pit && step.norm() < nearly_there && rests().end == Descent::End::rest &&
          result_.state.energy <= energy + rounding(energy)) {
        if (result_.state.is_clear || !falls_aside(*at, modes, energy)) return result_;
        continue;
      }
      const Place place = place_at(*at, modes, step, energy);
      if (place == Place::level && falls_aside(*at, modes, energy)) continue;
      if (place != Place::slope) return rests();
      if (!advance(*at, step, energy)) return rests();
      if (is_in_a_pit && before - energy <= rounding(energy) && step.norm() < nearly_there) {
        const bool is_clear = rests().end == Descent::End::rest && result_.state.is_clear;
        if (is_clear || !falls_aside(*at, modes, energy)) return result_;
      }
    }
    return result_;
  }

 private:
  static double rounding(double energy) { return 1e-14 * std::max(1.0, std::abs(energy)); }

  Vector step_at(const Ground& at, const Modes& modes) const {
    Vector y = -modes.slopes;
    for (Index i = 0; i < y.size(); ++i)
      y[i] /= std::max(modes.floor, std::abs(modes.curvatures[i]));
    const double size = y.norm(), longest = reach_of(landscape_, at.x);
    if (size > std::min(reach_, longest)) y *= std::min(reach_, longest) / size;
    return modes.directions * y;
  }

  enum class Place { slope, saddle, level };

  /// Where the step can gain nothing that rounding does not hide, and the state is in no pit: either a saddle is so
  /// near that it was met head on; rounding alone would choose the side, and who asked leaves it to both. Or nothing
  /// leads on, as on a level floor: beside a ridge of any order the gain along what falls grows from step to step.
  Place place_at(const Ground& at, const Modes& modes, const Vector& step, double energy) {
    const auto before = std::exchange(gain_on_ridge_, std::nullopt);
    if (modes.curvatures[0] > 0 || -at.slope.dot(step) > rounding(energy) ||
        step.norm() >= nearly_there)
      return Place::slope;
    const auto state = rest_near(landscape_, at.x);
    if (state && state->index > 0 && state->is_clear && state->energy <= energy + rounding(energy))
      return Place::saddle;
    double gain = 0;
    for (Index i = 0; i < modes.slopes.size() && modes.curvatures[i] <= 0; ++i)
      gain += modes.slopes[i] * modes.slopes[i] / std::max(modes.floor, -modes.curvatures[i]);
    gain_on_ridge_ = gain;
    return before && gain <= *before ? Place::level : Place::slope;
  }

  /// Slopes that are rounding may be those of a point of inflection, as at a limit point: a little way off along the
  /// softest modes the energy falls clearly. Goes there.
  bool falls_aside(const Ground& at, const Modes& modes, double& energy) {
    const Index soft = std::max<Index>(1, (modes.curvatures.array() <= modes.floor).count());
    for (Index i = 0; i < soft; ++i)
      for (const double side : {-nearly_there, nearly_there}) {
        const Vector step = side * modes.directions.col(i);
        const auto x = landscape_.moved(at, step);
        const double e = x ? landscape_.energy(*x) : std::numeric_limits<double>::quiet_NaN();
        if (!(e < energy - rounding(energy)) || !stays_below(landscape_, at, step, energy))
          continue;
        energy = e;
        result_.x = *x;
        return true;
      }
    return false;
  }

  /// Shortens the step until the energy falls as it should.
  bool advance(const Ground& at, Vector step, double& energy) {
    constexpr int halvings = 40;
    constexpr double enough = 1e-4;
    for (int h = 0; h < halvings; ++h, step /= 2) {
      const auto x = landscape_.moved(at, step);
      const double e = x ? landscape_.energy(*x) : std::numeric_limits<double>::quiet_NaN();
      if (!(e <= energy + enough * at.slope.dot(step)) ||
          !stays_below(landscape_, at, step, energy))
        continue;
      energy = e;
      result_.x = *x;
      reach_ = h == 0 ? 2 * reach_ : std::max(step.norm(), nearly_there);
      return true;
    }
    return false;
  }

  Descent& rests() {
    if (auto state = rest_near(landscape_, result_.x)) {
      result_.end = Descent::End::rest;
      result_.state = std::move(*state);
    } else {
      result_.end = Descent::End::lost;
    }
    return result_;
  }

  const Landscape& landscape_;
  Vector from_;
  double reach_;
  std::optional<double> gain_on_ridge_{};  ///< of the last step, if that was hidden by rounding
  Descent result_{};
};

/// What the modes of one piece say of a state of rest.
struct PieceModes {
  Index index = 0;
  double softest = 0;
  bool is_clear = true;
};

PieceModes modes_on(const Ground& ground) {
  if (ground.hessian.size() == 0) return {};
  const Vector k_i = symmetric_eigenvalues(ground.hessian);
  const double stiffest = k_i.cwiseAbs().maxCoeff();
  const double zero =
      zero_part * std::clamp(stiffest, least_unit, largest_unit) + rounding_part * stiffest;
  return {(k_i.array() < -zero).count(), k_i[0], (k_i.array().abs() > zero).all()};
}

/// Gradients of the switches that rest, one per column; nothing where one does not depend on the unknowns.
std::optional<Matrix> gradients_of(const Terrain& terrain, const Vector& x,
                                   const std::vector<std::size_t>& resting) {
  Matrix dg;
  Vector dg_dlambda;
  if (!terrain.problem.switch_gradients(x, terrain.lambda, dg, dg_dlambda)) return std::nullopt;
  Matrix gradients(dg.cols(), static_cast<Index>(resting.size()));
  for (std::size_t k = 0; k < resting.size(); ++k) {
    const auto row = dg.row(static_cast<Index>(resting[k]));
    if (row.isZero(0)) return std::nullopt;
    gradients.col(static_cast<Index>(k)) = row.transpose();
  }
  return gradients;
}

/// All pieces beside a state at which springs rest, together; nothing where they do not decide it.
std::optional<Index> index_on_cones(const Landscape& landscape, const Ground& at,
                                    const std::vector<Piece>& pieces) {
  const Terrain& terrain = landscape.terrain();
  std::vector<std::size_t> resting;
  for (std::size_t j = 0; j < at.piece.size(); ++j)
    if (std::any_of(pieces.begin(), pieces.end(),
                    [&](const Piece& other) { return other[j] != at.piece[j]; }))
      resting.push_back(j);
  const auto gradients = gradients_of(terrain, at.x, resting);
  if (!gradients) return std::nullopt;
  const auto matrix = [&](const Piece& piece) -> std::optional<Matrix> {
    Matrix A;
    Vector b;
    if (!terrain.problem.derivatives(at.x, terrain.lambda, piece, A, b)) return std::nullopt;
    return A;
  };
  const auto decided = resting_index(matrix, at.piece, resting, *gradients,
                                     static_cast<Index>(landscape.multipliers().size()));
  if (!decided || decided->verdict == Definiteness::undecided) return std::nullopt;
  return static_cast<Index>(decided->index());
}

/// Modes of a state of rest. Where springs rest at their thresholds it is a minimum only if the energy rises in every
/// piece beside it; a saddle then stands on the piece with most unstable modes.
std::optional<RestState> judged(const Landscape& landscape, const Vector& x,
                                const std::vector<Piece>& pieces) {
  std::optional<RestState> state;
  std::optional<Ground> first;
  for (const Piece& piece : pieces) {
    const auto ground = landscape.ground_on(x, piece);
    if (!ground) return std::nullopt;
    if (!first) first = ground;
    const PieceModes modes = modes_on(*ground);
    if (!state) {
      state = RestState{x, piece, landscape.energy(x), modes.index, modes.softest, modes.is_clear};
      continue;
    }
    if (modes.index > state->index) {
      state->index = modes.index;
      state->piece = piece;
    }
    state->softest = std::min(state->softest, modes.softest);
    state->is_clear &= modes.is_clear;
  }
  if (state && pieces.size() == 1 && is_at_own_fold(landscape, *first)) state->is_clear = false;
  if (!state || pieces.size() == 1 || (state->index == 0 && state->is_clear)) return state;
  // Pieces that are no minima may have no room beside the state for their unstable modes.
  if (const auto index = index_on_cones(landscape, *first, pieces)) {
    state->index = *index;
    state->is_clear = true;
    if (*index == 0) state->piece = pieces.front();
  }
  return state;
}

}  // namespace

bool is_away(const Landscape& landscape, const Vector& x, const Vector& from) {
  for (const Index i : landscape.moving()) {
    const double limit =
        landscape.periods()[i] > 0 ? 2 * std::numbers::pi * turns_away : lengths_away;
    if (!(std::abs(x[i] - from[i]) <= limit)) return true;
  }
  return false;
}

std::optional<RestState> rest_near(const Landscape& landscape, const Vector& x) {
  const auto at = landscape.ground(x);
  if (!at) return std::nullopt;
  const Terrain& terrain = landscape.terrain();
  continuation::NewtonOptions options;
  options.maximum_iterations = 50;
  const continuation::Direction only_lambda{Vector::Zero(x.size()), 1};
  Piece piece = at->piece;
  Vector from = at->x;
  constexpr int pieces = 4;  // the solution may lie just beyond a switching surface
  for (int k = 0; k < pieces; ++k) {
    const auto solved = continuation::correct(terrain.problem, terrain.problem.metric(), from,
                                              terrain.lambda, piece, only_lambda, options);
    if (!continuation::converged(solved)) return std::nullopt;
    if ((solved.x - at->x)(landscape.moving()).lpNorm<Eigen::Infinity>() > polishing_reach)
      return std::nullopt;
    const std::vector<Piece> there = landscape.pieces_beside(solved.x);
    if (there.empty()) return std::nullopt;
    if (std::find(there.begin(), there.end(), piece) == there.end()) {
      piece = there.front();
      from = solved.x;
      continue;
    }
    return judged(landscape, solved.x, there);
  }
  return std::nullopt;
}

Descent descend(const Landscape& landscape, Vector x) {
  return Walk(landscape, std::move(x)).down();
}

std::optional<RestState> climb(const Landscape& landscape, Vector x, Vector along, double highest) {
  constexpr int rounds = 240;
  constexpr double kick = 0.02;
  const Vector from = x;
  double reach = std::numeric_limits<double>::infinity(), energy = landscape.energy(x);
  for (int k = 0; k < rounds && energy <= highest; ++k) {
    const auto at = landscape.ground(x);
    if (!at || at->hessian.size() == 0 || is_away(landscape, x, from)) return std::nullopt;
    const Modes modes = modes_of(*at);
    Index up = 0;
    if (along.size() > 0) {
      const Vector seen = (modes.directions.transpose() * (at->motions.transpose() * along));
      seen.cwiseAbs().maxCoeff(&up);
      along = at->motions * (modes.directions.col(up) * (seen[up] < 0 ? -1 : 1));
      if (modes.curvatures[up] < 0) up = 0, along.resize(0);
    }
    Vector y(modes.slopes.size());
    for (Index i = 0; i < y.size(); ++i)
      y[i] = (i == up ? 1 : -1) * modes.slopes[i] /
             std::max(modes.floor, std::abs(modes.curvatures[i]));
    // Along the way up from a minimum there is no slope at first.
    if (along.size() > 0) {
      const double forward = (modes.directions.col(up).dot(at->motions.transpose() * along));
      y[up] = (forward < 0 ? -1 : 1) * std::max(kick, std::abs(y[up]));
    }
    if (along.size() == 0 && y.norm() < nearly_there && modes.curvatures[0] < 0)
      return rest_near(landscape, x);
    const auto next = trusted(landscape, *at, modes, y, energy, reach);
    if (!next) return std::nullopt;
    x = *next;
  }
  return std::nullopt;
}

}  // namespace springfold::analysis
