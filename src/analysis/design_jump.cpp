#include "design_jump.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "local_boundary.hpp"

namespace springfold::analysis {
namespace {

/// What falls like a root falls by the root of a gap: what is missed by so many times that beyond the gap jumps.
constexpr double by_far = 10;
/// Designs next to a jump cannot always be judged, where points merge on them: it is told across a gap no wider than
/// this.
constexpr double widest_gap = 1e-6;
/// Whether anything jumps is seen early from two gaps, this one and its square: over as much a root falls by 2^-5, what
/// jumps does not. Between both:
constexpr double wide_gap = 0x1p-10, jumps_from = 0.2;
/// Neighbours of a place, as parts of the change: first, and last, where rates of the third order add a millionth to
/// the normal.
constexpr double first_beside = 0x1p-6, last_beside = 0x1p-10;
/// Neighbours are located to this part of the square of their distance: it is the error of the curvature.
constexpr double part_of_square = 0x1p-10;
/// A boundary leans no more than this from its guessed normal.
constexpr double steepest = 32;
/// Where the best step along the boundary is shorter, relative to the change, the change is stationary.
constexpr double stationary = 1e-6;
/// What is as near to zero or a bound lies on it; steps are as exact as their small problem is solved.
constexpr double on_bound = 1e-12;
/// Few steps are needed from anywhere: they have curvature.
constexpr int most_steps = 30;

bool is_among(const std::vector<std::size_t>& list, std::size_t one) {
  return list.empty() || std::find(list.begin(), list.end(), one) != list.end();
}

/// With rates of zero where those of requirements that jump are not defined: the boundary tells of these. Nothing where
/// others are not.
std::optional<Assessment> with_known_rates(std::optional<Assessment> at,
                                           const std::vector<std::size_t>& jumping) {
  for (Index i = 0; at && i < at->g.size(); ++i) {
    if (at->dg.row(i).allFinite()) continue;
    const std::size_t of = at->of[static_cast<std::size_t>(i)];
    if (std::find(jumping.begin(), jumping.end(), of) == jumping.end()) return std::nullopt;
    at->dg.row(i).setZero();
  }
  return at;
}

class BoundarySearch {
 public:
  BoundarySearch(const JumpProblem& problem, JumpEnd from)
      : problem_{problem}, end_{std::move(from)}, length_{end_.changes.norm()} {}

  JumpEnd run(const std::vector<Vector>& known);

 private:
  double size(const Vector& u) const { return problem_.is_sum ? u.lpNorm<1>() : u.norm(); }
  bool is_inside(const Vector& u) const {
    return (u.array() >= problem_.low.array()).all() && (u.array() <= problem_.high.array()).all();
  }
  double closeness() const {
    return std::max(closely * length_, part_of_square * beside_ * beside_ / length_);
  }
  /// Of the local boundary at a distance, about.
  double error(double distance) const { return distance * std::pow(distance / length_, 2) / 4; }
  std::optional<Vector> crossing(const Vector& base, const Vector& along, double width,
                                 double reach, double close,
                                 const std::vector<std::size_t>& only) const;
  std::optional<LocalBoundary> frame(const Vector& normal, Index& two_sided) const;
  std::optional<LocalBoundary> fitted(const Vector& normal) const;
  std::optional<Vector> restored(const Vector& x, const Assessment& here, double width,
                                 double reach) const;
  bool move();
  void sharpen();

