/* A small angle from one vector to another. */
static REAL @_polygon_small_turn(const REAL from[2], const REAL to[2])
{
    return @_polygon_arc_tangent((from[0] * to[1] - from[1] * to[0]) / (from[0] * to[0] + from[1] * to[1]));
}
