/* Sine and cosine of a large angle, or of one with a large tail: reduced exactly, by integers. */
static void @_sin_cos_far(float angle, float tail, float *sine, float *cosine)
{
    float sum = angle;
    float left = 0.0F;
    @_add_angle(&sum, &left, tail);
    if (fabsf(sum) <= 1e4F) {
        @_sin_cos_near(sum, left, 1, sine, cosine);
    } else if (!(fabsf(sum) <= LARGEST)) {
        *sine = sum - sum;
        *cosine = sum - sum;
    } else {
        const uint64_t eighth = UINT64_C(1) << 61;
        const uint64_t shifted = @_turn(sum) + @_turn(left) + eighth;
        const uint64_t rest = (shifted & (2 * eighth - 1)) - eighth;
        const int negative = (rest >> 63) == 1;
        const uint64_t size = negative ? UINT64_C(0) - rest : rest;
        /* times 2 pi: in units of 2^-61 rad */
        const uint64_t mask = UINT64_C(0xffffffff);
        const uint64_t tau_high = UINT64_C(0xc90fdaa2);
        const uint64_t tau_low = UINT64_C(0x2168c234);
        const uint64_t middle = (size >> 32) * tau_low + (((size & mask) * tau_low) >> 32);
        const uint64_t cross = (size & mask) * tau_high + (middle & mask);
        uint64_t digits = (size >> 32) * tau_high + (middle >> 32) + (cross >> 32);
        /* 24 digits, and the next 24 */
        uint32_t zeros = 0;
        while (zeros < 64 && (digits >> 63) == 0) {
            digits <<= 1;
            ++zeros;
        }
        const uint32_t units[2] = {(UINT32_C(106) - zeros) << 23, (UINT32_C(82) - zeros) << 23};
        float unit[2];
        memcpy(unit, units, sizeof unit);
        const float r = (float)(uint32_t)(digits >> 40) * unit[0];
        const float low = (float)(uint32_t)((digits >> 16) & UINT64_C(0xffffff)) * unit[1];
        @_sin_cos_of_rest((uint32_t)(shifted >> 62), negative ? -r : r, negative ? -low : low, sine, cosine);
    }
}
