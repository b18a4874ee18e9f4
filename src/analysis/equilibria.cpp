#include "equilibria.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "branch_rows.hpp"
#include "limits.hpp"
#include "morse.hpp"
#include "quantities.hpp"
#include "springfold/continuation/search.hpp"
#include "springfold/model/rotation_vector.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

struct Box {
  Vector middle{}, side{};
};

/// What a search found, before it is written in words and columns.
struct Found {
  Vector z{};
  Piece piece{};
  std::string note{};
};

/// Bits of the generator are used as they are: library distributions differ between libraries.
double random_fraction(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

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
  for (const Limit& limit : study.search.box)
    for (const QuantityDefinition& q : quantities)
      if (q.name == limit.quantity && q.kind == QuantityDefinition::Kind::unknown) {
        box.middle[q.entry] = (limit.low + limit.high) / 2 / q.scale;
        box.side[q.entry] = (limit.high - limit.low) / q.scale;
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

/// Is this state within the study's limits?
using InRange = std::function<bool(const Vector& z)>;

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
  void run(const Vector& start, const Piece& piece, bool is_solution) {
    if (is_solution) add({start, piece, ""});
    std::mt19937_64 random(study_.search.seed);
    for (; report_.starts < study_.search.starts && !report_.limit_reached; ++report_.starts)
      search_from(report_.starts == 0 ? start : next_start(random));
  }

  const std::vector<Found>& found() const { return found_; }
  const EquilibriaReport& report() const { return report_; }

 private:
  /// Newton's method as it is, then driven away from everything that is known.
  void search_from(const Vector& from) {
    continuation::SearchOptions options{.low = from - box_.side / 2,
                                        .high = from + box_.side / 2,
                                        .starts = 1,
                                        .maximum_solutions = 1};
    take(continuation::search_at(problem_, 0, {}, options));
    std::vector<Vector> known;
    for (const Found& f : found_) known.push_back(f.z);
    options.maximum_solutions = study_.search.maximum - static_cast<int>(found_.size()) + 1;
    take(continuation::search_at(problem_, 0, known, options));
  }

  void take(const continuation::SearchResult& result) {
    for (std::size_t i = 0; i < result.solutions.size(); ++i)
      add({result.solutions[i], result.pieces[i], result.notes[i]});
  }

  void add(Found found) {
    for (Index i = 0; i < found.z.size(); ++i)
      if (periods_[i] > 0)
        found.z[i] -= periods_[i] * std::round((found.z[i] - box_.middle[i]) / periods_[i]);
    if (is_known(found.z)) return;
    if (static_cast<int>(found_.size()) == study_.search.maximum)
      report_.limit_reached = true;
    else
      found_.push_back(std::move(found));
  }

  bool is_known(const Vector& z) const {
    return std::any_of(found_.begin(), found_.end(), [&](const Found& other) {
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
    Vector z = suited(drawn(report_.starts, random));
    for (int i = 1; i < draws && !in_range_(z); ++i) z = suited(drawn(report_.starts, random));
    // Random states in turn from downhill, from a saddle, and as they are; even ones lie beside an
    // equilibrium that is known.
    const int kind = report_.starts % 6;
    if (!problem_.symmetric() || kind == 0) return z;
    return kind == 3 ? followed(z, 1) : kind == 1 ? followed(z, 0) : z;
  }

  /// In turn a random state of the box, and one beside an equilibrium that is known.
  Vector drawn(int number, std::mt19937_64& random) const {
    const bool beside = number % 2 == 0 && !found_.empty();
    const auto which =
        static_cast<std::size_t>(number / 2) % std::max<std::size_t>(1, found_.size());
    const double reach = beside ? std::pow(10, -0.5 - 2 * random_fraction(random)) : 1;
    Vector z = beside ? found_[which].z : box_.middle;
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
    for (int k = 0; k < rounds && linearised(z, A, r); ++k) {
      const Matrix J = A(parts_.wrenches, parts_.coordinates);
      const Vector gap = r(parts_.wrenches);
      if (J.size() == 0 || gap.lpNorm<Eigen::Infinity>() < 1e-6) return;
      Vector step = -J.completeOrthogonalDecomposition().solve(gap);
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
    z(parts_.wrenches) = -G.completeOrthogonalDecomposition().solve(Vector(r(parts_.moving)));
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
      const Matrix Z = kernel(A(parts_.wrenches, parts_.moving));
      if (Z.cols() == 0) break;
      const Matrix H = A(parts_.moving, parts_.moving);
      const Eigen::SelfAdjointEigenSolver<Matrix> modes(Z.transpose() * H * Z);
      Vector y = modes.eigenvectors().transpose() * (Z.transpose() * Vector(r(parts_.moving)));
      for (Index i = 0; i < y.size(); ++i)
        y[i] *= (i < uphill ? 1 : -1) / std::max(softest, std::abs(modes.eigenvalues()[i]));
      const double size = y.norm();
      if (size > longest) y *= longest / size;
      z(parts_.moving) += Z * (modes.eigenvectors() * y);
      z = suited(std::move(z));
      if (size < arrived) break;
    }
    return z;
  }

  /// Orthonormal basis of the directions in which J is zero; all directions where J has no rows.
  static Matrix kernel(const Matrix& J) {
    if (J.rows() == 0) return Matrix::Identity(J.cols(), J.cols());
    const Eigen::ColPivHouseholderQR<Matrix> qr(J.transpose());
    const Matrix Q = qr.householderQ();
    return Q.rightCols(J.cols() - qr.rank());
  }

  const PathProblem& problem_;
  const Study& study_;
  Box box_;
  InRange in_range_;
  Parts parts_;
  Vector periods_;
  std::vector<Found> found_{};
  EquilibriaReport report_{};
};

/// Poses with rotation vectors as rotation matrices, so that turns do not count.
bool same_poses(const statics::System& system, const Vector& a, const Vector& b, double near) {
  for (std::size_t i = 0; i < system.body_slices.size(); ++i) {
    const auto& slice = system.body_slices[i];
    const model::TaskSpace space = system.mechanism.bodies[i].task_space;
    const Index lengths = translations(space);
    const Vector p = a.segment(slice.t, slice.count), q = b.segment(slice.t, slice.count);
    if ((p - q).head(lengths).lpNorm<Eigen::Infinity>() > near) return false;
    if (space == model::TaskSpace::planar &&
        std::abs(std::remainder(p[2] - q[2], 2 * std::numbers::pi)) > near)
      return false;
    if (space == model::TaskSpace::spatial) {
      const model::Vec3<double> u = p.tail(3), v = q.tail(3);
      if ((model::exp_rotation(u) - model::exp_rotation(v)).cwiseAbs().maxCoeff() > near)
        return false;
    }
  }
  return true;
}

/// The same bodies, spring deflections and forces: other coordinates of joints without springs,
/// like those of a universal joint turned over, make no other equilibrium.
bool same_equilibrium(const statics::System& system, const Vector& a, const Vector& b) {
  constexpr double near = 1e-7;
  for (const statics::CoordinateSpring& spring : system.springs)
    if (std::abs(a[spring.coordinate] - b[spring.coordinate]) > near) return false;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)] &&
        std::abs(a[i] - b[i]) > near * std::max(1.0, std::abs(a[i])))
      return false;
  return same_poses(system, a, b, near);
}

