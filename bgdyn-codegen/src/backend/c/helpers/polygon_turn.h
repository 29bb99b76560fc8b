/* The angle from one vector to another in -pi ... pi: small ones to rounding, others to 1e-5 rad (Abramowitz and Stegun
   1964, 4.4.49). */
static REAL @_polygon_turn(const REAL from[2], const REAL to[2])
{
    const REAL series[5] = {ARC_TANGENT};
    const REAL x = from[0] * to[0] + from[1] * to[1];
    const REAL y = from[0] * to[1] - from[1] * to[0];
    const int steep = `fabs`(x) < `fabs`(y);
    const REAL t = (steep ? x : y) / (steep ? y : x);
    const REAL right = (y < `0`) ? -`1.5707963267948966` : `1.5707963267948966`;
    const REAL straight = (y < `0`) ? -`3.141592653589793` : `3.141592653589793`;
    REAL arc = series[0];
    for (int k = 1; k < 5; ++k) {
        arc = arc * (t * t) + series[k];
    }
    arc = (`fabs`(t) < SHORT_TURN) ? @_polygon_arc_tangent(t) : arc * t;
    return steep ? right - arc : arc + ((x < `0`) ? straight : `0`);
}
