// Generated C compiled for vectors of LANES doubles, LANES states a call: generated_lanes DESCRIPTION OPERATION LIBRARY
// Prints the time of a state. Sines come from glibc's vector library, which is off by up to 4 units in the last place.
#include "generated.hpp"

#ifndef LANES
#define LANES 8
#endif
typedef double Lanes __attribute__((vector_size(8 * LANES)));

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  const int numbers = mechanism.nq() + 2 * mechanism.nv(), calls = STATES / LANES;
  Generated<Lanes> generated(argv[3], argv[2], mechanism);
  const std::vector<State> all = states(mechanism);
  std::vector<Lanes> x(size_t(numbers * calls));
  for (int k = 0; k < STATES; ++k) {
    const State& s = all[size_t(k)];
    Lanes* at = &x[size_t(numbers * (k / LANES))];
    for (const auto& part : {s.q, s.v, generated.efforts ? s.tau : s.a})
      for (double number : part) (*at++)[k % LANES] = number;
  }
  auto call = [&](int k) { generated.compute(&x[size_t(numbers * k)]); };
  double sum = 0;
  for (int k = 0; k < calls; ++k) {
    call(k);
    Lanes some{};
    generated.for_each_result([&](Lanes x) { some += x; });
    for (int lane = 0; lane < LANES; ++lane) sum += some[lane];
  }
  std::printf("%.3f %.12e\n", time(call, calls) / LANES, sum);
}