  const JumpProblem& problem_;
  JumpEnd end_;
  const double length_;
  double last_ = 0, beside_ = 0, radius_ = 0;
  double known_ = closely * length_;  ///< how closely the place is on the boundary
  std::optional<LocalBoundary> local_{};
};

/// Where the requirements begin to hold on the line base + s along, near s = 0.
std::optional<Vector> BoundarySearch::crossing(const Vector& base, const Vector& along,
                                               double width, double reach, double close,
                                               const std::vector<std::size_t>& only) const {
  const auto is_met = [&](double s) { return holds(problem_.judge(base + s * along, only), only); };
  const bool first = is_met(0);
  double last = 0, other = 0;
  do {
    last = other;
    other += first ? -width : width;
    width *= 4;
    if (std::abs(other) > reach || !is_inside(base + other * along) || problem_.stopped())
      return std::nullopt;
  } while (is_met(other) == first);
  double bad = first ? other : last, good = first ? last : other;
  while (good - bad > close && !problem_.stopped()) {
    const double middle = bad + 0.5 * (good - bad);
    if (middle <= bad || middle >= good) break;
    (is_met(middle) ? good : bad) = middle;
  }
  return base + good * along;
}

/// Directions at the place: at bounds inwards only, and the boundary is looked for along them.
std::optional<LocalBoundary> BoundarySearch::frame(const Vector& normal, Index& two_sided) const {
  const Vector& u = end_.changes;
  const Index n = u.size();
  std::vector<Index> free;
  std::vector<std::pair<Index, double>> held;
  for (Index i = 0; i < n; ++i)
    if (u[i] - problem_.low[i] < 2 * beside_)
      held.emplace_back(i, 1);
    else if (problem_.high[i] - u[i] < 2 * beside_)
      held.emplace_back(i, -1);
    else
      free.push_back(i);
  const Vector open = normal(free);
  if (free.empty() || open.norm() * steepest < normal.norm()) return std::nullopt;
  LocalBoundary local{.at = u, .tangents = Matrix::Zero(n, n - 1), .along = Vector::Zero(n)};
  local.along(free) = open.normalized();
  two_sided = std::ssize(free) - 1;
  const Matrix q = Eigen::HouseholderQR<Matrix>(open).householderQ();
  for (Index c = 0; c < two_sided; ++c) local.tangents.col(c)(free) = q.col(c + 1);
  Index column = two_sided;
  for (const auto& [i, sign] : held)
    local.tangents.col(column++) =
        sign * (Vector::Unit(n, i) - normal[i] / open.norm() * local.along);
  Matrix all(n, n);
  all << local.tangents, local.along;
  local.inverse = all.inverse();
  return local;
}

/// The boundary through its points beside the place.
std::optional<LocalBoundary> BoundarySearch::fitted(const Vector& normal) const {
  Index two_sided = 0;
  auto local = frame(normal, two_sided);
  if (!local) return std::nullopt;
  const std::vector<Vector> all = offsets(local->tangents.cols(), two_sided, beside_);
  Vector y(std::ssize(all));
  for (std::size_t k = 0; k < all.size(); ++k) {
    Vector base = local->at + local->tangents * all[k];
    double width = beside_ / 4;
    if (local_) {  // the boundary as it was known before leads there
      const double guess = local_->value(base) / -local_->rates(base).dot(local->along);
      if (std::abs(guess) < beside_) {
        base += guess * local->along;
        width = std::max(4 * closeness(), error((base - local_->at).norm()));
      }
    }
    if (!is_inside(base)) return std::nullopt;
    const auto found = crossing(base, local->along, std::min(width, beside_ / 4),
                                steepest * beside_, closeness(), end_.jumping);
    if (!found) return std::nullopt;
    const Vector w = local->inverse * (*found - local->at);
    y[static_cast<Index>(k)] = w[w.size() - 1];
  }
  pass(*local, all, y);
  return local;
}

/// The design next to `x` that meets all requirements: what lies on a bound stays there, and so do linear requirements
/// on their limits.
std::optional<Vector> BoundarySearch::restored(const Vector& x, const Assessment& here,
                                               double width, double reach) const {
  const Vector moved = x - end_.changes;
  std::vector<Index> free;
  for (Index i = 0; i < x.size(); ++i) {
    const double room = std::min(x[i] - problem_.low[i], problem_.high[i] - x[i]);
    if (room > on_bound && (!problem_.is_sum || std::abs(x[i]) > on_bound)) free.push_back(i);
  }
  if (free.empty()) return std::nullopt;
  const Vector g = here.g + here.dg * moved;
  std::vector<Vector> normals{-local_->rates(x)};
  for (Index i = 0; i < g.size(); ++i)
    if (g[i] > -on_bound) normals.emplace_back(-here.dg.row(i).transpose());
  Matrix rows(std::ssize(normals), std::ssize(free));
  for (Index i = 0; i < rows.rows(); ++i)
    rows.row(i) = normals[static_cast<std::size_t>(i)](free).transpose();
  const auto solver = rows.completeOrthogonalDecomposition();
  const auto towards = [&](const Vector& gains) {
    Vector along = Vector::Zero(x.size());
    const Vector open = solver.solve(gains);
    along(free) = open;
    return Vector(along.normalized());
  };
  const Vector base = x.cwiseMax(problem_.low).cwiseMin(problem_.high);
  const Vector across = towards(Vector::Unit(rows.rows(), 0));
  if (!(across.norm() > 0)) return std::nullopt;
  const auto found = crossing(base, across, width, reach, closeness(), end_.jumping);
  if (!found || holds(problem_.judge(*found, {}))) return found;
  return crossing(*found, towards(Vector::Ones(rows.rows())), width, reach, closeness(), {});
}

/// One step with the boundary as it is known. @returns whether the change got smaller
bool BoundarySearch::move() {
  const auto here = with_known_rates(problem_.judge(end_.changes, {}), end_.jumping);
  if (!here) return false;
  while (!problem_.stopped()) {
    // The small problem's line search stops short in a unit that does not suit the step.
    const SmallProblem small{problem_, end_.changes, *here, &*local_, radius_};
    Vector x = end_.changes;
    for (const double unit : {length_, std::sqrt(length_ * beside_), beside_})
      x = small.least(x, unit);
    const double way = (x - end_.changes).norm();
    if (!(way > stationary * length_)) return false;
    const double width = std::max(closeness(), error(way));
    const auto found = restored(x, *here, width, way + 64 * width);
    if (found && size(*found) < size(end_.changes)) {
      end_.changes = *found;
      known_ = closeness();
      radius_ = std::max(radius_, 2 * way);
      beside_ = std::clamp(way, last_, beside_);
      return true;
    }
    radius_ = way / 4;
  }
  return false;
}

/// The place as near to the boundary as can be told.
void BoundarySearch::sharpen() {
  const auto here = with_known_rates(problem_.judge(end_.changes, {}), end_.jumping);
  if (!here) return;
  beside_ = 0;
  const auto found = restored(end_.changes, *here, closeness(), steepest * known_);
  if (found && size(*found) < size(end_.changes)) end_.changes = *found;
}

JumpEnd BoundarySearch::run(const std::vector<Vector>& known) {
  const double room = (problem_.high - problem_.low).minCoeff() / 8;
  last_ = std::min(room, last_beside * length_);
  beside_ = std::min(room, first_beside * length_);
  radius_ = length_ / 2;
  Vector normal = end_.inwards;
  for (int i = 0; i < most_steps && beside_ > last_ / 16 && !problem_.stopped(); ++i) {
    const auto local = fitted(normal);
    if (!local) {
      beside_ /= 4;
      continue;
    }
    local_ = local;
    normal = -local_->rates(end_.changes);
    if (move()) {
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const Vector& other) {
        return are_alike(other, end_.changes) &&
               size(other) <= size(end_.changes) * (1 + stationary);
      });
      if (is_known) {
        end_.is_known = true;
        return end_;
      }
    } else if (beside_ <= last_) {
      end_.slope = local_->rates(end_.changes);
      break;
    } else {
      beside_ = std::max(last_, beside_ / 16);
      radius_ = std::max(radius_, 4 * beside_);
    }
  }
  if (local_) sharpen();
  return end_;
}

