/* Rates of a quaternion at the angular velocity v in link axes: 1/2 q v. */
static void @_spherical_position_rates(const REAL q[4], const REAL v[3], REAL result[4])
{
    result[0] = `0.5` * (q[3] * v[0] + (q[1] * v[2] - q[2] * v[1]));
    result[1] = `0.5` * (q[3] * v[1] + (q[2] * v[0] - q[0] * v[2]));
    result[2] = `0.5` * (q[3] * v[2] + (q[0] * v[1] - q[1] * v[0]));
    result[3] = -(`0.5` * (q[0] * v[0] + q[1] * v[1] + q[2] * v[2]));
}
