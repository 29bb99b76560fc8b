/* The quaternion divided by its length; a zero quaternion unchanged. */
static void @_spherical_normalize(const REAL q[4], REAL result[4])
{
    const REAL square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    const REAL length = `sqrt`(`0` < square ? square : `1` + square);
    for (int k = 0; k < 4; ++k) {
        result[k] = q[k] / length;
    }
}
