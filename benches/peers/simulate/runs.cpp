// The same run in Pinocchio and MuJoCo, all steps in C++ and C: runs SYSTEM DESCRIPTION SCENE METHOD STEPS ...
//
// SYSTEM is pinocchio or mujoco, SCENE viscous or friction. METHOD of pinocchio: rk4, semi_implicit (velocities first, then positions). METHOD of
// mujoco: its integrator: Euler, implicitfast, RK4.
#include "model.hpp"
#include "mujoco_model.hpp"
#include <pinocchio/algorithm/aba.hpp>

constexpr double END = 2.0, DAMPING = 0.8, KINETIC = 0.5, WIDTH = 0.1;
static bool dry = false;  // whether joints have dry friction, too
constexpr double START[7] = {0.3, 0.6, -0.4, -1.2, 0.5, 1.4, -0.7};
using Vector = Eigen::VectorXd;

static Vector start() { return Eigen::Map<const Eigen::Matrix<double, 7, 1>>(START); }

// Prints the end of a run and the shortest time of its repetitions, for a simulated second.
template <class Once>
static void report(int steps, Once&& once) {
  const char* given = std::getenv("PEERS_PATIENCE");
  const double patience = (given ? std::atof(given) : 0.3) * 1e9;
  double best = HUGE_VAL;
  Vector q;
  for (double all = now(); now() - all < patience || best == HUGE_VAL;) {
    const double begun = now();
    q = once();
    best = std::min(best, now() - begun);
  }
  std::printf("{\"given\": %d, \"positions\": [", steps);
  for (int i = 0; i < int(q.size()); ++i)
    std::isfinite(q[i]) ? std::printf("%s%.17g", i ? ", " : "", q[i]) : std::printf("%snull", i ? ", " : "");
  std::printf("], \"seconds\": %.6e}\n", best * 1e-9 / END);
}

static void by_pinocchio(const Mechanism& mechanism, const std::string& method, int steps) {
  const pinocchio::Model model = model_of(mechanism);
  pinocchio::Data data(model);
  Vector tau(7);
  auto rate = [&](const Vector& q, const Vector& v) -> const Vector& {
    tau = -DAMPING * v;
    for (int i = 0; dry && i < 7; ++i) tau[i] -= KINETIC * std::tanh(v[i] / WIDTH);
    return pinocchio::aba(model, data, q, v, tau, pinocchio::Convention::LOCAL);
  };
  report(steps, [&] {
    const double h = END / steps;
    Vector q = start(), v = Vector::Zero(7), a, b, c, v2, v3, v4;
    for (int k = 0; k < steps; ++k) {
      if (method == "semi_implicit") {
        v += h * rate(q, v);
        q += h * v;
        continue;
      }
      a = rate(q, v);
      v2 = v + 0.5 * h * a;
      b = rate(q + 0.5 * h * v, v2);
      v3 = v + 0.5 * h * b;
      c = rate(q + 0.5 * h * v2, v3);
      v4 = v + h * c;
      const Vector& d = rate(q + h * v3, v4);
      q += h / 6 * (v + 2 * (v2 + v3) + v4);
      v += h / 6 * (a + 2 * (b + c) + d);
    }
    return q;
  });
}

static void friction(const mjModel* m, mjData* d) {
  for (int i = 0; i < m->nv; ++i) d->qfrc_passive[i] -= KINETIC * std::tanh(d->qvel[i] / WIDTH);
}

static void by_mujoco(const Mechanism& mechanism, const std::string& method, int steps) {
  std::ostringstream damping;
  damping << " damping=\"" << DAMPING << '"';
  mjModel* m = mujoco_model(xml(mechanism, damping.str(), " integrator=\"" + method + '"',
                                "<flag contact=\"disable\" constraint=\"disable\"/>"));
  m->opt.timestep = END / steps;
  mjData* d = mj_makeData(m);
  mjcb_passive = dry ? friction : nullptr;
  report(steps, [&] {
    mj_resetData(m, d);
    mju_copy(d->qpos, START, 7);
    for (int k = 0; k < steps; ++k) mj_step(m, d);
    return Vector(Eigen::Map<Vector>(d->qpos, 7));
  });
}

int main(int count, char** argv) {
  const std::string system = argv[1], method = argv[4];
  dry = std::string(argv[3]) == "friction";
  const Mechanism mechanism = read_axes_only(argv[2]);
  if (mechanism.nv() != 7) cannot("the run is that of an arm of seven joints");
  for (int i = 5; i < count; ++i) {
    if (system == "pinocchio") by_pinocchio(mechanism, method, std::atoi(argv[i]));
    else by_mujoco(mechanism, method, std::atoi(argv[i]));
  }
}
