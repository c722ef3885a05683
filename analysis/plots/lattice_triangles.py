#!/usr/bin/python3
"""Fig. 1 of ARL-CR-0761: all triangles of a lattice, as wires.

usage: lattice_triangles.py TRIANGLES.csv DIRECTORY

TRIANGLES.csv is what `plumbline lattice` prints. Writes lattice_triangles.png and .svg.
"""
import argparse
import itertools

from figure import BLACK, BLUE, fail, pyplot, read_csv, save
from mpl_toolkits.mplot3d.art3d import Line3DCollection

CORNERS = tuple(tuple(f"{corner}{axis}" for axis in "xyz") for corner in "abc")
MOST = 2000  # edges; more are one blot


def draw(rows):
    """Each triangle once, whatever the order of its vertices."""
    shapes = sorted({tuple(sorted(tuple(float(row[name]) for name in corner) for corner in CORNERS)) for row in rows})
    edges = sorted({edge for shape in shapes for edge in itertools.combinations(shape, 2)})
    if len(edges) > MOST:
        fail(f"{len(shapes)} triangles with {len(edges)} edges; draw at most {MOST} edges, of a lattice with a larger step")
    points = sorted({point for shape in shapes for point in shape})

    figure = pyplot.figure(figsize=(6.4, 6.4))
    axes = figure.add_subplot(projection="3d", proj_type="ortho", computed_zorder=False)
    axes.add_collection3d(Line3DCollection(edges, color=BLUE, linewidth=0.6, alpha=max(0.15, min(1, 120 / len(edges)))))
    axes.scatter(*zip(*points), color=BLACK, s=18, depthshade=False)
    for set_limits, set_ticks, set_label, values, name in zip(
            (axes.set_xlim, axes.set_ylim, axes.set_zlim), (axes.set_xticks, axes.set_yticks, axes.set_zticks),
            (axes.set_xlabel, axes.set_ylabel, axes.set_zlabel), zip(*points), "xyz"):
        layers = sorted(set(values))
        set_limits(layers[0], layers[-1])
        set_ticks(layers if len(layers) <= 6 else layers[::len(layers) // 5])
        set_label(name)
    axes.set_box_aspect([max(values) - min(values) for values in zip(*points)])
    axes.view_init(elev=17, azim=-67)
    axes.grid(False)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.pane.set_visible(False)
    axes.set_title(f"{len(shapes):,} triangles on {len(points)} lattice points ({len(rows):,} ordered triples)")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles")
    parser.add_argument("directory")
    arguments = parser.parse_args()
    save(draw(read_csv(arguments.triangles, sum(CORNERS, ()))), arguments.directory, "lattice_triangles")


if __name__ == "__main__":
    main()
