"""Labels beside points, none over another or over a point."""
from matplotlib.text import Text

from figure import BLACK

# Where a label may stand, from its point: directions, and how far in points of print.
WAYS = ((1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1))
FAR = (5, 10, 16, 24, 34, 46)
SIDES = {1: "left", 0: "center", -1: "right"}
HEIGHTS = {1: "bottom", 0: "center", -1: "top"}


def overlap(a, b):
    """Of two boxes (left, bottom, right, top): the area."""
    return max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1]))


def outside(a, frame):
    return (a[2] - a[0]) * (a[3] - a[1]) - overlap(a, frame)


def place_labels(axes, labels, obstacles, size=7):
    """Writes each (x, y, text) where it covers least of what is there: the obstacles, which are points, and the labels
    before it; within the axes. To be called when the layout is settled."""
    figure = axes.figure
    renderer, dot = figure.canvas.get_renderer(), figure.dpi / 72
    at = axes.transData.transform
    taken = []
    for x, y in obstacles:
        px, py = at((x, y))
        taken.append((px - 3 * dot, py - 3 * dot, px + 3 * dot, py + 3 * dot))
    frame = axes.get_window_extent(renderer).extents
    for x, y, text in labels:
        best, least = None, None
        for far in FAR:
            for dx, dy in WAYS:
                label = axes.annotate(text, (x, y), (dx * far, dy * far), textcoords="offset points", fontsize=size,
                                      ha=SIDES[dx], va=HEIGHTS[dy], zorder=5,
                                      arrowprops=dict(arrowstyle="-", color=BLACK, linewidth=0.4, shrinkA=0, shrinkB=2)
                                      if far > FAR[1] else None)
                box = text_box(label, renderer)
                cost = sum(overlap(box, other) for other in taken) + outside(box, frame)
                if least is None or cost < least:
                    if best:
                        best[0].remove()
                    best, least = (label, box), cost
                else:
                    label.remove()
                if least == 0:
                    break
            if least == 0:
                break
        taken.append(tuple(best[1]))


def text_box(label, renderer):
    """Without the line that leads to it."""
    label.update_positions(renderer)
    return Text.get_window_extent(label, renderer).extents
