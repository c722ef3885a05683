"""The figures of `plumbline bench tracers`: each function draws one, from what tracers_data.py reads."""
import math
import textwrap

from matplotlib import colors, ticker
from matplotlib.collections import LineCollection

from figure import BLACK, BLUE, LINES, ORANGE, distinct, pyplot
from labels import place_labels
from tracers_data import BITS, LEAST, TELLS, dials, own, points, precisions, speeds, tracers, unbeaten, within

pyplot.rcParams.update({
    "text.parse_math": False,  # a tracer's name may hold anything
    "axes.titley": 1.0,        # else every title is fitted to every tick, again and again
})
GREY, FAINT = "#9aa5ab", "#d4d9dc"
LONG, DOTS = (0, (6, 2)), (0, (1, 2))  # of lines that mark a bound
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

# One of each kind of algorithm and library gets a line of its own in figures over difficulty; then who else is there.
CHOSEN = ("moller_trumbore_f32", "woop_watertight_f32", "plucker_f32", "baldwin_weber_f32", "embree_default",
          "embree_robust", "bullet_f32", "moller_trumbore_f64", "woop_watertight_f64", "plucker_f64",
          "baldwin_weber_f64", "brlcad_bot_classic", "cgal_epick", "exact")


def short(name, most=30):
    return name if len(name) <= most else "…" + name[1 - most:]


def chosen(bench, precision):
    names = tracers(bench, precision)
    return ([n for n in CHOSEN if n in names] + [n for n in names if n not in CHOSEN])[:len(LINES)]


def power(value):
    return "½" if value == LEAST else "2" + f"{round(math.log2(value))}".translate(SUPERSCRIPTS)


