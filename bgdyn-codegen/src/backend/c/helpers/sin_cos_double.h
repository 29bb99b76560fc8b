/* Sine and cosine of angle + tail; beyond 1e5 rad those of libm. */
static void @_sin_cos(double angle, double tail, double *sine, double *cosine)
{
    double sum = angle;
    double rest = tail;
    if (!(fabs(angle) <= 1e5 && fabs(tail) <= 1.0 / 2097152.0)) {
        sum = angle;
        rest = 0.0;
        @_add_angle(&sum, &rest, tail);
    }
    if (fabs(sum) <= 1e5) {
        @_sin_cos_near(sum, rest, sine, cosine);
    } else {
        const double s = sin(sum);
        const double c = cos(sum);
        *sine = s + c * rest;
        *cosine = c - s * rest;
    }
}
