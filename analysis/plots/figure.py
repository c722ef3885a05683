"""What the figures have in common: reading CSV, one look, PNG and SVG side by side."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

# Told apart in grey by their lightness, and by colour-blind eyes (after Okabe and Ito).
BLACK, BLUE, ORANGE, PALE = "#000000", "#0072b2", "#e69f00", "#dfe7ec"
# Colours of lines, with markers and dashes for grey.
LINES = (("#000000", "o", "-"), ("#d55e00", "s", "--"), ("#0072b2", "^", "-."), ("#009e73", "D", ":"),
         ("#cc79a7", "v", "-"), ("#e69f00", "P", "--"), ("#56b4e9", "X", "-."))

pyplot.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.spines.top": False, "axes.spines.right": False,
    "hatch.linewidth": 0.6, "savefig.dpi": 160,
    "svg.hashsalt": "plumbline", "svg.fonttype": "none",  # the same input gives the same file; text stays text
})


def fail(message):
    print(f"{pathlib.Path(sys.argv[0]).name}: {message}", file=sys.stderr)
    sys.exit(2)


def read_csv(path, columns, may_be_empty=False):
    """The rows as dictionaries. The file must have the given columns, and at least one row unless it may be empty."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            missing = [name for name in columns if name not in (reader.fieldnames or [])]
            if missing:
                fail(f"{path}: no column {', '.join(missing)}; write the file with plumbline")
            rows = list(reader)
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    if not rows and not may_be_empty:
        fail(f"{path}: no rows")
    return rows


def distinct(values):
    return list(dict.fromkeys(values))


def offset_of(row):
    return row["offset_x"], row["offset_y"], row["offset_z"]


def save(figure, directory, name):
    """Writes DIRECTORY/NAME.png and .svg."""
    try:
        pathlib.Path(directory).mkdir(parents=True, exist_ok=True)
        box = figure.get_tightbbox(figure.canvas.get_renderer()).padded(pyplot.rcParams["savefig.pad_inches"])
        for suffix, metadata in (("png", {"Software": None}), ("svg", {"Date": None})):
            figure.savefig(f"{directory}/{name}.{suffix}", metadata=metadata, bbox_inches=box, facecolor="white")
    except OSError as error:
        fail(f"{directory}: {error.strerror}")
    pyplot.close(figure)
