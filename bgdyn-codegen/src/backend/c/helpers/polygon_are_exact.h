/* Whether these angles are turns to rounding. */
static int @_polygon_are_exact(const REAL *turns, int count)
{
    REAL most = `0`;
    for (int k = 0; k < count; ++k) {
        most = @_larger(most, `fabs`(turns[k]));
    }
    return SHORT_TURN * `0.9` - most > `0`;
}
