/* x/sin x of the angle x in 0 ... pi/2 with this square of the sine and this cosine: four halvings, then the series of
   the arc tangent. */
static REAL @_arc_ratio(REAL square, REAL cosine)
{
    const REAL reciprocals[TERMS] = {RECIPROCALS};
    REAL last = cosine;
    REAL product = `1`;
    REAL series = `0`;
    for (int k = 0; k < 4; ++k) {
        last = `sqrt`(`0.5` * (`1` + last));
        product = product * last;
    }
    const REAL share = `1` / (product * last);
    const REAL tangent = `0.0625` * share;
    const REAL minus = -(square * (tangent * tangent));
    for (int k = TERMS - 1; k >= 0; --k) {
        series = @_mul_add(series, minus, reciprocals[k]);
    }
    return share * series;
}
