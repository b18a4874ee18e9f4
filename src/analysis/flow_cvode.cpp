#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>

#include "flow.hpp"
#include "lasting.hpp"
#include "springfold/core/c_handles.hpp"

namespace springfold::analysis {
namespace {

Eigen::Map<Vector> view(N_Vector v) { return {N_VGetArrayPointer(v), N_VGetLength(v)}; }

/// State of the integration: the moving unknowns, with masses their rates, and what was dissipated.
struct Integration {
  const Motion* motion = nullptr;
  Vector x{};  ///< all unknowns of the landscape
  Piece piece{};
  Vector from{};
  bool refused = false;

  Index moving() const { return static_cast<Index>(motion->landscape.moving().size()); }
  bool has_masses() const { return static_cast<bool>(motion->masses); }
  Index size() const { return (has_masses() ? 2 : 1) * moving() + 1; }
  void put(const Vector& y) { x(motion->landscape.moving()) = y.head(moving()); }
  Vector speeds(const Vector& y) const { return y.segment(moving(), moving()); }
  std::optional<FlowRate> rate(const Vector& y) {
    put(y);
    return has_masses() ? inertial_rate(*motion, x, speeds(y), piece)
                        : overdamped_rate(*motion, x, piece);
  }
};

/// A state of the integration moved to the nearest one whose closures hold to rounding, and its rates to the nearest
/// ones that keep them. @returns the closures there; nothing where there is no such state near
std::optional<Closings> put_on_closures(Integration& data, Vector& y) {
  const Landscape& landscape = data.motion->landscape;
  data.put(y);
  auto closings = put_on_closures(landscape, data.x, data.piece);
  if (!closings) return std::nullopt;
  const Index n = data.moving();
  y.head(n) = data.x(landscape.moving());
  if (data.has_masses()) y.segment(n, n) = closings->kept(data.speeds(y));
  return closings;
}

// A positive return value tells CVODE to try a shorter step.
int rate_callback(double, N_Vector y, N_Vector rate, void* user) {
  auto& data = *static_cast<Integration*>(user);
  const auto found = data.rate(view(y));
  if (!found || !found->rate.allFinite()) return 1;
  auto out = view(rate);
  const Index n = data.moving();
  if (data.has_masses()) {
    out.head(n) = view(y).segment(n, n);
    out.segment(n, n) = found->rate;
  } else {
    out.head(n) = found->rate;
  }
  out[out.size() - 1] = found->power;
  return 0;
}

/// What was dissipated moves nothing; its own row is left to the next step's error control, as a quadrature:
/// d(power)/d(rate) = 2 D rate.
int jacobian_callback(double, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
                      N_Vector) {
  auto& data = *static_cast<Integration*>(user);
  const Vector state = view(y);
  const auto rate = data.rate(state);
  if (!rate) return 1;
  const Motion& motion = *data.motion;
  const Index n = data.moving(), size = data.size();
  const auto jacobian =
      data.has_masses() ? inertial_jacobian(motion, data.x, data.speeds(state), data.piece, *rate)
                        : overdamped_jacobian(motion, data.x, data.piece, *rate);
  if (!jacobian) return 1;
  Eigen::Map<Matrix> out(SM_DATA_D(J), size, size);
  out.setZero();
  const Matrix& D = motion.landscape.terrain().damping;
  const Vector moves = data.has_masses() ? Vector(data.speeds(state)) : rate->rate;
  const Vector force = motion.damping_factor * (D.size() > 0 ? Vector(D * moves) : moves);
  if (data.has_masses()) {
    out.block(0, n, n, n).setIdentity();
    out.block(n, 0, n, 2 * n) = *jacobian;
    out.row(2 * n).segment(n, n) = 2 * force.transpose();
  } else {
    out.topLeftCorner(n, n) = *jacobian;
    out.row(n).head(n) = 2 * force.transpose() * *jacobian;
  }
  return 0;
}

/// Errors across the closures are taken away with the gaps.
int projection_callback(double, N_Vector y, N_Vector correction, double, N_Vector error,
                        void* user) {
  auto& data = *static_cast<Integration*>(user);
  Vector closed = view(y);
  const auto closings = put_on_closures(data, closed);
  if (!closings) return 1;
  view(correction) = closed - view(y);
  if (error == nullptr) return 0;
  auto e = view(error);
  const Index n = data.moving();
  e.head(n) = closings->kept(e.head(n));
  if (data.has_masses()) e.segment(n, n) = closings->kept(e.segment(n, n));
  return 0;
}

/// Switching functions, then the distance to the bound.
int root_callback(double, N_Vector y, double* g, void* user) {
  auto& data = *static_cast<Integration*>(user);
  data.put(view(y));
  const Terrain& terrain = data.motion->landscape.terrain();
  Vector switches;
  if (!terrain.problem.switches(data.x, terrain.lambda, switches)) return 1;
  std::copy(switches.begin(), switches.end(), g);
  const auto& moving = data.motion->landscape.moving();
  g[switches.size()] = flow_bound - (data.x(moving) - data.from(moving)).lpNorm<Eigen::Infinity>();
  return 0;
}

void ignore_messages(int, const char*, const char*, char*, void*) {}

N_Vector cloned(N_Vector vector) { return made(N_VClone_Serial(vector)); }
SUNMatrix cloned_matrix(SUNMatrix matrix) { return made(SUNMatClone_Dense(matrix)); }

/// Slopes below this are near rest: Newton's method finishes.
constexpr double nearly_at_rest = 1e-6;
/// Slopes below this at a saddle are no motion any more.
constexpr double stands_still = 1e-10;

class Integrator {
 public:
  Integrator(const Motion& motion, const Vector& from, const FlowOptions& options)
      : options_{options} {
    data_.motion = &motion;
    data_.x = data_.from = from;
    data_.piece = motion.landscape.piece_at(from).value_or(Piece{});
  }

