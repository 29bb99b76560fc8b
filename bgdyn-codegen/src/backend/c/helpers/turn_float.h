/* 64 binary digits of 1/(2 pi) after the first `start` ones behind the point; digits before the point are 0. */
static uint64_t @_inverse_tau_digits(int start)
{
    const uint64_t words[4] = {UINT64_C(0x28be60db9391054a), UINT64_C(0x7f09d5f47d4d3770), UINT64_C(0x36d8a5664f10e410),
                               UINT64_C(0x7f9458eaf7aef158)};
    if (start < 0) {
        return (start > -64) ? words[0] >> -start : UINT64_C(0);
    }
    const int word = start / 64;
    const int shift = start % 64;
    return (shift == 0) ? words[word] : (words[word] << shift) | (words[word + 1] >> (64 - shift));
}

/* The finite angle x without its whole turns, in units of 2^-64 turns: its digits times those of 1/(2 pi) that affect
   the result (Payne and Hanek). */
static uint64_t @_turn(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t mantissa = (bits & UINT32_C(0x7fffff)) | UINT32_C(0x800000);
    const int exponent = (int)((bits >> 23) & UINT32_C(0xff)) - 150;
    const uint64_t next = @_inverse_tau_digits(exponent + 64);
    const uint64_t carried = (next >> 32) * mantissa + (((next & UINT64_C(0xffffffff)) * mantissa) >> 32);
    const uint64_t turn = @_inverse_tau_digits(exponent) * mantissa + (carried >> 32);
    return (x < 0.0F) ? UINT64_C(0) - turn : turn;
}
