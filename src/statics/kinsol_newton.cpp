#include "kinsol_newton.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "springfold/core/c_handles.hpp"
#include "whole_turns.hpp"

namespace springfold::statics {
namespace {

Eigen::Map<Vector> view(N_Vector v) { return {N_VGetArrayPointer(v), N_VGetLength(v)}; }

struct UserData {
  const SquareSystem* system = nullptr;
  Vector y{}, residual{};
  Matrix jacobian{};
};

// A positive return value tells KINSOL to try a shorter step.
int residual_callback(N_Vector y, N_Vector f, void* user) {
  auto& data = *static_cast<UserData*>(user);
  data.y = view(y);
  if (!data.system->residual(data.y, data.residual)) return 1;
  view(f) = data.residual;
  return 0;
}

int jacobian_callback(N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector) {
  auto& data = *static_cast<UserData*>(user);
  data.y = view(y);
  if (!data.system->jacobian(data.y, data.jacobian)) return 1;
  const Index n = data.system->size;
  Eigen::Map<Matrix>(SM_DATA_D(J), n, n) = data.jacobian;
  return 0;
}

void ignore_messages(int, const char*, const char*, char*, void*) {}

N_Vector cloned(N_Vector vector) { return made(N_VClone_Serial(vector)); }

}  // namespace

KinsolResult solve_by_kinsol(const SquareSystem& system, const Vector& start, double tolerance,
                             double largest_step) {
  // Nothing is unknown, and KINSOL takes no empty systems: a body on springs whose pose is given.
  if (system.size == 0) return {true, start, 0};
  KinsolResult result{false, start, 0};
  SUNContext raw_context = nullptr;
  require_room_for_context();
  prepared(SUNContext_Create(nullptr, &raw_context) == 0 ? 0 : -1);
  const auto context = owned(raw_context, [](SUNContext c) { SUNContext_Free(&c); });
  const auto n = static_cast<sunindextype>(system.size);
  const auto y = owned(made(N_VNew_Serial(n, raw_context)), N_VDestroy);
  y->ops->nvclone = cloned;
  const auto ones = owned(made(N_VNew_Serial(n, raw_context)), N_VDestroy);
  const auto J = owned(made(SUNDenseMatrix(n, n, raw_context)), SUNMatDestroy);
  const auto solver = owned(made(SUNLinSol_Dense(y.get(), J.get(), raw_context)), SUNLinSolFree);
  const auto kinsol = owned(made(KINCreate(raw_context)), [](void* memory) { KINFree(&memory); });

  view(y.get()) = start;
  N_VConst(1.0, ones.get());
  UserData data{&system, {}, {}, {}};
  KINSetErrHandlerFn(kinsol.get(), ignore_messages, nullptr);
  KINSetUserData(kinsol.get(), &data);
  prepared(KINInit(kinsol.get(), residual_callback, y.get()));
  prepared(KINSetLinearSolver(kinsol.get(), solver.get(), J.get()));
  KINSetJacFn(kinsol.get(), jacobian_callback);
  KINSetMaxSetupCalls(kinsol.get(), 1);  // an exact Jacobian in every iteration
  KINSetNumMaxIters(kinsol.get(), 300);
  KINSetFuncNormTol(kinsol.get(), tolerance);
  KINSetScaledStepTol(kinsol.get(), 1e-15);
  KINSetMaxNewtonStep(kinsol.get(), largest_step);
  const int flag = KINSol(kinsol.get(), y.get(), KIN_LINESEARCH, ones.get(), ones.get());

  long iterations = 0;
  KINGetNumNonlinSolvIters(kinsol.get(), &iterations);
  result.iterations = static_cast<int>(iterations);
  result.y = view(y.get());
  result.converged = flag >= 0 && flag != KIN_STEP_LT_STPTOL && result.y.allFinite();
  if (result.y.allFinite()) take_back_turns(system, start, result.y);
  return result;
}

}  // namespace springfold::statics
