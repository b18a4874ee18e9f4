// Study kind `workspace`: the largest square, disc, cube or ball about a centre within which the
// transmission factors keep their bounds. Along every ray from the centre the first place at which
// a bound is reached is found by root finding; the nearest of these places is the answer.
#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/undefined.hpp"
#include "commanded.hpp"
#include "cpu_time.hpp"
#include "run_kinds.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

constexpr double beyond =
    -10;  ///< margin where the chains do not close or the factors are undefined

struct PointFactors {
  statics::Factors velocity{undefined, undefined}, force{undefined, undefined};
};

/// Factors of translations in the units of the case, and how far they are from their bounds.
class Margin {
 public:
  Margin(const CommandSetup& setup, const WorkspaceSettings& settings)
      : setup_{setup}, settings_{settings} {
    lengths_ = translations(
        setup.system.mechanism.bodies[static_cast<std::size_t>(setup.task.body - 1)].task_space);
  }

  PointFactors factors(const statics::KinematicInverse& at) const {
    PointFactors f;
    if (!at.closed) return f;
    const statics::Transmission t = transmission(setup_.system, setup_.task, at.z, at.rho);
    const auto& scale = setup_.command_scale;
    if (t.velocity.size() > 0)
      f.velocity = statics::factors_of(setup_.scales.length * t.velocity.topRows(lengths_) *
                                       scale.cwiseInverse().asDiagonal());
    if (t.force.size() > 0)
      f.force = statics::factors_of(t.force.topRows(lengths_) * scale.asDiagonal() /
                                    setup_.scales.length);
    return f;
  }

  /// Positive within all bounds, zero where the first one is reached.
  double value(const statics::KinematicInverse& at) const {
    const PointFactors f = factors(at);
    double least = std::numeric_limits<double>::infinity();
    for (const double margin : margins(f)) least = std::min(least, margin);
    return std::isnan(least) || !(least > beyond) ? beyond : least;
  }

  /// The bound that is nearest: "the largest velocity factor reaches 2".
  std::string nearest_bound(const PointFactors& f) const {
    const auto all = margins(f);
    const std::array<const char*, 4> names{
        "the smallest velocity factor reaches ", "the largest velocity factor reaches ",
        "the smallest force factor reaches ", "the largest force factor reaches "};
    const std::array<double, 4> bounds{settings_.velocity.low, settings_.velocity.high,
                                       settings_.force.low, settings_.force.high};
    const auto i = static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin());
    return names[i] + rounded(bounds[i], 10);
  }

 private:
  std::array<double, 4> margins(const PointFactors& f) const {
    const auto& [v, w] = std::pair{settings_.velocity, settings_.force};
    const auto above = [](double value, double low) {
      return low > 0 ? std::log(value / low) : std::numeric_limits<double>::infinity();
    };
    const auto below = [](double value, double high) {
      return std::isfinite(high) ? std::log(high / value) : std::numeric_limits<double>::infinity();
    };
    std::array<double, 4> all{above(f.velocity.smallest, v.low), below(f.velocity.largest, v.high),
                              above(f.force.smallest, w.low), below(f.force.largest, w.high)};
    for (double& margin : all)
      if (std::isnan(margin)) margin = beyond;
    return all;
  }

  const CommandSetup& setup_;
  const WorkspaceSettings& settings_;
  Index lengths_ = 2;
};

/// The first place on a ray at which the margin is gone.
struct RayEnd {
  double size = std::numeric_limits<double>::infinity();
  statics::KinematicInverse at{};
};

/// The nearest end that is known on a face of the unit cube.
struct FaceEnd {
  int axis = 0;
  double sign = 1;
  Vector where{};  ///< place on the face
  double stride = 1;
  RayEnd end{};

  bool take(const Vector& place, RayEnd candidate) {
    if (!(candidate.size < end.size)) return false;
    where = place;
    end = std::move(candidate);
    return true;
  }
};

class Region {
 public:
  Region(const CommandSetup& setup, const WorkspaceSettings& settings, Vector centre,
         const Observer& observer)
      : setup_{setup},
        observer_{observer},
        margin_{setup, settings},
        centre_{std::move(centre)},
        far_{settings.up_to / setup.scales.length} {
    round_ = settings.shape == RegionShape::disc || settings.shape == RegionShape::ball;
    dimension_ = settings.shape == RegionShape::cube || settings.shape == RegionShape::ball ? 3 : 2;
    middle_ = approach(setup_, centre_, at_own_pose(setup_));
  }

