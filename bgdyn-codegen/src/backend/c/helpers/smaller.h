static inline REAL @_smaller(REAL a, REAL b)
{
    return (a < b || a != a) ? a : b;
}
