/* The root of a number, with the sign of the branch of the mechanism; refused where the number is negative. */
static REAL @_polygon_root(REAL square, int positive, int cause, int *refused)
{
    const REAL root = `sqrt`((square < `0`) ? `0` : square);
    @_polygon_check(square, cause, refused);
    return positive ? root : -root;
}
