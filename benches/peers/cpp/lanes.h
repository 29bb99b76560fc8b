/* Put in front of CasADi's C: its numbers become vectors of 8 doubles, its sines those of glibc's vector library. */
#include <immintrin.h>
#include <math.h>
typedef double Lanes __attribute__((vector_size(64)));
#define casadi_real Lanes
Lanes _ZGVeN8v_sin(Lanes);
Lanes _ZGVeN8v_cos(Lanes);
#define sin _ZGVeN8v_sin
#define cos _ZGVeN8v_cos
#define sqrt(x) ((Lanes)_mm512_sqrt_pd((__m512d)(x)))
#define casadi_sq(x) ((x) * (x))
static inline Lanes all_lanes(double x) { return (Lanes){} + x; }
