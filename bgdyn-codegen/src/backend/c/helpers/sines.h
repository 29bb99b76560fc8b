/* Of an angle x by its square: cos x, sin x/x, (1 - cos x)/x^2, (x - sin x)/x^3; below 2 rad by series. */
static void @_sines(REAL square, REAL ratios[4])
{
    const REAL even[SERIES] = {EVEN};
    const REAL odd[SERIES] = {ODD};
    const int is_near = square < `4`;
    const REAL far = is_near ? `1` : square;
    const REAL angle = `sqrt`(far);
    REAL versine = `0`;
    REAL excess = `0`;
    REAL sine;
    REAL cosine;
    @_sin_cos(angle, &sine, &cosine);
    for (int k = SERIES - 1; k >= 0; --k) {
        versine = @_mul_add(versine, -square, even[k]);
        excess = @_mul_add(excess, -square, odd[k]);
    }
    ratios[0] = is_near ? `1` - square * versine : cosine;
    ratios[1] = is_near ? `1` - square * excess : sine / angle;
    ratios[2] = is_near ? versine : (`1` - cosine) / far;
    ratios[3] = is_near ? excess : (`1` - sine / angle) / far;
}
