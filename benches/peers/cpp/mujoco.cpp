// MuJoCo, the parts that each operation needs: mujoco DESCRIPTION OPERATION
#include "mujoco_model.hpp"

int main(int, char** argv) {
  const Mechanism mechanism = read_axes_only(argv[1]);
  const std::string operation = argv[2];
  const mjModel* m = mujoco_model(xml(mechanism));
  MujocoState one{m};
  const int n = m->nv;
  const std::vector<size_t> joint = depth_first_joints(mechanism, m);
  std::vector<State> all = states(mechanism);
  for (State& s : all)
    for (auto* part : {&s.q, &s.v, &s.a, &s.tau}) {
      const std::vector<double> given = *part;
      for (int i = 0; i < n; ++i) (*part)[size_t(i)] = given[joint[size_t(i)]];
    }
  std::vector<double> result(size_t(n), 0);
  auto total = [&] {
    double sum = 0;
    for (double x : result) sum += x;
    return sum;
  };
  auto at = [&](int k) -> const State& { return all[size_t(k)]; };
  if (operation == "inverse_dynamics")
    measure([&](int k) { one.inverse_dynamics(at(k).q.data(), at(k).v.data(), at(k).a.data(), result.data()); }, total);
  else if (operation == "mass_matrix")
    measure([&](int k) { one.mass_matrix(at(k).q.data()); },
            [&] {
              std::vector<double> full(size_t(n * n), 0);
              mj_fullM(m, one.d, full.data());
              return upper(n, [&](int i, int j) { return full[size_t(i * n + j)]; });
            });
  else if (operation == "forward_dynamics")
    measure([&](int k) { one.forward_dynamics(at(k).q.data(), at(k).v.data(), at(k).tau.data(), result.data()); }, total);
  else
    cannot("no such operation: " + operation);
}
