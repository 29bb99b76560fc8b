// The mechanism as a model of Pinocchio. Headers only: the wheel's libraries are built for an older machine,
// and their Eigen has another alignment.
#pragma once
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/model.hpp>

#include "peer.hpp"

inline pinocchio::JointIndex add_joint(pinocchio::Model& model, const Body& b) {
  using namespace pinocchio;
  const Eigen::Vector3d axis(b.axis[0], b.axis[1], b.axis[2]);
  const SE3 placement(Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(b.R), Eigen::Vector3d(b.p[0], b.p[1], b.p[2]));
  const JointIndex parent = JointIndex(b.parent + 1);
  auto add = [&](const auto& joint) { return model.addJoint(parent, joint, placement, b.name); };
  if (b.floats) return add(JointModelFreeFlyer());
  // Its joints about a coordinate axis are faster than those about any other.
  if (axis == Eigen::Vector3d::UnitX()) return b.slides ? add(JointModelPX()) : add(JointModelRX());
  if (axis == Eigen::Vector3d::UnitY()) return b.slides ? add(JointModelPY()) : add(JointModelRY());
  if (axis == Eigen::Vector3d::UnitZ()) return b.slides ? add(JointModelPZ()) : add(JointModelRZ());
  return b.slides ? add(JointModelPrismaticUnaligned(axis)) : add(JointModelRevoluteUnaligned(axis));
}

// Pinocchio's mass matrix is wrong for joints that are not in depth-first order.
inline bool depth_first(const std::vector<Body>& bodies) {
  for (int i = 1; i < int(bodies.size()); ++i) {
    int ancestor = i - 1;
    while (ancestor >= 0 && ancestor != bodies[size_t(i)].parent) ancestor = bodies[size_t(ancestor)].parent;
    if (ancestor != bodies[size_t(i)].parent) return false;
  }
  return true;
}

inline pinocchio::Model model_of(const Mechanism& mechanism) {
  using namespace pinocchio;
  if (!depth_first(mechanism.bodies)) cannot("the links are not in depth-first order: a branch ends before the next begins");
  Model model;
  model.gravity.linear() = Eigen::Vector3d(mechanism.gravity[0], mechanism.gravity[1], mechanism.gravity[2]);
  for (const Body& b : mechanism.bodies) {
    Eigen::Matrix3d I;
    I << b.I[0], b.I[1], b.I[2], b.I[1], b.I[3], b.I[4], b.I[2], b.I[4], b.I[5];
    const Inertia inertia(b.m, Eigen::Vector3d(b.com[0], b.com[1], b.com[2]), I);
    model.appendBodyToJoint(add_joint(model, b), inertia, SE3::Identity());
  }
  return model;
}
