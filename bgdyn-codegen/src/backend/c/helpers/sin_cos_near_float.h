/* Sine and cosine of angle + tail, |angle| <= 1e4: less quarter turns in four parts (Cody and Waite), then a polynomial
   of each. */
static inline void @_sin_cos_near(float angle, float tail, float *sine, float *cosine)
{
    const float magic = 12582912.0F;
    const float quarters = @_mul_add(angle, `0.6366197723675814`, magic);
    const float n = quarters - magic;
    const float first = @_mul_add(-n, `1.5703125`, angle);
    const float rest = @_mul_add(-n, `0.0004837512969970703`, first);
    const float taken = @_mul_add(n, `7.549533620476723e-8`, -tail);
    const float r = rest - taken;
    const float left = @_mul_add(n, `7.549533620476723e-8`, -taken) - tail;
    const float error = ((rest - r) - taken) - left;
    const float low = @_mul_add(-n, `2.5633440682570896e-12`, error);

    const float x = r * r;
    const float xx = x * x;
    const float s01 = @_mul_add(x, `0.00833215490589`, `-0.166666545188`);
    const float s = @_mul_add(`-0.000195144732882`, xx, s01);
    const float c01 = @_mul_add(x, `-0.00138873083093`, `0.0416666455231`);
    const float c = @_mul_add(`2.44322318044e-5`, xx, c01);

    const float halved = 0.5F * x;
    const float rounded = 1.0F - halved;
    const float small = @_mul_add(r * x, s, @_mul_add(-halved, low, low));
    const float tiny = @_mul_add(x * x, c, ((1.0F - rounded) - halved) - r * low);
    const float of_rest[2] = {r + small, rounded + tiny};

    uint32_t bits[2];
    uint32_t turns;
    memcpy(bits, of_rest, sizeof bits);
    memcpy(&turns, &quarters, sizeof turns);
    const uint32_t swapped = UINT32_C(0) - (turns & UINT32_C(1));
    const uint32_t sine_bits = ((bits[0] & ~swapped) | (bits[1] & swapped)) ^ ((turns & UINT32_C(2)) << 30);
    const uint32_t cosine_bits =
        ((bits[1] & ~swapped) | (bits[0] & swapped)) ^ (((turns + UINT32_C(1)) & UINT32_C(2)) << 30);
    memcpy(sine, &sine_bits, sizeof sine_bits);
    memcpy(cosine, &cosine_bits, sizeof cosine_bits);
}
