#if defined(__GNUC__) && defined(__AVX2__) && defined(__FMA__) && !defined(__OPTIMIZE_SIZE__) && !defined(NO_LANES)
#define HAS_LANES
#include <immintrin.h>
#if !defined(__clang__)
/* GCC would collect neighbouring results in registers to store them at once: that takes longer than to store them. */
#pragma GCC optimize("no-tree-slp-vectorize")
#endif

/* a b + c in four lanes. */
INLINED __m256d @_mul_add_lanes(__m256d a, __m256d b, double c)
{
    return _mm256_fmadd_pd(a, b, _mm256_set1_pd(c));
}

/* Whether all sizes are at most `limit`. */
INLINED int @_are_small(__m256d x, double limit)
{
    const __m256d size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
    return _mm256_movemask_pd(_mm256_cmp_pd(size, _mm256_set1_pd(limit), _CMP_LE_OQ)) == 15;
}

/* The sines and cosines of r + low + n pi/2, |r| <= pi/4, in four lanes; the last two digits of `quarters` are those of n. */
INLINED void @_sin_cos_of_rests(__m256d quarters, __m256d r, __m256d low, double sines[4], double cosines[4])
{
    const __m256d x = _mm256_mul_pd(r, r);
    const __m256d xx = _mm256_mul_pd(x, x);
    const __m256d s01 = @_mul_add_lanes(x, _mm256_set1_pd(0.008333333333322118), -0.1666666666666663);
    const __m256d s23 = @_mul_add_lanes(x, _mm256_set1_pd(2.7557313621346115e-6), -0.00019841269829589428);
    const __m256d s45 = @_mul_add_lanes(x, _mm256_set1_pd(1.589622977567075e-10), -2.5050747756459783e-8);
    const __m256d s = _mm256_fmadd_pd(_mm256_fmadd_pd(s45, xx, s23), xx, s01);
    const __m256d c01 = @_mul_add_lanes(x, _mm256_set1_pd(-0.0013888888888873056), 0.041666666666666595);
    const __m256d c23 = @_mul_add_lanes(x, _mm256_set1_pd(-2.755731417926196e-7), 2.480158728885159e-5);
    const __m256d c45 = @_mul_add_lanes(x, _mm256_set1_pd(-1.1358536261228959e-11), 2.0875700837093765e-9);
    const __m256d c = _mm256_fmadd_pd(_mm256_fmadd_pd(c45, xx, c23), xx, c01);

    const __m256d one = _mm256_set1_pd(1.0);
    const __m256d halved = _mm256_mul_pd(_mm256_set1_pd(0.5), x);
    const __m256d rounded = _mm256_sub_pd(one, halved);
    const __m256d left = _mm256_sub_pd(_mm256_sub_pd(one, rounded), halved);
    const __m256d small = _mm256_fmadd_pd(_mm256_mul_pd(r, x), s, _mm256_fnmadd_pd(halved, low, low));
    const __m256d tiny = _mm256_fmadd_pd(xx, c, _mm256_sub_pd(left, _mm256_mul_pd(r, low)));
    const __m256d sine = _mm256_add_pd(r, small);
    const __m256d cosine = _mm256_add_pd(rounded, tiny);

    const __m256i turns = _mm256_castpd_si256(quarters);
    const __m256i two = _mm256_set1_epi64x(2);
    const __m256i next = _mm256_add_epi64(turns, _mm256_set1_epi64x(1));
    const __m256i sine_sign = _mm256_slli_epi64(_mm256_and_si256(turns, two), 62);
    const __m256i cosine_sign = _mm256_slli_epi64(_mm256_and_si256(next, two), 62);
    const __m256d swapped = _mm256_castsi256_pd(_mm256_slli_epi64(turns, 63));
    const __m256d chosen_sine = _mm256_blendv_pd(sine, cosine, swapped);
    const __m256d chosen_cosine = _mm256_blendv_pd(cosine, sine, swapped);
    _mm256_storeu_pd(sines, _mm256_xor_pd(chosen_sine, _mm256_castsi256_pd(sine_sign)));
    _mm256_storeu_pd(cosines, _mm256_xor_pd(chosen_cosine, _mm256_castsi256_pd(cosine_sign)));
}

/* The same as @_sin_cos_near, in four lanes. */
INLINED void @_sin_cos_lanes(__m256d angle, __m256d tail, int is_sum, double sines[4], double cosines[4])
{
    const __m256d magic = _mm256_set1_pd(6755399441055744.0);
    const __m256d part = _mm256_set1_pd(2.5633441515839558e-12);
    const __m256d quarters = _mm256_fmadd_pd(angle, _mm256_set1_pd(0.6366197723675814), magic);
    const __m256d n = _mm256_sub_pd(quarters, magic);
    const __m256d rest = _mm256_fnmadd_pd(n, _mm256_set1_pd(1.5707963267923333), angle);
    __m256d taken = _mm256_mul_pd(n, part);
    if (is_sum) {
        taken = _mm256_fmsub_pd(n, part, tail);
    }
    const __m256d r = _mm256_sub_pd(rest, taken);
    __m256d error = _mm256_sub_pd(_mm256_sub_pd(rest, r), taken);
    if (is_sum) {
        error = _mm256_sub_pd(error, _mm256_sub_pd(_mm256_fmsub_pd(n, part, taken), tail));
    }
    const __m256d low = _mm256_fnmadd_pd(n, _mm256_set1_pd(1.0562999066987428e-23), error);
    @_sin_cos_of_rests(quarters, r, low, sines, cosines);
}

/* Four elements of an array from this one on; the last one is repeated where there are fewer. The lanes are filled from
   registers: an array would be stored in other widths than it is loaded in, and the load would wait for the stores. */
INLINED __m256d @_lanes_of(const double *array, int first, int count)
{
    const int last = count - 1;
    const int second = (first + 1 < count) ? first + 1 : last;
    const int third = (first + 2 < count) ? first + 2 : last;
    const int fourth = (first + 3 < count) ? first + 3 : last;
    return _mm256_set_pd(array[fourth], array[third], array[second], array[first]);
}
#endif
