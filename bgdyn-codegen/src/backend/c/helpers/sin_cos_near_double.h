/* Sine and cosine of angle + tail, |angle| <= 1e5: less quarter turns in three parts (Cody and Waite), then a polynomial
   of each. A single angle has no tail. */
INLINED void @_sin_cos_near(double angle, double tail, int is_sum, double *sine, double *cosine)
{
    const double magic = 6755399441055744.0;
    const double quarters = @_mul_add(angle, 0.6366197723675814, magic);
    const double n = quarters - magic;
    const double rest = @_mul_add(-n, 1.5707963267923333, angle);
    const double part = 2.5633441515839558e-12;
    const double taken = is_sum ? @_mul_add(n, part, -tail) : n * part;
    const double r = rest - taken;
    const double left = is_sum ? @_mul_add(n, part, -taken) - tail : 0.0;
    const double difference = (rest - r) - taken;
    const double error = is_sum ? difference - left : difference;
    const double low = @_mul_add(-n, 1.0562999066987428e-23, error);
    uint64_t turns;
    memcpy(&turns, &quarters, sizeof turns);
    @_sin_cos_of_rest(turns, r, low, sine, cosine);
}
