/* Rates of x, y and the angle at the velocities v in link axes. */
static void @_planar_position_rates(const REAL q[3], const REAL v[3], REAL result[3])
{
    REAL sine;
    REAL cosine;
    @_sin_cos(q[2], &sine, &cosine);
    result[0] = cosine * v[0] - sine * v[1];
    result[1] = sine * v[0] + cosine * v[1];
    result[2] = v[2];
}
