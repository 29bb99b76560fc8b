/* The twist in the link axes at q0 from q0 to q1. With half the angle h of the turn, its vector p, and
   e = (1 - h/tan h)/4h^2 the linear part is d - 1/2 p x d + e p x (p x d). */
static void @_floating_difference(const REAL q1[7], const REAL q0[7], REAL result[6])
{
    const REAL back[4] = {-q0[3], -q0[4], -q0[5], q0[6]};
    REAL turn[4];
    REAL way[3];
    REAL path[3];
    REAL ratios[4];
    REAL once[3];
    REAL twice[3];
    @_quaternion_product(back, &q1[3], turn);
    const REAL square = @_quaternion_logarithm(turn, &result[3]);
    for (int k = 0; k < 3; ++k) {
        way[k] = q1[k] - q0[k];
    }
    @_quaternion_turn(back, way, path);
    @_sines(square, ratios);
    const REAL e = `0.25` * (ratios[2] - ratios[3]) / ratios[1];
    @_cross(&result[3], path, once);
    @_cross(&result[3], once, twice);
    for (int k = 0; k < 3; ++k) {
        result[k] = path[k] + (`-0.5` * once[k] + e * twice[k]);
    }
}
