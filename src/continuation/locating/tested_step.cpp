#include "continuation/locating/tested_step.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/branch_point.hpp"
#include "continuation/locating/cluster.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/locating/sigma_near.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// What lies nearer than this share of the way to the next zeros belongs to these.
constexpr double so_far = 2 * near_share;

/// What is left of Sigma near a place where all of it should vanish, as an error of the place: the
/// largest t with Sigma v = t Sigma' v. Zero where Sigma cannot be told from zero.
double left_of(const Vector& entries, const Vector& slopes, Index m, double nothing) {
  const auto Sigma = entries.reshaped(m, m), slope = slopes.reshaped(m, m);
  if (Sigma.norm() <= nothing) return 0;
  const double left = Lu(slope).solve(Sigma).norm();
  return std::isfinite(left) ? left : infinity;
}

/// Places near t where all m x m entries of Sigma vanish: least squares from several starts.
std::vector<Singularity> multiple_zeros_on(const TestedStep& arc, double t, double length,
                                           Index m) {
  const auto near = sigma_near(arc, t, length, m);
  if (!near) return {};
  const Interpolant& curve = near->curve;
  std::vector<Singularity> found;
  for (const double start : {t, curve.a, curve.b}) {
    double place = start;
    // All entries are multiples of t - t* near the place.
    settles(40, [&](double) -> std::optional<IterationStep> {
      const Vector s = near->entries(place), d = near->entries.slope(place);
      const double step = -d.dot(s) / d.squaredNorm();
      if (!std::isfinite(step)) return std::nullopt;
      place = std::clamp(place + step, curve.a, curve.b);
      return IterationStep{std::abs(step), few_roundings};
    });
    const double left =
        left_of(near->entries(place), near->entries.slope(place), m, m > 1 ? near->nothing : 0) +
        near->error / near->slope(place).norm();
    const bool known = std::any_of(found.begin(), found.end(), [&](const Singularity& other) {
      return std::abs(other.at - place) < 2 * same_point;
    });
    if (left <= same_point && !known)
      found.push_back({place, curve(place), curve.slope(place), left});
  }
  return found;
}

/// The best ones of a wide window, on which rounding matters less, and narrower ones; none that
/// belongs to other zeros of the determinant.
std::vector<Singularity> multiple_zeros(const TestedStep& arc, double t, double free, Index m) {
  const auto worst = [](const std::vector<Singularity>& list) {
    double doubt = 0;
    for (const Singularity& s : list) doubt = std::max(doubt, s.doubt);
    return doubt;
  };
  std::vector<Singularity> best;
  for (const double share : half_decades<5>()) {
    auto found = multiple_zeros_on(arc, t, share * (arc.high() - arc.low()), m);
    std::erase_if(found, [&](const Singularity& s) { return std::abs(s.at - t) > so_far * free; });
    if (!found.empty() && (best.empty() || worst(found) < worst(best))) best = std::move(found);
    if (!best.empty() && worst(best) < residual_level) break;
  }
  return best;
}

/// Does det Sigma cross zero here in the first order, as far as a third of the way to its next zero? Where m modes
/// vanish it has a zero of order m at least: one that is as straight as this is of one mode, however small the others
/// are.
bool is_simple_zero(const TestedStep& arc, double at, Index m, double free) {
  constexpr double straight_at_least = 1.5,
                   straight_at_most = 3;  // 2 on a line, 4 and more where modes vanish together
  const auto& middle = arc.point(0.5 * arc.length());
  const auto E = middle ? arc.matrix(*middle) : std::nullopt;
  if (!E) return false;
  const Borders borders = borders_of(*E, m);
  const auto value = [&](double ds) {
    const auto Sigma = arc.sigma(std::clamp(ds, arc.low(), arc.high()), borders);
    return Sigma ? Sigma->determinant() : 0;
  };
  const double far = near_share * free, near = 0.5 * far;
  const double left = value(at - near), right = value(at + near);
  const auto is_straight = [&](double outer, double inner) {
    return outer / inner > straight_at_least && outer / inner < straight_at_most;
  };
  return left * right < 0 && is_straight(value(at - far), left) &&
         is_straight(value(at + far), right);
}

