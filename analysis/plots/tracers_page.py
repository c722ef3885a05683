"""One HTML page of what `plumbline bench tracers` measured: figures with what is seen in them, the table of tracers,
how it was measured. It needs nothing beside it: pictures are in the page, there is no script."""
import base64
import html
import pathlib
import re

import tracers_findings as findings
from figure import fail
from tracers_data import LEAST, TELLS, dials, precisions, summary, tracers
from tracers_findings import number

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #1b2226; background: #fff; max-width: 62rem;
       margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
code { font: 0.88em "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.1rem 1rem; }
dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 40rem) { dl { grid-template-columns: 1fr; } dd { margin: 0 0 0.4rem; } }
figure { margin: 1rem 0; } .wide { overflow-x: auto; }
figure img { display: block; width: 100%; min-width: 34rem; max-width: var(--width); height: auto; margin: 0 auto; }
table { border-collapse: collapse; font-size: 0.85rem; white-space: nowrap; }
th, td { padding: 0.15rem 0.6rem; text-align: right; border-bottom: 1px solid #dfe7ec; }
th { vertical-align: bottom; white-space: normal; } td:first-child, th:first-child { text-align: left; }
tr.exact { background: #eef3f6; font-weight: 600; }
nav ul { columns: 2; padding-left: 1.2rem; } .note { color: #55626a; font-size: 0.9rem; }
a { color: #00567f; }
"""

MEANINGS = (
    "<b>Forward error</b>: how far off an answer is, measured exactly, in units in the last place (ulps) of the "
    "largest coordinate, at the tracer's precision. Of a right hit: how far its t, u and v lie from where they should. "
    "Of a wrong decision: how far the ray would have to move for it to be right.",
    "<b>Sensitivity</b>: how far the right t, u and v move where every coordinate moves by a relative 1. It belongs to "
    "the problem: on grazing rays or slivers it is large for everybody.",
    "<b>Backward error</b>: forward error over sensitivity, so the least relative change of the input that would make "
    "the answer right, in unit roundoffs (2<sup>−24</sup> or 2<sup>−53</sup>). It belongs to the algorithm.",
    "<b>Stable</b> is whose backward error stays within {bound:g} unit roundoffs in 99 of 100 cases, however hard.",
    "<b>p99</b>: 99 of 100 cases are no worse. A family's figure is that of its worst setting.",
    "binary32 tracers are put binary32 inputs and binary64 tracers full mantissas, unless said otherwise. An ulp of "
    "one is 2<sup>29</sup> ulps of the other, so the two are never in one panel.",
)


def marked(text):
    """Escaped, with what is between backticks as code."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text))


def picture(directory, name, alt):
    try:
        data = pathlib.Path(f"{directory}/{name}.png").read_bytes()
    except OSError as error:
        fail(f"{directory}/{name}.png: {error.strerror}")
    width = int.from_bytes(data[16:20], "big") / 160 * 96  # drawn at 160 dots an inch
    source = base64.b64encode(data).decode()
    return (f'<figure><div class="wide"><img style="--width: {1.25 * width:.0f}px" alt="{html.escape(alt)}" '
            f'src="data:image/png;base64,{source}"></div></figure>')


def section(directory, shown):
    """Title, what is drawn, picture, what is seen."""
    seen = "".join(f"<li>{marked(sentence)}</li>" for sentence in shown.seen)
    files = []
    if shown.drawn:
        files = [f"{shown.name}.png", f"{shown.name}.svg", *(f"{table}.csv" for table in shown.tables)]
    return (f'<h2 id="{shown.name}">{html.escape(shown.title)}</h2>\n<p>{marked(shown.what)}</p>\n'
            + (picture(directory, shown.name, shown.title) if shown.drawn else "")
            + (f"<ul>{seen}</ul>\n" if seen else "")
            + (f'<p class="note">In this folder: {", ".join(files)}</p>\n' if files else ""))


COLUMNS = ("tracer", "tells", "beaten by", "ns a ray", "times moller_trumbore_f64",
           "wrong answers, % (95 % confidence)", "p99 error, ulps: mean over families", "of the worst",
           "worst backward error, unit roundoffs", "stable families", "left open, %")


def table(bench, precision):
    head = "".join(f"<th>{html.escape(column)}</th>" for column in COLUMNS)
    lines = []
    for r in summary(bench, precision):
        cells = (f"<code>{html.escape(r.tracer)}</code>", TELLS[r.tells], r.beaten_by, number(r.ns, 3),
                 number(r.ratio, 3), f"{number(100 * r.wrong)} ({number(100 * r.low)} – {number(100 * r.high)})",
                 "≤ ½" if r.error <= LEAST else number(r.error), number(r.worst), number(r.backward),
                 f"{r.stable} of {r.families}", number(100 * r.open))
        kind = ' class="exact"' if r.tracer == "exact" else ""
        lines.append(f"<tr{kind}>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{"".join(lines)}</tbody></table></div>'


def tables(bench):
    seen = "".join(f"<li>{marked(sentence)}</li>" for sentence in findings.table(bench))
    parts = [f"<h3>{precision} tracers</h3>\n{table(bench, precision)}\n" for precision in precisions(bench)]
    what = ("Sorted by how many others of the same precision are faster and more accurate, or as good in one of these, "
            "and tell no less: t, u and v, t alone, or hit or miss. Wrong answers are counted over all settings of all "
            "families; error is the geometric mean over families, each held between half an ulp and the largest "
            "coordinate. Left open is what a tracer's contract doesn't promise or what it can't be asked: neither is "
            "counted against it, so who answers little looks better than it is.")
    return f'<h2 id="table">All tracers</h2>\n<p>{html.escape(what)}</p>\n<ul>{seen}</ul>\n{"".join(parts)}'


def head(bench):
    run = bench.run
    settings = len({(c.inputs, c.dial, c.setting) for c in bench.cells})
    facts = (
        ("made by", f"<code>{html.escape(run.command)}</code>"),
        ("version", f"plumbline {html.escape(run.version)}, {html.escape(run.compiler)}"),
        ("machine", html.escape(run.machine)),
        ("cases", f"{sum(int(c.cases) for c in bench.cells):,} answers judged exactly: {run.cases:,} seeded random "
                  f"cases (seed {run.seed}) at each of {settings} settings of {len(dials(bench))} families"),
        ("tracers", ", ".join(f"{len(tracers(bench, p))} of {p}" for p in precisions(bench))),
        ("times", f"medians of {run.rounds} interleaved repetitions of {1000 * run.slice_seconds:g} ms, one thread"),
    )
    return "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in facts)


def page(directory, bench, shown):
    """`shown`: what section() takes, in order; the table follows the first."""
    sections = [section(directory, one) for one in shown]
    links = "".join(f'<li><a href="#{name}">{html.escape(title)}</a></li>'
                    for name, title in [(s.name, s.title) for s in shown[:1]] + [("table", "All tracers")]
                    + [(s.name, s.title) for s in shown[1:]])
    meanings = "".join(f"<li>{meaning.format(bound=bench.run.stable_bound)}</li>" for meaning in MEANINGS)
    text = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Ray/triangle tracers: speed against error</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Ray/triangle tracers: speed against error, and numerical stability</h1>
<dl>{head(bench)}</dl>
<h2>How to read it</h2>
<ul>{meanings}</ul>
<nav><ul>{links}</ul></nav>
{sections[0]}{tables(bench)}{"".join(sections[1:])}</body>
</html>
"""
    try:
        pathlib.Path(f"{directory}/index.html").write_text(text, encoding="utf-8")
    except OSError as error:
        fail(f"{directory}/index.html: {error.strerror}")
