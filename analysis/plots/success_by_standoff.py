#!/usr/bin/python3
"""How the share of successes on vertices and edges depends on the standoff h, the choice behind the report's 84.8 %.

usage: success_by_standoff.py SWEEP.csv DIRECTORY

SWEEP.csv is what `plumbline sweep --csv` writes with --standoff repeated; a panel for each --offset. Writes
success_by_standoff.png and .svg.
"""
import argparse

from matplotlib import ticker

from figure import BLACK, LINES, distinct, fail, offset_of, pyplot, read_csv, save

COLUMNS = ("tracer", "offset_x", "offset_y", "offset_z", "standoff", "target", "attempts", "successes")
REPORT_STANDOFF, REPORT_RATE = 5, 100 * 1710 / 2016


def draw(rows):
    tracers = distinct(row["tracer"] for row in rows)
    offsets = distinct(offset_of(row) for row in rows)
    figure, panels = pyplot.subplots(1, len(offsets), sharey=True, squeeze=False, figsize=(1 + 4.2 * len(offsets), 3.9))
    for panel, offset in zip(panels[0], offsets):
        for tracer, (color, marker, dashes) in zip(tracers, LINES):
            points = sorted((float(row["standoff"]), 100 * int(row["successes"]) / int(row["attempts"])) for row in rows
                            if row["tracer"] == tracer and offset_of(row) == offset)
            panel.plot(*zip(*points), dashes, color=color, marker=marker, markersize=3.5, linewidth=1, label=tracer)
        panel.set_xscale("log")
        panel.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        panel.set_title(f"lattice from ({', '.join(offset)})")
        panel.set_xlabel("standoff h")
        panel.grid(axis="y", color="#dddddd", linewidth=0.6)
    panels[0][0].set_ylabel("successes on vertices and edges in %")
    panels[0][0].plot(REPORT_STANDOFF, REPORT_RATE, "o", markersize=11, markerfacecolor="none", markeredgecolor=BLACK,
                      label=f"the report: h = {REPORT_STANDOFF}, {REPORT_RATE:.1f} %", linestyle="none")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, frameon=False)
    figure.tight_layout()
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sweep")
    parser.add_argument("directory")
    arguments = parser.parse_args()
    rows = [row for row in read_csv(arguments.sweep, COLUMNS)
            if row["target"] == "vertex_edge" and int(row["attempts"]) > 0]
    if not rows:
        fail(f"{arguments.sweep}: no ray was fired at a vertex or an edge")
    tracers = distinct(row["tracer"] for row in rows)
    if len(tracers) > len(LINES):
        fail(f"{arguments.sweep}: {len(tracers)} tracers; sweep at most {len(LINES)} with --tracer, or no one can read it")
    save(draw(rows), arguments.directory, "success_by_standoff")


if __name__ == "__main__":
    main()
