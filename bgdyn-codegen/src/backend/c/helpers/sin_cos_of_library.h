/* Sine and cosine of an angle. */
static inline void @_sin_cos(REAL angle, REAL *sine, REAL *cosine)
{
    *sine = `sin`(angle);
    *cosine = `cos`(angle);
}
