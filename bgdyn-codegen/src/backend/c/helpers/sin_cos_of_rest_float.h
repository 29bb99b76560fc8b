/* Sines are a part of the function that needs them, except where code is to be short. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define INLINED static inline __attribute__((always_inline, unused))
#else
#define INLINED static inline
#endif

/* Sine and cosine of r + low + n pi/2, |r| <= pi/4; the last two digits of `turns` are those of n. */
INLINED void @_sin_cos_of_rest(uint32_t turns, float r, float low, float *sine, float *cosine)
{
    const float x = r * r;
    const float xx = x * x;
    const float s01 = @_mul_add(x, `0.00833215490589`, `-0.166666545188`);
    const float s = @_mul_add(`-0.000195144732882`, xx, s01);
    const float c01 = @_mul_add(x, `-0.00138873083093`, `0.0416666455231`);
    const float c = @_mul_add(`2.44322318044e-5`, xx, c01);

    const float halved = 0.5F * x;
    const float rounded = 1.0F - halved;
    const float small = @_mul_add(r * x, s, @_mul_add(-halved, low, low));
    const float tiny = @_mul_add(x * x, c, ((1.0F - rounded) - halved) - r * low);
    const float sine_of_rest = r + small;
    const float cosine_of_rest = rounded + tiny;

    uint32_t s_bits;
    uint32_t c_bits;
    memcpy(&s_bits, &sine_of_rest, sizeof s_bits);
    memcpy(&c_bits, &cosine_of_rest, sizeof c_bits);
    const uint32_t swapped = UINT32_C(0) - (turns & UINT32_C(1));
    const uint32_t sine_bits = ((s_bits & ~swapped) | (c_bits & swapped)) ^ ((turns & UINT32_C(2)) << 30);
    const uint32_t cosine_bits =
        ((c_bits & ~swapped) | (s_bits & swapped)) ^ (((turns + UINT32_C(1)) & UINT32_C(2)) << 30);
    memcpy(sine, &sine_bits, sizeof sine_bits);
    memcpy(cosine, &cosine_bits, sizeof cosine_bits);
}
