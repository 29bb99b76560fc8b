/* x, y and the angle unchanged. */
static inline void @_planar_normalize(const REAL q[3], REAL result[3])
{
    for (int k = 0; k < 3; ++k) {
        result[k] = q[k];
    }
}
