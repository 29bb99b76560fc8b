// Generated C, one state a call: generated DESCRIPTION OPERATION LIBRARY
#include "generated.hpp"

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  Generated<double> generated(argv[3], argv[2], mechanism);
  std::vector<std::vector<double>> x;
  for (const State& s : states(mechanism)) {
    std::vector<double> all;
    for (const auto& part : {s.q, s.v, generated.efforts ? s.tau : s.a}) all.insert(all.end(), part.begin(), part.end());
    x.push_back(all);
  }
  measure_outputs([&](int k) { generated.compute(x[size_t(k)].data()); },
                  [&](std::vector<double>& all) { generated.for_each_result([&](double x) { all.push_back(x); }); });
}
