/* A number with the sign of the determinant of these rows and columns, by Householder's reflections: the product of the
   lengths of the columns that are left, and of the signs of their first entries. */
static REAL @_block_determinant(const REAL jacobian[SIZE_NC * SIZE_NT], const int *rows, const int *columns, int count)
{
    REAL a[SIZE_NC][SIZE_NC];
    REAL v[SIZE_NC];
    REAL found = `1`;
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            a[i][j] = jacobian[rows[i] * SIZE_NT + columns[j]];
        }
    }
    for (int k = 0; k + 1 < count; ++k) {
        REAL square = `0`;
        for (int i = k; i < count; ++i) {
            square = square + a[i][k] * a[i][k];
            v[i] = a[i][k];
        }
        const REAL length = `sqrt`(square);
        const REAL sign = (a[k][k] < `0`) ? -`1` : `1`;
        const REAL half = length * (length + `fabs`(a[k][k]));
        found = found * sign * length;
        v[k] = v[k] + sign * length;
        for (int j = k + 1; j < count; ++j) {
            REAL along = `0`;
            for (int i = k; i < count; ++i) {
                along = along + v[i] * a[i][j];
            }
            for (int i = k; i < count; ++i) {
                a[i][j] = a[i][j] - v[i] * (along / half);
            }
        }
    }
    return found * a[count - 1][count - 1];
}
