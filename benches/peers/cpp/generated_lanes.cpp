// Generated C compiled for vectors of LANES doubles, LANES states a call: generated_lanes DESCRIPTION OPERATION LIBRARY
// Prints the time of a state. Sines come from glibc's vector library, which is off by up to 4 units in the last place.
#include "generated.hpp"

#ifndef LANES
#define LANES 8
#endif
typedef double Lanes __attribute__((vector_size(8 * LANES)));

int main(int, char** argv) {
  const Mechanism mechanism = read(argv[1]);
  const int n = mechanism.n(), calls = STATES / LANES;
  Generated<Lanes> generated(argv[3], argv[2], n);
  const std::vector<State> all = states(mechanism);
  std::vector<Lanes> x(size_t(3 * n * calls));
  for (int k = 0; k < STATES; ++k)
    for (int i = 0; i < n; ++i) {
      const State& s = all[size_t(k)];
      Lanes* at = &x[size_t(3 * n * (k / LANES) + i)];
      at[0][k % LANES] = s.q[size_t(i)];
      at[n][k % LANES] = s.v[size_t(i)];
      at[2 * n][k % LANES] = (generated.efforts ? s.tau : s.a)[size_t(i)];
    }
  auto call = [&](int k) { generated.call(&x[size_t(3 * n * k)]); };
  double sum = 0;
  for (int k = 0; k < calls; ++k) {
    call(k);
    const Lanes some = generated.sum();
    for (int lane = 0; lane < LANES; ++lane) sum += some[lane];
  }
  std::printf("%.3f %.12e\n", time(call, calls) / LANES, sum);
}
