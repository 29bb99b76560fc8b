/* Sine and cosine of a large angle, or of one with a large tail: reduced exactly, by integers. */
static void @_sin_cos_far(double angle, double tail, double *sine, double *cosine)
{
    double sum = angle;
    double left = 0.0;
    @_add_angle(&sum, &left, tail);
    if (fabs(sum) <= 1e5) {
        @_sin_cos_near(sum, left, 1, sine, cosine);
    } else if (!(fabs(sum) <= LARGEST)) {
        *sine = sum - sum;
        *cosine = sum - sum;
    } else {
        /* an eighth of a turn is added, and subtracted from what is left of the nearest quarter */
        uint64_t turn[5] = {UINT64_C(1) << 61, 0, 0, 0, 0};
        @_turn(sum, turn);
        @_turn(left, turn);
        const uint64_t quarter = turn[0] >> 62;
        turn[0] = (turn[0] & ((UINT64_C(1) << 62) - 1)) - (UINT64_C(1) << 61);
        const int negative = (turn[0] >> 63) == 1;
        uint64_t carry = 1;
        for (int i = 4; negative && i >= 0; --i) {
            turn[i] = ~turn[i] + carry;
            carry = (carry == 1 && turn[i] == 0) ? 1U : 0U;
        }
        double r;
        double low;
        @_radians_of_turn(turn, &r, &low);
        @_sin_cos_of_rest(quarter, negative ? -r : r, negative ? -low : low, sine, cosine);
    }
}