  Flow run() {
    Vector y0 = Vector::Zero(data_.size());
    y0.head(data_.moving()) = data_.from(data_.motion->landscape.moving());
    if (!data_.rate(y0)) {
      flow_.end = Flow::End::refused;
      return flow_;
    }
    SUNContext context = nullptr;
    require_room_for_context();
    prepared(SUNContext_Create(nullptr, &context) == 0 ? 0 : -1);
    const auto holder = owned(context, [](SUNContext c) { SUNContext_Free(&c); });
    const auto n = static_cast<sunindextype>(data_.size());
    const auto y = owned(made(N_VNew_Serial(n, context)), N_VDestroy);
    const auto tolerance = owned(made(N_VNew_Serial(n, context)), N_VDestroy);
    const auto J = owned(made(SUNDenseMatrix(n, n, context)), SUNMatDestroy);
    y->ops->nvclone = tolerance->ops->nvclone = cloned;
    J->ops->clone = cloned_matrix;
    const auto solver = owned(made(SUNLinSol_Dense(y.get(), J.get(), context)), SUNLinSolFree);
    const auto cvode = owned(made(CVodeCreate(CV_BDF, context)), [](void* c) { CVodeFree(&c); });
    view(y.get()) = y0;
    view(tolerance.get()).setConstant(options_.absolute);
    CVodeSetErrHandlerFn(cvode.get(), ignore_messages, nullptr);
    CVodeSetUserData(cvode.get(), &data_);
    prepared(CVodeInit(cvode.get(), rate_callback, 0, y.get()));
    prepared(CVodeSVtolerances(cvode.get(), options_.relative, tolerance.get()));
    prepared(CVodeSetLinearSolver(cvode.get(), solver.get(), J.get()));
    if (!data_.has_masses() || data_.motion->curvatures)
      CVodeSetJacFn(cvode.get(), jacobian_callback);
    if (!data_.motion->landscape.multipliers().empty())
      prepared(CVodeSetProjFn(cvode.get(), projection_callback));
    CVodeSetMaxNumSteps(cvode.get(), options_.most_steps);
    prepared(CVodeRootInit(cvode.get(), static_cast<int>(data_.piece.size()) + 1, root_callback));
    integrate(cvode.get(), y.get());
    return flow_;
  }

