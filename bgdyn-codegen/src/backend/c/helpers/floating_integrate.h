/* Position and quaternion after the twist d in link axes: a screw. With the angle x of the turn and its vector p the
   path is d + (1 - cos x)/x^2 p x d + (x - sin x)/x^3 p x (p x d). */
static void @_floating_integrate(const REAL q[7], const REAL d[6], REAL result[7])
{
    REAL step[4];
    REAL ratios[4];
    REAL once[3];
    REAL twice[3];
    REAL path[3];
    REAL shift[3];
    REAL turned[4];
    @_quaternion_exponential(&d[3], step, ratios);
    const REAL versine = `0.5` * (ratios[1] * ratios[1]);
    const REAL excess = `0.25` * (ratios[3] + ratios[1] * ratios[2]);
    @_cross(&d[3], d, once);
    @_cross(&d[3], once, twice);
    for (int k = 0; k < 3; ++k) {
        path[k] = d[k] + (versine * once[k] + excess * twice[k]);
    }
    @_quaternion_turn(&q[3], path, shift);
    for (int k = 0; k < 3; ++k) {
        result[k] = q[k] + shift[k];
    }
    @_quaternion_product(&q[3], step, turned);
    @_spherical_normalize(turned, &result[3]);
}