/// Spring energy less the work of the dead load, dimensionless; NaN where it is not defined.
double potential_of(const PathProblem& problem, const Vector& z) {
  const statics::System& system = problem.system(0);
  if (!problem.symmetric()) return std::numeric_limits<double>::quiet_NaN();
  double potential = spring_energy(system, z);
  const Vector W = problem.inputs(0).W;
  for (const auto& slice : system.body_slices)
    potential -= W.segment(slice.W, slice.count).dot(z.segment(slice.t, slice.count));
  return potential;
}

/// Lowest potential first; rounding does not decide.
void sort(std::vector<Found>& found, const PathProblem& problem) {
  const auto key = [&problem](const Found& f) {
    const double v = potential_of(problem, f.z);
    return std::round((std::isnan(v) ? spring_energy(problem.system(0), f.z) : v) * 1e9);
  };
  std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
    const double va = key(a), vb = key(b);
    if (va != vb) return va < vb;
    for (Index i = problem.system(0).first_pose; i < a.z.size(); ++i) {
      const double p = std::round(a.z[i] * 1e7), q = std::round(b.z[i] * 1e7);
      if (p != q) return p < q;
    }
    return false;
  });
}

CurvePoint point_at(const PathProblem& problem, const Found& found) {
  CurvePoint point;
  point.x = found.z;
  point.piece = found.piece;
  count_negative(problem, point);
  return point;
}

