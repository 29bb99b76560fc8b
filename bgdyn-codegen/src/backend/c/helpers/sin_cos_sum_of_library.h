/* Sine and cosine of a sum of angles, with the rounding errors of the sum. */
static inline void @_sin_cos_sum(REAL angle, REAL tail, REAL *sine, REAL *cosine)
{
    const REAL s = `sin`(angle);
    const REAL c = `cos`(angle);
    *sine = s + c * tail;
    *cosine = c - s * tail;
}
