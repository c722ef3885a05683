"""What is seen in the figures of `plumbline bench tracers`, in sentences: each is computed, and is there only where the
data say so. A function for each figure; names are put between backticks."""
import math

from figure import distinct
from tracers_data import (BITS, LEAST, TELLS, dials, interval, own, points, precisions, speeds, summary, tracers,
                          unbeaten, within)
from tracers_figures import chosen, conditions_of, suffix, wrong_by_inputs

# An absolute epsilon is told from underflow where no product of so many coordinates leaves the normal numbers.
FACTORS = 4
EXPONENTS = {"binary32": 126, "binary64": 1022}
INSTRUCTION_SETS = ("sse2", "avx", "avx2", "avx512")


def number(value, digits=2):
    """2, 0.31, 5,400, 1.7e+15"""
    if math.isinf(value):
        return "infinite"
    if value == 0:
        return "0"
    rounded = float(f"{value:.{digits}g}")
    if 1000 <= rounded < 1e6:
        return f"{rounded:,.0f}"
    return f"{rounded:.{digits}g}" if rounded < 100 or rounded >= 1e6 else f"{rounded:.0f}"


def ulps(error):
    return "at most ½ ulp" if error <= LEAST else f"{number(error)} ulps"


def percent(share):
    return f"{number(100 * share)} %"


def count(amount, noun):
    amount = int(amount)
    return f"{amount:,} {noun}" + ("" if amount == 1 else "es" if noun.endswith("s") else "s")


def are(amount):
    return "is" if amount == 1 else "are"


def families(amount):
    return "1 family" if amount == 1 else f"{amount} families"


def listed(items, most=6):
    """a, b and c"""
    items = list(items)
    if len(items) > most:
        items = items[:most - 1] + [f"{len(items) - most + 1} more"]
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1]


def named(names, most=6):
    """As listed(), of tracers and families."""
    names = list(names)
    rest = len(names) - most + 1 if len(names) > most else 0
    marked = [f"`{name}`" for name in (names[:most - 1] if rest else names)]
    return listed(marked + ([f"{rest} more"] if rest else []), most + 1)


def pareto(bench):
    told = []
    for precision in precisions(bench):
        found = points(bench, precision)
        best = unbeaten(found)
        told.append(f"Of {count(len(found), precision + ' tracer')}, {len(best)} {are(len(best))} beaten by none that "
                    "tells as much: " + listed(
                        [f"`{p.tracer}` ({number(p.ns)} ns, {ulps(p.error)})" for p in best], 9) + ".")
        for level, spared in ((0, "no t, u or v"), (1, "no u or v")):
            less = [p.tracer for p in found if p.tells == level]
            if less:
                told.append(f"Only {TELLS[level]} is told by {named(less, 9)}, so that {spared} can be wrong.")
    told += price_of_exact(bench)
    return told


def price_of_exact(bench):
    """What zero costs."""
    mixed = speeds(bench)
    if "exact" not in mixed:
        return []
    exact, told = mixed["exact"], []
    others = [row for row in own(bench.verdicts) if row.tracer != "exact"]
    wrong = {n for n in distinct(r.tracer for r in others) if any(r.wrong for r in others if r.tracer == n)}
    slower = [n for n in wrong if mixed[n].ns > exact.ns]
    told.append(f"Zero costs {number(exact.ns)} ns a ray: `exact` takes {number(exact.ratio)} times as long as "
                "`moller_trumbore_f64`.")
    if slower:
        told.append(f"{count(len(slower), 'tracer')} of {len(mixed) - 1} {are(len(slower))} slower than `exact` and "
                    f"wrong: {named(sorted(slower, key=lambda n: mixed[n].ns), 8)}.")
    return told


