#include "core/continuum/newton_equilibrium.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "core/continuum/bad_element.hpp"
#include "core/continuum/rigid_modes.hpp"
#include "core/continuum/stiffness.hpp"

namespace polynya::continuum {
namespace {

constexpr long most_iterations = 50;
constexpr int most_refinements = 5;
constexpr double slow = 0.1;           // a correction that leaves more than this asks for a new stiffness
constexpr double near = 100;           // times what is enough: there rounding slows it down
constexpr double least_pivot = 1e-13;  // of the largest: below it is rounding, and the body is loose

/// The equations: displacements since the shape without stress, unbalanced forces.
class Balance {
 public:
  Balance(const ExplicitSolid& solid, std::span<const double> loads, double enough)
      : enough_(enough),
        start_(solid),
        loads_(loads.begin(), loads.end()),
        modes_(free_rigid_modes(solid)),
        trial_(solid) {
    trial_.numerics = without_viscosities(solid.numerics);
    remembered_ = remembered_state(solid);
    number_unknowns();
  }

  Eigen::VectorXd unbalanced(const Eigen::VectorXd& displacement) {
    for (std::size_t i = 0; i < loads_.size(); ++i)
      trial_.mesh.nodes[i] = start_.mesh.nodes[i] - displacement[static_cast<Eigen::Index>(i)];
    displacement_.assign(displacement.begin(), displacement.end());
    step_from_reference(trial_, remembered_, start_.positions, displacement_);
    Eigen::VectorXd force(displacement.size());
    for (std::size_t i = 0; i < loads_.size(); ++i)
      force[static_cast<Eigen::Index>(i)] = is_free(i) ? trial_.internal_force[i] + loads_[i] : 0.0;
    return force;
  }

  /// Displacement that the stiffness lets follow from the forces; it moves the body as a whole in no way.
  Eigen::VectorXd displaced_by(const Eigen::VectorXd& force) {
    const double now = force.lpNorm<Eigen::Infinity>();
    if (asked_ || now > std::max(slow * last_force_, near * enough_)) factorise();
    last_force_ = now;
    Eigen::VectorXd right(unknowns_);
    for (Eigen::Index i = 0; i < force.size(); ++i)
      if (unknown_of_[static_cast<std::size_t>(i)] >= 0) right[unknown_of_[static_cast<std::size_t>(i)]] = force[i];
    const Eigen::VectorXd solved = factor_.solve(right);
    Eigen::VectorXd displacement = Eigen::VectorXd::Zero(force.size());
    for (Eigen::Index i = 0; i < force.size(); ++i)
      if (unknown_of_[static_cast<std::size_t>(i)] >= 0)
        displacement[i] = solved[unknown_of_[static_cast<std::size_t>(i)]];
    return displacement - modes_ * (modes_.transpose() * times_masses(start_, displacement));
  }

  void ask_for_stiffness() { asked_ = true; }
  int factorisations() const { return factorisations_; }
  ExplicitSolid&& result() && { return std::move(trial_); }

  std::exception_ptr failure;  ///< what must not pass through C

 private:
  bool is_free(std::size_t i) const { return start_.masses[i / 3] > 0 && !(start_.fixed[i / 3] >> i % 3 & 1); }

  /// A body that is free as a whole is held in as many components as it has rigid motions, the ones that hold them
  /// best: balanced loads leave no reaction there, and the residual, which they are part of, proves it.
  void number_unknowns() {
    unknown_of_.assign(loads_.size(), 0);
    for (std::size_t i = 0; i < loads_.size(); ++i)
      if (!is_free(i)) unknown_of_[i] = -1;
    if (modes_.cols() > 0) {
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(modes_.transpose());
      for (Eigen::Index c = 0; c < modes_.cols(); ++c)
        unknown_of_[static_cast<std::size_t>(pivots.colsPermutation().indices()[c])] = -1;
    }
    for (std::int32_t& unknown : unknown_of_)
      if (unknown == 0) unknown = unknowns_++;
    if (unknowns_ == 0) throw std::runtime_error("no equilibrium: every node of body '" + start_.name + "' is held");
  }

