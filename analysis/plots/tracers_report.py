#!/usr/bin/python3
"""Speed against error, and numerical stability: the figures and the page of `plumbline bench tracers`.

usage: tracers_report.py DIRECTORY

DIRECTORY holds the CSV files and run.json that the verb writes; the figures as PNG and SVG, and index.html, join them.
"""
import argparse
from types import SimpleNamespace

import tracers_figures as figures
import tracers_findings as findings
from figure import save
from tracers_data import own, precisions, read
from tracers_page import page


def shown(name, title, what, tables, draw, see, drawn=True):
    return SimpleNamespace(name=name, title=title, what=what, tables=tables, draw=draw, see=see, drawn=drawn)


def plan(bench):
    """What the page shows, in its order."""
    kinds, bound = precisions(bench), f"{bench.run.stable_bound:g}"

    def each(name, title, tables, what):
        draw, see = getattr(figures, name), getattr(findings, name)
        return [shown(f"{name}_{p}", f"{title}: {p} tracers", what, tables, lambda b, p=p: draw(b, p),
                      lambda b, p=p: see(b, p)) for p in kinds]

    def one(name, title, tables, what, drawn=True):
        return [shown(name, title, what, tables, getattr(figures, name), getattr(findings, name), drawn)]

    return [
        *one("pareto", "Speed against error", ("verdicts", "speed"),
             "Each point is a tracer: down is more accurate, left is faster. Blue are those that no other beats in "
             "both that tells no less: who reports no u and v can't be wrong in them. The line joins those that tell "
             "t, u and v. Errors of half an ulp or less are what rounding costs anyone, and lie on the band at the "
             "bottom; the upper end is an error as large as the largest coordinate, or more. The dashed line is what `exact` "
             "takes."),
        *each("pareto_families", "Speed against error, family by family", ("verdicts", "speed"),
              "As above, the error being the 99th percentile at the family's worst setting; the numbers are explained "
              "at the top."),
        *each("forward", "Error over difficulty", ("cells",),
              "Each family has a dial, from easy to as hard as the precision holds; the axes say what it counts. "
              "Errors are from half an ulp (rounding alone) to as large as the largest coordinate. An edge met "
              "exactly and missed is wrong by a distance of 0: `lattice` is told of below."),
        *each("backward", "Backward error over difficulty", ("cells",),
              f"What the algorithm loses, apart from what the problem does. Above the dashed line, {bound} unit "
              "roundoffs, an algorithm is called unstable."),
        *one("condition", "Error of t against the condition number", ("conditions",),
             "The condition number says by how much the problem enlarges a relative error of its input. What a "
             f"backward stable algorithm returns lies about the dashed diagonal and below the dotted line, {bound} times "
             f"it. Medians of {figures.FEWEST} hits or more, of all families.",
             any(figures.conditions_of(bench, p) for p in kinds)),
        *each("verdicts", "Where tracers leave their bound", ("verdicts",),
              f"The setting at which the 99th percentile of the backward error first exceeds {bound} unit roundoffs: "
              "the darker, the earlier on the dial, whose last setting stands below. A dot: never. Hatched: it "
              "answered nothing."),
        *one("inputs", "Doubles on binary32 inputs", ("verdicts",),
             "Tracers of binary64 on numbers that binary32 holds, and on full mantissas, of all families but those "
             f"whose dials go as far as the exponents ({', '.join(figures.AS_FAR_AS_EXPONENTS)}).",
             bool(figures.wrong_by_inputs(bench))),
        *one("symmetries", "Symmetries", ("symmetries",),
             "Each case again with points scaled by 2^12 or 2^-12, axes turned, vertices turned, all moved by a small "
             "whole vector where that is exact, the direction scaled by 2^5 or 2^-5. The right answer stays; a dot: so "
             "did the tracer's, always."),
        *one("builds", "Builds", ("builds",),
             "The same algorithm built or run in another way: fused multiply-add, -ffast-math, subnormals flushed to "
             "zero, instruction sets, widths, or in part.", bool(own(bench.builds))),
        *one("speed", "Speed", ("speed",),
             "Time a ray over that of `moller_trumbore_f64` in the same moments: 1,024 rays that hit, miss, or both at "
             "one triangle; a call for each; a triangle prepared for each; and rays that no cache holds. All through "
             "the tracers' interface, which costs some nanoseconds a call."),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    directory = parser.parse_args().directory
    bench = read(directory)
    sections = plan(bench)
    for one in sections:
        one.seen = one.see(bench)
        if one.drawn:
            save(one.draw(bench), directory, one.name)
    page(directory, bench, sections)


if __name__ == "__main__":
    main()
