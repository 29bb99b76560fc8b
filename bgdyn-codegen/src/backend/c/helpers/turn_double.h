/* 64 binary digits of 1/(2 pi) after the first `start` ones behind the point; digits before the point are 0. */
static uint64_t @_inverse_tau_digits(int start)
{
    static const uint64_t words[21] = {
        UINT64_C(0x28be60db9391054a), UINT64_C(0x7f09d5f47d4d3770), UINT64_C(0x36d8a5664f10e410),
        UINT64_C(0x7f9458eaf7aef158), UINT64_C(0x6dc91b8e909374b8), UINT64_C(0x01924bba82746487),
        UINT64_C(0x3f877ac72c4a69cf), UINT64_C(0xba208d7d4baed121), UINT64_C(0x3a671c09ad17df90),
        UINT64_C(0x4e64758e60d4ce7d), UINT64_C(0x272117e2ef7e4a0e), UINT64_C(0xc7fe25fff7816603),
        UINT64_C(0xfbcbc462d6829b47), UINT64_C(0xdb4d9fb3c9f2c26d), UINT64_C(0xd3d18fd9a797fa8b),
        UINT64_C(0x5d49eeb1faf97c5e), UINT64_C(0xcf41ce7de294a4ba), UINT64_C(0x9afed7ec47e35742),
        UINT64_C(0x1580cc11bf1edaea), UINT64_C(0xfc33ef0826bd0d87), UINT64_C(0x6a78e45857b986c2)};
    /* of no number in `double` starts are below -1088 */
    const int word = (start + 1088) / 64 - 17;
    const int shift = (start + 1088) % 64;
    const uint64_t first = (word < 0 || word > 20) ? UINT64_C(0) : words[word];
    const uint64_t second = (word < -1 || word > 19) ? UINT64_C(0) : words[word + 1];
    return (shift == 0) ? first : (first << shift) | (second >> (64 - shift));
}

/* Adds x, without its whole turns, to a fraction of a turn with 320 binary digits, the highest word first: the digits of
   x times those of 1/(2 pi) that affect the result (Payne and Hanek). */
static void @_turn(double x, uint64_t turn[5])
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t biased = (bits >> 52) & UINT64_C(0x7ff);
    const uint64_t fraction = bits & UINT64_C(0xfffffffffffff);
    const uint64_t mantissa = (biased == 0) ? fraction : fraction | (UINT64_C(1) << 52);
    const int exponent = ((biased == 0) ? 1 : (int)biased) - 1075;
    const uint64_t mask = UINT64_C(0xffffffff);
    /* a negative angle is subtracted: its complement and one are added */
    const uint64_t sign = (x < 0.0) ? ~UINT64_C(0) : UINT64_C(0);
    uint64_t of_product = 0;
    uint64_t of_sum = sign & 1U;
    for (int i = 4; i >= 0; --i) {
        const uint64_t digits = @_inverse_tau_digits(exponent + 64 * i);
        const uint64_t lower = (digits & mask) * (mantissa & mask);
        const uint64_t mixed = (digits >> 32) * (mantissa & mask);
        const uint64_t middle = (lower >> 32) + (mixed & mask) + (digits & mask) * (mantissa >> 32);
        const uint64_t low = ((middle << 32) | (lower & mask)) + of_product;
        const uint64_t high = (digits >> 32) * (mantissa >> 32) + (mixed >> 32) + (middle >> 32);
        of_product = high + ((low < of_product) ? 1U : 0U);
        const uint64_t sum = turn[i] + (low ^ sign);
        const uint64_t carried = sum + of_sum;
        of_sum = (sum < turn[i] || carried < sum) ? 1U : 0U;
        turn[i] = carried;
    }
}

/* A whole number below 2^53. */
static double @_whole(uint64_t x)
{
    return (double)(uint32_t)(x >> 32) * 4294967296.0 + (double)(uint32_t)(x & UINT64_C(0xffffffff));
}

/* A fraction of a turn of at most an eighth, in radians in two words. */
static void @_radians_of_turn(const uint64_t turn[5], double *radians, double *rest)
{
    int first = 0;
    while (first < 5 && turn[first] == 0) {
        ++first;
    }
    *radians = 0.0;
    *rest = 0.0;
    if (first == 5) {
        return;
    }
    const uint64_t second = (first < 4) ? turn[first + 1] : UINT64_C(0);
    const uint64_t third = (first < 3) ? turn[first + 2] : UINT64_C(0);
    int zeros = 0;
    while (((turn[first] << zeros) >> 63) == 0) {
        ++zeros;
    }
    /* 128 digits without leading zeros: 53 of them, and the others, rounded once */
    const uint64_t high = (zeros == 0) ? turn[first] : (turn[first] << zeros) | (second >> (64 - zeros));
    const uint64_t low = (zeros == 0) ? second : (second << zeros) | (third >> (64 - zeros));
    const double upper = @_whole(high >> 11) / 9007199254740992.0;
    const uint64_t next = ((high & UINT64_C(0x7ff)) << 11) | (low >> 53);
    const double after = @_whole(next) * 9007199254740992.0 + @_whole(low & UINT64_C(0x1fffffffffffff));
    const double lower = after / 9007199254740992.0 / 37778931862957161709568.0;
    const uint64_t unit_bits = (uint64_t)(1023 - 64 * first - zeros) << 52;
    double unit;
    memcpy(&unit, &unit_bits, sizeof unit);
    double a = upper;
    double tail = 0.0;
    @_add_angle(&a, &tail, lower);
    a = a * unit;
    tail = tail * unit;
    /* times 2 pi in two words, with Dekker's product */
    const double tau = 6.283185307179586;
    const double tau_tail = 2.4492935982947064e-16;
    const double product = a * tau;
    const double a_scaled = 134217729.0 * a;
    const double a_upper = a_scaled - (a_scaled - a);
    const double a_lower = a - a_upper;
    const double tau_scaled = 134217729.0 * tau;
    const double tau_upper = tau_scaled - (tau_scaled - tau);
    const double tau_lower = tau - tau_upper;
    const double error =
        ((a_upper * tau_upper - product) + a_upper * tau_lower + a_lower * tau_upper) + a_lower * tau_lower;
    const double left = error + (a * tau_tail + (tail * tau + tail * tau_tail));
    *radians = product + left;
    *rest = left - (*radians - product);
}
