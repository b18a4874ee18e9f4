// The points of a step that is tested, between its ends.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "continuation/locating/evidence.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Shares of a step at which a model of it is compared with the curve: between its nodes, and not evenly.
constexpr std::array places_of_comparison{0.07, 0.4, 0.6, 0.93};

}  // namespace

TestedStep::TestedStep(const Walker& walker, Samples samples)
    : walker_{walker}, from_{*samples.front()}, length_{samples.back()->s - samples.front()->s} {
  assert(samples.size() <= samples_.size());
  for (const CurvePoint* p : samples) samples_[sample_count_++] = p;
}

/// Solved to rounding, where that can be: beside a singular point what Newton's method leaves at its tolerance moves a
/// point by that over the least singular value, and so much is there no more than the value itself.
std::optional<CurvePoint> TestedStep::corrected(double ds) const {
  if (!finest_) {
    finest_ = walker_;
    finest_->options.newton.residual_tolerance = few_roundings;
  }
  std::optional<CurvePoint> point(std::in_place);
  const Walker& finest = *finest_;
  for (const Walker* walker : {&finest, &walker_}) {
    model_.point(walker_.weights, from_, ds, *point);
    if (find_point(*walker, from_.piece, from_.tangent, *point)) return point;
  }
  return {};
}

bool TestedStep::model_of_samples() const {
  return model_.go_through(walker_.weights, from_, Samples(samples_).first(sample_count_));
}

CurvePoint TestedStep::point_of_model(double ds) const {
  CurvePoint point;
  model_.point(walker_.weights, from_, ds, point);
  return point;
}

std::optional<TestedStep::Expected> TestedStep::expected(double ds) const {
  if (sample_count_ < 3 || (model_.empty() && (settled_ || !model_of_samples())))
    return std::nullopt;
  ArcModel& chord = walker_.memory->chord;
  const std::array ends{samples_[0], samples_[sample_count_ - 1]};
  if (!chord.go_through(walker_.weights, from_, ends)) return std::nullopt;
  std::optional<Expected> expected(Expected{.by_samples = point_of_model(ds)});
  chord.point(walker_.weights, from_, ds, expected->by_ends);
  return expected;
}

std::optional<CurvePoint> TestedStep::point_once(double ds) const {
  if (model_.empty() && (settled_ || !model_of_samples())) return point_at(walker_, from_, ds);
  return point_near(walker_, model_, from_, ds);
}

/// The samples' polynomial is compared with corrected points between them; these become nodes as well, and others are
/// compared with what they all define.
void TestedStep::settle_model() const {
  settled_ = true;
  if (sample_count_ < 2) return;
  std::vector<CurvePoint> nodes;
  for (std::size_t i = 0; i < sample_count_; ++i) nodes.push_back(*samples_[i]);
  const auto go_through = [&] {
    std::array<const CurvePoint*, ArcModel::most_nodes> list{};
    for (std::size_t i = 0; i < nodes.size(); ++i) list[i] = &nodes[i];
    return model_.go_through(walker_.weights, from_, Samples(list).first(nodes.size()));
  };
  if (!go_through()) return;
  if (nodes.size() < 3) {
    if (auto middle = corrected(0.5 * length_)) nodes.insert(nodes.begin() + 1, *middle);
    if (!go_through()) return;
  }
  for (std::size_t i = nodes.size(); i-- > 1;) {
    const double ds = 0.5 * (nodes[i - 1].s + nodes[i].s) - from_.s;
    if (auto point = corrected(ds))
      nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(i), std::move(*point));
  }
  if (!go_through()) return;
  const double scale = size_of(from_);
  int compared = 0;
  for (const double share : places_of_comparison) {
    const auto error = error_at(share * length_);
    if (!error) continue;
    error_.place = std::max(error_.place, error->place);
    error_.direction = std::max(error_.direction, error->direction);
    ++compared;
  }
  exact_ = compared > 2 && is_exact(error_.place, scale) &&
           is_exact(error_.direction * length_, scale * between_samples);
}

/// The place of the model's own point, with its residual.
LinearisedPoint* TestedStep::place_on_model(const CurvePoint& point) const {
  const ProblemView problem = walker_.problem;
  Workspace& memory = *walker_.memory;
  if (!problem.structured())
    return linearised_with_residual(problem, memory, point.x, point.lambda, point.piece);
  LinearisedPoint* const place = linearised_at(problem, memory, point.x, point.lambda, point.piece);
  if (!place) return nullptr;
  place->knows_F = problem.residual(point.x, point.lambda, point.piece, place->F);
  return place->knows_F ? place : nullptr;
}

