#include "equilibrium_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/random_fraction.hpp"
#include "closings.hpp"
#include "closure_rank.hpp"
#include "springfold/continuation/search.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::analysis {
namespace {

struct Box {
  Vector middle{}, side{};
};

/// Wrenches are not drawn: those that suit best are computed.
Box box_of(const PathProblem& problem, const Study& study,
           const std::vector<QuantityDefinition>& quantities, const Vector& start) {
  Box box{start, Vector::Constant(start.size(), 4)};
  const std::vector<bool> angles = problem.angles();
  const statics::System& system = problem.system(0);
  for (Index i = 0; i < start.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (angles[k] || (!system.is_wrench[k] && !system.is_length[k]))
      box.side[i] = 2 * std::numbers::pi;
  }
  for (const Limit& limit : study.search.box) {
    const QuantityDefinition* q = find_quantity(quantities, limit.quantity);
    if (q == nullptr || q->kind != QuantityDefinition::Kind::unknown) continue;
    box.middle[q->entry] = (limit.low + limit.high) / 2 / q->scale;
    box.side[q->entry] = (limit.high - limit.low) / q->scale;
  }
  return box;
}

/// Rows and columns of A by what they belong to.
struct Parts {
  std::vector<Index> coordinates{}, wrenches{};
  std::vector<Index> moving{};  ///< coordinates and poses
};

Parts parts_of(const statics::System& system) {
  Parts parts;
  for (Index i = 0; i < system.size; ++i) {
    const bool is_wrench = system.is_wrench[static_cast<std::size_t>(i)];
    (is_wrench ? parts.wrenches : parts.moving).push_back(i);
    if (!is_wrench && i < system.first_pose) parts.coordinates.push_back(i);
  }
  return parts;
}

class Searcher {
 public:
  Searcher(const PathProblem& problem, const Study& study, Box box, InRange in_range)
      : problem_{problem},
        study_{study},
        box_{std::move(box)},
        in_range_{std::move(in_range)},
        parts_{parts_of(problem.system(0))},
        periods_{problem.periods()} {}

  /// @param start  the study's start: an equilibrium if `is_solution`, otherwise a first guess
  EquilibriumSearch run(const Vector& start, const Piece& piece, bool is_solution,
                        const Observer& observer) {
    if (is_solution) add({start, piece, ""});
    std::mt19937_64 random(study_.search.seed);
    for (int wanted = study_.search.starts; result_.starts < wanted && !result_.limit_reached;) {
      result_.interrupted = observer && !observer(result_.starts, 0);
      if (result_.interrupted) break;
      const std::size_t known = result_.found.size();
      search_from(result_.starts == 0 ? start : next_start(random));
      ++result_.starts;
      if (result_.found.size() > known) wanted = std::max(wanted, wanted_behind(result_.starts));
    }
    return std::move(result_);
  }

 private:
  /// A search whose last find came late has hardly found all: it takes as many starts again as it took up to there.
  int wanted_behind(int starts) const {
    constexpr int most = 4;  // times what is asked for
    return static_cast<int>(std::min(2L * starts, static_cast<long>(most) * study_.search.starts));
  }

  /// Newton's method as it is, then driven away from everything that is known.
  void search_from(const Vector& from) {
    continuation::SearchOptions options{.low = from - box_.side / 2,
                                        .high = from + box_.side / 2,
                                        .starts = 1,
                                        .maximum_solutions = 1};
    take(continuation::search_at(problem_, 0, {}, options));
    std::vector<Vector> known;
    for (const FoundEquilibrium& f : result_.found) known.push_back(f.z);
    known.insert(known.end(), left_.begin(), left_.end());
    options.maximum_solutions = study_.search.maximum - static_cast<int>(result_.found.size()) + 1;
    take(continuation::search_at(problem_, 0, known, options));
  }

  void take(const continuation::SearchResult& result) {
    for (std::size_t i = 0; i < result.solutions.size(); ++i)
      add({result.solutions[i], result.pieces[i], result.notes[i]});
  }

