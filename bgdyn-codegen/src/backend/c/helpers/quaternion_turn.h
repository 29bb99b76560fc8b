/* The vector v, turned by a unit quaternion: v + w 2u x v + u x (2u x v). */
static void @_quaternion_turn(const REAL q[4], const REAL v[3], REAL result[3])
{
    REAL once[3];
    REAL twice[3];
    @_cross(q, v, once);
    for (int k = 0; k < 3; ++k) {
        once[k] = once[k] + once[k];
    }
    @_cross(q, once, twice);
    for (int k = 0; k < 3; ++k) {
        result[k] = v[k] + (q[3] * once[k] + twice[k]);
    }
}