/// Is what is missed behind a bracket no less behind a much narrower one, as where something jumps? Where it is not
/// known that is not told.
bool may_jump(const Bracket& wide, const Bracket& narrow) {
  return !std::isfinite(wide.missed) || !(narrow.missed < wide.missed * jumps_from);
}

/// The place on the boundary, and what is missed just beyond.
JumpEnd end_within(const JumpProblem& problem, const Bracket& wide) {
  const Bracket at = narrowed(problem, wide, closely);
  JumpEnd end{.changes = met_place(at), .inwards = -at.way.normalized()};
  auto missed = problem.judge(at.from + at.bad * at.way, {});
  double gap = std::max(at.bad - at.good, closely);
  while (!missed && gap < widest_gap && !problem.stopped()) {
    gap *= 4;
    missed = problem.judge(at.from + std::min(1.0, at.good + gap) * at.way, {});
  }
  const double far = by_far * std::sqrt(gap);
  end.jumps = !missed || missed->g.maxCoeff() > far;
  for (Index i = 0; missed && i < missed->g.size(); ++i) {
    const std::size_t of = missed->of[static_cast<std::size_t>(i)];
    if (missed->g[i] > far && (end.jumping.empty() || !is_among(end.jumping, of)))
      end.jumping.push_back(of);
  }
  return end;
}

}  // namespace

