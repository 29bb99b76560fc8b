/* Whether the second one of two changes of positions is the shorter one. */
static int @_polygon_is_nearer(const REAL *own, const REAL *other, int count)
{
    REAL squares[2] = {`0`, `0`};
    for (int k = 0; k < count; ++k) {
        squares[0] = squares[0] + own[k] * own[k];
        squares[1] = squares[1] + other[k] * other[k];
    }
    return squares[1] < squares[0];
}
