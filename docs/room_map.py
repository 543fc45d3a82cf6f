"""The map of the program: rooms as boxes on floors, with an arrow from each to what it includes, as SVG."""

import html

GROUND, FIELD, EDGE, TEXT, QUIET, ARROW = "#1d2027", "#14161b", "#333843", "#e6e9ef", "#9aa3b2", "#6f7a8c"
TINTS = {"app": "#56b4e9", "core": "#e69f00"}
WIDTH, MARGIN, GAP, LANE = 1000, 40, 28, 34  # pixels; a lane is where an arrow passes a floor
BOX, FLOOR, TOP, BETWEEN = 44, 76, 44, 44  # heights: of a box, from floor to floor, above each part, between the parts


def drawn_arrows(floors, arrows):
    """Those that no way over other rooms implies."""
    below, kept = {}, []
    for room in (name for floor in reversed(floors) for name, _ in floor):
        straight = {there for here, there in arrows if here == room}
        below[room] = straight.union(*(below[there] for there in straight))
        implied = set().union(*(below[there] for there in straight))
        kept += [(room, there) for there in sorted(straight - implied)]
    return kept


def with_lanes(floors, arrows):
    """Each floor's rooms and lanes, and the pieces of arrows from floor to floor. Arrows to one room share a lane: a
    lane is (floor, room that it leads to)."""
    level = {name: k for k, floor in enumerate(floors) for name, _ in floor}
    rows = [[name for name, _ in floor] for floor in floors]
    pieces = set()
    for here, there in arrows:
        last = here
        for k in range(level[here] + 1, level[there]):
            if (k, there) not in rows[k]:
                rows[k].append((k, there))
            pieces.add((last, (k, there)))
            last = (k, there)
        pieces.add((last, there))
    return rows, sorted(pieces, key=str)


def widths_of(rows, words):
    """Rooms are as wide as their words."""
    return {item: LANE if isinstance(item, tuple) else max(8.4 * len(item), 6.3 * len(words[item])) + 40
            for row in rows for item in row}


def side_by_side(row, widths, wished, weights):
    """Where the row's items have their middles: as near to those wished as keeping the gaps between them allows."""
    offsets, at = [], 0
    for item in row:
        at += widths[item] / 2
        offsets.append(at)
        at += widths[item] / 2 + GAP
    blocks = []  # items that touch: how many, their place without offsets, their weight
    for item, offset in zip(row, offsets):
        blocks.append([1, wished[item] - offset, weights[item]])
        while len(blocks) > 1 and blocks[-2][1] > blocks[-1][1]:
            count, place, weight = blocks.pop()
            last = blocks[-1]
            last[1] = (last[1] * last[2] + place * weight) / (last[2] + weight)
            last[0], last[2] = last[0] + count, last[2] + weight
    places = [place for count, place, _ in blocks for _ in range(count)]
    least, most = MARGIN, WIDTH - MARGIN - (at - GAP)
    return {item: min(max(place, least), most) + offset for item, place, offset in zip(row, places, offsets)}


def straightened(rows, words, pieces):
    """The middle of everything: rooms lean to the middle of the picture, and lanes run straight."""
    widths = widths_of(rows, words)
    middle = {item: x for row in rows
              for item, x in side_by_side(row, widths, dict.fromkeys(row, WIDTH / 2), dict.fromkeys(row, 1)).items()}
    beside = {item: [] for item in widths}
    for a, b in pieces:
        beside[a].append(b)
        beside[b].append(a)
    weights = {item: 4 if isinstance(item, tuple) else 1 for item in widths}
    for _ in range(200):
        for row in rows:
            wished = {}
            for item in row:
                lane = isinstance(item, tuple)
                # A lane follows the lane below it, so that it runs straight; at its end it follows what it leads to.
                pulls = [middle[other] for other in beside[item] if not lane or isinstance(other, tuple)]
                pulls = pulls or [middle[other] for other in beside[item]]
                wished[item] = sum(pulls + ([] if lane else 2 * [WIDTH / 2])) / (len(pulls) + (0 if lane else 2))
            middle.update(side_by_side(row, widths, wished, weights))
    return {item: (middle[item] - widths[item] / 2, widths[item]) for item in widths}


