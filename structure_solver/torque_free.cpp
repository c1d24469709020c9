#include "structure_solver/torque_free.hpp"

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <Eigen/LU>
#include <memory>
#include <stdexcept>
#include <string>

namespace polynya::structure {
namespace {

constexpr long most_steps = 100'000'000;

struct Spin {
  Eigen::Matrix3d inverse_inertia;
  Eigen::Vector3d angular_momentum;
};

int quaternion_rate(double, N_Vector state, N_Vector rate, void* data) {
  const Spin& spin = *static_cast<const Spin*>(data);
  const Eigen::Map<const Eigen::Quaterniond> q(N_VGetArrayPointer(state));
  Eigen::Map<Eigen::Quaterniond> change(N_VGetArrayPointer(rate));
  const Eigen::Vector3d momentum = q.normalized().conjugate() * spin.angular_momentum;
  const Eigen::Vector3d w = 0.5 * (spin.inverse_inertia * momentum);
  change = q * Eigen::Quaterniond(0, w.x(), w.y(), w.z());
  return 0;
}

void check(int code, const char* what) {
  if (code < 0)
    throw std::runtime_error(std::string("free flight of the rigid body: ARKODE failed in ") + what + " (" +
                             std::to_string(code) + ")");
}

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeIntegrator {
  void operator()(void* memory) const { ERKStepFree(&memory); }
};

}  // namespace

void advance_torque_free(RigidMotion& body, double dt, double tolerance) {
  body.centre += dt * body.velocity;
  if (body.angular_momentum.isZero(0)) return;
  Spin spin{body.inertia.inverse(), body.angular_momentum};
  SUNContext created = nullptr;
  check(SUNContext_Create(nullptr, &created), "SUNContext_Create");
  const std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext> context(created);
  Eigen::Quaterniond orientation(body.orientation);
  const std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector> state(
      N_VMake_Serial(4, orientation.coeffs().data(), context.get()));
  const std::unique_ptr<void, FreeIntegrator> solver(ERKStepCreate(quaternion_rate, 0.0, state.get(), context.get()));
  check(ERKStepSStolerances(solver.get(), tolerance, 0.1 * tolerance), "ERKStepSStolerances");
  check(ERKStepSetTableNum(solver.get(), ARKODE_FEHLBERG_13_7_8), "ERKStepSetTableNum");
  check(ERKStepSetUserData(solver.get(), &spin), "ERKStepSetUserData");
  check(ERKStepSetMaxNumSteps(solver.get(), most_steps), "ERKStepSetMaxNumSteps");
  check(ERKStepSetStopTime(solver.get(), dt), "ERKStepSetStopTime");
  double reached = 0;
  check(ERKStepEvolve(solver.get(), dt, state.get(), &reached, ARK_NORMAL), "ERKStepEvolve");
  body.orientation = orientation.normalized().toRotationMatrix();
}

}  // namespace polynya::structure
