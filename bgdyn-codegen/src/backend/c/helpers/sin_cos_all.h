#if defined(__clang__)
/* Where a register has more lanes than there are angles, the loop below is no wide one, without a warning. */
#pragma clang diagnostic ignored "-Wpass-failed"
#endif

/* Sines and cosines of several angles; `tails` are the rounding errors of sums, or NULL if all angles are single. The
   arrays have an even length: an odd number of angles ends with the last one twice, which takes no time where the
   processor has registers for two of them. */
INLINED void @_sin_cos_all(int count, const REAL *angles, const REAL *tails, REAL *sines, REAL *cosines)
{
#if defined(__SSE2__) || defined(__aarch64__)
    const int lanes = count + count % 2;
#else
    const int lanes = count;
#endif
    const int are_sums = tails != NULL;
    int are_near = 1;
    for (int k = 0; k < lanes; ++k) {
        are_near &= `fabs`(angles[k]) <= NEAR;
        are_near &= !are_sums || `fabs`(tails[k]) <= SMALL_TAIL;
    }
    if (!are_near) {
        for (int k = 0; k < lanes; ++k) {
            @_sin_cos_far(angles[k], are_sums ? tails[k] : `0`, &sines[k], &cosines[k]);
        }
    } else if (lanes > 3) {
#if defined(__clang__) && (defined(__SSE2__) || defined(__aarch64__))
#pragma clang loop unroll(disable) vectorize(enable)
#endif
        for (int k = 0; k < lanes; ++k) {
            @_sin_cos_near(angles[k], are_sums ? tails[k] : `0`, are_sums, &sines[k], &cosines[k]);
        }
    } else {
        for (int k = 0; k < lanes; ++k) {
            @_sin_cos_near(angles[k], are_sums ? tails[k] : `0`, are_sums, &sines[k], &cosines[k]);
        }
    }
}