  void add(FoundEquilibrium found) {
    for (Index i = 0; i < found.z.size(); ++i)
      if (periods_[i] > 0)
        found.z[i] -= periods_[i] * std::round((found.z[i] - box_.middle[i]) / periods_[i]);
    if (closures_contradict(problem_, {.x = found.z, .piece = found.piece})) {
      left_.push_back(std::move(found.z));
      return;
    }
    const Vector raw = found.z;
    if (shorten_rotations(found.z)) {
      left_.push_back(raw);
      if (!is_solution(found)) return;
    }
    if (is_known(found.z)) return;
    if (static_cast<int>(result_.found.size()) == study_.search.maximum)
      result_.limit_reached = true;
    else
      result_.found.push_back(std::move(found));
  }

  /// Rotation vectors longer than half a turn become the shortest of the same rotation.
  bool shorten_rotations(Vector& z) const {
    const statics::System& system = problem_.system(0);
    bool changed = false;
    for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
      if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
      auto phi = z.segment<3>(system.body_slices[b].t + 3);
      if (!(phi.norm() > std::numbers::pi + 1e-9)) continue;
      phi = model::log_rotation<double>(model::exp_rotation<double>(model::Vec3<double>(phi)));
      changed = true;
    }
    return changed;
  }

  /// At whole turns rotation vectors are singular, and a body seems balanced that is not.
  bool is_solution(const FoundEquilibrium& found) const {
    constexpr double tolerance = 1e-8;
    Vector r;
    return problem_.residual(found.z, 0, found.piece, r) &&
           r.lpNorm<Eigen::Infinity>() <=
               tolerance * std::max(1.0, found.z.lpNorm<Eigen::Infinity>());
  }

  bool is_known(const Vector& z) const {
    return std::any_of(result_.found.begin(), result_.found.end(),
                       [&](const FoundEquilibrium& other) {
                         Vector d = z - other.z;
                         for (Index i = 0; i < d.size(); ++i)
                           if (periods_[i] > 0) d[i] = std::remainder(d[i], periods_[i]);
                         return d.cwiseQuotient(box_.side).lpNorm<Eigen::Infinity>() <=
                                continuation::SearchOptions{}.same;
                       });
  }

  /// Within the study's limits, if that succeeds in a few draws.
  Vector next_start(std::mt19937_64& random) const {
    constexpr int draws = 20;
    Vector z = suited(drawn(result_.starts, random));
    for (int i = 1; i < draws && !in_range_(z); ++i) z = suited(drawn(result_.starts, random));
    if (!problem_.symmetric()) return z;
    // Odd ones, anywhere in the box, in turn from downhill, from a saddle, and as they are. Even ones, beside an
    // equilibrium that is known, as they are, and each fourth from where two modes are unstable, or as many more as
    // there may be.
    const int kind = result_.starts % 6;
    if (kind == 1 || kind == 3) return followed(z, kind == 1 ? 0 : 1);
    const bool is_fourth = result_.starts % 8 == 6;
    return is_fourth ? followed(z, 2 + result_.starts / 8 % other_indices()) : z;
  }

  /// How many numbers of unstable modes there are above 1.
  Index other_indices() const {
    const auto motions = static_cast<Index>(parts_.moving.size() - parts_.wrenches.size());
    return std::max<Index>(1, motions - 1);
  }

  /// In turn a random state of the box, and one beside an equilibrium that is known.
  Vector drawn(int number, std::mt19937_64& random) const {
    const bool beside = number % 2 == 0 && !result_.found.empty();
    const auto which =
        static_cast<std::size_t>(number / 2) % std::max<std::size_t>(1, result_.found.size());
    const double reach = beside ? std::pow(10, -0.5 - 2 * random_fraction(random)) : 1;
    Vector z = beside ? result_.found[which].z : box_.middle;
    for (Index i = 0; i < z.size(); ++i)
      z[i] += reach * (random_fraction(random) - 0.5) * box_.side[i];
    return z;
  }