/// Newton's first correction, and the angle to the tangent there: what is left after it is its square.
std::optional<TestedStep::ModelError> TestedStep::error_at(double ds) const {
  CurvePoint expected;
  model_.point(walker_.weights, from_, ds, expected);
  LinearisedPoint* const place = place_on_model(expected);
  Direction tangent;
  Workspace& memory = *walker_.memory;
  if (!place || !tangent_at(memory, *place, walker_.weights, from_.tangent, tangent))
    return std::nullopt;
  const Index n = expected.x.size();
  Vector& step = memory.step;
  step.resize(n + 1);
  step.head(n) = -place->F;
  step[n] = 0;
  if (!place->factors.solve(step.data())) return std::nullopt;
  return ModelError{length_of(walker_, {step.head(n), step[n]}),
                    length_of(walker_, difference(tangent, expected.tangent))};
}

/// The largest entry, of unknowns without weight in the arc length as well: forces in closures may bend where positions
/// do not.
double TestedStep::largest_of(const Direction& d) const {
  const double entry = d.dx.size() > 0 ? d.dx.lpNorm<Eigen::Infinity>() : 0.0;
  return std::max(length_of(walker_, d), entry);
}

/// Are the samples' ways from the first one, and their tangents, one direction to rounding?
bool TestedStep::samples_lie_straight() const {
  const Direction& line = from_.tangent;
  const double off = refined_step * std::max(1.0, size_of(from_)),
               turned = refined_step * std::max(1.0, largest_of(line));
  for (std::size_t i = 1; i < sample_count_; ++i) {
    const CurvePoint& p = *samples_[i];
    const double along = p.s - from_.s;
    Direction& d = walker_.memory->direction;
    d.dx = p.tangent.dx - line.dx;
    d.dlambda = p.tangent.dlambda - line.dlambda;
    if (!(largest_of(d) <= turned)) return false;
    d.dx = p.x - from_.x - along * line.dx;
    d.dlambda = p.lambda - from_.lambda - along * line.dlambda;
    if (!(largest_of(d) <= off)) return false;
  }
  return sample_count_ > 2;
}

/// Newton's first correction of places between the samples, with the middle's factors, is rounding: then the line is
/// the curve all along the step, and the line's direction its tangent.
bool TestedStep::is_straight() const {
  if (!samples_lie_straight()) return false;
  Workspace& memory = *walker_.memory;
  const CurvePoint& middle = *samples_[sample_count_ / 2];
  LinearisedPoint* const place =
      linearised_at(walker_.problem, memory, middle.x, middle.lambda, middle.piece);
  if (!place || !place->factors.set_border(walker_.weights, from_.tangent)) return false;
  const Index n = from_.x.size();
  on_line_ = from_;
  on_line_.negative.reset();
  Direction& d = memory.direction;
  for (const double share : places_of_comparison) {
    put_on_line(share * length_);
    if (!walker_.problem.residual(on_line_.x, on_line_.lambda, on_line_.piece, memory.F))
      return false;
    Vector& step = memory.step;
    step.resize(n + 1);
    step.head(n) = memory.F;
    step[n] = 0;
    if (!place->factors.solve(step.data())) return false;
    d.dx = step.head(n);
    d.dlambda = step[n];
    if (!is_exact(largest_of(d), size_of(from_))) return false;
  }
  return true;
}

void TestedStep::put_on_line(double ds) const {
  on_line_.x = from_.x + ds * from_.tangent.dx;
  on_line_.lambda = from_.lambda + ds * from_.tangent.dlambda;
  on_line_.s = from_.s + ds;
}

const CurvePoint* TestedStep::straight_point(double ds) const {
  if (!straight_) straight_ = is_straight();
  if (!*straight_ || ds < 0 || ds > length_) return nullptr;
  put_on_line(ds);
  return &on_line_;
}

/// Does the model's own point satisfy F as corrected ones do?
bool TestedStep::is_on_curve(const CurvePoint& point, const Vector& F) const {
  const double allowed =
      small_share * residual_bound(walker_.problem, point.piece, walker_.options.newton,
                                   std::max(1.0, size_of(point)));
  return F.size() == 0 || F.lpNorm<Eigen::Infinity>() <= allowed;
}

std::optional<CurvePoint> TestedStep::exact_place(double ds) const {
  if (!has_exact_model() || ds < 0 || ds > length_) return std::nullopt;
  if (const auto known = exact_points_.find(ds); known != exact_points_.end()) return known->second;
  std::optional<CurvePoint> point(point_of_model(ds));
  Vector& F = walker_.memory->F;
  const bool inside = walker_.problem.residual(point->x, point->lambda, point->piece, F);
  return inside && is_on_curve(*point, F) ? point : std::nullopt;
}

