/* The quaternion after the rotation vector d in link axes: q exp(d/2). */
static void @_spherical_integrate(const REAL q[4], const REAL d[3], REAL result[4])
{
    REAL turn[4];
    REAL ratios[4];
    REAL turned[4];
    @_quaternion_exponential(d, turn, ratios);
    @_quaternion_product(q, turn, turned);
    @_spherical_normalize(turned, result);
}