def centered(rows, words):
    """The left edge and the width of everything, each floor in the middle."""
    widths = widths_of(rows, words)
    out = {}
    for row in rows:
        x = (WIDTH - sum(widths[item] for item in row) - GAP * (len(row) - 1)) / 2
        for item in row:
            out[item] = (x, widths[item])
            x += widths[item] + GAP
    return out


def length(rows, words, pieces):
    """How far the pieces of arrows lean, the measure of an order of the rows."""
    at = centered(rows, words)
    return sum(abs(at[a][0] + at[a][1] / 2 - at[b][0] - at[b][1] / 2) for a, b in pieces)


def in_order(rows, words, pieces):
    """The rows with their items swapped while that makes arrows straighter."""
    best, better = length(rows, words, pieces), True
    while better:
        better = False
        for row in rows:
            for i in range(len(row)):
                for k in range(i + 1, len(row)):
                    row[i], row[k] = row[k], row[i]
                    now = length(rows, words, pieces)
                    if now < best - 1e-6:
                        best, better = now, True
                    else:
                        row[i], row[k] = row[k], row[i]
    return rows


def text(x, y, what, color, size, weight=400, anchor="middle"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" font-size="{size}" font-weight="{weight}" '
            f'text-anchor="{anchor}">{html.escape(what)}</text>')


def draw(floors, arrows, core):
    """Floors of (room, words), top to bottom, those of core/ from number `core` on; arrows (room, room), all down."""
    words = {name: says for floor in floors for name, says in floor}
    rows, pieces = with_lanes(floors, drawn_arrows(floors, arrows))
    rows = in_order(rows, words, pieces)
    at = straightened(rows, words, pieces)
    top = {item: TOP + 20 + k * FLOOR + (BETWEEN if k >= core else 0) for k, row in enumerate(rows) for item in row}
    height = TOP + len(rows) * FLOOR + BETWEEN + 10

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
           'font-family="DejaVu Sans, Segoe UI, Helvetica, Arial, sans-serif" role="img">',
           "<title>The rooms of the program, and what each includes: arrows point down</title>",
           '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
           'orient="auto">'
           f'<path d="M0 1 L9 5 L0 9 z" fill="{ARROW}"/></marker></defs>',
           f'<rect width="{WIDTH}" height="{height}" rx="10" fill="{GROUND}"/>']
    for part, first, last in (("app", 0, core), ("core", core, len(rows))):
        y = TOP - 24 + first * FLOOR + (BETWEEN if first else 0)
        out.append(f'<rect x="16" y="{y}" width="{WIDTH - 32}" height="{(last - first) * FLOOR + 20}" rx="8" '
                   f'fill="none" stroke="{TINTS[part]}" stroke-opacity="0.35"/>')
        out.append(text(34, y + 30, part + "/", TINTS[part], 19, 600, "start"))
    for a, b in pieces:
        xa, xb = at[a][0] + at[a][1] / 2, at[b][0] + at[b][1] / 2
        ya, yb = top[a] + BOX, top[b] - (0 if isinstance(b, tuple) else 2)
        bend = (yb - ya) * 0.6
        tip = "" if isinstance(b, tuple) else ' marker-end="url(#tip)"'
        out.append(f'<path d="M{xa:.1f} {ya} C{xa:.1f} {ya + bend:.1f} {xb:.1f} {yb - bend:.1f} {xb:.1f} {yb}" '
                   f'fill="none" stroke="{ARROW}" stroke-width="1.6"{tip}/>')
    for k, row in enumerate(rows):
        part = "core" if k >= core else "app"
        for item in row:
            x, wide = at[item]
            if isinstance(item, tuple):
                middle = x + wide / 2
                out.append(f'<path d="M{middle:.1f} {top[item]} V{top[item] + BOX}" stroke="{ARROW}" '
                           'stroke-width="1.6"/>')
                continue
            out.append(f'<rect x="{x:.1f}" y="{top[item]}" width="{wide:.1f}" height="{BOX}" rx="6" fill="{FIELD}" '
                       f'stroke="{TINTS[part]}" stroke-opacity="0.7"/>')
            out.append(text(x + wide / 2, top[item] + 18, item, TEXT, 14, 600))
            out.append(text(x + wide / 2, top[item] + 35, words[item], QUIET, 11.5))
    return "\n".join(out) + "\n</svg>\n"
