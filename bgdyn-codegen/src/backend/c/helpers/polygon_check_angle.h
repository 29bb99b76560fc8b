/* Refuses a planar loop where one of its angles is no number, or so large that its rounding opens the loop. */
static void @_polygon_check_angle(REAL angle, int cause, int *refused)
{
    const REAL kept = (`fabs`(angle) + CLOSING_STEP) - `fabs`(angle);
    @_polygon_check((kept > `0`) ? angle * angle : -CLOSING_STEP, cause, refused);
}
