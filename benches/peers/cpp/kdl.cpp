// Orocos KDL: kdl DESCRIPTION OPERATION. Trees have inverse dynamics only; in chains the mass matrix and forward
// dynamics as well.
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include "peer.hpp"

static KDL::Segment segment(const Body& b) {
  const KDL::Frame frame(KDL::Rotation(b.R[0], b.R[1], b.R[2], b.R[3], b.R[4], b.R[5], b.R[6], b.R[7], b.R[8]),
                         KDL::Vector(b.p[0], b.p[1], b.p[2]));
  const KDL::Vector axis = frame.M * KDL::Vector(b.axis[0], b.axis[1], b.axis[2]);
  const KDL::Joint joint(b.name, frame.p, axis, b.slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis);
  const KDL::RotationalInertia inertia(b.I[0], b.I[3], b.I[5], b.I[1], b.I[2], b.I[4]);
  const KDL::Vector com(b.com[0], b.com[1], b.com[2]);
  return KDL::Segment(b.name, joint, frame, KDL::RigidBodyInertia(b.m, com, inertia));
}

int main(int, char** argv) {
  const Mechanism mechanism = read_axes_only(argv[1]);
  const std::string operation = argv[2];
  const unsigned n = unsigned(mechanism.nv());
  const KDL::Vector gravity(mechanism.gravity[0], mechanism.gravity[1], mechanism.gravity[2]);
  KDL::Tree tree("world");
  KDL::Chain chain;
  bool serial = true;
  for (int i = 0; i < mechanism.nv(); ++i) {
    const Body& b = mechanism.bodies[size_t(i)];
    tree.addSegment(segment(b), b.parent < 0 ? "world" : mechanism.bodies[size_t(b.parent)].name);
    chain.addSegment(segment(b));
    serial &= b.parent == i - 1;
  }
  std::vector<KDL::JntArray> q, v, a, tau;
  auto vector = [](const std::vector<double>& x) {
    KDL::JntArray j(unsigned(x.size()));
    for (size_t i = 0; i < x.size(); ++i) j.data[Eigen::Index(i)] = x[i];
    return j;
  };
  for (const State& s : states(mechanism)) {
    q.push_back(vector(s.q));
    v.push_back(vector(s.v));
    a.push_back(vector(s.a));
    tau.push_back(vector(s.tau));
  }
  KDL::JntArray result(n);
  auto total = [&] { return result.data.sum(); };
  const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
  if (operation == "inverse_dynamics" && serial) {
    KDL::ChainIdSolver_RNE solver(chain, gravity);
    measure([&](int k) { solver.CartToJnt(q[k], v[k], a[k], none, result); }, total);
  } else if (operation == "inverse_dynamics") {
    KDL::TreeIdSolver_RNE solver(tree, gravity);
    measure([&](int k) { solver.CartToJnt(q[k], v[k], a[k], {}, result); }, total);
  } else if (operation == "mass_matrix" && serial) {
    KDL::ChainDynParam solver(chain, gravity);
    KDL::JntSpaceInertiaMatrix mass(n);
    measure([&](int k) { solver.JntToMass(q[k], mass); },
            [&] { return upper(int(n), [&](int i, int j) { return mass.data(i, j); }); });
  } else if (operation == "forward_dynamics" && serial) {
    KDL::ChainFdSolver_RNE solver(chain, gravity);
    measure([&](int k) { solver.CartToJnt(q[k], v[k], tau[k], none, result); }, total);
  } else
    cannot("KDL has no such operation for this mechanism");
}
