/* Sine and cosine of angle + tail. */
static inline void @_sin_cos(REAL angle, REAL tail, REAL *sine, REAL *cosine)
{
    const REAL s = `sin`(angle);
    const REAL c = `cos`(angle);
    *sine = s + c * tail;
    *cosine = c - s * tail;
}
