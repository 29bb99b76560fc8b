/* Sine and cosine of angle + tail, |angle| <= 1e4: less quarter turns in four parts (Cody and Waite), then a polynomial
   of each. A single angle has no tail. */
INLINED void @_sin_cos_near(float angle, float tail, int is_sum, float *sine, float *cosine)
{
    const float magic = 12582912.0F;
    const float quarters = @_mul_add(angle, `0.6366197723675814`, magic);
    const float n = quarters - magic;
    const float first = @_mul_add(-n, `1.5703125`, angle);
    const float rest = @_mul_add(-n, `0.0004837512969970703`, first);
    const float part = `7.549533620476723e-8`;
    const float taken = is_sum ? @_mul_add(n, part, -tail) : n * part;
    const float r = rest - taken;
    const float left = is_sum ? @_mul_add(n, part, -taken) - tail : 0.0F;
    const float difference = (rest - r) - taken;
    const float error = is_sum ? difference - left : difference;
    const float low = @_mul_add(-n, `2.5633440682570896e-12`, error);
    uint32_t turns;
    memcpy(&turns, &quarters, sizeof turns);
    @_sin_cos_of_rest(turns, r, low, sine, cosine);
}
