int @_assemble(DECLARED const REAL guess[SIZE_NQ], const int is_free[SIZE_NT], REAL result[SIZE_NQ])
{
    REAL found[SIZE_NQ];
    int refused = 0;
    memcpy(found, guess, sizeof found);
    @_descend(GIVEN found, FIRST_STEPS, is_free);
    (void)@_is_assembled(GIVEN found, &refused);
    memcpy(result, found, sizeof found);
    return @_status(refused, found, SIZE_NQ);
}
