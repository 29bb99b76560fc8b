static inline REAL @_sign(REAL a)
{
    return (a > `0`) ? `1` : ((a < `0`) ? -`1` : a * `0`);
}
