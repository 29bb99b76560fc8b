// Pinocchio's algorithms over CasADi's expressions, and their derivatives by CasADi, with common subexpressions shared,
// as C: codegen DESCRIPTION FOLDER MOST writes FOLDER/control_OPERATION.c for each operation of up to MOST instructions.
// Its functions take q, v, a and tau one behind the other.
#include <pinocchio/autodiff/casadi.hpp>
#include "../cpp/model.hpp"
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/center-of-mass.hpp>
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>

using ::casadi::Slice;
using ::casadi::SX;
using Model = pinocchio::ModelTpl<SX>;
using Data = pinocchio::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<SX, Eigen::Dynamic, Eigen::Dynamic>;

static Vector vector(const SX& s) {
  Vector v(s.size1());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = s(casadi_int(i));
  return v;
}

template <class M>
static SX dense(const M& m) {
  SX s(::casadi::Sparsity::dense(m.rows(), m.cols()));
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) s(casadi_int(i), casadi_int(j)) = SX(m(i, j));
  return SX::densify(s);
}

// The entries of the upper triangle, column by column.
template <class M>
static SX upper(const M& m) {
  std::vector<SX> entries;
  for (casadi_int j = 0; j < casadi_int(m.cols()); ++j)
    for (casadi_int i = 0; i <= j; ++i) entries.push_back(SX(m(i, j)));
  return SX::vertcat(entries);
}

template <class M>
static void fill_lower(M& m) {
  m.template triangularView<Eigen::StrictlyLower>() = m.transpose().template triangularView<Eigen::StrictlyLower>();
}

int main(int, char** argv) {
  const Mechanism mechanism = read_axes_only(argv[1]);
  const std::string folder = argv[2];
  const casadi_int most = std::atol(argv[3]);
  const Model model = model_of(mechanism).cast<SX>();
  const casadi_int n = mechanism.nv();
  const SX x = SX::sym("x", 4 * n);
  auto part = [&](casadi_int k) { return x(Slice(k * n, (k + 1) * n)); };
  const SX sq = part(0), sv = part(1), sa = part(2), st = part(3), none = SX::zeros(n);
  const Vector q = vector(sq), v = vector(sv), a = vector(sa), tau = vector(st);
  auto write = [&](const std::string& operation, const SX& result) {
    const ::casadi::Function function("f", {x}, {cse(SX::densify(SX::vec(result)))});
    if (function.n_instructions() > most) {
      std::printf("CasADi: %s takes %lld instructions\n", operation.c_str(), (long long)function.n_instructions());
      return;
    }
    ::casadi::CodeGenerator code("control_" + operation, {{"with_header", false}, {"casadi_int", "int"}});
    code.add(function);
    code.generate(folder + "/");
  };
  {
    Data data(model);
    write("regressor", dense(computeJointTorqueRegressor(model, data, q, v, a)));
  }
  {
    Data data(model);
    computeMinverse(model, data, q);
    write("inverse_mass_matrix", upper(data.Minv));
    fill_lower(data.Minv);
    computeJointJacobians(model, data, q);
    Matrix J = Matrix::Zero(6, n);
    getJointJacobian(model, data, pinocchio::JointIndex(model.njoints - 1), pinocchio::LOCAL_WORLD_ALIGNED, J);
    const Matrix inverse = J * data.Minv * J.transpose();
    write("operational_inverse", upper(inverse));
    if (n >= 6) {
      // By Cholesky's factors.
      const SX r = SX::chol(dense(inverse));
      const SX inverse_of_r = SX::solve(r, SX::eye(6));
      const SX inertia = SX::mtimes(inverse_of_r, inverse_of_r.T());
      std::vector<SX> entries;
      for (casadi_int j = 0; j < 6; ++j)
        for (casadi_int i = 0; i <= j; ++i) entries.push_back(inertia(i, j));
      write("operational_inertia", SX::vertcat(entries));
    }
  }
  {
    Data data(model);
    const SX efforts = dense(rnea(model, data, q, v, a));
    write("inverse_dynamics_along", SX::jtimes(efforts, x, SX::vertcat({st, sa, sv, none})));
    const SX adjoint = SX::jtimes(efforts, x, st, true);
    write("inverse_dynamics_adjoint", adjoint(Slice(0, 3 * n)));
    SX gradient;
    const SX hessian = SX::hessian(SX::dot(st, efforts), x, gradient);
    auto block = [&](casadi_int row, casadi_int column) {
      return SX::vec(hessian(Slice(row * n, (row + 1) * n), Slice(column * n, (column + 1) * n)));
    };
    write("inverse_dynamics_curvature", SX::vertcat({block(0, 0), block(0, 1), block(1, 1), block(2, 0)}));
  }
  {
    Data data(model);
    const SX accelerations = dense(aba(model, data, q, v, tau));
    write("forward_dynamics_along", SX::jtimes(accelerations, x, SX::vertcat({sa, sv, none, st})));
    const SX adjoint = SX::jtimes(accelerations, x, sa, true);
    write("forward_dynamics_adjoint", SX::vertcat({adjoint(Slice(0, 2 * n)), adjoint(Slice(3 * n, 4 * n))}));
  }
  {
    Data data(model);
    crba(model, data, q);
    fill_lower(data.M);
    write("mass_matrix_rate", SX::jtimes(SX::vec(dense(data.M)), x, SX::vertcat({sv, none, none, none})));
  }
  {
    Data data(model);
    write("centre_of_mass", dense(centerOfMass(model, data, q)));
  }
  {
    Data data(model);
    write("com_jacobian", dense(jacobianCenterOfMass(model, data, q, false)));
  }
  {
    Data data(model);
    write("centroidal_map", dense(computeCentroidalMap(model, data, q)));
  }
  {
    Data data(model);
    write("centroidal_momentum", dense(computeCentroidalMomentum(model, data, q, v).toVector()));
  }
  {
    Data data(model);
    const Vector still = Vector::Zero(n);
    write("centroidal_bias", dense(computeCentroidalMomentumTimeVariation(model, data, q, v, still).toVector()));
  }
}