  const Margin& margin() const { return margin_; }
  const statics::KinematicInverse& middle() const { return middle_; }

  /// The nearest end over all rays. @throws Interrupted once the observer wants no more
  RayEnd nearest() const {
    std::vector<FaceEnd> faces;
    double best = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < dimension_; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        faces.push_back(sampled(axis, sign, 1.5 * best));
        best = std::min(best, faces.back().end.size);
      }
    RayEnd nearest;
    for (FaceEnd& face : faces) {
      if (!(face.end.size <= 1.5 * best)) continue;
      refine(face);
      if (face.end.size < nearest.size) nearest = face.end;
    }
    return nearest;
  }

 private:
  static constexpr int steps = 64;  ///< in which a ray is looked over
  static constexpr int grid = 32;   ///< rays along each edge of a face, at first

  /// Unit vector in the norm of the shape, through a point of a face of the unit cube.
  Vector direction(int axis, double sign, const Vector& face) const {
    Vector u = Vector::Zero(centre_.size());
    Index next = 0;
    for (int i = 0; i < dimension_; ++i) u[i] = i == axis ? sign : face[next++];
    return round_ ? Vector(u / u.norm()) : u;
  }

  /// @param limit  ends farther away do not matter
  RayEnd end_of(const Vector& u, double limit) const {
    if (observer_ && !observer_(1, 0)) throw continuation::Interrupted{};
    statics::KinematicInverse near = middle_;
    double a = 0, m_a = margin_.value(middle_), before = m_a;
    for (int i = 1; i <= steps && a < limit; ++i) {
      const double b = far_ * i / steps;
      const statics::KinematicInverse at = approach(setup_, centre_ + b * u, near);
      const double m_b = margin_.value(at);
      if (m_b <= 0) return root(u, a, m_a, b, m_b, near);
      // A dip between two rows of steps is looked into.
      if (i > 1 && m_a < before && m_a < m_b)
        if (const auto dip = first_in_dip(u, a, b, near)) return *dip;
      before = m_a;
      a = b;
      m_a = m_b;
      near = at;
    }
    return {};
  }

  RayEnd root(const Vector& u, double a, double m_a, double b, double m_b,
              const statics::KinematicInverse& near) const {
    const auto margin = [&](double r) {
      return margin_.value(approach(setup_, centre_ + r * u, near));
    };
    double size = b;
    if (m_b < 0) {
      std::uintmax_t iterations = 200;
      const auto bracket = boost::math::tools::toms748_solve(
          margin, a, b, m_a, m_b,
          [](double low, double high) { return high - low <= 4e-16 * std::abs(high); }, iterations);
      // Of the bracket the end at which the chains still close.
      size =
          margin(bracket.second) > beyond ? bracket.first / 2 + bracket.second / 2 : bracket.first;
    }
    return {size, approach(setup_, centre_ + size * u, near)};
  }

  /// The smallest margin around b by golden section; an end if it is not positive.
  std::optional<RayEnd> first_in_dip(const Vector& u, double a, double b,
                                     const statics::KinematicInverse& near) const {
    double low = std::max(0.0, a - (b - a)), high = b;
    const auto margin = [&](double r) {
      return margin_.value(approach(setup_, centre_ + r * u, near));
    };
    const double start = low, m_start = margin(low);
    for (int i = 0; i < 40; ++i) {
      const double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
      const double m1 = margin(x1), m2 = margin(x2);
      const double x = m1 < m2 ? x1 : x2, m = std::min(m1, m2);
      if (m <= 0) return root(u, start, m_start, x, m, near);
      (m1 < m2 ? high : low) = m1 < m2 ? x2 : x1;
    }
    return std::nullopt;
  }

  /// The nearest of a grid of rays through a face.
  FaceEnd sampled(int axis, double sign, double limit) const {
    const int count = dimension_ - 1;  // coordinates of a face
    const int rays = count == 1 ? grid : grid / 4;
    FaceEnd best{.axis = axis, .sign = sign, .where = Vector::Zero(count)};
    best.stride = 2.0 / rays;
    for (int i = 0; i <= rays; ++i)
      for (int j = 0; j <= (count == 1 ? 0 : rays); ++j) {
        Vector face(count);
        face[0] = -1 + 2.0 * i / rays;
        if (count == 2) face[1] = -1 + 2.0 * j / rays;
        best.take(face, end_of(direction(axis, sign, face), std::min(limit, best.end.size)));
      }
    return best;
  }

  /// Compass search in shrinking strides, also diagonally, within the face: corners and edges are
  /// reached exactly.
  void refine(FaceEnd& best) const {
    const Index count = best.where.size();
    for (int halvings = 0; halvings < 46;) {
      bool moved = false;
      for (int code = 0; code < (count == 1 ? 3 : 9); ++code) {
        Vector step(count);
        step[0] = code % 3 - 1;
        if (count == 2) step[1] = code / 3 - 1;
        const Vector face = (best.where + best.stride * step).cwiseMax(-1).cwiseMin(1);
        if (step.isZero(0) || face == best.where) continue;
        const Vector u = direction(best.axis, best.sign, face);
        moved |= best.take(face, end_of(u, best.end.size));
      }
      if (moved) continue;
      best.stride /= 2;
      ++halvings;
    }
  }

  static constexpr double golden = 0.6180339887498949;
  const CommandSetup& setup_;
  const Observer& observer_;
  Margin margin_;
  Vector centre_;
  double far_ = 1;
  bool round_ = false;
  int dimension_ = 2;
  statics::KinematicInverse middle_{};
};

