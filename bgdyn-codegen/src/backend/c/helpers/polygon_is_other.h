/* Whether a sine or cosine has the sign of the other branch than that of the mechanism; not where it is too small to tell. */
static int @_polygon_is_other(REAL x, int positive)
{
    const REAL flat = CLOSING_STEP * FLAT_SINE;
    return positive ? x < -flat : flat < x;
}
