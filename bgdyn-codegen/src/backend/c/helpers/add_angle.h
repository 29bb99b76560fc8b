/* Adds an angle to a sum; the tail is the sum of the rounding errors (Knuth's two-sum). */
static inline void @_add_angle(REAL *sum, REAL *tail, REAL angle)
{
    const REAL next = *sum + angle;
    const REAL back = next - *sum;
    const REAL left = (angle - back) + *tail;
    *tail = (*sum - (next - back)) + left;
    *sum = next;
}
