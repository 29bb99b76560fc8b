// Pinocchio's algorithms over CppADCodeGen's tape, as C: cppad_codegen DESCRIPTION FOLDER writes
// FOLDER/cppad_OPERATION.c for each operation.
#include <pinocchio/codegen/cppadcg.hpp>
#include "model.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

using Code = CppAD::cg::CG<double>;
using Number = CppAD::AD<Code>;
using Model = pinocchio::ModelTpl<Number>;
using Data = pinocchio::DataTpl<Number>;
using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

// The C of a tape: one vector in, one out, in the same signature as CasADi's.
static void write(const std::string& path, CppAD::ADFun<Code>& tape) {
  tape.optimize("no_compare_op");
  CppAD::cg::CodeHandler<double> handler;
  std::vector<Code> in(tape.Domain());
  handler.makeVariables(in);
  std::vector<Code> out = tape.Forward(0, in);
  CppAD::cg::LanguageC<double> language("double");
  CppAD::cg::LangCDefaultVariableNameGenerator<double> names;
  std::ostringstream body;
  handler.generateCode(body, language, out, names);
  std::ofstream(path) << "#include <math.h>\n"
                      << "int f(const double** arguments, double** results, int* integers, double* work, int memory) {\n"
                      << "const double* x = arguments[0];\ndouble* restrict y = results[0];\n"
                      << "double v[" << handler.getTemporaryVariableCount() + 1 << "];\n"
                      << body.str() << "return 0;\n}\n";
}

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  const std::string folder = argv[2];
  const Model model = model_of(mechanism).cast<Number>();
  const int nq = mechanism.nq(), n = mechanism.nv();
  const State start = states(mechanism)[0];
  // Records what `results` makes of a state, and writes it.
  auto record = [&](const std::string& operation, auto&& results) {
    Vector x(nq + 2 * n);
    Eigen::Index place = 0;
    for (const auto& part : {start.q, start.v, start.a})
      for (double number : part) x[place++] = number;
    CppAD::Independent(x);
    Data data(model);
    const Vector q = x.head(nq), v = x.segment(nq, n), last = x.tail(n);
    Vector y = results(data, q, v, last);
    CppAD::ADFun<Code> tape;
    tape.Dependent(x, y);
    write(folder + "/cppad_" + operation + ".c", tape);
  };
  // Matrices column by column, one behind the other; of symmetric ones the upper triangle counts.
  auto joined = [&](std::initializer_list<std::pair<const Eigen::Matrix<Number, -1, -1>, bool>> matrices) {
    Vector y(Eigen::Index(matrices.size()) * n * n);
    Eigen::Index at = 0;
    for (const auto& [matrix, symmetric] : matrices)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) y[at++] = symmetric && i > j ? matrix(j, i) : matrix(i, j);
    return y;
  };
  record("inverse_dynamics", [&](Data& data, auto& q, auto& v, auto& a) -> Vector { return rnea(model, data, q, v, a); });
  record("mass_matrix", [&](Data& data, auto& q, auto&, auto&) -> Vector {
    crba(model, data, q);
    return joined({{data.M, true}});
  });
  record("forward_dynamics", [&](Data& data, auto& q, auto& v, auto& tau) -> Vector { return aba(model, data, q, v, tau); });
  if (n > 12) return 0;
  record("inverse_dynamics_derivatives", [&](Data& data, auto& q, auto& v, auto& a) -> Vector {
    computeRNEADerivatives(model, data, q, v, a);
    return joined({{data.dtau_dq, false}, {data.dtau_dv, false}});
  });
  record("forward_dynamics_derivatives", [&](Data& data, auto& q, auto& v, auto& tau) -> Vector {
    computeABADerivatives(model, data, q, v, tau);
    return joined({{data.ddq_dq, false}, {data.ddq_dv, false}, {data.Minv, true}});
  });
}
