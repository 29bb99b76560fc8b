/* A position in -1 ... 1 along both axes and an angle in -pi ... pi from three numbers in 0 ... 1. */
static void @_planar_sample(const REAL u[3], REAL result[3])
{
    for (int k = 0; k < 3; ++k) {
        result[k] = u[k] + u[k] - `1`;
    }
    result[2] = `3.141592653589793` * result[2];
}
