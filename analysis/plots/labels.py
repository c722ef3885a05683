"""Labels beside points, none over another or over a point."""
import itertools
import math

import numpy
from matplotlib.text import Text

from figure import BLACK

# Where a label may stand, from its point: directions, and how far in points of print.
WAYS = ((1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1),
        (0.5, 1), (-0.5, 1), (0.5, -1), (-0.5, -1))
FAR = (5, 10, 16, 24, 34, 46, 60)
SIDES, HEIGHTS = {1: "left", -1: "right"}, {1: "bottom", -1: "top"}  # else centred


def overlap(some, others):
    """The area that boxes (left, bottom, right, top) have in common with others, summed."""
    a, b = numpy.asarray(some, float).reshape(-1, 1, 4), numpy.asarray(others, float).reshape(1, -1, 4)
    sides = numpy.minimum(a[..., 2:], b[..., 2:]) - numpy.maximum(a[..., :2], b[..., :2])
    return float(numpy.prod(sides.clip(0), axis=-1).sum())


def outside(box, frame):
    return (box[2] - box[0]) * (box[3] - box[1]) - overlap(box, frame)


def distance(box, point):
    return math.hypot(max(box[0] - point[0], 0, point[0] - box[2]), max(box[1] - point[1], 0, point[1] - box[3]))


def nearest(places, i):
    """How far the nearest of the others is."""
    return min((math.dist(places[i], other) for k, other in enumerate(places) if k != i), default=math.inf)


def dot_at(x, y, half):
    return x - half, y - half, x + half, y + half


def box_at(x, y, way, size):
    """Of a text whose side or corner towards its point is there."""
    (dx, dy), (width, height) = way, size
    left = x - width * (0 if dx == 1 else 1 if dx == -1 else 0.5)
    bottom = y - height * (0 if dy == 1 else 1 if dy == -1 else 0.5)
    return left, bottom, left + width, bottom + height


def text_box(label, renderer):
    """Of an annotation, without the line that leads to it."""
    label.update_positions(renderer)
    return Text.get_window_extent(label, renderer).extents


def place_labels(axes, labels, obstacles, size=7):
    """Writes each (x, y, text) where it covers least of what is there: the obstacles, which are points, and other
    labels with the lines that lead to them; within the axes. To be called when the layout is settled."""
    renderer = axes.figure.canvas.get_renderer()
    inch = axes.figure.dpi / 72
    frame = axes.get_window_extent(renderer).extents
    points = [dot_at(*axes.transData.transform(point), 3 * inch) for point in obstacles]
    places = [tuple(axes.transData.transform((x, y))) for x, y, _ in labels]
    written, lines = [], []

    def cost(i, far, box, line):
        """As an area: worst is to be unreadable, then to be taken for another's; a long line is a covered point."""
        total = 100 * (overlap([box, *line], written) + overlap(box, lines) + outside(box, frame))
        total += overlap(box, points) + 5 * overlap(line, lines) + 0.1 * overlap(line, points) + 3 * far * inch
        if not line:
            total += sum(100 for other in places[:i] + places[i + 1:] if distance(box, other) < 2 * FAR[0] * inch)
        return total

    # Those that stand alone first: they are labelled at once, and the crowd keeps off.
    for i in sorted(range(len(labels)), key=lambda i: -nearest(places, i)):
        x, y, text = labels[i]
        px, py = places[i]
        label = axes.annotate(text, (x, y), (0, 0), textcoords="offset points", fontsize=size)
        left, bottom, right, top = text_box(label, renderer)
        label.remove()
        best, least = None, math.inf
        for far, way in itertools.product(FAR, WAYS):
            dx, dy = way
            box = box_at(px + dx * far * inch, py + dy * far * inch, way, (right - left, top - bottom))
            along = [far * inch * k / 16 for k in range(4, 16)] if far > FAR[0] else []
            line = [dot_at(px + dx * step, py + dy * step, inch) for step in along]
            if (total := cost(i, far, box, line)) < least:
                best, least = (far, way, box, line), total
        far, (dx, dy), box, line = best
        written.append(box)
        lines += line
        axes.annotate(text, (x, y), (dx * far, dy * far), textcoords="offset points", fontsize=size, zorder=5,
                      ha=SIDES.get(dx, "center"), va=HEIGHTS.get(dy, "center"),
                      arrowprops=dict(arrowstyle="-", color=BLACK, linewidth=0.4, shrinkA=0, shrinkB=2,
                                      relpos=((1 - dx) / 2, (1 - dy) / 2)) if line else None)
