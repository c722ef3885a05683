"""Labels beside points, none over another or over a point."""
import math

from matplotlib.text import Text

from figure import BLACK

# Where a label may stand, from its point: directions, and how far in points of print.
WAYS = ((1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1))
FAR = (5, 10, 16, 24, 34, 46, 60, 80)
SIDES = {1: "left", 0: "center", -1: "right"}
HEIGHTS = {1: "bottom", 0: "center", -1: "top"}


def overlap(a, b):
    """Of two boxes (left, bottom, right, top): the area."""
    return max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1]))


def outside(a, frame):
    return (a[2] - a[0]) * (a[3] - a[1]) - overlap(a, frame)


def distance(box, x, y):
    """From a box to a point."""
    return math.hypot(max(box[0] - x, 0, x - box[2]), max(box[1] - y, 0, y - box[3]))


def dot_at(x, y, half):
    return x - half, y - half, x + half, y + half


def place_labels(axes, labels, obstacles, size=7):
    """Writes each (x, y, text) where it covers least of what is there: the obstacles, which are points, and the labels
    before it with the lines that lead to them; within the axes. To be called when the layout is settled."""
    renderer = axes.figure.canvas.get_renderer()
    inch = axes.figure.dpi / 72
    taken = [dot_at(*axes.transData.transform(point), 3 * inch) for point in obstacles]
    frame = axes.get_window_extent(renderer).extents
    places = [tuple(axes.transData.transform((x, y))) for x, y, _ in labels]
    written = []
    for (x, y, text), (px, py) in zip(labels, places):
        best, least = None, None
        for far, (dx, dy) in ((far, way) for far in FAR for way in WAYS):
            leader = dict(arrowstyle="-", color=BLACK, linewidth=0.4, shrinkA=0, shrinkB=2,
                          relpos=((1 - dx) / 2, (1 - dy) / 2)) if far > FAR[0] else None
            label = axes.annotate(text, (x, y), (dx * far, dy * far), textcoords="offset points", fontsize=size,
                                  ha=SIDES[dx], va=HEIGHTS[dy], zorder=5, arrowprops=leader)
            box = text_box(label, renderer)
            along = [far * inch * i / 24 for i in range(4, 24)] if leader else []
            way = [dot_at(px + dx * step, py + dy * step, inch) for step in along]
            cost = sum(overlap(box, other) for other in taken) + outside(box, frame)
            cost += 100 * sum(overlap(part, other) for part in [box, *way] for other in written)
            if not leader:  # it would be read as another's
                cost += sum(100 for other in places if other != (px, py) and distance(box, *other) < 2 * FAR[0] * inch)
            if least is None or cost < least:
                if best:
                    best[0].remove()
                best, least = (label, box, way), cost
            else:
                label.remove()
            if least == 0:
                break
        taken += [tuple(best[1])] + best[2]
        written.append(tuple(best[1]))


def text_box(label, renderer):
    """Without the line that leads to it."""
    label.update_positions(renderer)
    return Text.get_window_extent(label, renderer).extents
