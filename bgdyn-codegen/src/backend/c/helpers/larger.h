static inline REAL @_larger(REAL a, REAL b)
{
    return (a > b || a != a) ? a : b;
}
