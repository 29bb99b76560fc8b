/* Rates of position and quaternion at the velocities v, linear and angular, in link axes. */
static void @_floating_position_rates(const REAL q[7], const REAL v[6], REAL result[7])
{
    @_quaternion_turn(&q[3], v, result);
    @_spherical_position_rates(&q[3], &v[3], &result[3]);
}
