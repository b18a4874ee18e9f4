#include "closure_rank.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Singular values of the closures' derivatives, redundant ones left out.
struct ClosureRank {
  double smallest = 0, largest = 0;
  Vector null{};              ///< the combination of closures that belongs to the smallest
  std::vector<Index> rows{};  ///< of the closures among the unknowns of the statics
};

/// @param along  with lambda among what moves
std::optional<ClosureRank> rank_at(const PathProblem& problem, const Vector& x, double lambda,
                                   const Piece& piece, bool along = true) {
  continuation::Linearisation at;
  if (!continuation::linearise(problem, x, lambda, piece, at)) return std::nullopt;
  const statics::System& layout = problem.layout();
  ClosureRank rank;
  for (Index i = 0; i < layout.first_pose; ++i)
    if (layout.is_wrench[static_cast<std::size_t>(i)]) rank.rows.push_back(i);
  const auto m = static_cast<Index>(rank.rows.size());
  if (m == 0) return std::nullopt;
  std::vector<Index> motions;
  for (Index i = 0; i < x.size(); ++i)
    if (std::find(rank.rows.begin(), rank.rows.end(), i) == rank.rows.end()) motions.push_back(i);
  Matrix J(m, static_cast<Index>(motions.size()) + 1);
  for (Index i = 0; i < m; ++i)  // rows of closures are columns of wrenches
    J.row(i).head(J.cols() - 1) =
        product(at, Vector::Unit(x.size(), rank.rows[static_cast<std::size_t>(i)]))(motions);
  J.rightCols(1) = along ? at.dF_dlambda(rank.rows) : Vector(Vector::Zero(m));
  if (layout.redundant > 0) {  // what they say twice counts once
    Vector z, r;
    statics::Workspace work;
    Matrix full;
    const statics::System& system = problem.turned_to_pose(x, lambda, z);
    if (!equilibrium_matrix(system, piece, z, problem.inputs(lambda), work, r, full))
      return std::nullopt;
    if (work.gauge.rows() != layout.redundant) return std::nullopt;
    const Matrix N = work.gauge(Eigen::all, rank.rows).transpose();
    J -= N * (N.transpose() * J);
  }
  const Svd svd = jacobi_svd(J, SingularVectors::full);
  const Index last = m - 1 - layout.redundant;
  if (last < 0) return std::nullopt;
  rank.largest = svd.values[0];
  rank.smallest = last < svd.values.size() ? svd.values[last] : 0;
  rank.null = svd.U.col(last);
  return rank;
}

/// Chains whose closures take part in the null combination: "chains a, b".
std::string words_for(const statics::System& system, const Vector& null) {
  std::string names;
  int count = 0;
  Index row = 0;
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const Index d = system.chain_slices[i].F_count;
    if (null.segment(row, d).norm() > 1e-3) {
      names += (names.empty() ? "" : ", ") + system.mechanism.chains[i].name;
      ++count;
    }
    row += d;
  }
  return (count == 1 ? "chain " : "chains ") + names;
}

/// The largest of what the points have; nothing where none has it.
std::optional<double> largest_rank(const PathProblem& problem, const EndOfCurve& curve,
                                   bool along) {
  std::optional<double> largest;
  for (const continuation::CurvePoint* point : curve.far)
    if (const auto rank = rank_at(problem, point->x, point->lambda, point->piece, along))
      largest = std::max(largest.value_or(0), rank->smallest);
  return largest;
}

/// Of a list that is not empty.
double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Index rank_of(const Matrix& J, double share) {
  if (J.size() == 0) return 0;
  return (jacobi_svd(J).values.array() > share * std::max(1.0, J.norm())).count();
}

std::optional<std::string> nears_kinematic_singularity(const PathProblem& problem,
                                                       const EndOfCurve& curve) {
  constexpr double share = 1e-2;
  const continuation::CurvePoint& end = curve.end;
  const auto here = rank_at(problem, end.x, end.lambda, end.piece);
  const auto there = largest_rank(problem, curve, true);
  if (!here || !there || here->smallest > share * *there) return std::nullopt;
  return "the closures of " + words_for(problem.layout(), here->null) +
         " are about to lose rank together here, a kinematic singularity";
}

