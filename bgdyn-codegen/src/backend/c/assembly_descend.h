static void @_descend(DECLARED REAL q[SIZE_NQ], int steps, const int is_free[SIZE_NT])
{
    const int is_condition[SIZE_NC] = {CONDITIONS};
    REAL jacobian[SIZE_NC * SIZE_NT];
    REAL residual[SIZE_NC];
    REAL found[SIZE_NC];
    REAL x[SIZE_NT];
    REAL next[SIZE_NQ];
    REAL damping = DAMPING_AT_FIRST;
    @_constraint_residual(GIVEN q, residual);
    for (int step = 0; step < steps; ++step) {
        REAL worst = `0`;
        REAL largest = `0`;
        REAL before = `0`;
        REAL after = `0`;
        @_constraint_jacobian(GIVEN q, jacobian);
        for (int i = 0; i < SIZE_NC; ++i) {
            residual[i] = is_condition[i] ? residual[i] : `0`;
            worst = @_larger(worst, `fabs`(residual[i]));
            before = before + residual[i] * residual[i];
            for (int j = 0; j < SIZE_NT; ++j) {
                jacobian[i * SIZE_NT + j] = (is_condition[i] && is_free[j]) ? jacobian[i * SIZE_NT + j] : `0`;
            }
        }
        @_shortest_step(jacobian, residual, damping, x);
        for (int j = 0; j < SIZE_NT; ++j) {
            largest = @_larger(largest, `fabs`(x[j]));
        }
        const REAL scale = (LONGEST_STEP < largest) ? LONGEST_STEP / largest : `1`;
        for (int j = 0; j < SIZE_NT; ++j) {
            x[j] = x[j] * scale;
        }
        @_moved(q, x, next);
        @_constraint_residual(GIVEN next, found);
        for (int i = 0; i < SIZE_NC; ++i) {
            found[i] = is_condition[i] ? found[i] : `0`;
            after = after + found[i] * found[i];
        }
        if (after < before) {
            memcpy(q, next, sizeof next);
            memcpy(residual, found, sizeof found);
            damping = @_larger(damping * DAMPING_AFTER_SUCCESS, LEAST_DAMPING);
        } else {
            damping = damping * DAMPING_AFTER_FAILURE;
        }
        if (worst < WITHIN) {
            return;
        }
    }
}
