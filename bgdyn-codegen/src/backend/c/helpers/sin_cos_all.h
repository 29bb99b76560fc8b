/* Sines and cosines of several angles. The arrays have an even length: an odd number of angles ends with the last one
   twice, which takes no time where the processor has registers for two of them. */
INLINED void @_sin_cos_all(int count, const REAL *angles, REAL *sines, REAL *cosines)
{
#if defined(__SSE2__) || defined(__aarch64__)
    const int lanes = count + count % 2;
#else
    const int lanes = count;
#endif
    int is_near = 1;
    for (int k = 0; k < lanes; ++k) {
        is_near &= `fabs`(angles[k]) <= NEAR;
    }
    if (is_near) {
#if defined(__clang__)
#pragma clang loop unroll(disable) vectorize(enable)
#endif
        for (int k = 0; k < lanes; ++k) {
            @_sin_cos_near(angles[k], `0`, 0, &sines[k], &cosines[k]);
        }
    } else {
        for (int k = 0; k < lanes; ++k) {
            @_sin_cos_far(angles[k], `0`, &sines[k], &cosines[k]);
        }
    }
}
