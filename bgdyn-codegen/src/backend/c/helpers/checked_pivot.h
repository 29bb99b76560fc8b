/* Returns a pivot; notes the number of its joint if it is the first one that is no more than rounding error, or -1 if
   it is not a number. */
static inline REAL @_checked_pivot(REAL value, REAL magnitude, int joint, int *refused)
{
    REAL least = magnitude * PIVOT_FLOOR;
    least = (least < `0`) ? `0` : least;
    if (!(value > least && value <= LARGEST) && *refused == 0) {
        *refused = (value <= `0` || value > `0`) ? joint : -1;
    }
    return value;
}
