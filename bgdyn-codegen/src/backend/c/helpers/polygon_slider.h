/* Two pins and a slide in the direction t beside the known vector D: e = t x D, y = root(a^2 - e^2), arm y t + e t rotated,
   displacement y - D t. Arm and displacement on the branch of the mechanism and on the other one. */
static void @_polygon_slider(const REAL known[2], const REAL along[2], REAL square_of_arm, int positive, int cause,
                             int *refused, REAL found[2][1][2], REAL slides[2])
{
    const REAL off = along[0] * known[1] - along[1] * known[0];
    const REAL start = known[0] * along[0] + known[1] * along[1];
    const REAL root = @_polygon_root(square_of_arm - off * off, positive, cause, refused);
    const REAL roots[2] = {root, -root};
    for (int k = 0; k < 2; ++k) {
        found[k][0][0] = along[0] * roots[k] - along[1] * off;
        found[k][0][1] = along[1] * roots[k] + along[0] * off;
        slides[k] = roots[k] - start;
    }
}
