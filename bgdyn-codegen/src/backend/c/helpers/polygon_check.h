/* Notes the cause of a planar loop where a number is negative, NaN or infinite, if it is the first one. */
static void @_polygon_check(REAL x, int cause, int *refused)
{
    if (!(x >= `0` && x <= LARGEST) && *refused == 0) {
        *refused = cause;
    }
}