  void factorise() {
    factor_.compute(tangent_stiffness(trial_, remembered_, start_.positions, displacement_, unknown_of_));
    ++factorisations_;
    asked_ = false;
    const bool done = factor_.info() == Eigen::Success;
    if (!done || !(factor_.vectorD().minCoeff() > least_pivot * factor_.vectorD().maxCoeff()))
      throw std::runtime_error("no equilibrium: body '" + start_.name +
                               "' can move without straining (parts that hang together by edges or corners, or that "
                               "nothing joins), or the loads bring it to where it gives way");
  }

  double enough_;  ///< N
  const ExplicitSolid& start_;
  std::vector<double> loads_;
  Eigen::MatrixXd modes_;
  ExplicitSolid trial_;
  RememberedState remembered_;
  std::vector<double> displacement_;  ///< of the last trial, m
  std::vector<std::int32_t> unknown_of_;
  std::int32_t unknowns_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  double last_force_ = 0;
  int factorisations_ = 0;
  bool asked_ = true;
};

Eigen::Map<Eigen::VectorXd> values_of(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<Eigen::Index>(N_VGetLength_Serial(vector))};
}

/// KINSOL asks through C. An element that a trial turns inside out asks for a shorter correction.
int residual(N_Vector displacement, N_Vector force, void* data) {
  Balance& balance = *static_cast<Balance*>(data);
  try {
    values_of(force) = balance.unbalanced(values_of(displacement));
    return 0;
  } catch (const std::runtime_error&) {
    return 1;
  } catch (...) {
    balance.failure = std::current_exception();
    return -1;
  }
}

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector correction, N_Vector right, realtype) {
  Balance& balance = *static_cast<Balance*>(solver->content);
  try {
    // KINSOL's J p = -F, and J = dF/du = -K.
    values_of(correction) = -balance.displaced_by(values_of(right));
    return SUNLS_SUCCESS;
  } catch (...) {
    balance.failure = std::current_exception();
    return SUNLS_PACKAGE_FAIL_UNREC;
  }
}

void keep_quiet(int, const char*, const char*, char*, void*) {}  // what went wrong is said in one sentence below

// The stiffness stays with the equations, KINSOL's matrix is empty: it says only when a new one is due.
int ask_for_stiffness(N_Vector, N_Vector, SUNMatrix, void* data, N_Vector, N_Vector) {
  static_cast<Balance*>(data)->ask_for_stiffness();
  return 0;
}
int prepare_nothing(SUNLinearSolver) {
  return 0;
}
int set_nothing_up(SUNLinearSolver, SUNMatrix) {
  return 0;
}
int clear_nothing(SUNMatrix) {
  return 0;
}
SUNLinearSolver_Type direct(SUNLinearSolver) {
  return SUNLINEARSOLVER_DIRECT;
}
SUNMatrix_ID custom(SUNMatrix) {
  return SUNMATRIX_CUSTOM;
}

