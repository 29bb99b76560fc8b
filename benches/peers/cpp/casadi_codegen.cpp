// Pinocchio's algorithms over CasADi's expressions, with common subexpressions shared, as C:
// casadi_codegen DESCRIPTION FOLDER MOST writes FOLDER/casadi_OPERATION.c for each operation of up to MOST instructions.
#include <pinocchio/autodiff/casadi.hpp>
#include "model.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

using ::casadi::SX;
using Model = pinocchio::ModelTpl<SX>;
using Data = pinocchio::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

static Vector vector(const SX& s) {
  Vector v(s.size1());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = s(casadi_int(i));
  return v;
}

template <class Matrix>
static SX dense(const Matrix& m) {
  SX s(::casadi::Sparsity::dense(m.rows(), m.cols()));
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) s(casadi_int(i), casadi_int(j)) = SX(m(i, j));
  return SX::densify(s);
}

template <class Matrix>
static void fill_lower(Matrix& m) {
  m.template triangularView<Eigen::StrictlyLower>() = m.transpose().template triangularView<Eigen::StrictlyLower>();
}

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  const std::string folder = argv[2];
  const casadi_int most = std::atol(argv[3]);
  const Model model = model_of(mechanism).cast<SX>();
  const int n = mechanism.nv();
  const SX sq = SX::sym("q", mechanism.nq()), sv = SX::sym("v", n), sx = SX::sym("x", n);
  const Vector q = vector(sq), v = vector(sv), x = vector(sx);
  auto write = [&](const std::string& operation, const std::vector<SX>& results) {
    const ::casadi::Function function("f", {sq, sv, sx}, cse(results));
    if (function.n_instructions() > most) return;
    ::casadi::CodeGenerator code("casadi_" + operation, {{"with_header", false}, {"casadi_int", "int"}});
    code.add(function);
    code.generate(folder + "/");
  };
  {
    Data data(model);
    rnea(model, data, q, v, x);
    write("inverse_dynamics", {dense(data.tau)});
  }
  {
    Data data(model);
    crba(model, data, q);
    fill_lower(data.M);
    write("mass_matrix", {dense(data.M)});
  }
  {
    Data data(model);
    aba(model, data, q, v, x);
    write("forward_dynamics", {dense(data.ddq)});
  }
  if (n > 12) return 0;
  {
    Data data(model);
    computeRNEADerivatives(model, data, q, v, x);
    write("inverse_dynamics_derivatives", {dense(data.dtau_dq), dense(data.dtau_dv)});
  }
  {
    Data data(model);
    computeABADerivatives(model, data, q, v, x);
    fill_lower(data.Minv);
    write("forward_dynamics_derivatives", {dense(data.ddq_dq), dense(data.ddq_dv), dense(data.Minv)});
  }
}