  /// The same bodies with chains that lead to them, as far as they reach, and the wrenches that
  /// suit best.
  Vector suited(Vector z) const {
    close_chains(z);
    choose_wrenches(z);
    return z;
  }

  bool linearised(const Vector& z, Matrix& A, Vector& r) const {
    Vector b;
    const Piece piece = statics::piece_at(problem_.system(0), z);
    return problem_.residual(z, 0, piece, r) && problem_.derivatives(z, 0, piece, A, b);
  }

  /// A few steps of least squares: [A_Fx] dx = -r_F.
  void close_chains(Vector& z) const {
    constexpr int rounds = 12;
    Matrix A;
    Vector r;
    z(parts_.wrenches)
        .setZero();  // where closures depend on each other their residuals are gaps then
    for (int k = 0; k < rounds && linearised(z, A, r); ++k) {
      const Matrix J = A(parts_.wrenches, parts_.coordinates);
      const Vector gap = r(parts_.wrenches);
      if (J.size() == 0 || gap.lpNorm<Eigen::Infinity>() < 1e-6) return;
      Vector step = -least_squares(J, gap);
      const double size = step.lpNorm<Eigen::Infinity>();
      if (size > 1) step /= size;
      z(parts_.coordinates) += step;
    }
  }

  /// [A_xF; A_tF] F = -(r_x, r_t) at F = 0 in the least-squares sense.
  void choose_wrenches(Vector& z) const {
    Matrix A;
    Vector r;
    z(parts_.wrenches).setZero();
    if (parts_.wrenches.empty() || !linearised(z, A, r)) return;
    const Matrix G = A(parts_.moving, parts_.wrenches);
    z(parts_.wrenches) = -least_squares(G, r(parts_.moving));
  }

  /// Follows the energy downhill, but uphill along the `uphill` lowest modes: to an equilibrium with
  /// that many unstable modes. With the kernel Z of the closure, g = Z^T r, Z^T H Z = V diag(k) V^T,
  /// a step is Z V y with y_i = -+ (V^T g)_i/|k_i|, of bounded length.
  Vector followed(Vector z, Index uphill) const {
    constexpr int rounds = 40;
    constexpr double longest = 0.3, softest = 1e-3, arrived = 1e-3;
    Matrix A;
    Vector r;
    for (int k = 0; k < rounds && linearised(z, A, r); ++k) {
      const Closings closings(A(parts_.wrenches, parts_.moving), problem_.layout().redundant);
      const Matrix Z = closings.motions();
      if (Z.cols() == 0) break;
      const Matrix H = A(parts_.moving, parts_.moving);
      const SymmetricEigen modes = symmetric_eigen(Z.transpose() * H * Z);
      Vector y = modes.vectors.transpose() * (Z.transpose() * Vector(r(parts_.moving)));
      for (Index i = 0; i < y.size(); ++i)
        y[i] *= (i < uphill ? 1 : -1) / std::max(softest, std::abs(modes.values[i]));
      const double size = y.norm();
      if (size > longest) y *= longest / size;
      z(parts_.moving) += Z * (modes.vectors * y);
      z = suited(std::move(z));
      if (size < arrived) break;
    }
    return z;
  }

  const PathProblem& problem_;
  const Study& study_;
  Box box_;
  InRange in_range_;
  Parts parts_;
  std::vector<Vector>
      left_{};  ///< solutions with long rotation vectors, as they were found, and torn ones
  Vector periods_;
  EquilibriumSearch result_{};
};

}  // namespace

EquilibriumSearch search_equilibria(const PathProblem& problem, const Study& study,
                                    const std::vector<QuantityDefinition>& quantities,
                                    const EquilibriumStart& start, const InRange& in_range,
                                    const Observer& observer) {
  return Searcher(problem, study, box_of(problem, study, quantities, start.z), in_range)
      .run(start.z, start.piece, start.is_equilibrium, observer);
}

}  // namespace springfold::analysis
