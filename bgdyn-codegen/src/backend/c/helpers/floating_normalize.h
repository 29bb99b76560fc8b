/* Position x, y, z and the quaternion divided by its length. */
static void @_floating_normalize(const REAL q[7], REAL result[7])
{
    for (int k = 0; k < 3; ++k) {
        result[k] = q[k];
    }
    @_spherical_normalize(&q[3], &result[3]);
}