def error_axis(axis, precision):
    """Of a logarithmic axis within the limits that errors are drawn in: ticks at powers of two."""
    bits = BITS[precision]
    step = 4 if bits <= 24 else 8
    ticks = [LEAST] + [2.0 ** k for k in range(step, bits - 3 * step // 4 + 1, step)] + [2.0 ** bits]
    axis.set_major_locator(ticker.FixedLocator(ticks))
    axis.set_major_formatter(ticker.FuncFormatter(
        lambda value, _: ("≤ " if value == LEAST else "≥ " if value == ticks[-1] else "") + power(value)))
    axis.set_minor_locator(ticker.NullLocator())


def error_scale(axes, precision):
    axes.set_yscale("log")
    axes.set_ylim(LEAST / 1.6, 1.6 * 2.0 ** BITS[precision])
    error_axis(axes.yaxis, precision)
    axes.grid(axis="y", color="#e4e8ea", linewidth=0.5)
    axes.axhspan(LEAST / 1.6, LEAST * 1.25, color="#eef1f3", linewidth=0, zorder=0)


def speed_scale(axes):
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:,.10g}"))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())


def panels_of(count, columns, width, height, **shared):
    columns = min(columns, count)
    rows = math.ceil(count / columns)
    figure, grid = pyplot.subplots(rows, columns, squeeze=False, figsize=(max(width * columns, 4), 0.3 + height * rows),
                                   **shared)
    axes = list(grid.flat)
    for unused in axes[count:]:
        unused.set_visible(False)
    return figure, axes[:count], grid


POINTS = ("s", "^", "o")  # by what a tracer tells


def draw_points(axes, found):
    """The points, and the steps of those that tell most and aren't beaten. Returns who isn't beaten, and what labels
    have to keep off."""
    best = unbeaten(found)
    edge = [(p.ns, p.error) for p in best if p.tells == 2]
    for point in found:
        style = (dict(color=BLUE, markersize=5, zorder=3) if point in best
                 else dict(color=FAINT, markeredgecolor=GREY, markersize=4, zorder=2))
        axes.plot(point.ns, point.error, POINTS[point.tells], linestyle="none", markeredgewidth=0.5, **style)
    axes.step([x for x, _ in edge], [y for _, y in edge], where="post", color=BLUE, linewidth=1, zorder=2.5)
    obstacles = [(p.ns, p.error) for p in found]
    for (x0, y0), (x1, y1) in zip(edge, edge[1:]):
        obstacles += [(x0 * (x1 / x0) ** (i / 12), y0) for i in range(13)]
        obstacles += [(x1, y0 * (y1 / y0) ** (i / 12)) for i in range(13)]
    return best, obstacles


def point_key(found):
    """Handles and labels of the kinds of points there are."""
    there = [i for i in (2, 1, 0) if any(p.tells == i for p in found)]
    handles = [pyplot.Line2D([], [], marker=POINTS[i], color=BLUE, linestyle="none", markersize=5) for i in there]
    handles.append(pyplot.Line2D([], [], marker="o", color=FAINT, markeredgecolor=GREY, linestyle="none", markersize=4))
    return handles, [f"tells {TELLS[i]}" for i in there] + ["beaten by one that tells as much"]


def mark_exact(axes, bench, precision, size=7):
    """What no error costs, where `exact` is no point of the panel."""
    exact = speeds(bench).get("exact")
    if exact and precision == "binary32":
        axes.axvline(exact.ns, color=BLACK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=1)
        axes.text(exact.ns, 0.99, " exact", transform=axes.get_xaxis_transform(), fontsize=size, va="top")


def pareto(bench):
    """All families together, the precisions side by side."""
    kinds = precisions(bench)
    figure, axes, _ = panels_of(len(kinds), 2, 4.0, 4.0)
    drawn = []
    for panel, precision in zip(axes, kinds):
        found = points(bench, precision)
        best, obstacles = draw_points(panel, found)
        speed_scale(panel)
        error_scale(panel, precision)
        mark_exact(panel, bench, precision)
        panel.set_xlim(min(p.ns for p in found) / 1.5, max(p.ns for p in found) * 2)
        panel.set_title(f"{precision} tracers")
        panel.set_xlabel("time a ray in ns, mixed hits and misses")
        drawn.append((panel, best, obstacles))
    axes[0].set_ylabel("error in ulps of the largest coordinate:\np99, geometric mean over the families")
    figure.tight_layout(w_pad=2)
    key(figure, *point_key([p for precision in kinds for p in points(bench, precision)]))
    figure.canvas.draw()
    for panel, best, obstacles in drawn:
        place_labels(panel, [(p.ns, p.error, short(p.tracer)) for p in best], obstacles)
    return figure


def pareto_families(bench, precision):
    """A panel for each family; who isn't beaten has a number, explained above."""
    families = dials(bench)
    found = {dial: points(bench, precision, dial) for dial in families}
    best = [point for dial in families for point in unbeaten(found[dial])]
    numbered = distinct(p.tracer for p in sorted(best, key=lambda p: (p.ns, p.tracer)))
    figure, axes, grid = panels_of(len(families), 3, 2.5, 1.75, sharex=True, sharey=True)
    drawn = []
    for panel, dial in zip(axes, families):
        drawn.append((panel, *draw_points(panel, found[dial])))
        speed_scale(panel)
        error_scale(panel, precision)
        mark_exact(panel, bench, precision, 6)
        panel.set_title(dial, fontsize=8, pad=3)
        panel.tick_params(labelsize=7)
    finish_grid(axes, grid, "time a ray in ns", "p99 error in ulps")
    figure.tight_layout(h_pad=0.6, w_pad=0.6)
    figure.canvas.draw()
    for panel, best, obstacles in drawn:
        place_labels(panel, [(p.ns, p.error, str(1 + numbered.index(p.tracer))) for p in best], obstacles)
    nothing = [pyplot.Line2D([], [], linestyle="none") for _ in numbered]
    key(figure, nothing, [f"{i} {short(name)}" for i, name in enumerate(numbered, 1)], handlelength=0)
    return figure


def key(figure, handles, labels, **more):
    figure.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False, fontsize=7.5,
                  ncol=min(4, max(1, len(labels))), handletextpad=0.6, columnspacing=1.4, **more)


def finish_grid(axes, grid, x_label, y_label):
    """Labels where nothing stands below or to the left."""
    columns = grid.shape[1]
    for i, panel in enumerate(axes):
        if i + columns >= len(axes):
            panel.set_xlabel(x_label, fontsize=7.5)
            panel.tick_params(axis="x", labelbottom=True)
        if i % columns == 0:
            panel.set_ylabel(y_label, fontsize=7.5)


def draw_lines(axes, lines, names):
    """Those of `names` each in a style of its own, all others faint."""
    others = [sorted(line) for name, line in lines.items() if name not in names]
    axes.add_collection(LineCollection(others, color=FAINT, linewidth=0.6, zorder=1), autolim=True)
    axes.autoscale_view()
    for name, (color, marker, dashes) in zip(names, LINES):
        if name in lines:
            axes.plot(*zip(*sorted(lines[name])), dashes, color=color, marker=marker, markersize=2.8, linewidth=1,
                      zorder=3)