std::optional<CurvePoint> TestedStep::exact_point(double ds) const {
  if (!has_exact_model() || ds < 0 || ds > length_) return std::nullopt;
  if (const auto known = exact_points_.find(ds); known != exact_points_.end()) return known->second;
  std::optional<CurvePoint> point(point_of_model(ds));
  LinearisedPoint* const place = place_on_model(*point);
  if (!place || !is_on_curve(*point, place->F)) return std::nullopt;
  const Direction expected = point->tangent;
  if (!tangent_at(*walker_.memory, *place, walker_.weights, from_.tangent, point->tangent))
    return std::nullopt;
  if (length_of(walker_, difference(point->tangent, expected)) > told_apart) return std::nullopt;
  if (walker_.problem.symmetric()) point->negative = place->factors.negative();
  exact_points_.emplace(ds, *point);
  return point;
}

double TestedStep::error_of_rate() const {
  double error = 0;
  for (const double share : places_of_comparison) {
    const auto own = exact_point(share * length_);
    const auto better = own ? corrected(share * length_) : std::nullopt;
    if (better) error = std::max(error, std::abs(own->tangent.dlambda - better->tangent.dlambda));
  }
  return error;
}

std::optional<CurvePoint> TestedStep::find(double ds) const {
  if (!settled_) settle_model();
  if (model_.empty()) return point_at(walker_, from_, ds);
  auto point = exact_point(ds);
  if (!point) point = corrected(ds);
  if (!exact_) return point ? point : point_at(walker_, from_, ds);
  CurvePoint expected;
  model_.point(walker_.weights, from_, ds, expected);
  const double place = std::max(error_.place, exact_model * std::max(1.0, size_of(expected)));
  const double direction = std::max(error_.direction, between_samples * place / length_);
  const bool aside = !point ||
                     length_of(walker_, difference(*point, expected)) > between_samples * place ||
                     length_of(walker_, difference(point->tangent, expected.tangent)) >
                         between_samples * direction;
  return aside ? expected : point;
}

namespace {

double residual_at(const Walker& walker, const CurvePoint& p) {
  Vector F;
  const bool inside = walker.problem.residual(p.x, p.lambda, p.piece, F);
  return inside && F.size() > 0 ? F.lpNorm<Eigen::Infinity>()
                                : std::numeric_limits<double>::infinity();
}

/// Between special points close to each other rounding decides about a corrected point. Where the curve interpolated
/// from farther off satisfies F as well as it does, that one is nearer to the curve.
CurvePoint least_blurred(const TestedStep& step, const CurvePoint& corrected) {
  if (corrected.x.size() == 0)
    return corrected;  // a body that is driven in all its ways: lambda alone is left
  const double ds = corrected.s - step.from().s;
  const auto curve = curve_near(step, ds, aside_share * step.length());
  if (!curve) return corrected;
  CurvePoint point = corrected;
  const Vector u = (*curve)(ds);
  point.x = u.head(corrected.x.size());
  point.lambda = u[corrected.x.size()];
  const Walker& walker = step.walker();
  const auto E = step.matrix(point);
  if (!E) return corrected;
  const double rounded = rounding_unit * magnitudes(*E, u).topRows(point.x.size()).maxCoeff();
  if (residual_at(walker, point) > std::max(residual_at(walker, corrected), rounded))
    return corrected;
  LinearisedPoint* const place =
      linearised_at(walker.problem, *walker.memory, point.x, point.lambda, point.piece);
  if (!place || place->factors.negative() != corrected.negative) return corrected;
  return point;
}

}  // namespace

std::vector<CurvePoint> points_between_special(const Walker& walker, Samples samples,
                                               const std::vector<double>& places) {
  std::vector<CurvePoint> points;
  if (places.size() < 2) return points;
  const CurvePoint& from = *samples.front();
  const bool has_unknowns =
      from.x.size() > 0;  // else lambda alone is left: a body that is driven in all its ways
  const TestedStep step(walker, samples);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double left = std::max(places[i - 1], from.s), right = places[i];
    for (const double share : {0.5, near_share, 1 - near_share}) {
      const double s = left + share * (right - left);
      if (!(s > left && s < right)) break;
      const auto& point = step.point(s - from.s);
      if (!point || (walker.problem.symmetric() && !point->negative)) continue;
      const CurvePoint kept = has_unknowns ? least_blurred(step, *point) : *point;
      if (has_unknowns && !is_determined(step, kept, same_point)) continue;
      points.push_back(kept);
      break;
    }
  }
  return points;
}

}  // namespace springfold::continuation
