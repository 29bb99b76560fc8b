// Pinocchio, header-only: pinocchio DESCRIPTION OPERATION. What it has no algorithm for is made of those that it has, as
// its users do.
#include "../cpp/model.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/center-of-mass.hpp>
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea-second-order-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>


using namespace pinocchio;
using Outputs = std::vector<double>;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

static void append(Outputs& all, const Eigen::Ref<const Matrix>& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) all.push_back(matrix(i, j));
}

static void append_upper(Outputs& all, const Matrix& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i <= j; ++i) all.push_back(matrix(i, j));
}

// Sum over i of l_i T_i, for T of three indices, the first of which is i.
template <class Tensor>
static void contract(const Tensor& tensor, const Vector& l, Matrix& result) {
  const Eigen::Index n = l.size();
  result.setZero();
  const Eigen::Map<const Matrix> slices(tensor.data(), n, n * n);
  Eigen::Map<Vector>(result.data(), n * n).noalias() = slices.transpose() * l;
}

int main(int, char** argv) {
  const Mechanism mechanism = read_axes_only(argv[1]);
  const std::string operation = argv[2];
  const Model model = model_of(mechanism);
  const Eigen::Index n = model.nv;
  Data data(model);
  std::vector<Vector> q, v, a, tau;
  auto vector = [](const std::vector<double>& x) { return Vector::Map(x.data(), Eigen::Index(x.size())); };
  for (const State& s : states(mechanism)) {
    q.push_back(vector(s.q));
    v.push_back(vector(s.v));
    a.push_back(vector(s.a));
    tau.push_back(vector(s.tau));
  }
  const Vector still = Vector::Zero(n);
  Vector x(n), y(n), z(n);
  Matrix jacobian = Matrix::Zero(6, n), product(6, n), six(6, 6), rate(n, n);
  Matrix blocks[4];
  for (Matrix& block : blocks) block.resize(n, n);
  auto inverse_of_inertia = [&](int k) {
    computeMinverse(model, data, q[k]);
    computeJointJacobians(model, data, q[k]);
    getJointJacobian(model, data, JointIndex(model.njoints - 1), LOCAL_WORLD_ALIGNED, jacobian);
    product.noalias() = jacobian * data.Minv.selfadjointView<Eigen::Upper>();
    six.noalias() = product * jacobian.transpose();
  };

  if (operation == "regressor")
    measure_outputs([&](int k) { computeJointTorqueRegressor(model, data, q[k], v[k], a[k]); },
                    [&](Outputs& all) { append(all, data.jointTorqueRegressor); });
  else if (operation == "inverse_mass_matrix")
    measure_outputs([&](int k) { computeMinverse(model, data, q[k]); }, [&](Outputs& all) { append_upper(all, data.Minv); });
  else if (operation == "operational_inverse")
    measure_outputs([&](int k) { inverse_of_inertia(k); }, [&](Outputs& all) { append_upper(all, six); });
  else if (operation == "operational_inertia" && n >= 6)
    measure_outputs(
        [&](int k) {
          inverse_of_inertia(k);
          six = Eigen::LLT<Eigen::Matrix<double, 6, 6>>(six).solve(Eigen::Matrix<double, 6, 6>::Identity());
        },
        [&](Outputs& all) { append_upper(all, six); });
  else if (operation == "inverse_dynamics_along")
    measure_outputs(
        [&](int k) {
          computeRNEADerivatives(model, data, q[k], v[k], a[k]);
          x.noalias() = data.dtau_dq * tau[k];
          x.noalias() += data.dtau_dv * a[k];
          x.noalias() += data.M.selfadjointView<Eigen::Upper>() * v[k];
        },
        [&](Outputs& all) { append(all, x); });
  else if (operation == "inverse_dynamics_adjoint")
    measure_outputs(
        [&](int k) {
          computeRNEADerivatives(model, data, q[k], v[k], a[k]);
          x.noalias() = data.dtau_dq.transpose() * tau[k];
          y.noalias() = data.dtau_dv.transpose() * tau[k];
          z.noalias() = data.M.selfadjointView<Eigen::Upper>() * tau[k];
        },
        [&](Outputs& all) {
          append(all, x);
          append(all, y);
          append(all, z);
        });
  else if (operation == "forward_dynamics_along")
    measure_outputs(
        [&](int k) {
          computeABADerivatives(model, data, q[k], v[k], tau[k]);
          x.noalias() = data.ddq_dq * a[k];
          x.noalias() += data.ddq_dv * v[k];
          x.noalias() += data.Minv.selfadjointView<Eigen::Upper>() * tau[k];
        },
        [&](Outputs& all) { append(all, x); });
  else if (operation == "forward_dynamics_adjoint")
    measure_outputs(
        [&](int k) {
          computeABADerivatives(model, data, q[k], v[k], tau[k]);
          x.noalias() = data.ddq_dq.transpose() * a[k];
          y.noalias() = data.ddq_dv.transpose() * a[k];
          z.noalias() = data.Minv.selfadjointView<Eigen::Upper>() * a[k];
        },
        [&](Outputs& all) {
          append(all, x);
          append(all, y);
          append(all, z);
        });
  else if (operation == "inverse_dynamics_curvature")
    measure_outputs(
        [&](int k) {
          ComputeRNEASecondOrderDerivatives(model, data, q[k], v[k], a[k]);
          contract(data.d2tau_dqdq, tau[k], blocks[0]);
          contract(data.d2tau_dqdv, tau[k], blocks[1]);
          contract(data.d2tau_dvdv, tau[k], blocks[2]);
          contract(data.d2tau_dadq, tau[k], blocks[3]);
        },
        [&](Outputs& all) {
          for (const Matrix& block : blocks) append(all, block);
        });
  else if (operation == "mass_matrix_rate")
    measure_outputs(
        [&](int k) {
          computeCoriolisMatrix(model, data, q[k], v[k]);
          rate.noalias() = data.C + data.C.transpose();
        },
        [&](Outputs& all) { append(all, rate); });
  else if (operation == "centre_of_mass")
    measure_outputs([&](int k) { centerOfMass(model, data, q[k], false); }, [&](Outputs& all) { append(all, data.com[0]); });
  else if (operation == "com_jacobian")
    measure_outputs([&](int k) { jacobianCenterOfMass(model, data, q[k], false); },
                    [&](Outputs& all) { append(all, data.Jcom); });
  else if (operation == "centroidal_map")
    measure_outputs([&](int k) { computeCentroidalMap(model, data, q[k]); }, [&](Outputs& all) { append(all, data.Ag); });
  else if (operation == "centroidal_momentum")
    measure_outputs([&](int k) { computeCentroidalMomentum(model, data, q[k], v[k]); },
                    [&](Outputs& all) { append(all, data.hg.toVector()); });
  else if (operation == "centroidal_bias")
    measure_outputs([&](int k) { computeCentroidalMomentumTimeVariation(model, data, q[k], v[k], still); },
                    [&](Outputs& all) { append(all, data.dhg.toVector()); });
  else
    cannot("no such operation: " + operation);
}
