/* x = -J'(J J' + m 1)^-1 c, the shortest of the x with the least |c + J x|^2 + m |x|^2: by L D L'. m is damping times the
   largest diagonal entry of J J', or damping. */
static void @_shortest_step(const REAL jacobian[SIZE_NC * SIZE_NT], const REAL residual[SIZE_NC], REAL damping,
                            REAL x[SIZE_NT])
{
    REAL a[SIZE_NC][SIZE_NC];
    REAL y[SIZE_NC];
    REAL largest = `0`;
    for (int i = 0; i < SIZE_NC; ++i) {
        for (int j = 0; j < SIZE_NC; ++j) {
            a[i][j] = `0`;
            for (int k = 0; k < SIZE_NT; ++k) {
                a[i][j] = @_mul_add(jacobian[i * SIZE_NT + k], jacobian[j * SIZE_NT + k], a[i][j]);
            }
        }
        y[i] = residual[i];
        largest = @_larger(largest, a[i][i]);
    }
    largest = (largest > `0`) ? largest : `1`;
    for (int i = 0; i < SIZE_NC; ++i) {
        a[i][i] = a[i][i] + damping * largest;
    }
    for (int k = 0; k < SIZE_NC; ++k) {
        for (int i = k + 1; i < SIZE_NC; ++i) {
            const REAL factor = a[i][k] / a[k][k];
            for (int j = k + 1; j < SIZE_NC; ++j) {
                a[i][j] = a[i][j] - factor * a[k][j];
            }
            y[i] = y[i] - factor * y[k];
        }
    }
    for (int k = SIZE_NC - 1; k >= 0; --k) {
        for (int j = k + 1; j < SIZE_NC; ++j) {
            y[k] = y[k] - a[k][j] * y[j];
        }
        y[k] = y[k] / a[k][k];
    }
    for (int k = 0; k < SIZE_NT; ++k) {
        REAL sum = `0`;
        for (int i = 0; i < SIZE_NC; ++i) {
            sum = sum + jacobian[i * SIZE_NT + k] * y[i];
        }
        x[k] = -sum;
    }
}