/// The step's points may be off by more than their scatter shows, beside a multiple point of a path that bends. The
/// equations of one place at which all of these modes vanish do not know the step: do they contradict each other by as
/// much as the modes are apart?
bool contradict_one_place(const TestedStep& arc, const SigmaNear& near,
                          const std::vector<ZeroOfMode>& modes) {
  const double first = modes.front().at, last = modes.back().at;
  const Vector u = near.curve(0.5 * (first + last));
  CurvePoint middle = arc.from();
  middle.x = u.head(u.size() - 1);
  middle.lambda = u[u.size() - 1];
  Index m = 0;
  for (const ZeroOfMode& zero : modes) m += zero.m;
  const auto one = place_branch_point(arc.walker(), middle, static_cast<int>(m));
  return one && one->misfit > small_share * (last - first);
}

/// The places of modes that are told apart, each with its exact point, in order and none on another's.
/// @returns none unless all of them have one
std::vector<Candidate> candidates_of(const TestedStep& arc, const SigmaNear& near,
                                     const std::vector<ZeroOfMode>& modes,
                                     const std::vector<ZeroOf>& zeros, double free) {
  Index all = 0;
  for (const ZeroOfMode& zero : modes) all += zero.m;
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& [at, off, m] = modes[i];
    double alone = free;
    if (i > 0) alone = std::min(alone, at - modes[i - 1].at);
    if (i + 1 < modes.size()) alone = std::min(alone, modes[i + 1].at - at);
    const Singularity place{at, near.curve(at), near.curve.slope(at), off, alone};
    auto candidate = candidate_at(arc, place, zeros, m, false, all);
    if (!candidate || !(std::abs(candidate->at - at) <= near_share * alone)) return {};
    result.push_back(std::move(*candidate));
  }
  return result;
}

/// Several modes vanish close together, where the determinant is lost in its rounding: each of them on its own, or with
/// those that vanish at the same place.
struct Apart {
  std::vector<Candidate>
      found{};  ///< none unless all of them are told apart, and as many as the determinant's signs ask for
  bool several = false;  ///< more than one mode vanishes here
};

Apart apart_at(const TestedStep& arc, const std::vector<ZeroOf>& zeros, Index most, double free) {
  Apart result;
  const double middle = 0.5 * (zeros.front().at + zeros.back().at);
  const double reach = 0.5 * (zeros.back().at - zeros.front().at) + so_far * free;
  const auto crossings =
      std::count_if(zeros.begin(), zeros.end(), [](const ZeroOf& z) { return !z.touches; });
  for (const double share : half_decades<3>()) {
    const auto near = sigma_near(arc, middle, share * (arc.high() - arc.low()), most);
    const auto modes = near ? modes_near(*near, middle, reach) : std::vector<ZeroOfMode>{};
    Index all = 0;
    for (const ZeroOfMode& zero : modes) all += zero.m;
    if (all == 1 && crossings == 1) return {};
    result.several = result.several || all > 1;
    if (modes.size() < 2 || all % 2 != crossings % 2) continue;
    if (!contradict_one_place(arc, *near, modes)) continue;
    result.found = candidates_of(arc, *near, modes, zeros, free);
    if (!result.found.empty()) break;
  }
  return result;
}

/// Branch points where zeros of det Sigma lie together: each on its own where the modes are told apart, multiple ones
/// if all entries vanish in one place, otherwise a simple one, where the zero is.
std::vector<Candidate> branch_points_at(const TestedStep& arc, const std::vector<ZeroOf>& zeros,
                                        Index most, double free) {
  const double middle = 0.5 * (zeros.front().at + zeros.back().at);
  const auto crossings =
      std::count_if(zeros.begin(), zeros.end(), [](const ZeroOf& z) { return !z.touches; });
  std::vector<Candidate> result;
  const auto add = [&](const Singularity& place, Index m, bool touches) {
    Singularity alone = place;
    alone.free = free;
    auto candidate = candidate_at(arc, alone, zeros, m, touches);
    if (!candidate) return false;
    // Interpolated places may be two in their rounding, and the exact one is one.
    if (std::ranges::none_of(result, [&](const Candidate& other) {
          return std::abs(other.at - candidate->at) <=
                 std::max(promised_place, other.off + candidate->off);
        }))
      result.push_back(std::move(*candidate));
    return true;
  };
  const bool is_simple = zeros.size() == 1 && crossings == 1 && most > 1 &&
                         is_simple_zero(arc, zeros.front().at, most, free);
  const Apart apart = is_simple || most == 1 ? Apart{} : apart_at(arc, zeros, most, free);
  if (!apart.found.empty()) return apart.found;
  for (Index m = is_simple ? 1 : most; m > 1; --m) {
    const auto places = multiple_zeros(arc, middle, free, m);
    bool all_settle = true;
    for (const Singularity& place : places) all_settle = add(place, m, false) && all_settle;
    // Some of the eigenvalues may only touch zero: the determinant knows.
    if (result.size() == 1) result.front().odd = crossings % 2 == 1;
    if (!places.empty()) return all_settle ? result : std::vector<Candidate>{};
    // The entries are too small against their rounding; the place itself may be well-conditioned.
    if (crossings == 1 && zeros.size() == 1 && m == 2 &&
        vanishing_modes(arc, most, zeros.front()) < 2)
      continue;
    if (const auto curve = curve_near(arc, middle, aside_share * arc.length()))
      add({middle, (*curve)(middle), curve->slope(middle), infinity}, m, false);
    if (result.size() == 1) {
      result.front().odd = crossings % 2 == 1;
      return result;
    }
  }
  if (zeros.size() > 1 || apart.several) return {};
  const bool touches = zeros.front().touches;
  // Of several modes one must be seen to vanish alone.
  if (touches && most > 1 && vanishing_modes(arc, most, zeros.front()) != 1) return {};
  const auto places = touches ? std::vector<Singularity>{} : multiple_zeros(arc, middle, free, 1);
  if (places.size() == 1)
    add(places.front(), 1, false);
  else if (const auto curve = curve_near(arc, middle, aside_share * arc.length()))
    add({middle, (*curve)(middle), curve->slope(middle), touches ? 0 : zeros.front().off}, 1,
        touches);
  return result;
}

