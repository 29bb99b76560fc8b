/* Sine and cosine of an angle. */
INLINED void @_sin_cos(REAL angle, REAL *sine, REAL *cosine)
{
    if (`fabs`(angle) <= NEAR) {
        @_sin_cos_near(angle, `0`, 0, sine, cosine);
    } else {
        @_sin_cos_far(angle, `0`, sine, cosine);
    }
}
