/* Sine and cosine of angle + tail; beyond 1e4 rad those of libm. */
static void @_sin_cos(float angle, float tail, float *sine, float *cosine)
{
    float sum = angle;
    float rest = tail;
    if (!(fabsf(angle) <= 1e4F && fabsf(tail) <= 1.0F / 2048.0F)) {
        sum = angle;
        rest = 0.0F;
        @_add_angle(&sum, &rest, tail);
    }
    if (fabsf(sum) <= 1e4F) {
        @_sin_cos_near(sum, rest, sine, cosine);
    } else {
        const float s = sinf(sum);
        const float c = cosf(sum);
        *sine = s + c * rest;
        *cosine = c - s * rest;
    }
}
