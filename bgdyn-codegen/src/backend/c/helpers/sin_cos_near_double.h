/* Sine and cosine of angle + tail, |angle| <= 1e5: less quarter turns in three parts (Cody and Waite), then a polynomial
   of each. */
static inline void @_sin_cos_near(double angle, double tail, double *sine, double *cosine)
{
    const double magic = 6755399441055744.0;
    const double quarters = @_mul_add(angle, 0.6366197723675814, magic);
    const double n = quarters - magic;
    const double rest = @_mul_add(-n, 1.5707963267923333, angle);
    const double taken = @_mul_add(n, 2.5633441515839558e-12, -tail);
    const double r = rest - taken;
    const double left = @_mul_add(n, 2.5633441515839558e-12, -taken) - tail;
    const double error = ((rest - r) - taken) - left;
    const double low = @_mul_add(-n, 1.0562999066987428e-23, error);

    const double x = r * r;
    const double xx = x * x;
    const double s01 = @_mul_add(x, 0.008333333333322118, -0.1666666666666663);
    const double s23 = @_mul_add(x, 2.7557313621346115e-6, -0.00019841269829589428);
    const double s45 = @_mul_add(x, 1.589622977567075e-10, -2.5050747756459783e-8);
    const double s = @_mul_add(@_mul_add(s45, xx, s23), xx, s01);
    const double c01 = @_mul_add(x, -0.0013888888888873056, 0.041666666666666595);
    const double c23 = @_mul_add(x, -2.755731417926196e-7, 2.480158728885159e-5);
    const double c45 = @_mul_add(x, -1.1358536261228959e-11, 2.0875700837093765e-9);
    const double c = @_mul_add(@_mul_add(c45, xx, c23), xx, c01);

    const double halved = 0.5 * x;
    const double rounded = 1.0 - halved;
    const double small = @_mul_add(r * x, s, @_mul_add(-halved, low, low));
    const double tiny = @_mul_add(x * x, c, ((1.0 - rounded) - halved) - r * low);
    const double of_rest[2] = {r + small, rounded + tiny};

    uint64_t bits[2];
    uint64_t turns;
    memcpy(bits, of_rest, sizeof bits);
    memcpy(&turns, &quarters, sizeof turns);
    const uint64_t swapped = UINT64_C(0) - (turns & UINT64_C(1));
    const uint64_t sine_bits = ((bits[0] & ~swapped) | (bits[1] & swapped)) ^ ((turns & UINT64_C(2)) << 62);
    const uint64_t cosine_bits =
        ((bits[1] & ~swapped) | (bits[0] & swapped)) ^ (((turns + UINT64_C(1)) & UINT64_C(2)) << 62);
    memcpy(sine, &sine_bits, sizeof sine_bits);
    memcpy(cosine, &cosine_bits, sizeof cosine_bits);
}
