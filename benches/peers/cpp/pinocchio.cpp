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
  if (operation == "inverse_dynamics")
    measure([&](int k) { rnea(model, data, q[k], v[k], a[k]); }, [&] { return data.tau.sum(); });
  else if (operation == "mass_matrix")
    measure([&](int k) { crba(model, data, q[k]); },
            [&] { return upper(mechanism.n(), [&](int i, int j) { return data.M(i, j); }); });
  else if (operation == "forward_dynamics")
    measure([&](int k) { aba(model, data, q[k], v[k], tau[k]); }, [&] { return data.ddq.sum(); });
  else if (operation == "inverse_dynamics_derivatives")
    measure([&](int k) { computeRNEADerivatives(model, data, q[k], v[k], a[k]); },
            [&] { return data.dtau_dq.sum() + data.dtau_dv.sum(); });
  else if (operation == "forward_dynamics_derivatives")
    measure([&](int k) { computeABADerivatives(model, data, q[k], v[k], tau[k]); },
            [&] { return data.ddq_dq.sum() + data.ddq_dv.sum(); });
  else
    cannot("no such operation: " + operation);
}
