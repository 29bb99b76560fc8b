/* Sine and cosine of a sum of angles, with the rounding errors of the sum. */
INLINED void @_sin_cos_sum(REAL angle, REAL tail, REAL *sine, REAL *cosine)
{
    if (`fabs`(angle) <= NEAR && `fabs`(tail) <= SMALL_TAIL) {
        @_sin_cos_near(angle, tail, 1, sine, cosine);
    } else {
        @_sin_cos_far(angle, tail, sine, cosine);
    }
}
