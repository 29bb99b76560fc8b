/* Sines are a part of the function that needs them, except where code is to be short. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define INLINED static inline __attribute__((always_inline, unused))
#else
#define INLINED static inline
#endif

/* Sine and cosine of r + low + n pi/2, |r| <= pi/4; the last two digits of `turns` are those of n. */
INLINED void @_sin_cos_of_rest(uint64_t turns, double r, double low, double *sine, double *cosine)
{
    const double x = r * r;
    const double xx = x * x;
    const double s01 = @_mul_add(x, 0.008333333333322118, -0.1666666666666663);
    const double s23 = @_mul_add(x, 2.7557313621346115e-6, -0.00019841269829589428);
    const double s45 = @_mul_add(x, 1.589622977567075e-10, -2.5050747756459783e-8);
    const double s = @_mul_add(@_mul_add(s45, xx, s23), xx, s01);
    const double c01 = @_mul_add(x, -0.0013888888888873056, 0.041666666666666595);
    const double c23 = @_mul_add(x, -2.755731417926196e-7, 2.480158728885159e-5);
    const double c45 = @_mul_add(x, -1.1358536261228959e-11, 2.0875700837093765e-9);
    const double c = @_mul_add(@_mul_add(c45, xx, c23), xx, c01);

    const double halved = 0.5 * x;
    const double rounded = 1.0 - halved;
    const double small = @_mul_add(r * x, s, @_mul_add(-halved, low, low));
    const double tiny = @_mul_add(x * x, c, ((1.0 - rounded) - halved) - r * low);
    const double sine_of_rest = r + small;
    const double cosine_of_rest = rounded + tiny;

    uint64_t s_bits;
    uint64_t c_bits;
    memcpy(&s_bits, &sine_of_rest, sizeof s_bits);
    memcpy(&c_bits, &cosine_of_rest, sizeof c_bits);
    const uint64_t swapped = UINT64_C(0) - (turns & UINT64_C(1));
    const uint64_t sine_bits = ((s_bits & ~swapped) | (c_bits & swapped)) ^ ((turns & UINT64_C(2)) << 62);
    const uint64_t cosine_bits =
        ((c_bits & ~swapped) | (s_bits & swapped)) ^ (((turns + UINT64_C(1)) & UINT64_C(2)) << 62);
    memcpy(sine, &sine_bits, sizeof sine_bits);
    memcpy(cosine, &cosine_bits, sizeof cosine_bits);
}