 private:
  void integrate(void* cvode, N_Vector y) {
    constexpr double far = 1e12;
    constexpr int now_and_then = 64;
    double t = 0;
    for (flow_.steps = 0; flow_.steps < options_.most_steps; ++flow_.steps) {
      if (options_.goes_on && flow_.steps % now_and_then == 0 && !options_.goes_on()) return;
      const double before = t;
      const int flag = CVode(cvode, far, y, &t, CV_ONE_STEP);
      if (flag < 0) return;
      const Vector state = view(y);
      Instant now = instant_at(state);
      if (data_.has_masses()) watch(cvode, y, now, before, t);
      flow_.time = t;
      flow_.dissipated = state[state.size() - 1];
      taken_.emplace_back(t, flow_.dissipated);
      if (flag == CV_ROOT_RETURN) {
        if (!pass_root(cvode, y, t)) return;
        now = instant_at(state);
      }
      const bool goes_on = observe(state, now);
      if (options_.keep_way) flow_.way.emplace_back(t, data_.x);
      if (!goes_on || (lasting_.is_asked(flow_.steps + 1) && is_known(state))) {
        flow_.settled = settling_time(taken_, flow_.dissipated);
        return;
      }
    }
  }

  bool is_known(const Vector& y) {
    data_.put(y);
    const double energy = data_.motion->landscape.energy(data_.x) +
                          kinetic_energy(data_.motion->masses(data_.x), data_.speeds(y));
    const auto known =
        lasting_.look({flow_.steps + 1, flow_.time, energy, flow_.dissipated}, data_.x);
    if (!known) return false;
    flow_.state = known->state;
    flow_.left = known->left;
    flow_.would_settle = known->would_settle;
    flow_.end = known->has_settled ? Flow::End::rest : Flow::End::swings_on;
    if (known->has_settled) rest_there();
    return true;
  }

  /// What is left of all energy is dissipated on the way there.
  void rest_there() {
    flow_.dissipated += flow_.left;
    Vector y = Vector::Zero(data_.size());
    y.head(data_.moving()) = flow_.state.x(data_.motion->landscape.moving());
    data_.piece = flow_.state.piece;
    const Vector resting = watched(instant_at(y));
    if (resting.size() == peaks_.size()) peaks_ = peaks_.cwiseMax(resting);
    flow_.peak_multipliers = peaks_.tail(peaks_.size() - 1);
  }

  /// Switches that change side; the step behind one begins afresh.
  bool pass_root(void* cvode, N_Vector y, double t) {
    std::vector<int> roots(data_.piece.size() + 1, 0);
    CVodeGetRootInfo(cvode, roots.data());
    if (roots.back() != 0) {
      flow_.end = Flow::End::runs_away;
      return false;
    }
    for (std::size_t j = 0; j < data_.piece.size(); ++j) {
      if (roots[j] == 0) continue;
      data_.piece[j] = static_cast<std::int8_t>(roots[j] > 0 ? 1 : -1);
      flow_.switched.push_back(static_cast<Index>(j));
    }
    // Between steps the integrator interpolates.
    Vector closed = view(y);
    if (!put_on_closures(data_, closed)) return false;
    view(y) = closed;
    CVodeReInit(cvode, t, y);
    return true;
  }

  /// Largest speeds of masses and of what only turns.
  struct Speeds {
    double moving = 0, turning = 0;
  };
  Speeds speeds_at(const Vector& y) {
    data_.put(y);
    Speeds largest;
    for (const MassPoint& mass : data_.motion->masses(data_.x)) {
      double& speed = mass.has_speed ? largest.moving : largest.turning;
      speed = std::max(speed, (mass.jacobian * data_.speeds(y)).norm());
    }
    return largest;
  }

  /// What is looked at behind every step.
  struct Instant {
    std::optional<FlowRate> rate{};
    Speeds speeds{};
  };
  Instant instant_at(const Vector& y) {
    return {data_.rate(y), data_.has_masses() ? speeds_at(y) : Speeds{}};
  }

  /// What peaks are told of: the largest speed of a mass, then the size of every multiplier.
  static Vector watched(const Instant& at) {
    if (!at.rate) return {};
    Vector values(1 + at.rate->multipliers.size());
    values << at.speeds.moving, at.rate->multipliers.cwiseAbs();
    return values;
  }

