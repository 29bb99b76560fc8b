"""The plot of results: for each robot and function, how many times as long as bgdyn each peer takes."""

import math

import page

OPERATIONS = {"inverse_dynamics": "inverse dynamics", "mass_matrix": "mass matrix", "forward_dynamics": "forward dynamics"}
# Colours that colour-blind readers can tell apart (Okabe, Ito 2008).
COLOURS = dict(zip(page.PEERS, ["#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9"]))
# The counterparts of all colours on a dark ground, as `bgdyn_accuracy::dark` makes them.
DARK_COLOURS = {
    "fill": {"#0072B2": "#3793d6", "#009E73": "#16a479", "#222": "#c4c4c4", "#56B4E9": "#56b4e9",
             "#CC79A7": "#cc79a7", "#D55E00": "#dc6410", "white": "#161616"},
    "stroke": {"#222": "#c4c4c4", "#ddd": "#383838", "#eee": "#292929"},
}
DARK = (
    "<style>@media (prefers-color-scheme: dark){svg:not([fill]){fill:#f5f5f5}"
    + "".join(f'[{a}="{c}"]{{{a}:{d}}}' for a, all_of in DARK_COLOURS.items() for c, d in all_of.items())
    + "}</style>"
)
TICKS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000]
LEFT, TOP, WIDTH, ROW, GAP = 190, 64, 560, 15, 9


def svg(results):
    robots = list(dict.fromkeys(r["robot"] for r in results))
    by_place = {(r["robot"], r["operation"]): r for r in results}
    ratios = [e["ratio"] for r in results for c in page.PEERS.values() if (e := page.entry(r, c))]
    most = next(t for t in TICKS if t >= 1.05 / min(ratios, default=0.1))
    least = min(1.0, 0.9 / max(ratios, default=1.0))
    x = lambda times: LEFT + WIDTH * (math.log(times / least) / math.log(most / least))
    height = TOP + len(robots) * (len(OPERATIONS) * ROW + GAP) + 34
    text = lambda at, y, what, more="": f'<text x="{at:.1f}" y="{y:.1f}" {more}>{what}</text>'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 20} {height}" '
        'font-family="sans-serif" font-size="11" fill="#222">',
        DARK,
        '<rect width="100%" height="100%" fill="white"/>',
        text(10, 18, "Times as long as bgdyn, one state a call, f64", 'font-size="14"'),
    ]
    for i, (peer, colour) in enumerate(COLOURS.items()):
        lines.append(f'<circle cx="{LEFT + 100 * i:.1f}" cy="36" r="4" fill="{colour}"/>')
        lines.append(text(LEFT + 100 * i + 8, 40, peer))
    bottom = height - 30
    for t in [t for t in TICKS if least <= t <= most]:
        stroke = 'stroke="#222"' if t == 1 else 'stroke="#ddd"'
        lines.append(f'<line x1="{x(t):.1f}" x2="{x(t):.1f}" y1="{TOP - 8}" y2="{bottom}" {stroke}/>')
        lines.append(text(x(t), bottom + 15, f"{t:g}×", 'text-anchor="middle"'))
    y = TOP
    for robot in robots:
        lines.append(text(10, y + ROW / 2 + 4, robot, 'font-weight="bold"'))
        for operation, title in OPERATIONS.items():
            middle = y + ROW / 2
            lines.append(text(LEFT - 12, middle + 4, title, 'text-anchor="end"'))
            lines.append(f'<line x1="{LEFT}" x2="{LEFT + WIDTH}" y1="{middle}" y2="{middle}" stroke="#eee"/>')
            result = by_place.get((robot, operation))
            for peer, columns in page.PEERS.items() if result else []:
                if found := page.entry(result, columns):
                    at = x(1 / found["ratio"])
                    lines.append(f'<circle cx="{at:.1f}" cy="{middle}" r="4" fill="{COLOURS[peer]}" fill-opacity="0.85"/>')
            y += ROW
        y += GAP
    return "\n".join([*lines, "</svg>", ""])
