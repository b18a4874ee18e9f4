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

/// Of the overdamped motion. What was dissipated moves nothing; its own row is left to the next step's error
/// control, as a quadrature: d(power)/dx = 2 D x' . d(rate)/dx.
int jacobian_callback(double, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
                      N_Vector) {
  auto& data = *static_cast<Integration*>(user);
  const auto rate = data.rate(view(y));
  if (!rate) return 1;
  const auto jacobian = overdamped_jacobian(*data.motion, data.x, data.piece, *rate);
  if (!jacobian) return 1;
  const Index n = data.moving();
  Eigen::Map<Matrix> out(SM_DATA_D(J), n + 1, n + 1);
  out.setZero();
  out.topLeftCorner(n, n) = *jacobian;
  const Matrix& D = data.motion->landscape.terrain().damping;
  const Vector force =
      data.motion->damping_factor * (D.size() > 0 ? Vector(D * rate->rate) : rate->rate);
  out.row(n).head(n) = 2 * force.transpose() * *jacobian;
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
    if (!data_.has_masses()) CVodeSetJacFn(cvode.get(), jacobian_callback);
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
      if (data_.has_masses()) look_within(cvode, y, before, t);
      const Vector state = view(y);
      flow_.time = t;
      flow_.dissipated = state[state.size() - 1];
      if (flag == CV_ROOT_RETURN && !pass_root(cvode, y, t)) return;
      const bool goes_on = observe(state);
      if (options_.keep_way) flow_.way.emplace_back(t, data_.x);
      if (!goes_on) return;
    }
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

  /// The largest speed lies between steps: the integrator's polynomial of the last one is searched, in parts first, then
  /// beside the fastest one by the golden section.
  void look_within(void* cvode, N_Vector y, double from, double to) {
    constexpr int parts = 8,
                  bits = 26;  // at a maximum half of the digits of a place tell all of a value
    constexpr double may_be_largest = 0.98;
    std::uintmax_t most = 40;
    const auto inside = owned(made(N_VClone(y)), N_VDestroy);
    const auto speed = [&](double t) {
      if (CVodeGetDky(cvode, t, 0, inside.get()) != 0) return 0.0;
      const double found = speeds_at(view(inside.get())).moving;
      flow_.peak_speed = std::max(flow_.peak_speed, found);
      return found;
    };
    double best = 0, at = to;
    for (int i = 1; i <= parts; ++i) {
      const double t = from + (to - from) * i / parts, found = speed(t);
      if (found > best) best = found, at = t;
    }
    if (best < may_be_largest * flow_.peak_speed) return;
    const double a = std::max(from, at - (to - from) / parts);
    const double b = std::min(to, at + (to - from) / parts);
    boost::math::tools::brent_find_minima([&](double t) { return -speed(t); }, a, b, bits, most);
  }

  /// @returns false at rest
  bool observe(const Vector& y) {
    const auto rate = data_.rate(y);
    if (!rate) return false;
    const Landscape& landscape = data_.motion->landscape;
    if (rate->multipliers.size() > 0) {
      if (flow_.peak_multipliers.size() == 0)
        flow_.peak_multipliers.setZero(rate->multipliers.size());
      flow_.peak_multipliers = flow_.peak_multipliers.cwiseMax(rate->multipliers.cwiseAbs());
      flow_.peak_multiplier = flow_.peak_multipliers.maxCoeff();
    }
    double speed = rate->rate.lpNorm<Eigen::Infinity>();
    if (data_.has_masses()) {
      const Speeds largest = speeds_at(y);
      flow_.peak_speed = std::max(flow_.peak_speed, largest.moving);
      speed = std::max(largest.moving, largest.turning);
    } else {
      flow_.peak_speed = std::max(flow_.peak_speed, speed);
    }
    Vector r;
    if (landscape.terrain().problem.residual(data_.x, landscape.terrain().lambda, data_.piece, r) &&
        !landscape.multipliers().empty())
      flow_.closure =
          std::max(flow_.closure, Vector(r(landscape.multipliers())).lpNorm<Eigen::Infinity>());
    // Far from rest that is seen without second derivatives: power = slope . motion <= |slope| |motion|.
    const bool is_fast = data_.has_masses() ? speed >= nearly_at_rest
                                            : rate->power >= nearly_at_rest * rate->rate.norm();
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
};

}  // namespace

Flow flow_by_cvode(const Motion& motion, const Vector& from, const FlowOptions& options) {
  return Integrator(motion, from, options).run();
}

}  // namespace springfold::analysis
