int @_assemble(DECLARED const REAL guess[SIZE_NQ], const int is_free[SIZE_NT], REAL result[SIZE_NQ])
{
    const REAL start[SIZE_NQ] = {START};
    const int joints[JOINT_COUNT][2] = {JOINTS};
    const REAL shares[2] = {SHARES};
    const int steps[2] = {STEPS};
    REAL found[SIZE_NQ];
    int refused = 0;
    memcpy(found, guess, sizeof found);
    @_descend(GIVEN found, FIRST_STEPS, is_free);
    int fits = @_is_assembled(GIVEN found, &refused);
    for (int k = 0; k < 2 && !fits; ++k) {
        REAL other[SIZE_NQ];
        int cause = 0;
        memcpy(other, guess, sizeof other);
        for (int i = 0; i < JOINT_COUNT; ++i) {
            const int p = joints[i][1];
            if (is_free[joints[i][0]]) {
                other[p] = other[p] + (start[p] - other[p]) * shares[k];
            }
        }
        @_descend(GIVEN other, steps[k], is_free);
        fits = @_is_assembled(GIVEN other, &cause);
        if (fits) {
            memcpy(found, other, sizeof found);
            refused = cause;
        }
    }
    memcpy(result, found, sizeof found);
    return @_status(refused, found, SIZE_NQ);
}
