/* The unit quaternion of a rotation vector, and the ratios of half its length. */
static void @_quaternion_exponential(const REAL vector[3], REAL turn[4], REAL ratios[4])
{
    REAL half[3];
    for (int k = 0; k < 3; ++k) {
        half[k] = `0.5` * vector[k];
    }
    @_sines(half[0] * half[0] + half[1] * half[1] + half[2] * half[2], ratios);
    for (int k = 0; k < 3; ++k) {
        turn[k] = ratios[1] * half[k];
    }
    turn[3] = ratios[0];
}