def line_key(names, others, *more):
    """Handles and labels of what draw_lines() drew, and of more: (style, label)."""
    styles = [(dict(color=c, marker=m, linestyle=d, markersize=3.5, linewidth=1), short(name))
              for name, (c, m, d) in zip(names, LINES)]
    styles += ([(dict(color=FAINT), "all others")] if others else []) + list(more)
    return [pyplot.Line2D([], [], **style) for style, _ in styles], [label for _, label in styles]


def over_difficulty(bench, precision, measure, y_label, bound=None):
    families, names = dials(bench), chosen(bench, precision)
    rows = own(bench.cells, precision)
    figure, axes, grid = panels_of(len(families), 3, 2.5, 1.85, sharey=True)
    for panel, dial in zip(axes, families):
        lines = {}
        for r in rows:
            if r.dial == dial and r.cases > r.unspecified + r.faults:
                lines.setdefault(r.tracer, []).append((r.setting, within(getattr(r, measure), precision)))
        draw_lines(panel, lines, names)
        error_scale(panel, precision)
        if bound is not None:
            panel.axhline(bound, color=BLACK, linewidth=0.8, linestyle=LONG, zorder=2)
        panel.set_title(dial, fontsize=8, pad=3)
        panel.set_xlabel("\n".join(textwrap.wrap(bench.run.dials[dial], 44)), fontsize=6.5)
        panel.tick_params(labelsize=7)
    for panel in axes[::grid.shape[1]]:
        panel.set_ylabel(y_label, fontsize=7.5)
    figure.tight_layout(h_pad=0.6, w_pad=0.6)
    more = []
    if bound is not None:
        more.append((dict(color=BLACK, linewidth=0.8, linestyle=LONG), f"bound: {bound:g} unit roundoffs"))
    key(figure, *line_key(names, len(tracers(bench, precision)) > len(names), *more))
    return figure


def forward(bench, precision):
    return over_difficulty(bench, precision, "forward_p99", "p99 error in ulps")


def backward(bench, precision):
    return over_difficulty(bench, precision, "backward_p99", "p99 backward error\nin unit roundoffs",
                           bench.run.stable_bound)


FEWEST = 10  # hits, of which a median is drawn


def conditions_of(bench, precision):
    """Those bins that hold enough."""
    return [r for r in own(bench.conditions, precision) if r.count >= FEWEST]


def condition(bench):
    kinds = [p for p in precisions(bench) if conditions_of(bench, p)]
    figure, axes, _ = panels_of(len(kinds), 2, 4.0, 3.8)
    for panel, precision in zip(axes, kinds):
        ends, lines, names = [1.0, 2.0 ** BITS[precision]], {}, chosen(bench, precision)
        for r in conditions_of(bench, precision):
            lines.setdefault(r.tracer, []).append((2.0 ** r.log2_condition, within(r.median, precision)))
        names = [name for name in names if name in lines]
        panel.set_xscale("log")
        draw_lines(panel, lines, names)
        for times, dashes in ((1, LONG), (bench.run.stable_bound, DOTS)):
            panel.plot(ends, [times * x for x in ends], color=BLACK, linewidth=0.8, linestyle=dashes, zorder=2)
        panel.set_xlim(0.7, 1.6 * ends[1])
        error_axis(panel.xaxis, precision)
        error_scale(panel, precision)
        panel.set_title(f"{precision} tracers")
        panel.set_xlabel("condition number of t")
        panel.legend(*line_key(names, len(lines) > len(names)), loc="upper center", bbox_to_anchor=(0.5, -0.17),
                     frameon=False, fontsize=7, ncol=2)
    axes[0].set_ylabel("median relative error of t,\nin unit roundoffs")
    figure.tight_layout(w_pad=1.5)
    return figure


SHADES = colors.LinearSegmentedColormap.from_list("shades", ["#ffffff", "#9fc6e0", BLUE, "#00263d"])


def heat_map(axes, cells, rows, columns):
    """cells[i][j] is (shade from 0 to 1, text), or None: nothing to say, hatched."""
    for i, line in enumerate(cells):
        for j, cell in enumerate(line):
            square = pyplot.Rectangle((j - 0.5, i - 0.5), 1, 1, linewidth=0, in_layout=False)
            axes.add_patch(square)
            if cell is None:
                square.set(facecolor="white", hatch="//////", edgecolor=FAINT)
                continue
            shade, text = cell
            square.set(color=SHADES(shade))
            axes.text(j, i, text, ha="center", va="center", fontsize=6, color="white" if shade > 0.45 else BLACK,
                      in_layout=False)
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xticks(range(len(columns)), columns, rotation=40, ha="left", fontsize=7)
    axes.set_yticks(range(len(rows)), [short(row) for row in rows], fontsize=7)
    axes.tick_params(length=0, top=False, bottom=False, labeltop=True, labelbottom=False, pad=1)
    for spine in axes.spines.values():
        spine.set_visible(False)
    ends_x, ends_y = (-0.5, len(columns) - 0.5), (-0.5, len(rows) - 0.5)
    axes.vlines([x - 0.5 for x in range(len(columns) + 1)], *ends_y, color=FAINT, linewidth=0.3)
    axes.hlines([y - 0.5 for y in range(len(rows) + 1)], *ends_x, color=FAINT, linewidth=0.3)


