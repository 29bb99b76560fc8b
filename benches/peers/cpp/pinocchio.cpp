// Pinocchio, header-only: pinocchio DESCRIPTION OPERATION
#include "model.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

using namespace pinocchio;

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  const std::string operation = argv[2];
  const Model model = model_of(mechanism);
  Data data(model);
  std::vector<Eigen::VectorXd> q, v, a, tau;
  auto vector = [](const std::vector<double>& x) { return Eigen::VectorXd::Map(x.data(), Eigen::Index(x.size())); };
  for (const State& s : states(mechanism)) {
    q.push_back(vector(s.q));
    v.push_back(vector(s.v));
    a.push_back(vector(s.a));
    tau.push_back(vector(s.tau));
  }
  using Outputs = std::vector<double>;
  // Column by column, the lower triangle left out where it is not filled.
  auto append = [](Outputs& all, const auto& matrix, bool symmetric) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      for (Eigen::Index i = 0; i < (symmetric ? j + 1 : matrix.rows()); ++i) all.push_back(matrix(i, j));
  };
  if (operation == "inverse_dynamics")
    measure_outputs([&](int k) { rnea(model, data, q[k], v[k], a[k]); },
                    [&](Outputs& all) { append(all, data.tau, false); });
  else if (operation == "mass_matrix")
    measure_outputs([&](int k) { crba(model, data, q[k]); }, [&](Outputs& all) { append(all, data.M, true); });
  else if (operation == "forward_dynamics")
    measure_outputs([&](int k) { aba(model, data, q[k], v[k], tau[k]); },
                    [&](Outputs& all) { append(all, data.ddq, false); });
  else if (operation == "inverse_dynamics_derivatives")
    measure_outputs([&](int k) { computeRNEADerivatives(model, data, q[k], v[k], a[k]); }, [&](Outputs& all) {
      append(all, data.dtau_dq, false);
      append(all, data.dtau_dv, false);
    });
  else if (operation == "forward_dynamics_derivatives")
    measure_outputs([&](int k) { computeABADerivatives(model, data, q[k], v[k], tau[k]); }, [&](Outputs& all) {
      append(all, data.ddq_dq, false);
      append(all, data.ddq_dv, false);
    });
  else
    cannot("no such operation: " + operation);
}
