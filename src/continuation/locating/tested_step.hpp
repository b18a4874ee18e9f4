// A step on which special points are looked for, and what is found on it. Private to the engine.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/zeros.hpp"
#include "continuation/points/arc.hpp"
#include "continuation/points/chebyshev.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// Share of the step before and after it that is searched as well.
inline constexpr double beyond = 0.03;

/// One step, its points (each computed once), and its test functions. Points are predicted by the model that its
/// samples define. Where that is exact, and a corrected point lies aside of it, or has another tangent, rounding
/// decides about the point, beside a branch point: there the model is the better curve.
class TestedStep {
 public:
  TestedStep(const Walker& walker, Samples samples);

  TestedStep(const Walker& walker, const CurvePoint& from, double length)
      : walker_{walker}, from_{from}, length_{length} {}

  const Walker& walker() const { return walker_; }
  const CurvePoint& from() const { return from_; }
  double length() const { return length_; }
  double low() const { return -beyond * length_; }
  double high() const { return (1 + beyond) * length_; }
  /// Was it seen that branches pass each other on the step, and do not meet?
  bool passing() const { return passing_; }
  void note_passing() const { passing_ = true; }

  const std::optional<CurvePoint>& point(double ds) const {
    auto found = points_.find(ds);
    if (found == points_.end()) found = points_.emplace(ds, find(ds)).first;
    return found->second;
  }
  /// A point between the ends for whoever asks once, corrected from the model as far as it is known.
  /// @returns nothing also where the tangent found is not that of the model: another branch's
  std::optional<CurvePoint> point_once(double ds) const;
  /// The point there of a straight step, with the step's one tangent and nothing counted; valid until the next one is
  /// asked for. @returns nullptr where the step is not seen to be straight, and outside of it
  const CurvePoint* straight_point(double ds) const;
  /// The model's own point, with the tangent there: where the model is exact and satisfies F as corrected points do.
  std::optional<CurvePoint> exact_point(double ds) const;
  /// The same with the model's tangent, and nothing counted.
  std::optional<CurvePoint> exact_place(double ds) const;
  /// Where the polynomial through the samples expects the curve, and where the cubic through the ends does: nothing is
  /// evaluated. @returns nothing where there is no such polynomial
  struct Expected {
    CurvePoint by_samples{}, by_ends{};
  };
  std::optional<Expected> expected(double ds) const;
  std::optional<double> rate(double ds) const {
    if (const auto exact = exact_point(ds)) return exact->tangent.dlambda;
    const auto& p = point(ds);
    return p ? std::optional<double>(p->tangent.dlambda) : std::nullopt;
  }
  /// What the model's error makes of rate() at the model's own points: how far it is off at points that are corrected.
  double error_of_rate() const;
  /// Of lambda, as the polynomial through the step's samples, or a better one, has it; nothing where there is none.
  std::optional<double> rate_of_model(double ds) const {
    if (model_.empty() && (settled_ || !model_of_samples())) return std::nullopt;
    return model_.rate_of_lambda(ds);
  }
  std::optional<ExtendedMatrix> matrix(const CurvePoint& p) const {
    const LinearisedPoint* place =
        linearised_at(walker_.problem, *walker_.memory, p.x, p.lambda, p.piece);
    if (!place) return std::nullopt;
    return extended_matrix(place->at, walker_.weights, from_.tangent);
  }
  std::optional<Matrix> sigma(double ds, const Borders& borders) const {
    const auto& p = point(ds);
    const auto E = p ? matrix(*p) : std::nullopt;
    return E ? sigma_of(*E, borders) : std::nullopt;
  }

 private:
  const Walker& walker_;
  const CurvePoint& from_;
  double length_;
  std::optional<CurvePoint> find(double ds) const;
  /// Is the model as exact as corrected points are?
  bool has_exact_model() const {
    if (!settled_) settle_model();
    return exact_;
  }
  CurvePoint point_of_model(double ds) const;
  std::optional<CurvePoint> corrected(double ds) const;
  bool model_of_samples() const;
  LinearisedPoint* place_on_model(const CurvePoint& point) const;
  bool is_on_curve(const CurvePoint& point, const Vector& F) const;
  void settle_model() const;
  double largest_of(const Direction& d) const;
  bool samples_lie_straight() const;
  bool is_straight() const;
  void put_on_line(double ds) const;

