/* Whether a number is positive; notes the cause of the first one that is not, or not finite. */
static int @_is_held(REAL value, int cause, int *refused)
{
    (void)@_checked_pivot(value, `0`, cause, refused);
    return value > `0`;
}
