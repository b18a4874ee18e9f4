#include "stretches.hpp"

#include <algorithm>
#include <cmath>

#include "branch_rows.hpp"
#include "descent.hpp"
#include "fall.hpp"
#include "limits.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using Kind = QuantityDefinition::Kind;

/// States of one lambda that are farther apart than this are different before they are polished.
constexpr double far_apart = 0.1;

}  // namespace

Stretches::Stretches(const Tracing& t, const Scales& scales, const SnapSettings& settings,
                     StudyResult& result)
    : t_{t},
      scales_{scales},
      settings_{settings},
      result_{result},
      arc_length_{column_of(Kind::arc_length, t.quantities)},
      lambda_{column_of(Kind::lambda, t.quantities)},
      index_{column_of(Kind::index, t.quantities)},
      size_{t.problem.layout().size} {}

bool Stretches::is_full() const { return count() >= settings_.transitions->maximum; }

void Stretches::follow(const continuation::DiagramStart& from) {
  if (is_full()) return;
  auto stretch = trace_stable(t_, from);
  if (stretch) {
    tracks_.push_back(track_of(*stretch));
    list_.push_back(std::move(*stretch));
  } else
    result_.doubts.push_back("a stable state was found from which no single branch leads on");
}

CurvePoint Stretches::point_of(const Frozen& frozen, const RestState& state) const {
  CurvePoint point;
  point.x = t_.problem.reduce(frozen.unknowns(state.x));
  point.lambda = frozen.lambda();
  point.piece = state.piece;
  return point;
}

bool Stretches::is_within(const Frozen& frozen, const RestState& state) const {
  return !limit_passed(t_.study, t_.evaluator, t_.quantities, point_of(frozen, state));
}

void Stretches::follow_new(const Frozen& frozen, const RestState& state) {
  if (number_of(frozen, state.x) > 0 || !is_within(frozen, state)) return;
  const CurvePoint point = point_of(frozen, state);
  follow({point.x, point.lambda, point.piece});
}

void Stretches::write_branches() {
  if (result_.branches.size() == list_.size()) return;
  std::vector<BranchRows> rows;
  for (const StableStretch& s : list_) rows.push_back(s.rows);
  label_events(rows, 0, t_.quantities);
  result_.branches.clear();
  for (BranchRows& r : rows) result_.branches.push_back(std::move(r.branch));
  losses_ = losses_of(result_, t_.quantities);
}

int Stretches::number_of(const Frozen& frozen, const Vector& x) const {
  for (std::size_t b = 0; b < list_.size(); ++b)
    if (passes(frozen, b, x)) {
      const auto state = rest_near(frozen.landscape(), *near_on(frozen, b));
      if (state && frozen.landscape().same(state->x, x)) return static_cast<int>(b) + 1;
    }
  return 0;
}

StretchTrack Stretches::track_of(const StableStretch& stretch) const {
  StretchTrack track;
  const Frozen any = frozen(stretch.rows.branch.samples.front().values[lambda_] / t_.lambda_scale);
  for (const Sample& sample : stretch.rows.branch.samples) {
    track.s.push_back(sample.values[arc_length_]);
    track.lambda.push_back(sample.values[lambda_] / t_.lambda_scale);
    track.x.push_back(any.reduced(unknowns_in(sample.values, t_.quantities, size_)));
    track.is_stable.push_back(!(sample.values[index_] > 0));
  }
  return track;
}

std::optional<Vector> Stretches::near_on(const Frozen& frozen, std::size_t stretch) const {
  return state_near(tracks_[stretch], frozen.lambda());
}

bool Stretches::passes(const Frozen& frozen, std::size_t stretch, const Vector& x) const {
  const auto near = near_on(frozen, stretch);
  if (!near) return false;
  const Landscape& landscape = frozen.landscape();
  return std::all_of(landscape.moving().begin(), landscape.moving().end(), [&](Index i) {
    const double d = (*near)[i] - x[i];
    const double period = landscape.periods()[i];
    return std::abs(period > 0 ? std::remainder(d, period) : d) <= far_apart;
  });
}

StateBook Stretches::book_at(const Frozen& frozen) const {
  StateBook book(frozen.landscape());
  for (std::size_t b = 0; b < list_.size(); ++b)
    if (const auto near = near_on(frozen, b))
      if (const auto state = rest_near(frozen.landscape(), *near)) book.add(*state);
  if (!book.states().empty()) return book;
  for (const StretchTrack& track : tracks_) {
    const auto distance = [&](double lambda) { return std::abs(lambda - frozen.lambda()); };
    const auto nearest =
        std::min_element(track.lambda.begin(), track.lambda.end(),
                         [&](double p, double q) { return distance(p) < distance(q); });
    if (nearest == track.lambda.end()) continue;
    Vector x = track.x[static_cast<std::size_t>(nearest - track.lambda.begin())];
    if (frozen.landscape().close(x)) book.ways_down(x);
  }
  return book;
}

bool Stretches::ends(int number, int direction) const {
  return direction > 0 ? at(number).ends_high : at(number).ends_low;
}

double Stretches::end_of(int number, int direction) const {
  const auto b = static_cast<std::size_t>(number - 1);
  return result_.branches[b].samples[end_row(b, direction)].values[lambda_] / t_.lambda_scale;
}

/// Where stability is lost; where it is not, the row of the largest or smallest lambda.
std::size_t Stretches::end_row(std::size_t branch, int direction) const {
  for (const Loss& loss : losses_)
    if (loss.branch == branch && loss.loading == direction)
      return result_.branches[branch].events[loss.event].row;
  const auto& samples = result_.branches[branch].samples;
  std::size_t row = 0;
  for (std::size_t r = 0; r < samples.size(); ++r)
    if ((samples[r].values[lambda_] - samples[row].values[lambda_]) * direction > 0) row = r;
  return row;
}

std::vector<RestState> Stretches::taking_over(int number, int direction) const {
  std::vector<RestState> list;
  const auto b = static_cast<std::size_t>(number - 1);
  const Frozen beside = frozen(end_of(number, direction) + direction * beyond_end);
  const Landscape& landscape = beside.landscape();
  Vector x = beside.reduced(
      unknowns_in(result_.branches[b].samples[end_row(b, direction)].values, t_.quantities, size_));
  const auto at = landscape.close(x) ? landscape.softest_ground(x) : std::nullopt;
  if (!at || at->hessian.size() == 0) return list;
  const Vector mode = symmetric_eigen(at->hessian).vectors.col(0);
  for (const double side : {1.0, -1.0}) {
    const auto pushed = landscape.moved(*at, side * push_size * mode);
    const Descent down = pushed ? descend(landscape, *pushed) : Descent{};
    if (down.end != Descent::End::rest || !is_minimum(down.state)) continue;
    const bool known = std::any_of(list.begin(), list.end(), [&](const RestState& other) {
      return landscape.same(other.x, down.state.x);
    });
    if (!known) list.push_back(down.state);
  }
  return list;
}

}  // namespace springfold::analysis
