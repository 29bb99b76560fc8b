/* Whether a number is positive; notes the cause of the first one that is not, or not finite. */
static int @_is_held(REAL value, int cause, int *refused)
{
    if (!(value > `0` && value <= LARGEST) && *refused == 0) {
        *refused = cause;
    }
    return value > `0`;
}