template <auto free>
struct Freed {
  void operator()(auto* thing) const {
    if constexpr (std::is_invocable_v<decltype(free), decltype(&thing)>)
      free(&thing);
    else
      free(thing);
  }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, Freed<SUNContext_Free>>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, Freed<N_VDestroy>>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Freed<SUNLinSolFreeEmpty>>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Freed<SUNMatFreeEmpty>>;
using Memory = std::unique_ptr<void, Freed<KINFree>>;

Vector constant_vector(Eigen::Index size, double value, const Context& context) {
  Vector vector(N_VNew_Serial(size, context.get()));
  N_VConst(value, vector.get());
  return vector;
}

/// Returns KINSOL's answer; `displacement` is its last estimate.
int solve_by_newton(Balance& balance, double largest_load, double enough, Eigen::VectorXd& displacement,
                    int& iterations) {
  SUNContext created = nullptr;
  if (SUNContext_Create(nullptr, &created) != 0) throw std::runtime_error("KINSOL: no context");
  const Context context(created);
  const Vector unknown(N_VMake_Serial(displacement.size(), displacement.data(), context.get()));
  const Vector length_scale = constant_vector(displacement.size(), 1.0, context),
               force_scale = constant_vector(displacement.size(), 1 / largest_load, context);
  const LinearSolver linear(SUNLinSolNewEmpty(context.get()));
  linear->ops->gettype = direct;
  linear->ops->initialize = prepare_nothing;
  linear->ops->setup = set_nothing_up;
  linear->ops->solve = solve;
  linear->content = &balance;
  const Matrix matrix(SUNMatNewEmpty(context.get()));
  matrix->ops->getid = custom;
  matrix->ops->zero = clear_nothing;
  const Memory memory(KINCreate(context.get()));
  KINSetErrHandlerFn(memory.get(), keep_quiet, nullptr);
  int code = KINInit(memory.get(), residual, unknown.get());
  if (code == 0) code = KINSetUserData(memory.get(), &balance);
  if (code == 0) code = KINSetLinearSolver(memory.get(), linear.get(), matrix.get());
  if (code == 0) code = KINSetJacFn(memory.get(), ask_for_stiffness);
  if (code == 0) code = KINSetFuncNormTol(memory.get(), enough / largest_load);
  if (code == 0) code = KINSetScaledStepTol(memory.get(), 1e-200);  // the forces alone say when it is done
  if (code == 0) code = KINSetNumMaxIters(memory.get(), most_iterations);
  if (code != 0) throw std::runtime_error("KINSOL cannot be set up (" + std::to_string(code) + ")");
  code = KINSol(memory.get(), unknown.get(), KIN_LINESEARCH, length_scale.get(), force_scale.get());
  long count = 0;
  KINGetNumNonlinSolvIters(memory.get(), &count);
  iterations = static_cast<int>(count);
  return code;
}

std::string in_two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// With the stiffness at hand, on to where rounding ends it: what is left would push a body that dashpots hold, however
/// little it is, for as long as it stands. Returns the imbalance, N.
double refine(Balance& balance, Eigen::VectorXd& displacement) {
  Eigen::VectorXd force = balance.unbalanced(displacement);
  for (int correction = 0; correction < most_refinements; ++correction) {
    const Eigen::VectorXd further = displacement + balance.displaced_by(force), left = balance.unbalanced(further);
    if (!(left.squaredNorm() < slow * force.squaredNorm())) break;
    displacement = further;
    force = left;
  }
  return balance.unbalanced(displacement).lpNorm<Eigen::Infinity>();
}

}  // namespace

NewtonResult newton_equilibrium(const ExplicitSolid& solid, std::span<const double> loads, double enough) {
  Balance balance(solid, loads, enough);
  double largest_load = 0;
  for (const double load : loads) largest_load = std::max(largest_load, std::abs(load));
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(loads.size()));
  NewtonResult result;
  const int code = solve_by_newton(balance, largest_load, enough, displacement, result.iterations);
  if (balance.failure) std::rethrow_exception(balance.failure);
  try {
    result.imbalance = refine(balance, displacement);
  } catch (const BadElement& error) {
    throw std::runtime_error(std::string("no equilibrium: ") + error.what());
  }
  // Where rounding ends the descent early, KINSOL calls it no descent: the forces decide.
  if (!(result.imbalance <= enough))
    throw std::runtime_error("no equilibrium: " + in_two_digits(result.imbalance / largest_load) +
                             " of the largest nodal load on body '" + solid.name + "' is not balanced after " +
                             std::to_string(result.iterations) + " corrections (KINSOL " + std::to_string(code) + ")");
  result.factorisations = balance.factorisations();
  result.solid = std::move(balance).result();
  return result;
}

}  // namespace polynya::continuum
