/* sin x/x; below 2 rad by its series. */
static REAL @_sine_ratio(REAL x)
{
    const REAL odd[SERIES] = {ODD};
    const REAL square = x * x;
    const int is_near = square < `4`;
    const REAL far = is_near ? `1` : x;
    REAL series = `0`;
    REAL sine;
    REAL cosine;
    @_sin_cos(far, &sine, &cosine);
    for (int k = SERIES - 1; k >= 0; --k) {
        series = @_mul_add(series, -square, odd[k]);
    }
    return is_near ? `1` - square * series : sine / far;
}
