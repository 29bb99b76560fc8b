#if defined(HAS_LANES)
/* Sines and cosines of at most eight angles; `tails` are the rounding errors of sums, or NULL if all angles are single. */
INLINED void @_sin_cos_all(int count, const double *angles, const double *tails, double *sines, double *cosines)
{
    const int are_sums = tails != NULL;
    const int beyond = (count > 4) ? 4 : 0;
    const __m256d angle = @_lanes_of(angles, 0, count);
    const __m256d other_angle = @_lanes_of(angles, beyond, count);
    const __m256d tail = are_sums ? @_lanes_of(tails, 0, count) : _mm256_setzero_pd();
    const __m256d other_tail = are_sums ? @_lanes_of(tails, beyond, count) : _mm256_setzero_pd();
    double all_sines[8];
    double all_cosines[8];
    int are_near = @_are_small(angle, NEAR) && @_are_small(other_angle, NEAR);
    if (are_sums) {
        are_near = are_near && @_are_small(tail, SMALL_TAIL) && @_are_small(other_tail, SMALL_TAIL);
    }
    if (are_near) {
        @_sin_cos_lanes(angle, tail, are_sums, all_sines, all_cosines);
        if (count > 4) {
            @_sin_cos_lanes(other_angle, other_tail, are_sums, &all_sines[4], &all_cosines[4]);
        }
    } else {
        double all_angles[8];
        double all_tails[8];
        _mm256_storeu_pd(all_angles, angle);
        _mm256_storeu_pd(&all_angles[4], other_angle);
        _mm256_storeu_pd(all_tails, tail);
        _mm256_storeu_pd(&all_tails[4], other_tail);
        for (int k = 0; k < count; ++k) {
            @_sin_cos_far(all_angles[k], all_tails[k], &all_sines[k], &all_cosines[k]);
        }
    }
    for (int k = 0; k < count; ++k) {
        sines[k] = all_sines[k];
        cosines[k] = all_cosines[k];
    }
}
#else
