/* x, y and the angle after the twist d in link axes: an arc, whose chord has the direction of its middle. */
static void @_planar_integrate(const REAL q[3], const REAL d[3], REAL result[3])
{
    const REAL half = `0.5` * d[2];
    const REAL chord = @_sine_ratio(half);
    const REAL x = chord * d[0];
    const REAL y = chord * d[1];
    REAL angle = q[2];
    REAL tail = `0`;
    REAL sine;
    REAL cosine;
    @_add_angle(&angle, &tail, half);
    @_sin_cos_sum(angle, tail, &sine, &cosine);
    result[0] = q[0] + (cosine * x - sine * y);
    result[1] = q[1] + (sine * x + cosine * y);
    result[2] = q[2] + d[2];
}
