/* Sine and cosine of a large angle, or of one with a large tail: beyond 1e5 rad those of libm. */
static void @_sin_cos_far(double angle, double tail, double *sine, double *cosine)
{
    double sum = angle;
    double rest = 0.0;
    @_add_angle(&sum, &rest, tail);
    if (fabs(sum) <= 1e5) {
        @_sin_cos_near(sum, rest, 1, sine, cosine);
    } else {
        const double s = sin(sum);
        const double c = cos(sum);
        *sine = s + c * rest;
        *cosine = c - s * rest;
    }
}
