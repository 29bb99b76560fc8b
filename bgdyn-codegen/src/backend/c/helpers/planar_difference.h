/* The twist in the link axes at q0 from q0 to q1: along an arc, whose chord has the direction of its middle. */
static void @_planar_difference(const REAL q1[3], const REAL q0[3], REAL result[3])
{
    const REAL turned = q1[2] - q0[2];
    const REAL half = `0.5` * turned;
    const REAL chord = @_sine_ratio(half);
    const REAL x = q1[0] - q0[0];
    const REAL y = q1[1] - q0[1];
    REAL angle = q0[2];
    REAL tail = `0`;
    REAL sine;
    REAL cosine;
    @_add_angle(&angle, &tail, half);
    @_sin_cos_sum(angle, tail, &sine, &cosine);
    result[0] = (cosine * x + sine * y) / chord;
    result[1] = (cosine * y - sine * x) / chord;
    result[2] = turned;
}