/// Chains whose joints cannot move their end in all directions in which they can elsewhere: a bar
/// along the first axis of its universal joint, a bar of no length.
std::string locked_chains(const PathProblem& problem, const Evaluator& evaluator,
                          const Found& found) {
  const statics::System& system = problem.system(0);
  const auto ranks = evaluator.closure_ranks(point_at(problem, found));
  std::string names;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const auto& slice = system.chain_slices[i];
    if (ranks[i] < std::min(slice.x_count, slice.F_count))
      names += (names.empty() ? "" : ", ") + system.mechanism.chains[i].name;
  }
  return names;
}

CountedEquilibrium counted(const PathProblem& problem, const Evaluator& evaluator,
                           const Found& found) {
  const CurvePoint point = point_at(problem, found);
  CountedEquilibrium result{found.z, std::nullopt,
                            !locked_chains(problem, evaluator, found).empty()};
  if (point.negative) result.index = *point.negative - problem.closures();
  return result;
}

}  // namespace

void find_equilibria(const Setup& setup, const Study& study, const statics::FirstEquilibrium& first,
                     StudyResult& result) {
  const PathProblem problem(setup.system, setup.rule);
  const Evaluator evaluator(problem, study, setup.scales);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  const Vector from = result.start.found ? first.z : start_guess(setup, study);
  const auto in_range = [&](const Vector& z) {
    CurvePoint point;
    point.x = z;
    point.piece = statics::piece_at(problem.system(0), z);
    return !limit_passed(study, evaluator, quantities, point);
  };
  Searcher searcher(problem, study, box_of(problem, study, quantities, from), in_range);
  searcher.run(from, first.piece, result.start.found);

  EquilibriaReport report = searcher.report();
  std::vector<Found> distinct;
  std::vector<CountedEquilibrium> raw, once;
  for (const Found& f : searcher.found()) {
    raw.push_back(counted(problem, evaluator, f));
    const bool is_known = std::any_of(distinct.begin(), distinct.end(), [&](const Found& other) {
      return same_equilibrium(problem.system(0), f.z, other.z);
    });
    if (is_known) continue;
    distinct.push_back(f);
    once.push_back(raw.back());
  }
  report.morse = morse_count(problem, raw, once);
  sort(distinct, problem);
  for (const Found& f : distinct) {
    const CurvePoint point = point_at(problem, f);
    if (limit_passed(study, evaluator, quantities, point)) {
      ++report.out_of_range;
      continue;
    }
    Equilibrium equilibrium{.label = "EQ" + std::to_string(report.list.size() + 1)};
    equilibrium.sample = single_point(point, evaluator, quantities, problem).samples.front();
    equilibrium.potential = setup.scales.moment() * potential_of(problem, f.z);
    equilibrium.stiffness = evaluator.platform_stiffness(point);
    equilibrium.note = f.note;
    if (const std::string locked = locked_chains(problem, evaluator, f); !locked.empty())
      equilibrium.note += (f.note.empty() ? "" : "; ") +
                          ("the joints of " + locked + " are locked here: they lose rank");
    equilibrium.is_start = result.start.found && same_equilibrium(problem.system(0), f.z, first.z);
    report.list.push_back(std::move(equilibrium));
  }
  if (!result.start.found && !report.list.empty()) {
    result.start.found = true;
    result.start.method =
        "none near the guess (" + result.start.message + "); the search found some";
    result.start.message.clear();
  }
  if (report.morse.applies && report.morse.found != report.morse.expected)
    result.doubts.push_back("the search missed equilibria: the sum of (-1)^index is " +
                            std::to_string(report.morse.found) + ", it must be " +
                            std::to_string(report.morse.expected));
  result.equilibria = std::move(report);
}

}  // namespace springfold::analysis
