"""What `plumbline bench tracers` wrote into its folder, and what follows from it by counting: errors over all families,
who is beaten by whom, shares with their confidence."""
import json
import math
from types import SimpleNamespace

from figure import distinct, fail, read_csv

COLUMNS = {
    "cells": "tracer precision inputs dial setting cases hits false_misses false_hits unspecified faults t_count "
             "u_count forward_p99 backward_p99",
    "verdicts": "tracer precision inputs dial stable leaves_at slope wrong answers forward_p99 backward_p99 "
                "backward_worst",
    "symmetries": "tracer precision inputs symmetry asked changed",
    "builds": "tracer variant precision inputs asked differ",
    "conditions": "tracer precision inputs log2_condition count median p99",
    "speed": "tracer way ns ratio clock",
    "tracers": "tracer precision",
}
TEXTS = {"tracer", "variant", "precision", "inputs", "dial", "symmetry", "way", "clock"}
MAY_BE_EMPTY = {"builds", "conditions"}
RUN = ("command", "version", "machine", "compiler", "seed", "cases", "stable_bound", "rounds", "slice_seconds",
       "dials")

# Errors are drawn from half an ulp, which rounding costs anyone, to as many as make up the largest coordinate.
BITS = {"binary32": 24, "binary64": 53}
LEAST = 0.5
TELLS = ("hit or miss", "t", "t, u, v")


def read_table(directory, name):
    path, columns = f"{directory}/{name}.csv", COLUMNS[name].split()
    table = []
    for number, row in enumerate(read_csv(path, columns, name in MAY_BE_EMPTY), 1):
        try:
            table.append(SimpleNamespace(**{
                c: row[c] if c in TEXTS else float(row[c]) if row[c] or c != "leaves_at" else None for c in columns}))
        except (TypeError, ValueError):
            fail(f"{path}: row {number} isn't what plumbline writes; run plumbline bench tracers again")
        for kind in ("precision", "inputs"):
            if getattr(table[-1], kind, "binary64") not in BITS:
                fail(f"{path}: row {number}: {kind} is neither {' nor '.join(BITS)}; "
                     "run plumbline bench tracers again")
    return table


def read_run(directory):
    path = f"{directory}/run.json"
    try:
        with open(path, encoding="utf-8") as file:
            run = json.load(file)
        missing = [name for name in RUN if name not in run]
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    except (TypeError, ValueError):
        fail(f"{path}: isn't JSON; run plumbline bench tracers again")
    if missing:
        fail(f"{path}: no {', '.join(missing)}; run plumbline bench tracers again")
    return SimpleNamespace(**run)


def tells_by_tracer(cells):
    """Index in TELLS. Who tells less can be wrong in less."""
    found = {}
    for c in cells:
        found[c.tracer] = max(found.get(c.tracer, 0), 2 if c.u_count else 1 if c.t_count else 0)
    return found


def read(directory):
    """Each table of COLUMNS as a list of its rows, run.json as `run`, what each tracer tells as `tells`."""
    bench = SimpleNamespace(**{name: read_table(directory, name) for name in COLUMNS}, run=read_run(directory))
    bench.tells = tells_by_tracer(bench.cells)
    timed = {row.tracer for row in bench.speed if row.way == "mixed"}
    for row in bench.verdicts:
        if row.tracer not in timed:
            fail(f"{directory}/speed.csv: {row.tracer} has no row 'mixed'; run plumbline bench tracers again")
        if row.dial not in bench.run.dials:
            fail(f"{directory}/run.json: says nothing of the dial {row.dial}; run plumbline bench tracers again")
    if not precisions(bench):
        fail(f"{directory}/verdicts.csv: no tracer answered anything")
    return bench


def own(rows, precision=None):
    """Of tracers on inputs of their own precision, which may be given."""
    return [row for row in rows if row.inputs == row.precision and precision in (None, row.precision)]


def precisions(bench):
    return [p for p in BITS if any(row.answers > 0 for row in own(bench.verdicts, p))]


def dials(bench):
    return distinct(row.dial for row in bench.verdicts)


def tracers(bench, precision):
    return distinct(row.tracer for row in own(bench.verdicts, precision))


def speeds(bench, way="mixed"):
    return {row.tracer: row for row in bench.speed if row.way == way}


def within(value, precision):
    """As it is drawn."""
    return min(max(value, LEAST), 2.0 ** BITS[precision])


def overall_error(rows, precision):
    """The geometric mean, over the families in which it answers, of how far off a tracer is: one bad family doesn't
    outweigh all others, as in a mean, and isn't lost, as in a median."""
    logs = [math.log2(within(row.forward_p99, precision)) for row in rows if row.answers > 0]
    return 2 ** (sum(logs) / len(logs)) if logs else None


def points(bench, precision, dial=None):
    """tracer, ns a ray, error as it is drawn and what it tells, of those that answer: in a family, or overall."""
    ns, found = speeds(bench), []
    rows = own(bench.verdicts, precision)
    for tracer in tracers(bench, precision):
        error = overall_error([r for r in rows if r.tracer == tracer and dial in (None, r.dial)], precision)
        if error is not None:
            found.append(SimpleNamespace(tracer=tracer, ns=ns[tracer].ns, error=error,
                                         tells=bench.tells.get(tracer, 0)))
    return found


def beats(a, b):
    """Of points: no slower, no less accurate, better in one of these, and it tells no less."""
    return a.ns <= b.ns and a.error <= b.error and (a.ns < b.ns or a.error < b.error) and a.tells >= b.tells


def unbeaten(found):
    """Of points(), from the fastest to the slowest."""
    kept = [p for p in found if not any(beats(other, p) for other in found)]
    return sorted(kept, key=lambda p: (p.ns, p.error, p.tracer))


def interval(part, whole):
    """Wilson's score interval of a share, at 95 %; as analysis/stability_table.cpp has it."""
    if whole == 0:
        return 0.0, 1.0
    z, p = 1.959963984540054, part / whole
    middle, scale = p + z * z / (2 * whole), 1 + z * z / whole
    half = z * math.sqrt((p * (1 - p) + z * z / (4 * whole)) / whole)
    return (middle - half) / scale if part > 0 else 0.0, (middle + half) / scale if part < whole else 1.0


def summary(bench, precision):
    """A row for each tracer, those first that the fewest others beat."""
    found, speed, table = points(bench, precision), speeds(bench), []
    for point in found:
        rows = [r for r in own(bench.verdicts, precision) if r.tracer == point.tracer]
        cells = [c for c in own(bench.cells, precision) if c.tracer == point.tracer]
        wrong, answers = sum(r.wrong for r in rows), sum(r.answers for r in rows)
        low, high = interval(wrong, answers)
        table.append(SimpleNamespace(
            **vars(point), beaten_by=sum(beats(other, point) for other in found), ratio=speed[point.tracer].ratio,
            wrong=wrong / answers, low=low, high=high, worst=max(r.forward_p99 for r in rows if r.answers > 0),
            backward=max(r.backward_worst for r in rows), stable=sum(r.stable == 1 and r.answers > 0 for r in rows),
            families=sum(r.answers > 0 for r in rows),
            open=sum(c.unspecified + c.faults for c in cells) / sum(c.cases for c in cells)))
    return sorted(table, key=lambda t: (t.beaten_by, t.error, t.ns, t.tracer))
