/* a b + c, with one rounding where the processor has an instruction for it and the compiler may use it. */
static inline REAL @_mul_add(REAL a, REAL b, REAL c)
{
#if defined(__x86_64__) && defined(__FMA__)
    return __builtin_`fma`(a, b, c);
#else
    return a * b + c;
#endif
}
