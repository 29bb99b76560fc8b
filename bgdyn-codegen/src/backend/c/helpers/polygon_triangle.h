/* Three pins, with rigid arms of the lengths a and b from the ends of the known vector D to the third pin:
   2H = root[((a + b)^2 - D D)(D D - (a - b)^2)], first arm ((D D + a^2 - b^2) D + 2H D rotated)/(2 D D), second arm less D.
   Both arms on the branch of the mechanism and on the other one. */
static void @_polygon_triangle(const REAL known[2], REAL outer, REAL inner, REAL difference, int positive, int cause,
                               int *refused, REAL found[2][2][2])
{
    const REAL squared = known[0] * known[0] + known[1] * known[1];
    const REAL root = @_polygon_root((outer - squared) * (squared - inner), positive, cause, refused);
    const REAL half = `0.5` / squared;
    const REAL along = (squared + difference) * half;
    const REAL across[2] = {root * half, -(root * half)};
    for (int k = 0; k < 2; ++k) {
        found[k][0][0] = known[0] * along - known[1] * across[k];
        found[k][0][1] = known[1] * along + known[0] * across[k];
        found[k][1][0] = found[k][0][0] - known[0];
        found[k][1][1] = found[k][0][1] - known[1];
    }
}
