/* The arc tangent of a small number. */
static REAL @_polygon_arc_tangent(REAL t)
{
    const REAL square = t * t;
    return t + t * square * (square * `0.2` - `0.3333333333333333`);
}