def verdicts(bench, precision):
    """The setting at which each tracer leaves its bound: the earlier, the darker."""
    rows, families = own(bench.verdicts, precision), dials(bench)
    reach = {d: sorted({c.setting for c in own(bench.cells, precision) if c.dial == d}) for d in families}
    found = {(r.tracer, r.dial): r for r in rows}
    names = sorted(tracers(bench, precision), key=lambda n: (
        -sum(found[n, d].stable for d in families if found[n, d].answers > 0), n))

    def cell(row):
        if row.answers == 0:
            return None
        if row.leaves_at is None:
            return 0, "·"
        first, last = reach[row.dial][0], reach[row.dial][-1]
        return 1 - 0.8 * (row.leaves_at - first) / max(last - first, 1), f"{row.leaves_at:g}"

    figure, axes = pyplot.subplots(figsize=(2.6 + 0.42 * len(families), 0.8 + 0.165 * len(names)))
    heat_map(axes, [[cell(found[n, d]) for d in families] for n in names], names, families)
    last = "last:  " if len(families) > 3 else ""
    axes.text(-0.6, len(names) + 0.1, last, ha="right", fontsize=6.5)
    for j, dial in enumerate(families):
        axes.text(j, len(names) + 0.1, f"{reach[dial][-1]:g}", ha="center", fontsize=6.5)
    return figure


def percent(share):
    if share == 0:
        return "·"
    return f"{100 * share:.2g}" if share >= 0.0001 else "<.01"


def share_shade(share):
    """Logarithmic: what happens once in ten thousand is seen."""
    return 0 if share == 0 else min(1, max(0.08, 1 + math.log10(share) / 4))


def share_cell(part, whole):
    return None if whole == 0 else (share_shade(part / whole), percent(part / whole))


def symmetries(bench):
    kinds = precisions(bench)
    columns = distinct(r.symmetry for r in bench.symmetries)
    tallest = max(len(tracers(bench, p)) for p in kinds)
    figure, axes = pyplot.subplots(1, len(kinds), squeeze=False,
                                   figsize=(4.0 * len(kinds), max(0.9 + 0.165 * tallest, 2)))
    for panel, precision in zip(axes[0], kinds):
        found = {(r.tracer, r.symmetry): r for r in own(bench.symmetries, precision)}
        names = sorted(tracers(bench, precision), key=lambda n: (
            sum(found[n, c].changed for c in columns) / max(1, sum(found[n, c].asked for c in columns)), n))
        heat_map(panel, [[share_cell(found[n, c].changed, found[n, c].asked) for c in columns] for n in names], names,
                 columns)
        panel.set_ylim(tallest - 0.5, -0.5)
        panel.text((len(columns) - 1) / 2, len(names) + 0.2, f"{precision} tracers: answers that change, in %",
                   ha="center", fontsize=8)
    figure.tight_layout(w_pad=2)
    return figure


def suffix(row):
    return row.variant.removeprefix(row.tracer + "_")


def builds(bench):
    rows = own(bench.builds)
    names, columns = distinct(r.tracer for r in rows), distinct(suffix(r) for r in rows)
    found = {(r.tracer, suffix(r)): r for r in rows}
    cells = [[share_cell(found[n, c].differ, found[n, c].asked) if (n, c) in found else (0, "") for c in columns]
             for n in names]
    figure, axes = pyplot.subplots(figsize=(2.4 + 0.5 * len(columns), 0.9 + 0.2 * len(names)))
    heat_map(axes, cells, names, columns)
    axes.set_xlabel("answers that differ from the build on the left, in %", fontsize=8)
    return figure


