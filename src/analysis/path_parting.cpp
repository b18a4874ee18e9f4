#include "path_parting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beside_answer.hpp"
#include "cut_curve.hpp"
#include "first_unwanted.hpp"
#include "load_path.hpp"
#include "load_pieces.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {
namespace {

/// So many parts of a piece are looked at, and how closely, in parts of it, places are bracketed.
constexpr int values_between = 8;
constexpr double closest_parting = 1e-12;

class PartingSearch {
 public:
  PartingSearch(const FollowedPiece& piece, const CaseCurves& curves,
                const CriticalPointSettings& settings, const Observer& observer)
      : piece_{piece},
        curves_{curves},
        settings_{settings},
        observer_{observer},
        towards_{piece.to > piece.from ? 1.0 : -1.0},
        sheet_{curves.at(piece.from)->sheet} {}

  Parting run() {
    result_.bad = piece_.from;
    look_between();
    if (!parts_at() && piece_.at_range && last_ == At::unknown) look_before_unknown();
    const bool is_near_end = !parts_at() && !piece_.at_end && look_near_end();
    if (parts_at()) bracket();
    if (is_near_end && result_.clear && !paths_part(result_.bad, *result_.clear))
      result_.clear.reset();
    if (result_.clear) result_.at_other_start = sheet_at(*result_.clear) != sheet_at(result_.bad);
    return result_;
  }

 private:
  enum class At { happens, another, clear, unknown };

  /// -1: there is no start.
  int sheet_at(double value) const {
    const Member* const member = curves_.at(value);
    return member != nullptr ? member->sheet : -1;
  }

  /// How closely places are bracketed: short pieces to rounding.
  double closest() const {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    return std::max(closest_parting * std::abs(piece_.to - piece_.from),
                    rounding * std::abs(piece_.to));
  }

  double before_end(double distance) const { return beyond_value(piece_.to, towards_, -distance); }

  At look(double value, bool other_starts) {
    const FirstUnwanted first = first_unwanted(curves_, value, settings_, observer_);
    const Member* const member = curves_.at(value);
    why_ = first.why;
    if (member == nullptr || (!first.point && !first.why.empty())) return At::unknown;
    if (!other_starts && member->sheet != sheet_) return At::unknown;
    if (!first.point) return At::clear;
    return is_another(first.point->hit.point.lambda, value) ? At::another : At::happens;
  }

  /// Has what comes first there another load than the point that is followed?
  bool is_another(double lambda, double value) const {
    const auto here = point_of_curve(curves_, *piece_.start, *piece_.curve, value, 0);
    return here && std::abs(here->lambda - lambda) > same_load * (1 + std::abs(lambda));
  }

  void note(double value, At at) {
    if (at == At::clear || at == At::another) {
      result_.clear.reset();
      result_.another.reset();
      (at == At::clear ? result_.clear : result_.another) = value;
    }
    if (at == At::happens) result_.bad = value;
    last_ = at;
  }

  std::optional<double> parts_at() const { return result_.clear ? result_.clear : result_.another; }

  static At at_own(At at) { return at == At::another ? At::happens : at; }

  void look_between() {
    // Where points merge a path is told from one without them at this distance before.
    const double last = piece_.at_end ? piece_.to : before_end(distances_beside.back());
    for (int i = 1; i <= values_between && !parts_at(); ++i) {
      const bool is_last = i == values_between;
      const double value =
          is_last ? last : piece_.from + (piece_.to - piece_.from) * i / values_between;
      if (towards_ * (last - value) < 0 || towards_ * (value - piece_.from) <= 0) break;
      const At at = look(value, piece_.at_end || !is_last);
      // Next to where points merge, or branches cross, they have nearly the same load.
      note(value, is_last && !piece_.at_end ? at_own(at) : at);
    }
  }

  /// The end of the range says nothing, as where its start lies outside of the limits: so far as values say something
  /// the path is asked whether it comes to the point.
  void look_before_unknown() {
    double unknown = piece_.to;
    std::string why = why_;
    while (!parts_at() && std::abs(unknown - result_.bad) > closest()) {
      const double middle = result_.bad + 0.5 * (unknown - result_.bad);
      const At at = look(middle, true);
      note(middle, at);
      if (at != At::unknown) continue;
      unknown = middle;
      why = why_;
    }
    if (parts_at()) return;
    result_.unknown_from = unknown;
    result_.why = why;
  }

  /// Nearer to its end a path without it may only not tell it from its neighbour: then it is the same path all along.
  bool look_near_end() {
    for (std::size_t i = distances_beside.size() - 1; i-- > 0 && !parts_at();) {
      const double value = before_end(distances_beside[i]);
      if (towards_ * (value - result_.bad) <= 0) break;
      note(value, at_own(look(value, false)));
    }
    return result_.clear.has_value();
  }

  void bracket() {
    const double placed =
        continuation::promised_place * std::max(std::abs(piece_.to), piece_.width);
    const bool other_starts = sheet_at(*parts_at()) != sheet_;
    while (std::abs(*parts_at() - result_.bad) > closest()) {
      const double middle = result_.bad + 0.5 * (*parts_at() - result_.bad);
      const At at = look(middle, other_starts);
      if (at == At::unknown) {
        result_.is_bracketed = std::abs(*parts_at() - result_.bad) <= placed;
        return;
      }
      note(middle, at);
    }
  }

  /// Do the paths at two values next to each other go different ways?
  bool paths_part(double a, double b) const {
    constexpr double parted =
        1e-6;  // of the size of the state: values next to each other move it far less
    const auto end = [&](double value) {
      const BasePath path = load_path(*curves_.at(value), settings_, observer_);
      Vector state;
      if (!path.problem.empty() || path.forward.points.empty()) return state;
      const continuation::CurvePoint& last = path.forward.points.back();
      state.resize(last.x.size() + 1);
      state << last.x, last.lambda;
      return state;
    };
    const Vector from = end(a), to = end(b);
    return from.size() > 0 && from.size() == to.size() &&
           (from - to).norm() > parted * std::max(1.0, from.norm());
  }

  const FollowedPiece& piece_;
  const CaseCurves& curves_;
  const CriticalPointSettings& settings_;
  const Observer& observer_;
  double towards_;
  int sheet_;
  Parting result_{};
  At last_ = At::unknown;  ///< what was found at the value that was looked at last
  std::string why_{};      ///< why that is unknown
};

}  // namespace

Parting parting_on(const FollowedPiece& piece, const CaseCurves& curves,
                   const CriticalPointSettings& settings, const Observer& observer) {
  return PartingSearch(piece, curves, settings, observer).run();
}

}  // namespace springfold::analysis