/// Distances along the arc at which E, moving on as it does at t, is singular, also complex ones.
std::vector<double> singular_distances(const TestedStep& arc, double t) {
  const double d = 2 * negligible_share * arc.length();
  std::vector<ExtendedMatrix> E;
  for (const double ds : {t, t - d, t + d}) {
    const auto& p = arc.point(ds);
    auto matrix = p ? arc.matrix(*p) : std::nullopt;
    if (!matrix) return {};
    E.push_back(std::move(*matrix));
  }
  std::vector<double> distances = relative_motion(E[0], E[1], E[2]);
  for (double& distance : distances) distance = 2 * d / distance;
  return distances;
}

/// A corrected point is off by the rounding of F over the smallest singular value, and that changes an entry
/// of Sigma in proportion to the rate of E: this is the product of the entry and its change, the same at
/// every distance from a singular point.
double blur_of_entries(const TestedStep& arc, const ExtendedMatrix& E, const Borders& borders,
                       double reach) {
  const Index n = arc.from().x.size();
  Vector sizes(n + 1);
  sizes << arc.from().x.cwiseAbs().cwiseMax(tiny_share), std::abs(arc.from().lambda);
  const double rounding_of_F =
      rounding_unit *
      (borders.B.topRows(n).cwiseAbs().transpose() * magnitudes(E, sizes).topRows(n)).norm();
  return reach / arc.length() * rounding_of_F;
}

/// Distance from zeros[first..last] to the nearest other one.
double free_length(const std::vector<ZeroOf>& zeros, std::size_t first, std::size_t last,
                   double length) {
  double free = length;
  if (first > 0) free = std::min(free, zeros[first].at - zeros[first - 1].at);
  if (last + 1 < zeros.size()) free = std::min(free, zeros[last + 1].at - zeros[last].at);
  return free;
}

}  // namespace

TestedZeros singularities_on(const TestedStep& arc, Samples samples) {
  if (!arc.walker().options.branch_points) return {};
  if (surely_regular(arc.walker(), arc.from().tangent, samples)) return {};
  std::vector<ExtendedMatrix> E;
  for (const CurvePoint* p : samples) {
    auto matrix = arc.matrix(*p);
    if (!matrix) return {.resolved = false};
    E.push_back(std::move(*matrix));
  }
  const std::size_t middle = E.size() / 2;
  const Reach reach = reach_of(E, middle);
  TestedZeros result{.order = reach.order, .examined = true};
  const Borders borders = borders_of(E[middle], result.order);
  double scale = 0;
  const auto determinant = [&](double ds) -> std::optional<double> {
    const auto Sigma = arc.sigma(ds, borders);
    if (!Sigma) return std::nullopt;
    const double value = Sigma->determinant();
    scale = std::max(scale, std::abs(value));
    return value;
  };
  for (const double t : {0.0, 0.5, 1.0})
    if (!determinant(t * arc.length())) return {.resolved = false};
  // det Sigma is a product of m factors, each with the noise of an entry.
  const auto m = static_cast<double>(result.order);
  const double entry = sigma_noise(E[middle], borders);
  double noise = std::max(function_noise * scale,
                          m * entry * std::pow(std::max(entry, std::pow(scale, 1 / m)), m - 1));
  // Beside a touch the determinant is small on a long way, where points are no better than elsewhere.
  if (result.order == 1)
    noise = std::max(noise, change_of_rounding(arc, *samples[middle]).value_or(0));
  const double blur = result.order > 1 ? m * std::pow(scale, 1 - 2 / m) *
                                             blur_of_entries(arc, E[middle], borders, reach.size)
                                       : 0.0;
  if (scale <= std::max(noise, blur)) return {.resolved = false};
  const ZeroSearch found =
      find_zeros(determinant, 0, arc.high(), std::max(noise, blur), same_point, NoiseIs::doubt);
  result.zeros = found.zeros;
  result.resolved = found.resolved;
  if (result.order == 1) return result;
  std::erase_if(result.zeros, [&](const ZeroOf& zero) {
    return zero.touches && !sigma_may_vanish(arc, borders, zero);
  });
  return result;
}

