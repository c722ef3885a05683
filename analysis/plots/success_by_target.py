#!/usr/bin/python3
"""Fig. 7 of ARL-CR-0761, taken apart: how often each tracer answers as wished, for each kind of target, and why not.

usage: success_by_target.py SWEEP.csv DIRECTORY

SWEEP.csv is what `plumbline sweep --csv` writes, of one standoff and one offset. Writes success_by_target.png and .svg.
"""
import argparse
import math

from figure import BLACK, BLUE, ORANGE, PALE, distinct, fail, offset_of, pyplot, read_csv, save

COUNTS = ("attempts", "successes", "false_misses", "false_hits", "lucky_misses", "lucky_hits", "unlucky_harness_errors")
COLUMNS = ("tracer", "offset_x", "offset_y", "offset_z", "standoff", "target", "tolerance") + COUNTS


def parts_of(row):
    """The rays of one bar by what became of them; together they are the attempts."""
    n = {name: int(row[name]) for name in COUNTS}
    lucky = n["lucky_misses"] + n["lucky_hits"]
    parts = [n["successes"] - lucky, lucky, n["unlucky_harness_errors"], n["false_misses"] - n["lucky_misses"],
             n["false_hits"] - n["lucky_hits"]]
    return parts + [n["attempts"] - sum(parts)]


STYLES = (
    ("success", dict(color=PALE)),
    ("lucky success: a wrong answer that was wished for", dict(facecolor=PALE, hatch="//////", edgecolor=BLACK)),
    ("harness error: the ray went elsewhere, the answer is right", dict(color=ORANGE)),
    ("false miss", dict(color=BLUE)),
    ("false hit", dict(color=BLACK)),
    ("left open by the tracer's contract, or no answer", dict(facecolor="white", hatch="....", edgecolor="#777777")),
)


def title_of(target, tolerance):
    return f"tolerance {tolerance}" if target == "tolerance" else target.replace("_", "/")


def draw(rows):
    tracers = distinct(row["tracer"] for row in rows)
    targets = distinct((row["target"], row["tolerance"]) for row in rows)
    rate = {id(row): 100 * int(row["successes"]) / int(row["attempts"]) for row in rows}
    start = max(0, 10 * math.floor((min(rate.values()) - 15) / 10))  # leaves room for the number in the shortest bar

    figure, panels = pyplot.subplots(1, len(targets), sharey=True, squeeze=False,
                                     figsize=(1.6 + 2.1 * len(targets), 1.5 + 0.27 * len(tracers)))
    for panel, target in zip(panels[0], targets):
        for row in rows:
            if (row["target"], row["tolerance"]) != target:
                continue
            left, y = 0, tracers.index(row["tracer"])
            for part, (_, style) in zip(parts_of(row), STYLES):
                width = 100 * part / int(row["attempts"])
                if part:
                    panel.barh(y, width, left=left, height=0.7, linewidth=0, **style)
                left += width
            panel.text(start + (100 - start) * 0.03, y, f"{rate[id(row)]:.1f}", va="center", fontsize=8,
                       bbox=dict(facecolor=PALE, edgecolor="none", pad=0.8))
        panel.set_title(title_of(*target))
        panel.set_xlim(start, 100)
        panel.set_xticks([x for x in range(0, 101, 20) if x >= start])
        panel.set_yticks(range(len(tracers)), tracers)
        panel.tick_params(axis="y", length=0)
        panel.spines["left"].set_visible(False)
    panels[0][0].set_ylim(len(tracers) - 0.4, -0.6)
    panels[0][len(targets) // 2].set_xlabel("rays in %" + (f" (the axis begins at {start})" if start else ""))
    handles = [pyplot.Rectangle((0, 0), 1, 1, linewidth=0, **style) for _, style in STYLES]
    figure.legend(handles, [label for label, _ in STYLES], loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2,
                  frameon=False)
    figure.tight_layout(w_pad=1.2)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sweep")
    parser.add_argument("directory")
    arguments = parser.parse_args()
    rows = [row for row in read_csv(arguments.sweep, COLUMNS) if int(row["attempts"]) > 0]
    if not rows:
        fail(f"{arguments.sweep}: no ray was fired")
    if len({(offset_of(row), row["standoff"]) for row in rows}) > 1:
        fail(f"{arguments.sweep}: several standoffs or offsets; success_by_standoff.py shows these")
    save(draw(rows), arguments.directory, "success_by_target")


if __name__ == "__main__":
    main()
