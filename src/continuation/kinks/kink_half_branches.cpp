
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/reduced_equation.hpp"
#include "continuation/locating/singular.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/piecewise_form.hpp"

namespace springfold::continuation {
namespace {

/// An eigenvalue of some piece is zero here.
struct ZeroBeside {
  Hit hit{};
  std::vector<Piece> pieces{};  ///< which
  bool own = false;             ///< the step's own piece is one of them
  bool crosses = false;         ///< of some piece it changes sign
};

/// Arc length within which zeros of different pieces are one: they are located as well as crossings are, touches less.
double one_point(bool crosses) { return crosses ? promised_place : 10 * one_place; }

bool singular_kind(HitKind kind) { return kind == HitKind::branch_point || kind == HitKind::touch; }

void add_place(Hit hit, const Piece& piece, bool own, std::vector<ZeroBeside>& places) {
  const bool crosses = hit.kind == HitKind::branch_point;
  for (ZeroBeside& place : places)
    if (std::abs(place.hit.point.s - hit.point.s) <= one_point(crosses && place.crosses)) {
      place.crosses = place.crosses || crosses;
      place.pieces.push_back(piece);
      return;
    }
  places.push_back({std::move(hit), {piece}, own, crosses});
}

/// Those of the step's own piece are taken out of `found`.
void take_own(StepEvents& found, std::vector<ZeroBeside>& places) {
  for (const Hit& hit : found.hits)
    if (singular_kind(hit.kind)) add_place(hit, hit.point.piece, true, places);
  std::erase_if(found.hits, [](const Hit& hit) { return singular_kind(hit.kind); });
}

/// Directions of the resting switches, k x r, in the motions that the other equations admit; nothing where
/// that cannot be told.
std::optional<Matrix> admitted_directions(const Walker& walker, const CurvePoint& at,
                                          const std::vector<Index>& resting) {
  if (walker.problem.structured()) return std::nullopt;
  Linearisation linear;
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!linearise_densely(walker.problem, at.x, at.lambda, at.piece, linear) ||
      !walker.problem.switch_gradients(at.x, at.lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  const auto k = static_cast<Index>(resting.size());
  const Matrix E = dg_dx(resting, Eigen::all).transpose();
  const auto X = solve_symmetric(linear.dF_dx, E);
  if (!X) return std::nullopt;
  const auto form = condensed_form(E.transpose() * *X, 0, Vector::Zero(k), -Vector::Ones(k));
  return form ? std::optional<Matrix>(form->form.directions) : std::nullopt;
}

/// The other pieces that have room beside the curve. (Two opposite springs are never both stretched.) Grown switch by
/// switch: k surfaces cut r dimensions into far fewer than 2^k cones.
class PiecesBeside {
 public:
  PiecesBeside(std::optional<Matrix> directions, const std::vector<Index>& resting)
      : directions_{std::move(directions)},
        resting_{resting},
        all_have_room_{!directions_ || all_cones_have_room(*directions_)} {}

  /// @returns nothing for more than `most_active` switches
  std::optional<std::vector<Piece>> of(const Piece& own) {
    Piece piece = own;
    if (resting_.size() > most_active) return std::nullopt;
    grow(0, piece);
    std::erase(pieces_, own);
    return pieces_;
  }

 private:
  void grow(std::size_t k, Piece& piece) {
    if (k == resting_.size()) {
      pieces_.push_back(piece);
      return;
    }
    auto& side = piece[static_cast<std::size_t>(resting_[k])];
    const auto own = side;
    for (const int sign : {1, -1}) {
      side = static_cast<std::int8_t>(sign * (own > 0 ? 1 : -1));
      if (has_room(k + 1, piece)) grow(k + 1, piece);
    }
    side = own;
  }

  bool has_room(std::size_t count, const Piece& piece) const {
    if (all_have_room_) return true;
    Matrix sides = directions_->topRows(static_cast<Index>(count));
    for (std::size_t k = 0; k < count; ++k)
      sides.row(static_cast<Index>(k)) *= piece[static_cast<std::size_t>(resting_[k])];
    return inside_cone(sides).has_value();
  }

  std::optional<Matrix> directions_;
  const std::vector<Index>& resting_;
  bool all_have_room_;
  std::vector<Piece> pieces_{};
};

/// Stiff members beside soft ones make a piece look singular at some way from its zero.
bool is_regular(const Walker& walker, const CurvePoint& at) {
  if (walker.problem.structured()) return false;
  const auto own = equilibrated_jacobian(walker, at);
  if (!own) return false;
  const Vector values = jacobi_svd(own->J).values;
  return values[values.size() - 1] > located_rank * std::max(values[0], 1.0);
}

/// A piece that is singular at the begin of the step, where the curve leaves a junction, is looked at from a
/// little further on: that zero belongs to the junction.
/// @param own  the begin of the step in its own piece, with which the others share the curve
void leave_zero_at_begin(const Walker& walker, const CurvePoint& own,
                         std::vector<CurvePoint>& points) {
  CurvePoint& first = points.front();
  Linearisation at;
  if (!linearise(walker.problem, first.x, first.lambda, first.piece, at)) return;
  if (!is_singular(extended_matrix(at, walker.weights, first.tangent), located_rank) ||
      is_regular(walker, first))
    return;
  auto moved = point_at(walker, own, negligible_share * (points.back().s - first.s));
  if (!moved) return;
  moved->piece = first.piece;
  moved->negative.reset();
  first = std::move(*moved);
}

/// May a branch of this piece leave along a direction, one way or the other, as the rates of the resting switches say?
/// Not if some of them clearly lead into the piece and others out of it.
bool may_leave(const Walker& walker, const Piece& piece, const std::vector<Index>& resting,
               const CurvePoint& at, const Direction& along) {
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!walker.problem.switch_gradients(at.x, at.lambda, dg_dx, dg_dlambda)) return true;
  double in = 0, out = 0;
  for (const Index j : resting) {
    const double rate =
        piece[static_cast<std::size_t>(j)] * switch_rate(dg_dx, dg_dlambda, j, along);
    in = std::max(in, rate);
    out = std::max(out, -rate);
  }
  return std::min(in, out) <= negligible_share * std::max(in, out);
}

/// Zeros of the eigenvalues in all pieces beside the step.
/// @returns false for too many pieces
bool find_places(const Walker& walker, Samples samples, const std::vector<Index>& resting,
                 StepEvents& found, std::vector<ZeroBeside>& places) {
  const Piece own = samples.front()->piece;
  const auto pieces =
      PiecesBeside(admitted_directions(walker, *samples.front(), resting), resting).of(own);
  if (!pieces) return false;
  for (const Piece& piece : *pieces) {
    std::vector<CurvePoint> moved;
    for (const CurvePoint* sample : samples) {
      moved.push_back(*sample);
      moved.back().piece = piece;
      moved.back().negative.reset();
    }
    leave_zero_at_begin(walker, *samples.front(), moved);
    std::vector<const CurvePoint*> pointers;
    for (const CurvePoint& point : moved) pointers.push_back(&point);
    StepEvents singular = singular_points(TestedStep(walker, pointers), pointers,
                                          [&](const CurvePoint& at, const Direction& null) {
                                            return may_leave(walker, piece, resting, at, null);
                                          });
    if (!singular.doubt.empty()) {
      found.doubt = "beside " + names_of(walker.problem, resting) + ": " + singular.doubt;
      found.unexplained = singular.unexplained;
    }
    for (Hit& hit : singular.hits)
      if (singular_kind(hit.kind)) {
        hit.point.piece = own;
        add_place(std::move(hit), piece, false, places);
      }
  }
  return true;
}

bool along_the_curve(const Walker& walker, const Ray& ray, const Direction& tangent) {
  return std::abs(std::abs(metric_product(walker.weights, ray.tangent, tangent)) - 1) < one_place;
}

CurvePoint start_of(const Walker& walker, const CurvePoint& at, const Ray& ray) {
  CurvePoint start = point_on_ray(walker, at, ray);
  if (ray.start) {
    start.negative = ray.start->negative;
    return start;
  }
  const auto beyond =
      point_at(walker, start, told_apart);  // at the point itself an eigenvalue is zero
  start.negative = beyond ? beyond->negative : std::nullopt;
  return start;
}

/// Pieces that differ by a spring which the branch hardly stretches are zero so near to each other that both are
/// singular, to rounding, at both places. What leaves in a piece leaves where that piece is zero.
bool leaves_elsewhere(const Ray& ray, const ZeroBeside& place,
                      const std::vector<ZeroBeside>& places) {
  const auto is_zero_at = [&ray](const ZeroBeside& other) {
    return std::find(other.pieces.begin(), other.pieces.end(), ray.piece) != other.pieces.end();
  };
  return !is_zero_at(place) && std::any_of(places.begin(), places.end(), is_zero_at);
}

/// Turns a place into what it is; false: nothing leaves here and nothing of this piece changes.
bool explain(const Walker& walker, const std::vector<Index>& resting,
             const std::vector<ZeroBeside>& places, ZeroBeside& place) {
  Hit& hit = place.hit;
  const std::string names = names_of(walker.problem, resting);
  // The curve stays within all surfaces: a piece that is regular here has no other way.
  std::vector<Piece> singular{hit.point.piece};
  for (const ZeroBeside& other : places)
    if (std::abs(other.hit.point.s - hit.point.s) <= told_apart)
      singular.insert(singular.end(), other.pieces.begin(), other.pieces.end());
  const Rays rays =
      rays_around(walker, hit.point, resting, half_branch_rank, nullptr, false, &singular);
  hit.switches = resting;
  hit.leaving = {start_of(walker, hit.point, {hit.point.piece, hit.point.tangent})};
  for (const Ray& ray : rays.rays)
    if (!along_the_curve(walker, ray, hit.point.tangent)) {
      auto& ways = leaves_elsewhere(ray, place, places) ? hit.leaving_beside : hit.leaving;
      ways.push_back(start_of(walker, hit.point, ray));
    }
  if (!rays.complete) {
    hit.kind = HitKind::unresolved;
    hit.name = "unresolved: branches beside " + names + ": " + rays.why;
    return true;
  }
  if (hit.leaving.size() > 1) {
    hit.kind = HitKind::branching_kink;
    hit.name = "half-branch beside " + names;
    return true;
  }
  if (!place.own) return false;
  if (!place.crosses) return true;  // still a touch
  hit.kind = HitKind::kink;
  hit.name = "eigenvalue zero beside " + names + ", no branch leaves";
  return true;
}

/// Too many pieces: said once for the whole stretch.
void note_untested(const CurvePoint& from, const CurvePoint& to, const std::vector<Index>& resting,
                   StepEvents& found, Curve& curve) {
  for (Hit& hit : curve.hits)
    if (hit.kind == HitKind::unresolved && hit.switches == resting && hit.s_after >= from.s) {
      hit.s_after = to.s;
      return;
    }
  Hit hit{.kind = HitKind::unresolved,
          .name = "unresolved: " + std::to_string(resting.size()) +
                  " switches rest at zero; branches beside them are not looked for",
          .point = from,
          .switches = resting,
          .s_before = from.s,
          .s_after = to.s};
  found.hits.push_back(std::move(hit));
  sort_by_place(found.hits);
}

}  // namespace

void add_half_branches(const Walker& walker, Samples samples, const std::vector<Index>& resting,
                       StepEvents& found, Curve& curve) {
  if (!walker.problem.symmetric() || !walker.options.branch_points) return;
  std::vector<ZeroBeside> places;
  StepEvents others = found;
  take_own(others, places);
  if (!find_places(walker, samples, resting, others, places))
    return note_untested(*samples.front(), *samples.back(), resting, found, curve);
  found = std::move(others);
  for (ZeroBeside& place : places) {
    const double s = place.hit.point.s;
    if (explain(walker, resting, places, place))
      found.hits.push_back(std::move(place.hit));
    else
      curve.log.push_back({s, 0,
                           "an eigenvalue is zero beside " + names_of(walker.problem, resting) +
                               ", but its branch leads out of its piece"});
  }
  sort_by_place(found.hits);
}

}  // namespace springfold::continuation
