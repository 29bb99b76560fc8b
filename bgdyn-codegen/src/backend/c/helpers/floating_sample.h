/* A position in -1 ... 1 along each axis and an evenly distributed unit quaternion from six numbers in 0 ... 1. */
static void @_floating_sample(const REAL u[6], REAL result[7])
{
    for (int k = 0; k < 3; ++k) {
        result[k] = u[k] + u[k] - `1`;
    }
    @_spherical_sample(&u[3], &result[3]);
}
