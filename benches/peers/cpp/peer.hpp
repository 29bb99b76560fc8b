// What all peers share: the mechanism as `describe` writes it, the states, the clock, the line printed.
#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

// A moving body and the joint that carries it; whatever is fixed to it is part of it.
struct Body {
  std::string name;
  int parent;       // number of the carrying body, -1 for the world
  bool slides;      // prismatic
  bool floats;      // floating: q is position and quaternion x, y, z, w, v linear and angular, in the body's axes
  double R[9];      // axes in the carrier's at coordinate zero, row by row
  double p[3];      // origin in the carrier's axes, m
  double axis[3];   // unit vector, in the body's axes; of no meaning where it floats
  double m;         // kg
  double com[3];    // m, in the body's axes
  double I[6];      // xx xy xz yy yz zz about the centre of mass, kg m^2
  int nq() const { return floats ? 7 : 1; }
  int nv() const { return floats ? 6 : 1; }
};

struct Mechanism {
  std::string name;
  double gravity[3];  // m/s^2, world axes
  std::vector<Body> bodies;
  int nq() const {  // positions
    int count = 0;
    for (const Body& b : bodies) count += b.nq();
    return count;
  }
  int nv() const {  // velocities
    int count = 0;
    for (const Body& b : bodies) count += b.nv();
    return count;
  }
};

// This mechanism or operation is beyond the peer: exit code 3, a dash in the table.
[[noreturn]] inline void cannot(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(3);
}

inline Mechanism read(const std::string& path) {
  Mechanism mechanism;
  std::ifstream in(path);
  std::string word, kind;
  size_t count = 0;
  in >> word >> mechanism.name >> word;
  for (double& x : mechanism.gravity) in >> x;
  in >> word >> count;
  for (size_t i = 0; i < count; ++i) {
    Body b;
    in >> b.name >> b.parent >> kind;
    b.slides = kind == "prismatic";
    b.floats = kind == "floating";
    for (double& x : b.R) in >> x;
    for (double& x : b.p) in >> x;
    for (double& x : b.axis) in >> x;
    in >> b.m;
    for (double& x : b.com) in >> x;
    for (double& x : b.I) in >> x;
    mechanism.bodies.push_back(b);
  }
  if (!in) {
    std::fprintf(stderr, "%s is no description of a mechanism\n", path.c_str());
    std::exit(2);
  }
  return mechanism;
}

// The mechanism for a peer that takes joints about and along an axis only.
inline Mechanism read_axes_only(const std::string& path) {
  const Mechanism mechanism = read(path);
  for (const Body& b : mechanism.bodies)
    if (b.floats) cannot("floating joints are not compared with this peer");
  return mechanism;
}

// splitmix64 (Steele, Lea, Flood 2014), the same numbers in every program.
struct Random {
  uint64_t state = 0x5EED5EED12345678ull;
  double within(double size) {  // in [-size, size)
    uint64_t z = (state += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    z ^= z >> 31;
    return size * (double(z >> 11) * (2.0 / 9007199254740992.0) - 1.0);
  }
};

constexpr int STATES = 1024;

struct State {
  std::vector<double> q, v, a, tau;
};

// The states of every timing: any angle, +-0.3 m, any orientation, velocities and accelerations +-2, efforts +-10.
inline std::vector<State> states(const Mechanism& mechanism) {
  Random random;
  std::vector<State> all(STATES);
  for (State& s : all) {
    for (const Body& b : mechanism.bodies) {
      if (!b.floats) {
        s.q.push_back(random.within(b.slides ? 0.3 : M_PI));
        continue;
      }
      for (int i = 0; i < 3; ++i) s.q.push_back(random.within(0.3));
      double x[4], square = 0;
      for (double& component : x) {
        component = random.within(1);
        square += component * component;
      }
      for (double component : x) s.q.push_back(component / std::sqrt(square));
    }
    for (int i = 0; i < mechanism.nv(); ++i) s.v.push_back(random.within(2));
    for (int i = 0; i < mechanism.nv(); ++i) s.a.push_back(random.within(2));
    for (int i = 0; i < mechanism.nv(); ++i) s.tau.push_back(random.within(10));
  }
  return all;
}

inline double now() {  // ns
  using namespace std::chrono;
  return double(duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count());
}

// Median time of a call, ns: batches of about 40 us, for PEERS_SECONDS (0.1 s). call(k) is one call, in state k.
template <class Call>
double time(Call&& call, int number = STATES) {
  int k = 0;
  long calls = 1;
  auto batch = [&] {
    double start = now();
    for (long i = 0; i < calls; ++i) {
      call(k);
      k = k + 1 == number ? 0 : k + 1;
    }
    return now() - start;
  };
  for (double end = now() + 3e7; now() < end;) {  // warm up, and find how many calls make a batch
    double t = batch();
    if (t < 4e4) calls *= 2;
    else if (t > 1.2e5 && calls > 1) calls /= 2;
  }
  const char* seconds = std::getenv("PEERS_SECONDS");
  double end = now() + (seconds ? std::atof(seconds) : 0.1) * 1e9;
  std::vector<double> times;
  while (now() < end || times.size() < 31) times.push_back(batch() / double(calls));
  std::nth_element(times.begin(), times.begin() + long(times.size() / 2), times.end());
  return times[times.size() / 2];
}

// Prints the time of a call and the sum of all outputs over all states.
template <class Call, class Sum>
void measure(Call&& call, Sum&& sum) {
  double all = 0;
  for (int k = 0; k < STATES; ++k) {
    call(k);
    all += sum();
  }
  std::printf("%.3f %.12e\n", time(call), all);
}

// The same where `outputs` appends all outputs to a vector. With PEERS_VALUES they are printed instead, for as many
// states as it says, a line each.
template <class Call, class Outputs>
void measure_outputs(Call&& call, Outputs&& outputs) {
  std::vector<double> all;
  if (const char* number = std::getenv("PEERS_VALUES")) {
    for (int k = 0; k < std::min(std::atoi(number), STATES); ++k) {
      call(k);
      all.clear();
      outputs(all);
      for (double x : all) std::printf("%.17g ", x);
      std::printf("\n");
    }
    return;
  }
  measure(call, [&] {
    all.clear();
    outputs(all);
    double sum = 0;
    for (double x : all) sum += x;
    return sum;
  });
}

// Sum of the upper triangle of a symmetric matrix: some peers fill only that one.
template <class Entry>
double upper(int n, Entry&& entry) {
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) sum += entry(i, j);
  return sum;
}
