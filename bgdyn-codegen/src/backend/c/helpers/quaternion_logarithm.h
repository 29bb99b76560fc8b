/* The rotation vector of a quaternion, no longer than pi; returns the square of half its length. */
static REAL @_quaternion_logarithm(const REAL q[4], REAL vector[3])
{
    REAL shorter[4];
    REAL turn[4];
    for (int k = 0; k < 4; ++k) {
        shorter[k] = q[3] < `0` ? -q[k] : q[k];
    }
    @_spherical_normalize(shorter, turn);
    const REAL square = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
    const REAL ratio = @_arc_ratio(square, turn[3]);
    const REAL whole = ratio + ratio;
    for (int k = 0; k < 3; ++k) {
        vector[k] = whole * turn[k];
    }
    return square * (ratio * ratio);
}