def inputs(bench):
    """Those of binary64, wrong on full mantissas and on binary32 numbers."""
    shares = wrong_by_inputs(bench)
    names = sorted(shares, key=lambda n: (shares[n]["binary64"], shares[n]["binary32"], n), reverse=True)
    least = 1e-6
    figure, axes = pyplot.subplots(figsize=(5.2, max(0.9 + 0.16 * len(names), 1.6)))
    for y, name in enumerate(names):
        values = {kind: max(share, least) for kind, share in shares[name].items()}
        axes.plot([values["binary32"], values["binary64"]], [y, y], color=GREY, linewidth=1, zorder=1)
        axes.plot(values["binary32"], y, "o", markerfacecolor="white", markeredgecolor=BLUE, markersize=5, zorder=2)
        axes.plot(values["binary64"], y, "s", color=BLACK, markersize=3.5, zorder=3)
    axes.set_xscale("log")
    axes.set_xlim(least / 1.5, 1)
    axes.set_xticks([least] + [10.0 ** k for k in range(-4, 1)], ["none", "0.01", "0.1", "1", "10", "100"])
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.axvspan(least / 1.5, least * 1.5, color="#eef1f3", linewidth=0, zorder=0)
    axes.grid(axis="x", color="#e4e8ea", linewidth=0.5)
    axes.set_yticks(range(len(names)), [short(n) for n in names], fontsize=7)
    axes.set_ylim(-0.7, len(names) - 0.3)
    axes.set_xlabel("wrong answers in %")
    key(figure, [pyplot.Line2D([], [], marker="o", markerfacecolor="white", markeredgecolor=BLUE, linestyle="none"),
                 pyplot.Line2D([], [], marker="s", color=BLACK, linestyle="none", markersize=4)],
        ["binary32 inputs", "binary64 inputs, full mantissas"])
    figure.tight_layout()
    return figure


AS_FAR_AS_EXPONENTS = ("tiny", "huge", "direction_scale")  # dials that go on where binary32 ends


def wrong_by_inputs(bench):
    """Of each tracer of binary64 that answers on both: the share of wrong answers by precision of the inputs."""
    shares = {}
    for name in tracers(bench, "binary64"):
        counts = {kind: [0, 0] for kind in BITS}
        for row in bench.verdicts:
            if row.tracer == name and row.dial not in AS_FAR_AS_EXPONENTS:
                counts[row.inputs][0] += row.wrong
                counts[row.inputs][1] += row.answers
        if all(whole for _, whole in counts.values()):
            shares[name] = {kind: part / whole for kind, (part, whole) in counts.items()}
    return shares


WAY_MARKS = (("hits", "^", BLUE), ("misses", "v", BLUE), ("mixed", "o", BLACK), ("single", "s", ORANGE),
             ("bags", "D", "#009e73"), ("memory", "x", "#cc79a7"))


def speed(bench):
    """Ratios to the reference, by way of shooting."""
    kinds = precisions(bench)
    tallest = max(len(tracers(bench, p)) for p in kinds)
    figure, axes = pyplot.subplots(1, len(kinds), squeeze=False, sharex=True,
                                   figsize=(4.1 * len(kinds), max(1 + 0.165 * tallest, 2)))
    mixed = speeds(bench)
    for panel, precision in zip(axes[0], kinds):
        names = sorted(tracers(bench, precision), key=lambda n: (mixed[n].ratio, n))
        for way, marker, color in WAY_MARKS:
            rows = speeds(bench, way)
            here = [(rows[n].ratio, y) for y, n in enumerate(names) if n in rows]
            panel.plot(*zip(*here), marker, color=color, markersize=4, linestyle="none", markeredgewidth=0.9,
                       **(dict(zorder=4) if way == "mixed" else dict(markerfacecolor="none", zorder=3)))
        panel.set_xscale("log")
        panel.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:,.10g}"))
        panel.axvline(1, color=BLACK, linewidth=0.7)
        panel.set_yticks(range(len(names)), [short(n) + " *" * (mixed[n].clock == "wall") for n in names], fontsize=7)
        panel.set_ylim(tallest - 0.4, -0.6)
        panel.grid(color="#e4e8ea", linewidth=0.5)
        panel.set_title(f"{precision} tracers")
        panel.set_xlabel("time over that of moller_trumbore_f64", fontsize=8)
    handles = [pyplot.Line2D([], [], marker=m, color=c, linestyle="none", markersize=4.5,
                             markerfacecolor=c if way == "mixed" else "none") for way, m, c in WAY_MARKS]
    figure.tight_layout(w_pad=2)
    figure.legend(handles, [way for way, _, _ in WAY_MARKS], loc="lower center", bbox_to_anchor=(0.5, 1.0),
                  frameon=False, fontsize=8, ncol=6)
    return figure