bool add_branch_points(const TestedStep& arc, const TestedZeros& singular,
                       std::vector<ZeroOf>& turns, std::vector<Candidate>& found) {
  const auto& zeros = singular.zeros;
  const auto add = [&](const std::vector<ZeroOf>& group, double free) {
    auto candidates = branch_points_at(arc, group, singular.order, free);
    if (candidates.empty()) return false;
    const std::vector<Candidate> of_others = found;
    for (Candidate& candidate : candidates) {
      // Where lambda turns at a branch point, one eigenvalue more comes back without crossing zero.
      bool turned = false;
      std::erase_if(turns, [&](const ZeroOf& turn) {
        const double distance = std::abs(turn.at - candidate.at);
        const bool here =
            distance <= same_point + 50 * turn.off || (candidate.turns && distance <= blurred);
        turned = turned != (here && !turn.touches);
        return here;
      });
      candidate.odd = candidate.odd != (turned || candidate.turns);
      const bool twice =
          std::any_of(of_others.begin(), of_others.end(), [&](const Candidate& other) {
            return std::abs(other.at - candidate.at) <
                   std::max(small_share * same_point, 10 * (other.off + candidate.off));
          });
      if (twice) return false;
      found.push_back(std::move(candidate));
    }
    return true;
  };
  for (std::size_t i = 0; i < zeros.size();) {
    std::size_t last = i;
    while (last + 1 < zeros.size() && zeros[last + 1].at - zeros[last].at < together) ++last;
    const double free = free_length(zeros, i, last, arc.length());
    const std::vector<ZeroOf> group(zeros.begin() + static_cast<std::ptrdiff_t>(i),
                                    zeros.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    bool explained = add(group, free);
    if (!explained && last > i) {  // close, but not one point
      explained = true;
      for (std::size_t k = i; k <= last; ++k)
        explained = add({zeros[k]}, free_length(zeros, k, k, arc.length())) && explained;
    }
    if (!explained) return false;
    i = last + 1;
  }
  return true;
}

bool examine_turn(const TestedStep& arc, const ZeroOf& turn, bool& regular,
                  std::vector<Candidate>& found) {
  constexpr double far_enough = 1000;
  regular = true;
  const std::vector<double> distances = singular_distances(arc, turn.at);
  if (turn.off > poor && !(distances.empty() || distances.front() > far_enough * turn.off))
    return false;
  if (distances.empty() || distances.front() > blurred || !arc.walker().options.branch_points)
    return true;
  const auto known = [&](const Candidate& c) {
    return c.kind == HitKind::branch_point && std::abs(c.at - turn.at) <= 2 * blurred;
  };
  if (std::any_of(found.begin(), found.end(), known)) return true;
  const auto curve = curve_near(arc, turn.at, aside_share * arc.length());
  if (!curve) return false;
  // Only the exact place can tell: a fold of curves that pass each other closely lies on its curve, too.
  const Singularity place{turn.at, (*curve)(turn.at), curve->slope(turn.at), infinity};
  const auto near = std::count_if(distances.begin(), distances.end(), [&](double d) {
    return d <= 10 * std::max(distances.front(), poor);
  });
  for (Index m = std::min<Index>(near, 6); m > 0; --m) {
    auto candidate = candidate_at(arc, place, {turn}, m, false);
    // A branch that leads through a branch point without turning does not explain the turn: where modes nearly vanish
    // beside a limit point, points aside of the curve are singular, as far aside as its equations are still met.
    if (!candidate || candidate->turns == turn.touches) continue;
    candidate->odd = candidate->odd != candidate->turns;
    found.push_back(std::move(*candidate));
    regular = false;
    return true;
  }
  return distances.front() > poor;
}

}  // namespace springfold::continuation
