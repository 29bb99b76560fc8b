// Generated C of one argument and one result: generated DESCRIPTION OPERATION LIBRARY
#include <dlfcn.h>

#include "../cpp/peer.hpp"

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  void* opened = dlopen(argv[3], RTLD_NOW);
  if (!opened) cannot(dlerror());
  using Function = int (*)(const double** arguments, double** results, int* integers, double* work, int memory);
  using Sizes = int (*)(int*, int*, int*, int*);
  using Pattern = const int* (*)(int);
  const auto function = Function(dlsym(opened, "f"));
  int arguments = 0, results = 0, whole = 0, numbers = 0;
  if (auto sizes = Sizes(dlsym(opened, "f_work"))) sizes(&arguments, &results, &whole, &numbers);
  const int* pattern = Pattern(dlsym(opened, "f_sparsity_out"))(0);
  std::vector<double> result(size_t(pattern[0] * pattern[1])), work(size_t(numbers) + 1);
  std::vector<int> integers(size_t(whole) + 1);
  std::vector<std::vector<double>> x;
  for (const State& s : states(mechanism)) {
    std::vector<double> all;
    for (const auto& part : {s.q, s.v, s.a, s.tau}) all.insert(all.end(), part.begin(), part.end());
    x.push_back(all);
  }
  const double* from[8] = {};
  double* to[8] = {result.data()};
  measure_outputs(
      [&](int k) {
        from[0] = x[size_t(k)].data();
        function(from, to, integers.data(), work.data(), 0);
      },
      [&](std::vector<double>& all) { all = result; });
}
