// Generated C in a shared library, with CasADi's calling convention: a pointer per argument and per result.
// The arguments q, v and a (or tau) stand one behind the other, and so do the results, for code that
// takes one vector and gives one.
#pragma once
#include <dlfcn.h>

#include "peer.hpp"

template <class Number>
using Function = int (*)(const Number** arguments, Number** results, int* integers, Number* work, int memory);

template <class Number>
struct Generated {
  Function<Number> function;
  int nq, n;                 // positions, velocities
  int matrices, vectors;     // results of n x n, of n
  bool symmetric, efforts;   // whether the result is M; whether the third argument is tau
  std::vector<Number> result, work;
  std::vector<int> integers;

  Generated(const char* library, const std::string& operation, const Mechanism& mechanism)
      : nq(mechanism.nq()), n(mechanism.nv()) {
    void* opened = dlopen(library, RTLD_NOW);
    if (!opened) cannot(dlerror());
    function = Function<Number>(dlsym(opened, "f"));
    using Sizes = int (*)(int*, int*, int*, int*);
    int arguments = 0, results = 0, whole = 0, numbers = 0;
    if (auto sizes = Sizes(dlsym(opened, "f_work"))) sizes(&arguments, &results, &whole, &numbers);
    integers.resize(size_t(whole) + 1);
    work.resize(size_t(numbers) + 1);
    symmetric = operation == "mass_matrix";
    efforts = operation.rfind("forward", 0) == 0;
    const bool derivatives = operation.find("derivatives") != std::string::npos;
    matrices = symmetric ? 1 : !derivatives ? 0 : efforts ? 3 : 2;
    vectors = matrices ? 0 : 1;
    result.resize(size_t(matrices * n * n + vectors * n));
  }

  // One call; x: q, v, and a or tau.
  void compute(const Number* x) {
    const Number* arguments[8] = {x, x + nq, x + nq + n};
    Number* results[8] = {result.data(), result.data() + n * n, result.data() + 2 * n * n};
    function(arguments, results, integers.data(), work.data(), 0);
  }

  // Calls each(x) with each result; of M with the upper triangle, of the inverse of M with nothing.
  template <class Each>
  void for_each_result(Each&& each) const {
    if (symmetric) {
      for (int j = 0; j < n; ++j)
        for (int i = 0; i <= j; ++i) each(result[size_t(j * n + i)]);
      return;
    }
    const int count = vectors * n + std::min(matrices, 2) * n * n;
    for (int i = 0; i < count; ++i) each(result[size_t(i)]);
  }
};