  /// Peaks up to the end of a step.
  void watch(void* cvode, N_Vector y, const Instant& now, double from, double to) {
    const Vector end = watched(now);
    if (end.size() == 0) return;
    if (peaks_.size() == 0) peaks_ = last_ = end;
    peaks_ = peaks_.cwiseMax(end);
    look_within(cvode, y, {from, last_}, {to, end});
    last_ = end;
    flow_.peak_speed = peaks_[0];
    flow_.peak_multipliers = peaks_.tail(peaks_.size() - 1);
  }

  struct Seen {
    double t = 0;
    const Vector& values;
  };

  /// A peak lies between two steps where what is watched rises behind the first and falls before the second: there the
  /// integrator's polynomial is searched for it.
  void look_within(void* cvode, N_Vector y, const Seen& begin, const Seen& end) {
    constexpr double may_be_largest = 0.98, beside = 1e-3;  // of the largest so far; of the step
    constexpr int bits = 26;  // at a maximum half of the digits of a place tell all of a value
    const Vector larger = begin.values.cwiseMax(end.values);
    if ((larger.array() < may_be_largest * peaks_.array()).all()) return;
    const auto inside = owned(made(N_VClone(y)), N_VDestroy);
    const auto at = [&](double t) -> Vector {
      if (CVodeGetDky(cvode, t, 0, inside.get()) != 0) return Vector::Zero(peaks_.size());
      Vector closed = view(inside.get());
      const Vector found = put_on_closures(data_, closed) ? watched(instant_at(closed)) : Vector{};
      return found.size() == peaks_.size() ? found : Vector::Zero(peaks_.size());
    };
    const double part = beside * (end.t - begin.t);
    const Vector after = at(begin.t + part), before = at(end.t - part);
    for (Index i = 0; i < peaks_.size(); ++i) {
      const bool is_peak = after[i] > begin.values[i] && before[i] > end.values[i];
      if (!is_peak || larger[i] < may_be_largest * peaks_[i]) continue;
      std::uintmax_t most = 40;
      const auto peak = boost::math::tools::brent_find_minima([&](double t) { return -at(t)[i]; },
                                                              begin.t, end.t, bits, most);
      peaks_[i] = std::max(peaks_[i], -peak.second);
    }
  }

  /// @returns false at rest
  bool observe(const Vector& y, const Instant& now) {
    if (!now.rate) return false;
    data_.put(y);
    const Landscape& landscape = data_.motion->landscape;
    const double speed = std::max(now.speeds.moving, now.speeds.turning);
    Vector r;
    if (landscape.terrain().problem.residual(data_.x, landscape.terrain().lambda, data_.piece, r) &&
        !landscape.multipliers().empty())
      flow_.closure =
          std::max(flow_.closure, Vector(r(landscape.multipliers())).lpNorm<Eigen::Infinity>());
    // Far from rest that is seen without second derivatives: power = slope . motion <= |slope| |motion|.
    const bool is_fast = data_.has_masses()
                             ? speed >= nearly_at_rest
                             : now.rate->power >= nearly_at_rest * now.rate->rate.norm();
    if (is_fast) return true;
    const auto at = landscape.ground_on(data_.x, data_.piece);
    if (!at) return false;
    const bool is_slow =
        at->slope.norm() < nearly_at_rest && (!data_.has_masses() || speed < nearly_at_rest);
    if (!is_slow) return true;
    const auto state = rest_near(landscape, data_.x);
    // The critical state itself, from which the motion crawls away, is no rest.
    if (!state || !state->is_clear || (state->index > 0 && at->slope.norm() > stands_still))
      return true;
    // What is left of the way, to rounding: the energy above that of the state.
    flow_.dissipated += std::max(0.0, landscape.energy(data_.x) - state->energy);
    flow_.state = *state;
    flow_.end = Flow::End::rest;
    return false;
  }

  FlowOptions options_;
  Integration data_{};
  Flow flow_{};
  std::vector<std::pair<double, double>> taken_{};  ///< times, and what was dissipated until then
  Lasting lasting_{options_};
  Vector peaks_{}, last_{};  ///< of what is watched: the largest, those at the last step
};

}  // namespace

Flow flow_by_cvode(const Motion& motion, const Vector& from, const FlowOptions& options) {
  return Integrator(motion, from, options).run();
}

}  // namespace springfold::analysis
