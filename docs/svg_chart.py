"""Line charts for pages that a script writes, as SVG: panels beside each other, sizes of the cloth along x."""

import dataclasses
import html
import math

GROUND, FIELD, GRID, TEXT, QUIET = "#1d2027", "#14161b", "#333843", "#e6e9ef", "#9aa3b2"
COLORS = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7"]
DASHES = ["", "9 5", "2 5", "12 4 2 4"]  # colors are not told apart by everybody
WIDTH, HEIGHT, EDGE, HEAD, FOOT = 480, 400, 56, 84, 96  # of a panel, pixels


@dataclasses.dataclass
class Panel:
    title: str
    unit: str
    lines: dict  # name: {x: y}
    logarithmic: bool = False
    mark: tuple = None  # a y that a line is drawn at, and what it is called


def ticks(low, high, logarithmic):
    """Round numbers from under the smallest to over the largest value."""
    if logarithmic:
        return [10.0 ** k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]
    step = 10.0 ** math.floor(math.log10(high / 2))
    step *= next(k for k in (1, 2, 5, 10) if high / (k * step) <= 6)
    return [step * k for k in range(math.ceil(high / step - 1e-9) + 1)]


def text(x, y, what, color=QUIET, size=14, anchor="start", weight=400):
    return (f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" font-size="{size}" font-weight="{weight}" '
            f'text-anchor="{anchor}">{html.escape(what)}</text>')


def line(points, color, width, dash=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"'
            + (f' stroke-dasharray="{dash}"' if dash else "") + "/>")


def draw(panel, left):
    """The panel's elements, its left edge at `left`."""
    values = [y for points in panel.lines.values() for y in points.values()] + ([panel.mark[0]] if panel.mark else [])
    xs = sorted({x for points in panel.lines.values() for x in points})
    marks = ticks(min(values), max(values), panel.logarithmic)
    lo, hi = left + EDGE, left + WIDTH - 24
    scale = math.log10 if panel.logarithmic else float

    def at_x(x):
        return lo + 16 + (hi - lo - 32) * xs.index(x) / max(len(xs) - 1, 1)

    def at_y(y):
        part = (scale(y) - scale(marks[0])) / (scale(marks[-1]) - scale(marks[0]))
        return HEIGHT - FOOT - part * (HEIGHT - FOOT - HEAD)

    out = [text(left + 16, 34, panel.title, TEXT, 17, weight=600), text(left + 16, 60, panel.unit),
           f'<rect x="{lo}" y="{HEAD}" width="{hi - lo}" height="{HEIGHT - FOOT - HEAD}" fill="{FIELD}"/>']
    for mark in marks:
        out.append(line([(lo, at_y(mark)), (hi, at_y(mark))], GRID, 1))
        out.append(text(lo - 8, at_y(mark) + 5, f"{mark:g}", anchor="end"))
    for x in xs:
        out.append(text(at_x(x), HEIGHT - FOOT + 22, str(x), anchor="middle"))
    out.append(text((lo + hi) / 2, HEIGHT - FOOT + 46, "particles along a side", anchor="middle"))
    if panel.mark:
        value, name = panel.mark
        out.append(line([(lo, at_y(value)), (hi, at_y(value))], QUIET, 1.5, "4 4"))
        out.append(text(hi - 8, at_y(value) - 7, name, anchor="end", size=13))
    key = left + 16
    for n, (name, points) in enumerate(panel.lines.items()):
        color, dash = COLORS[n % len(COLORS)], DASHES[n % len(DASHES)]
        places = [(at_x(x), at_y(y)) for x, y in sorted(points.items())]
        out.append(line(places, color, 3, dash))
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{color}"/>' for x, y in places]
        out.append(line([(key, HEIGHT - 22), (key + 34, HEIGHT - 22)], color, 3, dash))
        out.append(text(key + 42, HEIGHT - 17, name, TEXT))
        key += 42 + 8.2 * len(name) + 22
    return out


def svg(panels):
    """The picture's text."""
    width = WIDTH * len(panels)
    elements = [part for n, panel in enumerate(panels) for part in draw(panel, n * WIDTH)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT}" width="{width}" height="{HEIGHT}" '
            'font-family="Inter, DejaVu Sans, sans-serif">\n'
            f'<rect width="{width}" height="{HEIGHT}" fill="{GROUND}"/>\n' + "\n".join(elements) + "\n</svg>\n")
