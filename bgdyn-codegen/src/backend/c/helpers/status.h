/* Returns the number of a joint whose pivot is refused; -1 if a value is not finite; else 0. */
static inline int @_status(int refused, const REAL *values, int count)
{
    int status = refused;
    for (int i = 0; status == 0 && i < count; ++i) {
        if (!(`fabs`(values[i]) <= LARGEST)) {
            status = -1;
        }
    }
    return status;
}
