"""Plain SVG: lines, discs, words and plots over time, with a style for dark pages."""

import sys

DARK = {
    "#ffffff": "#161616",
    "#282828": "#bfbfbf",
    "#777777": "#838383",
    "#e3e3e3": "#333333",
    "#1d4f91": "#689de5",
    "#8a5a12": "#b38140",
    "#2e7d32": "#6fbf73",
    "#b3261e": "#e5786f",
    "#b9cde8": "#36475d",
}
INK, GREY, PALE = "#282828", "#777777", "#e3e3e3"
BLUE, BROWN, GREEN, RED, SHADE = "#1d4f91", "#8a5a12", "#2e7d32", "#b3261e", "#b9cde8"


class Canvas:
    """A drawing of a width and a height in pixels."""

    def __init__(self, width, height):
        self.size, self.parts = (width, height), []

    def line(self, points, colour, width=1.5, dash=None, opacity=1.0):
        """A line through points (x, y), thinned where they are closer than half a pixel."""
        kept = [points[0]]
        for p in points[1:-1]:
            if abs(p[0] - kept[-1][0]) + abs(p[1] - kept[-1][1]) > 0.7:
                kept.append(p)
        kept.append(points[-1])
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in kept)
        more = (f' stroke-dasharray="{dash}"' if dash else "") + (f' opacity="{opacity}"' if opacity < 1 else "")
        self.parts.append(
            f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="{width}"'
            f' stroke-linejoin="round" stroke-linecap="round"{more}/>'
        )

    def area(self, points, fill, stroke, opacity=1.0):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f'<polygon points="{text}" fill="{fill}" stroke="{stroke}" opacity="{opacity}"/>')

    def disc(self, p, radius, colour, opacity=1.0):
        self.parts.append(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius}" fill="{colour}" opacity="{opacity}"/>')

    def text(self, x, y, words, colour=INK, size=13, anchor="start", bold=False):
        weight = ' font-weight="bold"' if bold else ""
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}"{weight} fill="{colour}" text-anchor="{anchor}">{words}</text>'
        )

    def write(self, path):
        rules = "".join(
            f'[{kind}="{light}"]{{{kind}:{dark}}}' for light, dark in DARK.items() for kind in ("fill", "stroke")
        )
        (w, h), body = self.size, "\n".join(self.parts)
        path.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}"'
            f' font-family="sans-serif">\n<style>@media (prefers-color-scheme: dark){{{rules}}}</style>\n'
            f'<rect width="{w}" height="{h}" fill="#ffffff"/>\n{body}\n</svg>\n'
        )


class Plot:
    """Axes of a plot: `box` is left, top, right, bottom; `xs` and `ys` are ticks."""

    def __init__(self, canvas, box, xs, ys, title, unit="s"):
        self.canvas, self.box = canvas, box
        left, top, right, bottom = box
        self.x = lambda v: left + (v - xs[0]) / (xs[-1] - xs[0]) * (right - left)
        self.y = lambda v: bottom - (v - ys[0]) / (ys[-1] - ys[0]) * (bottom - top)
        canvas.text(left, top - 10, title, bold=True)
        for v in ys:
            canvas.line([(left, self.y(v)), (right, self.y(v))], PALE, 1)
            canvas.text(left - 6, self.y(v) + 4, f"{v:g}".replace("-", "−"), GREY, 12, "end")
        for v in xs:
            words = f"{v:g} {unit}" if v == xs[-1] else f"{v:g}"
            canvas.text(self.x(v), bottom + 17, words, GREY, 12, "middle")
        canvas.line([(left, bottom), (right, bottom)], GREY, 1)

    def curve(self, ts, vs, colour, width=1.8, dash=None):
        self.canvas.line([(self.x(t), self.y(v)) for t, v in zip(ts, vs)], colour, width, dash)


def fact(words):
    """Prints what was measured."""
    print(f"  {words}")


def write(page, path):
    """Writes a picture if the command line asks for pictures."""
    if "--draw" in sys.argv:
        page.write(path)