double most_missed(const Assessment& at, const std::vector<std::size_t>& only) {
  double most = -HUGE_VAL;
  for (Index i = 0; i < at.g.size(); ++i)
    if (is_among(only, at.of[static_cast<std::size_t>(i)])) most = std::max(most, at.g[i]);
  return most;
}

bool holds(const std::optional<Assessment>& at, const std::vector<std::size_t>& only) {
  return at && most_missed(*at, only) <= design_tolerance;
}

Bracket narrowed(const JumpProblem& problem, Bracket at, double width) {
  while (at.bad - at.good > width && !problem.stopped()) {
    const double middle = at.good + 0.5 * (at.bad - at.good);
    if (middle <= at.good || middle >= at.bad) break;
    const auto there = problem.judge(at.from + middle * at.way, {});
    (holds(there) ? at.good : at.bad) = middle;
    if (at.bad == middle) at.missed = there ? most_missed(*there) : HUGE_VAL;
  }
  return at;
}

Bracket bracket(const JumpProblem& problem, const Vector& from, const Vector& to, double width) {
  return narrowed(problem, {.from = from, .way = to - from}, width);
}

JumpEnd drawn_to(const JumpProblem& problem, const Vector& from, const Vector& to) {
  return end_within(problem, {.from = from, .way = to - from});
}

std::optional<JumpEnd> jump_between(const JumpProblem& problem, const Vector& from,
                                    const Vector& to) {
  const Bracket wide = bracket(problem, from, to, wide_gap),
                narrow = narrowed(problem, wide, wide_gap * wide_gap);
  if (!may_jump(wide, narrow)) return std::nullopt;
  JumpEnd end = end_within(problem, narrow);
  return end.jumps ? std::optional{std::move(end)} : std::nullopt;
}

JumpEnd drawn_back(const JumpProblem& problem, const Vector& changes) {
  JumpEnd end{.changes = changes};
  for (int i = 0; i < most_steps && !end.jumps && !problem.stopped(); ++i) {
    const auto here = with_known_rates(problem.judge(end.changes, {}), {});
    if (!here) break;
    const double length = end.changes.norm();
    const Vector target = SmallProblem{problem, end.changes, *here}.least(end.changes, length);
    if (!((target - end.changes).norm() > stationary * length)) break;
    const Vector before = end.changes;
    if (holds(problem.judge(target, {})))
      end.changes = target;
    else
      end = drawn_to(problem, end.changes, target);
    if (!((before - end.changes).norm() > stationary * length)) break;
  }
  return end;
}

JumpEnd least_on_boundary(const JumpProblem& problem, JumpEnd from,
                          const std::vector<Vector>& known) {
  return BoundarySearch(problem, std::move(from)).run(known);
}

}  // namespace springfold::analysis