std::string coordinates_of(const Vector& pose) {
  std::string text;
  for (const double x : pose) text += (text.empty() ? "" : ", ") + rounded(x, 6);
  return "(" + text + ")";
}

}  // namespace

StudyResult run_workspace(const model::Mechanism& mechanism, const Study& study,
                          const Observer& observer) {
  const double began = thread_seconds();
  StudyResult result;
  result.study = study.name;
  result.quantities = columns_of(study, mechanism);
  const WorkspaceSettings& settings = study.workspace;
  const CommandSetup setup = command_setup(mechanism, study, study.constant_load);
  const Vector centre = settings.centre.size() > 0
                            ? Vector(settings.centre.cwiseQuotient(setup.pose_scale))
                            : setup.pose;
  const Region region(setup, settings, centre, observer);
  const Margin& margin = region.margin();
  result.start.attempts = 1;
  result.start.method = "root finding along rays from the centre";
  const auto finished = [&] {
    result.seconds = thread_seconds() - began;
    return result;
  };
  if (!region.middle().closed) {
    result.start.message = "the chains cannot be closed at the centre";
    return finished();
  }
  if (!(margin.value(region.middle()) > 0)) {
    result.start.message = "the centre is not within the bounds: " +
                           margin.nearest_bound(margin.factors(region.middle())) + " or is beyond";
    return finished();
  }
  RayEnd end;
  try {
    end = region.nearest();
  } catch (const continuation::Interrupted&) {  // a region that is half looked over is none
    result.start.message = "interrupted";
    return finished();
  }
  result.start.found = true;
  Sample sample;
  Branch& branch = result.branches.emplace_back();
  branch.backward = branch.forward = {"one region", true};
  if (std::isfinite(end.size)) {
    const double size = setup.scales.length * end.size;
    sample.values = {size, 2 * size};
    const PointFactors f = margin.factors(end.at);
    const Vector pose = end.at.z.segment(setup.t, setup.d).cwiseProduct(setup.pose_scale);
    sample.values.insert(sample.values.end(), pose.begin(), pose.end());
    for (const double x :
         {f.velocity.smallest, f.velocity.largest, f.force.smallest, f.force.largest})
      sample.values.push_back(x);
    sample.status = end.at.closed ? margin.nearest_bound(f) : "the chains close no further";
    sample.status += " at " + coordinates_of(pose);
    branch.forward.reason = sample.status;
  } else {
    sample.status = "no bound is reached up to " + rounded(settings.up_to, 10);
    branch.forward.reason = sample.status;
  }
  sample.values.resize(result.quantities.size(), undefined);
  branch.samples.push_back(std::move(sample));
  return finished();
}

}  // namespace springfold::analysis
