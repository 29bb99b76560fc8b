/* Sines and cosines of a single angle and of a sum: together where that saves time. */
INLINED void @_sin_cos_pair(double single, double sum, double tail, double sines[2], double cosines[2])
{
#if defined(HAS_LANES)
    const __m256d angles = _mm256_set_pd(sum, single, sum, single);
    const __m256d tails = _mm256_set_pd(tail, 0.0, tail, 0.0);
    if (@_are_small(angles, NEAR) && @_are_small(tails, SMALL_TAIL)) {
        double all_sines[4];
        double all_cosines[4];
        @_sin_cos_lanes(angles, tails, 1, all_sines, all_cosines);
        for (int k = 0; k < 2; ++k) {
            sines[k] = all_sines[k];
            cosines[k] = all_cosines[k];
        }
    } else {
        @_sin_cos_far(single, 0.0, &sines[0], &cosines[0]);
        @_sin_cos_far(sum, tail, &sines[1], &cosines[1]);
    }
#else
    @_sin_cos(single, &sines[0], &cosines[0]);
    @_sin_cos_sum(sum, tail, &sines[1], &cosines[1]);
#endif
}