def pareto_families(bench, precision):
    told, times = [], {}
    for dial in dials(bench):
        for point in unbeaten(points(bench, precision, dial)):
            times.setdefault(point.tracer, []).append(dial)
    if times:
        most = sorted(times, key=lambda n: (-len(times[n]), n))
        told.append("Beaten by none: " + listed([f"`{n}` in {families(len(times[n]))}" for n in most], 7) + ".")
    hard = [d for d in dials(bench) if (here := [p for p in points(bench, precision, d) if p.tracer != "exact"])
            and all(p.error >= 2.0 ** (BITS[precision] // 2) for p in here if p.tells == 2)
            and any(p.tells == 2 for p in here)]
    if hard:
        told.append(f"No tracer that tells t, u and v keeps half of its digits on {named(hard)}" +
                    (", but for `exact`." if "exact" in tracers(bench, precision) else "."))
    return told


def forward(bench, precision):
    told = []
    rows = [r for r in own(bench.verdicts, precision) if r.answers > 0]
    for name in chosen(bench, precision)[:4]:
        here = [r for r in rows if r.tracer == name]
        if not here:
            continue
        worst = max(here, key=lambda r: r.forward_p99)
        good = sum(r.forward_p99 <= 2 ** 4 for r in here)
        how = "where its numbers aren't finite" if math.isinf(worst.forward_p99) else f"with {ulps(worst.forward_p99)}"
        told.append(f"`{name}` stays within 16 ulps in {good} of {families(len(here))}"
                    + (f"; its worst is `{worst.dial}`, {how}." if worst.forward_p99 > 16 else "."))
    told += growth(bench, precision)
    told += closed_edges(bench, precision)
    return told


def growth(bench, precision):
    """Errors that grow in step with the dial."""
    rows = [r for r in own(bench.verdicts, precision) if r.tracer != "exact" and r.answers > 0]
    told = []
    for dial in dials(bench):
        slopes = [r.slope for r in rows if r.dial == dial and r.forward_p99 > 2 ** 10]
        steps = bench.run.dials[dial].endswith("log2")
        among = sum(r.dial == dial for r in rows)
        if steps and among > 2 and len(slopes) > among / 2 and 0.5 < (middle := sorted(slopes)[len(slopes) // 2]) < 4:
            told.append(f"`{dial}`: 2^{number(middle)} in the median of {count(len(slopes), 'tracer')}")
    return [f"By so much the error grows with each doubling of the difficulty: {listed(told, 8)}."] if told else []


def closed_edges(bench, precision):
    """On the lattice every ray meets an edge or vertex exactly, so that whoever misses one isn't closed."""
    rows = [c for c in own(bench.cells, precision) if c.dial == "lattice" and c.hits > 0]
    told = []
    for name in distinct(c.tracer for c in rows):
        hits, missed = (sum(getattr(c, what) for c in rows if c.tracer == name) for what in ("hits", "false_misses"))
        if missed and name in ("woop_watertight_f32", "woop_watertight_f64"):
            low, high = interval(missed, hits)
            told.append(f"`{name}` isn't closed on a single triangle: of {count(hits, 'ray')} that meet an edge or "
                        f"vertex of `lattice` exactly it misses {percent(missed / hits)} ({percent(low)} to "
                        f"{percent(high)}). Watertight is a promise about two triangles that share the edge.")
    closed = [n for n in distinct(c.tracer for c in rows) if n != "exact" and all(
        c.false_misses == 0 and c.unspecified + c.faults == 0 for c in rows if c.tracer == n)]
    if closed:
        told.append(f"Besides, no ray of `lattice` is missed by {named(closed)}.")
    return told


def backward(bench, precision):
    rows, names = [r for r in own(bench.verdicts, precision) if r.answers > 0], tracers(bench, precision)
    bound, told = f"{bench.run.stable_bound:g}", []
    always = [n for n in names if (here := [r for r in rows if r.tracer == n]) and all(r.stable for r in here)]
    if always:
        told.append(f"Backward stable on every family, with a 99th percentile within {bound} unit roundoffs at each "
                    f"setting: {named(always, 10)}.")
    elif names:
        told.append(f"No {precision} tracer stays within {bound} unit roundoffs on every family.")
    hard, easy = [], []
    for dial in dials(bench):
        here = [r for r in rows if r.dial == dial]
        leaving = sum(not r.stable for r in here)
        (hard if here and leaving > len(here) / 2 else easy).append((dial, leaving, len(here)))
    if hard:
        told.append("Most tracers are unstable on " + listed([f"`{d}` ({n} of {of})" for d, n, of in hard], 9) + ".")
    calm = [d for d, n, of in easy if n == 0 and of]
    if calm:
        told.append(f"None is on {named(calm)}: what error there is, the problem makes.")
    return told


def condition(bench):
    told, bound = [], bench.run.stable_bound
    for precision in precisions(bench):
        rows = conditions_of(bench, precision)
        names = distinct(r.tracer for r in rows)
        if not names:
            continue

        def excess(name, share):
            """By how much the error is more than its condition explains, at most."""
            here = [r for r in rows if r.tracer == name]
            return max(within(getattr(r, share), precision) / 2.0 ** r.log2_condition for r in here)

        half, nearly_all = ([n for n in names if excess(n, share) <= bound] for share in ("median", "p99"))
        told.append(f"{precision}: in half of the hits t is within {bound:g} times what the condition number explains, "
                    f"at every condition number, with {len(half)} of {count(len(names), 'tracer')} that tell t; in 99 "
                    "of 100 hits with " + (f"{len(nearly_all)} ({named(nearly_all)})." if nearly_all else "none."))
        beyond = sorted((n for n in names if n not in half), key=lambda n: (-excess(n, "median"), n))
        if beyond:
            told.append("Farthest from it in the median: " + listed(
                [f"`{n}` by {number(excess(n, 'median'))}" for n in beyond[:4]]) + ".")
    return told


def verdicts(bench, precision):
    rows = [r for r in own(bench.verdicts, precision) if r.answers > 0]
    told = []
    first = {d: min(c.setting for c in own(bench.cells, precision) if c.dial == d) for d in dials(bench)}
    easy = [r for r in rows if r.leaves_at == first[r.dial]]
    names = distinct(r.tracer for r in easy)
    if names:
        times = {n: sum(r.tracer == n for r in easy) for n in names}
        told.append(f"Outside their bound already where a dial is at its easiest, of {len(tracers(bench, precision))}: "
                    + listed([f"`{n}` ({families(times[n])})" for n in sorted(times, key=lambda n: -times[n])], 7)
                    + ".")
    single = computes_in_binary32(bench) if precision == "binary64" else []
    if single:
        told.append(f"Even there off by about 2^29 unit roundoffs, so much as binary32 is coarser: {named(single)}.")
    return told


def computes_in_binary32(bench):
    """Those of binary64 whose backward error, where a dial is at its easiest and no decision wrong, is about the 2^29
    that lie between the precisions."""
    first, losses = {}, {}
    for c in own(bench.cells, "binary64"):
        first[c.dial] = min(c.setting, first.get(c.dial, c.setting))
    for c in own(bench.cells, "binary64"):
        if c.setting == first[c.dial] and c.hits and not c.false_misses + c.false_hits:
            losses.setdefault(c.tracer, []).append(c.backward_p99)
    return [n for n, loss in losses.items() if all(2 ** 26 <= x <= 2 ** 31 for x in loss)]


def absolute_epsilons(bench):
    """Where scaled points are missed though no product under- or overflows there, and unscaled they are hit: a length
    is built in."""
    missed, single = {}, computes_in_binary32(bench)  # where binary32 ends, the latter have underflow
    for row in own(bench.cells):
        if row.dial not in ("tiny", "huge") or not row.hits or row.tracer in single:
            continue
        if FACTORS * row.setting <= EXPONENTS[row.precision]:
            missed.setdefault((row.tracer, row.dial), {})[row.setting] = row.false_misses / row.hits
    found = []
    for (tracer, dial), shares in missed.items():
        worst = min((setting for setting in shares if shares[setting] > 0.9), default=None)
        if worst and shares.get(0, 1) < 0.05:
            found.append(f"`{tracer}` at 2^{'-' if dial == 'tiny' else ''}{worst:g}")
    return found


def symmetries(bench):
    rows, told = own(bench.symmetries), []
    names = distinct(r.tracer for r in rows)
    for what in distinct(r.symmetry for r in rows):
        here = [r for r in rows if r.symmetry == what and r.asked]
        changed = sorted((r for r in here if r.changed), key=lambda r: (-r.changed / r.asked, r.tracer))
        if changed:
            told.append(f"`{what}`: {count(len(changed), 'tracer')} of {len(here)}, most often " +
                        listed([f"`{r.tracer}` ({percent(r.changed / r.asked)})" for r in changed[:3]]))
    if told:
        told = ["Answers that change from hit to miss or back, though the right answer can't. " + "; ".join(told) + "."]
    asked, changing = ({r.tracer for r in rows if getattr(r, what)} for what in ("asked", "changed"))
    never = [n for n in names if n in asked - changing]
    if never:
        told.append(f"None changes with {named(never, 8)}.")
    epsilons = absolute_epsilons(bench)
    if epsilons:
        told.append(f"Absolute epsilons die under scaling: at scales where no product of {FACTORS} coordinates under- "
                    "or overflows, more than nine of ten hits are missed, and unscaled less than one in twenty, by "
                    f"{listed(epsilons, 20)}.")
    return told


def builds(bench):
    rows, told = own(bench.builds), []
    if not rows:
        return ["No tracer here is another build of one that is here."]
    for what in distinct(suffix(r) for r in rows):
        here = [r for r in rows if suffix(r) == what and r.asked]
        differ = sorted((r for r in here if r.differ), key=lambda r: (-r.differ / r.asked, r.tracer))
        if differ:
            worst = differ[0]
            told.append(f"`{what}` changes answers of {len(differ)} of {len(here)}, at most "
                        f"{percent(worst.differ / worst.asked)} of `{worst.tracer}`")
    same = [w for w in distinct(suffix(r) for r in rows) if not any(r.differ for r in rows if suffix(r) == w)]
    told = ["; ".join(told) + "."] if told else []
    if same:
        told.append(f"Without any effect: {named(same, 8)}.")
    sets = [r for r in rows if r.tracer.startswith("embree_") and suffix(r) in INSTRUCTION_SETS and r.differ]
    if sets:
        told.append("Embree's answers depend on the instruction set it is run with: " + listed(
            [f"`{r.tracer}` and `{suffix(r)}` differ in {percent(r.differ / r.asked)}" for r in sets]) + ".")
    return told


def inputs(bench):
    shares, told = wrong_by_inputs(bench), []
    good = [n for n in shares if shares[n]["binary32"] < 0.01]
    perfect = sum(shares[n]["binary32"] == 0 for n in shares)
    if good:
        told.append(f"On binary32 inputs {len(good)} of {count(len(shares), 'binary64 tracer')} {are(len(good))} wrong "
                    f"in less than 1 % of the answers, {perfect} of them never.")
    worse = sorted((-share["binary64"], n) for n, share in shares.items()
                   if share["binary64"] >= 0.001 and share["binary64"] > 5 * share["binary32"])
    if worse:
        told.append("Full mantissas tell more: at least five times as often wrong on them are " + listed(
            [f"`{n}` ({percent(-share)} against {percent(shares[n]['binary32'])})" for share, n in worse], 8) + ".")
    return told


def speed(bench):
    mixed, told = speeds(bench), []
    ranked = sorted(mixed.values(), key=lambda r: (r.ns, r.tracer))
    told.append(f"Fastest on mixed rays is `{ranked[0].tracer}` with {number(ranked[0].ns)} ns a ray, slowest "
                f"`{ranked[-1].tracer}` with {number(ranked[-1].ns)} ns.")
    for way, words in (("single", "A call for each ray instead of one for all"),
                       ("bags", "A triangle prepared for each ray")):
        rows = speeds(bench, way)
        ratios = sorted((rows[n].ns / mixed[n].ns, n) for n in mixed if n in rows and mixed[n].ns > 0)
        if ratios:
            most, who = ratios[-1]
            told.append(f"{words} costs {number(ratios[len(ratios) // 2][0])} times as much in the median, and at most "
                        f"{number(most)} times (`{who}`).")
    wall = [r.tracer for r in ranked if r.clock == "wall"]
    if wall:
        told.append(f"In a process of their own, by the clock on the wall (*): {named(wall)}.")
    return told


def table(bench):
    told = []
    for precision in precisions(bench):
        rows = summary(bench, precision)
        unbeaten = [r.tracer for r in rows if r.beaten_by == 0]
        told.append(f"{precision}: nobody is both faster and more accurate than {named(unbeaten, 8)}.")
        right = [r.tracer for r in rows if r.wrong == 0]
        if right:
            told.append(f"No wrong decision: {named(right, 8)}.")
    return told
