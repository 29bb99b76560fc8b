/* Two pins and a slide opposite the known vector D, with the distances of the pins "start" along the slide at displacement
   zero and e across it: y = root(D D - e^2), direction (D y - D rotated e)/(D D), displacement y - start. Direction and
   displacement on the branch of the mechanism and on the other one. */
static void @_polygon_cylinder(const REAL known[2], REAL start, REAL across, int positive, int cause, int *refused,
                               REAL found[2][1][2], REAL slides[2])
{
    const REAL squared = known[0] * known[0] + known[1] * known[1];
    const REAL root = @_polygon_root(squared - across * across, positive, cause, refused);
    const REAL inverse = `1` / squared;
    const REAL roots[2] = {root, -root};
    for (int k = 0; k < 2; ++k) {
        found[k][0][0] = (known[0] * roots[k] + known[1] * across) * inverse;
        found[k][0][1] = (known[1] * roots[k] - known[0] * across) * inverse;
        slides[k] = roots[k] - start;
    }
}
