/* An evenly distributed unit quaternion from three numbers in 0 ... 1. */
static void @_spherical_sample(const REAL u[3], REAL result[4])
{
    const REAL turn = `6.283185307179586`;
    const REAL a = `sqrt`(`1` - u[0]);
    const REAL b = `sqrt`(u[0]);
    REAL sines[2];
    REAL cosines[2];
    for (int k = 0; k < 2; ++k) {
        @_sin_cos(turn * u[k + 1], &sines[k], &cosines[k]);
    }
    result[0] = a * sines[0];
    result[1] = a * cosines[0];
    result[2] = b * sines[1];
    result[3] = b * cosines[1];
}
