"""The plot: error of each run over its time for a simulated second, or over its step where times were not measured."""

import math

# Colours that colour-blind readers can tell apart (Okabe, Ito 2008).
COLOURS = {"bgdyn": "#D55E00", "Pinocchio": "#0072B2", "MuJoCo": "#009E73", "Drake": "#CC79A7"}
# On a dark ground.
DARK_COLOURS = {
    "fill": {"#222": "#c4c4c4", "white": "#161616"},
    "stroke": {"#ddd": "#383838"},
    "both": {"#D55E00": "#dc6410", "#0072B2": "#3793d6", "#009E73": "#16a479", "#CC79A7": "#cc79a7"},
}
DARK = (
    "<style>@media (prefers-color-scheme: dark){svg:not([fill]){fill:#f5f5f5}"
    + "".join(
        f'[{attribute}="{light}"]{{{attribute}:{dark}}}'
        for attribute in ("fill", "stroke")
        for light, dark in {**DARK_COLOURS[attribute], **DARK_COLOURS["both"]}.items()
    )
    + "}</style>"
)
TITLES = {"parallelograms": "Two parallelograms: error, m", "five_bar": "Five-bar: error, rad"}
WIDTH, HEIGHT, LEFT, TOP, GAP = 330, 260, 60, 70, 80


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def svg(rows):
    timed = any(r.get("seconds") for r in rows)
    along = lambda r: r["seconds"] if timed else r["step"]
    total = LEFT + 2 * WIDTH + GAP + 20
    text = lambda x, y, what, more="": f'<text x="{x:.1f}" y="{y:.1f}" {more}>{what}</text>'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {TOP + HEIGHT + 50}" '
        'font-family="sans-serif" font-size="11" fill="#222">',
        DARK,
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for i, (system, colour) in enumerate(COLOURS.items()):
        lines.append(f'<circle cx="{LEFT + 100 * i}" cy="20" r="4" fill="{colour}"/>')
        lines.append(text(LEFT + 100 * i + 8, 24, system))
    for k, (name, title) in enumerate(TITLES.items()):
        some = [r for r in rows if r["mechanism"] == name and r.get("error")]
        left = LEFT + k * (WIDTH + GAP)
        (x0, x1), (y0, y1) = decades([along(r) for r in some]), decades([r["error"] for r in some])
        margin = 0 if timed else 24
        x = lambda v: left + margin + (WIDTH - 2 * margin) * (math.log10(v) - x0) / (x1 - x0)
        y = lambda v: TOP + HEIGHT * (y1 - math.log10(v)) / (y1 - y0)
        lines.append(text(left, TOP - 18, title, 'font-size="13"'))
        for decade in range(x0, x1 + 1):
            at = x(10.0**decade)
            lines.append(f'<line x1="{at:.1f}" x2="{at:.1f}" y1="{TOP}" y2="{TOP + HEIGHT}" stroke="#ddd"/>')
            lines.append(text(at, TOP + HEIGHT + 15, f"1e{decade}", 'text-anchor="middle"'))
        for decade in range(y0, y1 + 1, 1 if y1 - y0 < 9 else 2):
            at = y(10.0**decade)
            lines.append(f'<line x1="{left}" x2="{left + WIDTH}" y1="{at:.1f}" y2="{at:.1f}" stroke="#ddd"/>')
            lines.append(text(left - 6, at + 4, f"1e{decade}", 'text-anchor="end"'))
        lines.append(text(left + WIDTH / 2, TOP + HEIGHT + 33, "time for a simulated second, s" if timed else "step, s", 'text-anchor="middle"'))
        for r in some:
            # Hollow where Python takes part in each step.
            colour = COLOURS[r["system"]]
            fill = f'fill="white" stroke="{colour}" stroke-width="1.5"' if timed and "Python" in r["inside"] else f'fill="{colour}"'
            # Over the step, systems stand side by side.
            beside = 0 if timed else 9 * (list(COLOURS).index(r["system"]) - 1.5)
            lines.append(f'<circle cx="{x(along(r)) + beside:.1f}" cy="{y(r["error"]):.1f}" r="4" {fill}/>')
    if timed:
        lines.append(text(LEFT + 410, 24, "hollow: with Python in each step"))
    lines.append("</svg>")
    return "\n".join(lines) + "\n"
