/* The rotation vector in link axes from the quaternion q0 to q1. */
static void @_spherical_difference(const REAL q1[4], const REAL q0[4], REAL result[3])
{
    const REAL back[4] = {-q0[0], -q0[1], -q0[2], q0[3]};
    REAL turn[4];
    @_quaternion_product(back, q1, turn);
    (void)@_quaternion_logarithm(turn, result);
}
