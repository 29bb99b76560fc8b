// The mechanism as a model of MuJoCo.
#pragma once
#include <mujoco/mujoco.h>

#include "peer.hpp"

// A body, without its end: its place, its joint with these attributes, its inertia.
inline void write_body(std::ostream& out, const Body& b, const std::string& attributes) {
  auto list = [&](const char* name, std::initializer_list<double> numbers) {
    out << ' ' << name << "=\"";
    for (double x : numbers) out << x << ' ';
    out << '"';
  };
  out << "<body";
  list("pos", {b.p[0], b.p[1], b.p[2]});
  list("xyaxes", {b.R[0], b.R[3], b.R[6], b.R[1], b.R[4], b.R[7]});
  out << "><joint name=\"" << b.name << "\" type=\"" << (b.slides ? "slide" : "hinge") << '"' << attributes;
  list("axis", {b.axis[0], b.axis[1], b.axis[2]});
  out << "/><inertial";
  list("mass", {b.m});
  list("pos", {b.com[0], b.com[1], b.com[2]});
  list("fullinertia", {b.I[0], b.I[3], b.I[5], b.I[1], b.I[2], b.I[4]});
  out << "/>";
}

// The mechanism in MuJoCo's XML, with these attributes of joints, and attributes and elements of `option`.
inline std::string xml(const Mechanism& mechanism, const std::string& joint = "", const std::string& option = "",
                       const std::string& within = "") {
  std::ostringstream out;
  out << std::setprecision(17);
  auto bodies = [&](auto& self, int parent) -> void {
    for (int i = 0; i < int(mechanism.bodies.size()); ++i) {
      if (mechanism.bodies[size_t(i)].parent != parent) continue;
      write_body(out, mechanism.bodies[size_t(i)], joint);
      self(self, i);
      out << "</body>";
    }
  };
  const double* g = mechanism.gravity;
  out << "<mujoco><compiler angle=\"radian\"/><option gravity=\"" << g[0] << ' ' << g[1] << ' ' << g[2] << '"' << option << '>'
      << within << "</option><worldbody>";
  bodies(bodies, -1);
  out << "</worldbody></mujoco>";
  return out.str();
}

inline mjModel* mujoco_model(const std::string& text) {
  char error[1000] = "";
  mjSpec* spec = mj_parseXMLString(text.c_str(), nullptr, error, sizeof error);
  if (!spec) cannot(error);
  mjModel* model = mj_compile(spec, nullptr);
  if (!model) cannot(mjs_getError(spec));
  return model;
}

// The joint of the mechanism for each of MuJoCo's, which are numbered depth first.
inline std::vector<size_t> depth_first_joints(const Mechanism& mechanism, const mjModel* m) {
  std::vector<size_t> joint(size_t(m->nv), 0);
  for (size_t i = 0; i < joint.size(); ++i)
    joint[size_t(m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, mechanism.bodies[i].name.c_str())])] = i;
  return joint;
}

// The parts that each operation needs, of one state.
struct MujocoState {
  const mjModel* m;
  mjData* d = mj_makeData(m);

  void place(const double* q) {
    mju_copy(d->qpos, q, m->nq);
    mj_kinematics(m, d);
    mj_comPos(m, d);
  }
  void move(const double* v) {
    mju_copy(d->qvel, v, m->nv);
    mj_comVel(m, d);
  }
  void inverse_dynamics(const double* q, const double* v, const double* a, double* result) {
    place(q);
    move(v);
    mju_copy(d->qacc, a, m->nv);
    mj_rne(m, d, 1, result);
  }
  void mass_matrix(const double* q) {
    place(q);
    mj_makeM(m, d);
  }
  void forward_dynamics(const double* q, const double* v, const double* tau, double* result) {
    mass_matrix(q);
    mj_factorM(m, d);
    move(v);
    mj_rne(m, d, 0, d->qfrc_bias);
    mju_sub(d->qfrc_smooth, tau, d->qfrc_bias, m->nv);
    mj_solveM(m, d, result, d->qfrc_smooth, 1);
  }
};