namespace {

struct ChainState {
  double smallest = 0;  ///< singular value of its closure in its own coordinates
  double wrench = 0;
};

/// Of every chain; empty where not defined.
std::vector<ChainState> states_of_chains(const PathProblem& problem,
                                         const continuation::CurvePoint& point) {
  Vector z, r;
  statics::Workspace work;
  Matrix A;
  const statics::System& system = problem.turned_to_pose(point.x, point.lambda, z);
  if (problem.structured() ||
      !equilibrium_matrix(system, point.piece, z, problem.inputs(point.lambda), work, r, A))
    return {};
  std::vector<ChainState> list;
  for (const statics::ChainSlice& slice : system.chain_slices) {
    const Matrix J = A.block(slice.F, slice.x, slice.F_count, slice.x_count);
    list.push_back({J.size() > 0 ? jacobi_svd(J).values.minCoeff() : 0,
                    z.segment(slice.F, slice.F_count).norm()});
  }
  return list;
}

}  // namespace

namespace {

/// Below which share of what it is far away a singular value has fallen, is at its end, and how much a force has grown
/// there.
constexpr double fallen = 1e-2, at_end = 1e-3, more_force = 100;

/// What every chain has far along the curve: the largest singular value, the middle wrench.
std::vector<ChainState> states_far(const PathProblem& problem, const EndOfCurve& curve) {
  std::vector<std::vector<ChainState>> all;
  for (const continuation::CurvePoint* point : curve.far)
    if (auto states = states_of_chains(problem, *point); !states.empty())
      all.push_back(std::move(states));
  std::vector<ChainState> list(all.empty() ? 0 : all.front().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<double> wrenches;
    for (const auto& states : all) {
      list[i].smallest = std::max(list[i].smallest, states[i].smallest);
      wrenches.push_back(states[i].wrench);
    }
    list[i].wrench = middle_of(std::move(wrenches));
  }
  return list;
}

/// All chains together.
double whole_wrench(const std::vector<ChainState>& states) {
  double square = 0;
  for (const ChainState& chain : states) square += chain.wrench * chain.wrench;
  return std::sqrt(square);
}

/// A wrench that balances forces f across a direction v in which a singular value falls to zero is f . v over that
/// value, and what stays bounded: from point to point it grows as the inverse, but for a share of the order of what is
/// left.
bool forces_become_infinite(const ChainState& before, const ChainState& end) {
  const double growth = std::log(end.wrench / before.wrench),
               fall = std::log(before.smallest / end.smallest);
  static const double inexact = std::sqrt(fallen);
  return std::isfinite(growth) && fall > fallen && std::abs(growth - fall) < inexact * fall;
}

/// Has the value fallen, and the force grown, as far as at the end of the reach?
bool has_grown(const ChainState& far, const ChainState& end) {
  return end.smallest < at_end * far.smallest && far.wrench > 0 &&
         end.wrench > more_force * far.wrench;
}

void judge(const ChainState& far, const ChainState& before, const ChainState& end,
           StretchedChains& found) {
  found.has_grown |= has_grown(far, end);
  found.is_end_of_reach |= has_grown(far, end) || forces_become_infinite(before, end);
}

/// The joints of no chain are stretched, but all of them together hardly move what is driven: a crank at its dead
/// centre. Or they move on, but what they can do more than before meets forces that nothing balances.
std::optional<StretchedChains> stopped_drive(const PathProblem& problem, const EndOfCurve& curve,
                                             const std::vector<ChainState>& states,
                                             const std::vector<ChainState>& far) {
  const auto rank = [&](const continuation::CurvePoint& at) {
    return rank_at(problem, at.x, at.lambda, at.piece, false);
  };
  const auto here = rank(curve.end), before = rank(curve.before);
  const auto there = largest_rank(problem, curve, false);
  if (!here || !before || !there || !(here->smallest < fallen * *there)) return std::nullopt;
  const std::string chains = words_for(problem.layout(), here->null);
  StretchedChains found;
  // Their closures lose rank with what is driven let go, too.
  found.moves_on = nears_kinematic_singularity(problem, curve).has_value();
  found.text = found.moves_on
                   ? "the closures of " + chains +
                         " lose rank together here, a kinematic singularity: the joints can move "
                         "on in more ways than one, and what they transmit grows without bound; "
                         "behind it another curve begins, from a start there"
                   : "the joints of " + chains +
                         " hardly move any further what is driven, and the forces in them grow "
                         "without bound";
  judge({*there, whole_wrench(far)},
        {before->smallest, whole_wrench(states_of_chains(problem, curve.before))},
        {here->smallest, whole_wrench(states)}, found);
  return found;
}

}  // namespace

