// MuJoCo, the parts that each operation needs: mujoco DESCRIPTION OPERATION
#include <mujoco/mujoco.h>

#include "peer.hpp"

// The mechanism in MuJoCo's XML.
static std::string xml(const Mechanism& mechanism) {
  std::ostringstream out;
  out << std::setprecision(17);
  auto list = [&](const char* name, std::initializer_list<double> numbers) {
    out << ' ' << name << "=\"";
    for (double x : numbers) out << x << ' ';
    out << '"';
  };
  auto bodies = [&](auto& self, int parent) -> void {
    for (int i = 0; i < mechanism.nv(); ++i) {
      const Body& b = mechanism.bodies[size_t(i)];
      if (b.parent != parent) continue;
      out << "<body";
      list("pos", {b.p[0], b.p[1], b.p[2]});
      list("xyaxes", {b.R[0], b.R[3], b.R[6], b.R[1], b.R[4], b.R[7]});
      out << "><joint name=\"" << b.name << "\" type=\"" << (b.slides ? "slide" : "hinge") << '"';
      list("axis", {b.axis[0], b.axis[1], b.axis[2]});
      out << "/><inertial";
      list("mass", {b.m});
      list("pos", {b.com[0], b.com[1], b.com[2]});
      list("fullinertia", {b.I[0], b.I[3], b.I[5], b.I[1], b.I[2], b.I[4]});
      out << "/>";
      self(self, i);
      out << "</body>";
    }
  };
  out << "<mujoco><compiler angle=\"radian\"/><option";
  list("gravity", {mechanism.gravity[0], mechanism.gravity[1], mechanism.gravity[2]});
  out << "/><worldbody>";
  bodies(bodies, -1);
  out << "</worldbody></mujoco>";
  return out.str();
}

int main(int, char** argv) {
  const Mechanism mechanism = read_axes_only(argv[1]);
  const std::string operation = argv[2];
  char error[1000] = "";
  mjSpec* spec = mj_parseXMLString(xml(mechanism).c_str(), nullptr, error, sizeof error);
  if (!spec) cannot(error);
  mjModel* m = mj_compile(spec, nullptr);
  if (!m) cannot(mjs_getError(spec));
  mjData* d = mj_makeData(m);
  const int n = m->nv;
  // MuJoCo numbers joints depth first.
  std::vector<size_t> joint(size_t(n), 0);
  for (int i = 0; i < n; ++i) joint[size_t(m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, mechanism.bodies[size_t(i)].name.c_str())])] = size_t(i);
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
  auto place = [&](int k) {
    mju_copy(d->qpos, all[size_t(k)].q.data(), n);
    mj_kinematics(m, d);
    mj_comPos(m, d);
  };
  auto move = [&](int k) {
    mju_copy(d->qvel, all[size_t(k)].v.data(), n);
    mj_comVel(m, d);
  };
  if (operation == "inverse_dynamics")
    measure(
        [&](int k) {
          place(k);
          move(k);
          mju_copy(d->qacc, all[size_t(k)].a.data(), n);
          mj_rne(m, d, 1, result.data());
        },
        total);
  else if (operation == "mass_matrix")
    measure(
        [&](int k) {
          place(k);
          mj_makeM(m, d);
        },
        [&] {
          std::vector<double> full(size_t(n * n), 0);
          mj_fullM(m, d, full.data());
          return upper(n, [&](int i, int j) { return full[size_t(i * n + j)]; });
        });
  else if (operation == "forward_dynamics")
    measure(
        [&](int k) {
          place(k);
          mj_makeM(m, d);
          mj_factorM(m, d);
          move(k);
          mj_rne(m, d, 0, d->qfrc_bias);
          mju_sub(d->qfrc_smooth, all[size_t(k)].tau.data(), d->qfrc_bias, n);
          mj_solveM(m, d, result.data(), d->qfrc_smooth, 1);
        },
        total);
  else
    cannot("no such operation: " + operation);
}