  /// How far corrected points are from the model, and their tangents from its own.
  struct ModelError {
    double place = 0, direction = 0;
  };
  std::optional<ModelError> error_at(double ds) const;
  /// Of the step's ends and what is known between them; they outlive it. Most steps never ask for the model.
  std::array<const CurvePoint*, ArcModel::most_nodes> samples_{};
  std::size_t sample_count_ = 0;
  mutable std::optional<Walker> finest_{};  ///< solves to rounding
  mutable ArcModel model_{};
  mutable ModelError error_{};
  mutable bool settled_ = false, exact_ = false;
  mutable std::optional<bool> straight_{};  ///< once it was asked
  mutable CurvePoint on_line_{};
  mutable std::map<double, std::optional<CurvePoint>> points_{};
  mutable std::map<double, CurvePoint>
      exact_points_{};  ///< several events are sampled at the same places
  mutable bool passing_ = false;
};

/// One point of the curve between any two neighbouring special points on a step, kinks at its ends among them, with the
/// number of negative eigenvalues there; none where they lie so close together that rounding decides on which branch it
/// lies.
/// @param places  arc lengths of the special points, in order
std::vector<CurvePoint> points_between_special(const Walker& walker, Samples samples,
                                               const std::vector<double>& places);

/// A special point on the arc before its label is final.
struct Candidate {
  double at = 0, before = 0, after = 0;
  CurvePoint point{};
  HitKind kind = HitKind::limit_point;
  int multiplicity = 1;
  bool odd = false;    ///< an odd number of eigenvalues change sign here
  bool turns = false;  ///< branch points: lambda turns back here as well
  double off = 0;      ///< estimated error of a branch point's place
};

struct TestedZeros {
  std::vector<ZeroOf> zeros{};
  bool resolved = true;
  Index order = 1;
  bool examined = false;  ///< the samples did not show that there are none
  bool flat = false;      ///< the function is lost in its rounding, here and beside the step
};

/// Zeros of the determinant of Sigma on the arc; none where the samples show that E stays regular.
TestedZeros singularities_on(const TestedStep& arc, Samples samples);

/// Branch points from the zeros of det Sigma; turns of lambda at them are taken from `turns`.
/// @returns false when a zero could not be told to be a branch point
bool add_branch_points(const TestedStep& arc, const TestedZeros& singular,
                       std::vector<ZeroOf>& turns, std::vector<Candidate>& found);

/// At a limit point E is regular. Is it so at this turn of lambda? If not, and det Sigma did not show the
/// branch point at which the branch turns, it is added to `found`.
/// @param regular  whether the turn is a limit point
/// @returns false when a branch point is too near to tell
bool examine_turn(const TestedStep& arc, const ZeroOf& turn, bool& regular,
                  std::vector<Candidate>& found);

/// A branch point on the arc, from the curve's points around it: (x, lambda) and Sigma are
/// interpolated on a window; neither is ever computed at the singular point itself.
struct Singularity {
  double at = 0;
  Vector u{};        ///< (x, lambda)
  Vector along{};    ///< its rate along the arc
  double doubt = 0;  ///< how far the place may be off
  double free = 0;   ///< distance to the next zero of the test function; 0: not known
};

/// The curve's points near t, interpolated.
std::optional<Interpolant> curve_near(const TestedStep& arc, double t, double length);

/// A branch point of corank m from its interpolated place: placed to rounding where second derivatives tell
/// it, polished otherwise.
/// @param zeros    of the test function that showed it
/// @param touches  the test function does not change its sign: a degenerate point
/// @param near     how many modes vanish so near that one alone tells little; 0: those m
/// @returns nothing if branches do not meet there
std::optional<Candidate> candidate_at(const TestedStep& arc, const Singularity& place,
                                      const std::vector<ZeroOf>& zeros, Index m, bool touches,
                                      Index near = 0);

}  // namespace springfold::continuation