std::optional<StretchedChains> stretched_chains(const PathProblem& problem,
                                                const EndOfCurve& curve) {
  const std::vector<ChainState> here = states_of_chains(problem, curve.end),
                                before = states_of_chains(problem, curve.before),
                                there = states_far(problem, curve);
  std::string names;
  int count = 0;
  StretchedChains found;
  for (std::size_t i = 0; i < std::min({here.size(), before.size(), there.size()}); ++i) {
    const bool is_singular_all_along = there[i].smallest <= same_rank;
    if (is_singular_all_along || !(here[i].smallest < fallen * there[i].smallest)) continue;
    names += (names.empty() ? "" : ", ") + problem.layout().mechanism.chains[i].name;
    ++count;
    judge(there[i], before[i], here[i], found);
  }
  if (count == 0) return stopped_drive(problem, curve, here, there);
  found.text =
      (count == 1 ? "chain " + names + " is" : "chains " + names + " are") +
      std::string(
          " stretched out or folded here: the joints hardly move the end any further in one "
          "direction, and the force in it grows without bound");
  return found;
}

namespace {

/// Below which share of the largest a singular value of a solved point is rounding.
constexpr double rounded_rank = 1e-9;

}  // namespace

Vector any_direction(Index size) { return Vector::LinSpaced(size, 0.7, 1.3).normalized(); }

bool closures_always_depend(const PathProblem& problem, const continuation::CurvePoint& point) {
  const Vector any = any_direction(point.x.size());
  for (const double h : {0.0, -look_beside, look_beside}) {
    const auto rank = rank_at(problem, point.x + h * any, point.lambda, point.piece, false);
    if (!rank || rank->smallest > rounded_rank * rank->largest) return false;
  }
  return true;
}

bool closures_contradict(const PathProblem& problem, const continuation::CurvePoint& point) {
  constexpr double allowed_gap = 1e-9;  // of redundant closures [-]
  if (problem.layout().redundant == 0) return false;
  Vector r;
  statics::Workspace work;
  equilibrium_residual(problem.turned(point.x, point.lambda), point.piece,
                       problem.local(point.x, point.lambda), problem.inputs(point.lambda), work, r);
  return work.undetermined.lpNorm<Eigen::Infinity>() > allowed_gap;
}

std::optional<std::string> kinematic_singularity(const PathProblem& problem,
                                                 const continuation::CurvePoint& point) {
  constexpr double drop = 1e-3;
  const bool along = point.tangent.dx.size() > 0;
  const double singular =
      along ? 1e-4 : rounded_rank;  // a point on a curve is located less exactly
  const auto here = rank_at(problem, point.x, point.lambda, point.piece);
  if (!here || here->smallest > singular * here->largest) return std::nullopt;
  const Vector any = any_direction(point.x.size());
  const Vector dx = along ? point.tangent.dx : any;
  const double dlambda = along ? point.tangent.dlambda : 0;
  for (const double h : {-look_beside, look_beside}) {
    const auto there = rank_at(problem, point.x + h * dx, point.lambda + h * dlambda, point.piece);
    const bool is_low_too = there && there->smallest <= rounded_rank * there->largest;
    if (!there || is_low_too || here->smallest > drop * there->smallest) return std::nullopt;
  }
  return "kinematic singularity: the closures of " + words_for(problem.layout(), here->null) +
         " lose rank together, a part of their wrenches is not determined here, and other modes of "
         "assembly may cross that are not searched for";
}

}  // namespace springfold::analysis
