"""`plumbline bench tracers` as a user meets it: the page and its figures, counts that stay, sentences that come and go
with the data, trouble told in one line with exit code 2. Argument: the program."""
import contextlib
import csv
import io
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

PLOTS = pathlib.Path(__file__).resolve().parents[2] / "analysis" / "plots"
sys.path.insert(0, str(PLOTS))
import labels  # noqa: E402
import tracers_data as data  # noqa: E402
import tracers_findings as findings  # noqa: E402
import tracers_report  # noqa: E402
from figure import pyplot  # noqa: E402

PROGRAM = sys.argv.pop()
INF = float("inf")
TRACERS = ("moller_trumbore_f32", "moller_trumbore_f32_fma", "woop_watertight_f64", "exact")
DIALS = ("lattice", "far")
COUNTED = ("cells", "verdicts", "symmetries", "builds", "conditions", "tracers")
FIGURES = ("pareto", "pareto_families_binary32", "pareto_families_binary64", "forward_binary32", "forward_binary64",
           "backward_binary32", "backward_binary64", "condition", "verdicts_binary32", "verdicts_binary64", "inputs",
           "symmetries", "builds", "speed")
# What a row has where a test says nothing else.
ROWS = {
    "cells": dict(tracer="exact", precision="binary64", inputs="binary64", dial="tiny", setting=0, cases=10, hits=10,
                  false_misses=0, false_hits=0, unspecified=0, faults=0, t_count=5, u_count=5, forward_p99=0.25,
                  backward_p99=0.5),
    "verdicts": dict(tracer="exact", precision="binary64", inputs="binary64", dial="tiny", stable=1, leaves_at="",
                     slope=0, wrong=0, answers=100, forward_p99=0.25, backward_p99=0.5, backward_worst=0.75),
    "symmetries": dict(tracer="exact", precision="binary64", inputs="binary64", symmetry="scale", asked=10, changed=0),
    "builds": dict(tracer="embree_robust", variant="embree_robust_sse2", precision="binary32", inputs="binary32",
                   asked=100, differ=0),
    "conditions": dict(tracer="exact", precision="binary64", inputs="binary64", log2_condition=1, count=50,
                       median=0.5, p99=1),
    "speed": dict(tracer="exact", way="mixed", ns=50, ratio=10, clock="processor"),
    "tracers": dict(tracer="exact", precision="binary64", package="", summary="the control"),
}
RUN = dict(command="plumbline bench tracers", version="1", machine="a", compiler="b", seed=1, cases=10, stable_bound=64,
           rounds=3, slice_seconds=2e-4, dials={"tiny": "1 over scale, log2", "lattice": "bits of a coordinate"})


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def bench(folder, *more, tracers=TRACERS):
    named = [word for option, names in (("--tracer", tracers), ("--dial", DIALS)) for name in names
             for word in (option, name)]
    return plumbline("bench", "tracers", "--quick", "--cases", 20, *named, "-o", folder, *more)


def draw(folder):
    command = ["/usr/bin/python3", "-B", PLOTS / "tracers_report.py", folder]
    return subprocess.run(command, capture_output=True, text=True)


def write(folder, **tables):
    """Hand-made results: of each table the rows given, each with what it has else; one row where none is given."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, usual in ROWS.items():
        with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, usual)
            writer.writeheader()
            writer.writerows({**usual, **row} for row in tables.get(name, [{}]))
    (folder / "run.json").write_text(json.dumps(RUN))


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name) / "bench"


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name) / "one"
        cls.done = bench(cls.folder)

    def test_is_made_with_every_figure(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertTrue(self.done.stdout.endswith(f"{self.folder}/index.html\n"))
        for name in FIGURES:
            self.assertTrue((self.folder / f"{name}.png").read_bytes().startswith(b"\x89PNG"), name)
            self.assertIn("</svg>", (self.folder / f"{name}.svg").read_text(), name)
        files = {path.name for path in self.folder.iterdir()}
        self.assertEqual(files, {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
                         | {f"{name}.csv" for name in COUNTED + ("speed",)} | {"run.json", "index.html"})

    def test_needs_nothing_beside_it(self):
        page = (self.folder / "index.html").read_text()
        self.assertEqual(page.count('src="data:image/png;base64,'), len(FIGURES))
        self.assertEqual(set(re.findall(r'(?:src|href)="(.)', page)), {"d", "#"})
        self.assertIsNone(re.search(r"http|<script|<link|url\(|@import", page))
        for name in TRACERS:
            self.assertIn(f"<td><code>{name}</code></td>", page)
        for fact in ("plumbline bench tracers --seed 1 --quick --cases 20", "(seed 1)", "20 seeded random cases"):
            self.assertIn(fact, page)

    def test_counts_are_the_same_in_every_run_and_company(self):
        again = self.folder.parent / "again"
        done = bench(again, "--jobs", 1, tracers=[name for name in TRACERS if "f32" in name])
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in COUNTED:
            lines = (again / f"{name}.csv").read_text().splitlines()
            self.assertGreater(len(lines), 1, name)
            self.assertLessEqual(set(lines), set((self.folder / f"{name}.csv").read_text().splitlines()), name)

    def test_the_same_tables_give_the_same_files(self):
        again = self.folder.parent / "redrawn"
        again.mkdir()
        for path in itertools.chain(self.folder.glob("*.csv"), self.folder.glob("run.json")):
            shutil.copy(path, again)
        done = draw(again)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        for path in self.folder.iterdir():
            self.assertEqual(path.read_bytes(), (again / path.name).read_bytes(), path.name)


class HandMade(Scratch):
    def read(self, **tables):
        write(self.folder, **tables)
        return data.read(self.folder)

    def told(self, see, *more, **tables):
        return " ".join(see(self.read(**tables), *more))

    def test_watertight_is_not_closed_where_it_misses(self):
        def told(missed):
            return self.told(findings.forward, "binary64", cells=[
                {"tracer": "woop_watertight_f64", "dial": "lattice", "hits": 100, "false_misses": missed}])
        self.assertIn("`woop_watertight_f64` isn't closed on a single triangle: of 100 rays that meet an edge or vertex "
                      "of `lattice` exactly it misses 25 % (18 % to 34 %)", told(25))
        self.assertNotIn("isn't closed", told(0))
        self.assertIn("no ray of `lattice` is missed by `woop_watertight_f64`", told(0))

    def test_absolute_epsilons_are_told_from_underflow(self):
        def told(*misses):
            return self.told(findings.symmetries, cells=[
                {"tracer": "mine", "setting": setting, "false_misses": missed} for setting, missed in misses])
        self.assertIn("less than one in twenty, by `mine` at 2^-100.", told((0, 0), (100, 10), (200, 10), (400, 10)))
        self.assertNotIn("epsilon", told((0, 0), (100, 0), (200, 0), (300, 10)))  # 2^-1200: underflow
        self.assertNotIn("epsilon", told((0, 1), (100, 10)))  # misses anyway
        self.assertNotIn("epsilon", told((0, 0), (100, 9)))

    def test_who_computes_in_binary32(self):
        def told(*losses):
            return self.told(findings.verdicts, "binary64", verdicts=[{"tracer": "mine"}], speed=[{"tracer": "mine"}], cells=[
                {"tracer": "mine", "setting": 10 * i, "backward_p99": loss} for i, loss in enumerate(losses)])
        self.assertIn("so much as binary32 is coarser: `mine`.", told(2 ** 29, 1))
        self.assertEqual(told(100, 2 ** 29), "")
        self.assertEqual(told(INF), "")

    def test_embree_by_instruction_set(self):
        self.assertIn("Embree's answers depend on the instruction set it is run with: `embree_robust` and `sse2` differ "
                      "in 5 %.", self.told(findings.builds, builds=[{"differ": 5}]))
        self.assertEqual(self.told(findings.builds), "Without any effect: `sse2`.")
        other = [{"tracer": "my", "variant": "my_sse2", "differ": 5}]
        self.assertNotIn("Embree", self.told(findings.builds, builds=other))
        self.assertIn("No tracer here is another build", self.told(findings.builds, builds=[]))

    def test_doubles_look_good_on_binary32_inputs(self):
        def told(on_single, on_double, dial="lattice"):
            return self.told(findings.inputs, verdicts=[
                {"inputs": "binary32", "wrong": on_single, "answers": 1000, "dial": dial},
                {"inputs": "binary64", "wrong": on_double, "answers": 1000, "dial": dial}])
        self.assertIn("On binary32 inputs 1 of 1 binary64 tracer is wrong in less than 1 % of the answers, 1 of them "
                      "never.", told(0, 90))
        self.assertIn("wrong on them are `exact` (9 % against 0.2 %)", told(2, 90))
        self.assertNotIn("Full mantissas", told(2, 10))
        self.assertNotIn("less than 1 %", told(10, 90))
        self.assertEqual(told(0, 90, dial="tiny"), "")  # goes on where binary32 ends

    def test_the_price_of_exact(self):
        rows = dict(verdicts=[{}, {"tracer": "mine", "wrong": 1}],
                    speed=[{}, {"tracer": "mine", "ns": 60}])
        told = self.told(findings.pareto, **rows)
        self.assertIn("Zero costs 50 ns a ray: `exact` takes 10 times as long", told)
        self.assertIn("1 tracer of 1 is slower than `exact` and wrong: `mine`.", told)
        rows["speed"][1]["ns"] = 40
        self.assertNotIn("slower than `exact`", self.told(findings.pareto, **rows))
        alone = [{"tracer": "mine"}]
        self.assertNotIn("Zero costs", self.told(findings.pareto, verdicts=alone, speed=alone))

    def test_stability(self):
        told = self.told(findings.backward, "binary64", verdicts=[
            {}, {"tracer": "mine", "stable": 0, "leaves_at": 100}, {"tracer": "yours", "stable": 0, "leaves_at": 0},
            {"tracer": "silent", "answers": 0}],
            speed=[{"tracer": name} for name in ("exact", "mine", "yours", "silent")])
        self.assertIn("within 64 unit roundoffs at each setting: `exact`.", told)
        self.assertIn("Most tracers are unstable on `tiny` (2 of 3).", told)
        self.assertNotIn("None is on", told)
        self.assertIn("None is on `tiny`", self.told(findings.backward, "binary64"))

    def test_who_is_beaten(self):
        verdicts, cells, speed = [], [], []
        for name, ns, error, uv in (("fast", 5, 1024, 1), ("slow", 9, 1024, 1), ("exact", 50, 0.25, 1),
                                    ("as_good", 60, 0.125, 1), ("quiet", 20, 1, 0), ("nan", 4, INF, 1)):
            verdicts.append({"tracer": name, "forward_p99": error})
            cells.append({"tracer": name, "u_count": uv})
            speed.append({"tracer": name, "ns": ns})
        made = self.read(verdicts=verdicts, cells=cells, speed=speed)
        best = data.unbeaten(data.points(made, "binary64"))
        self.assertEqual([p.tracer for p in best], ["nan", "fast", "quiet", "exact"])
        rows = data.summary(made, "binary64")
        self.assertEqual([(r.tracer, r.beaten_by) for r in rows],
                         [("exact", 0), ("quiet", 0), ("fast", 0), ("nan", 0), ("as_good", 1), ("slow", 1)])

    def test_errors_over_all_families(self):
        def overall(*errors):
            made = self.read(verdicts=[{"dial": dial, "forward_p99": e, "answers": n}
                                       for dial, (e, n) in zip(("tiny", "lattice"), errors)])
            return data.points(made, "binary64")[0].error
        self.assertEqual(overall((2, 1), (8, 1)), 4)
        self.assertEqual(overall((0, 1), (8, 1)), 2)  # no less than half an ulp
        self.assertEqual(overall((INF, 1), (2, 1)), 2 ** 27)  # no more than 2^53
        self.assertEqual(overall((INF, 0), (2, 1)), 2)  # without an answer

    def test_confidence(self):
        self.assertEqual(data.interval(0, 0), (0, 1))
        for whole in (1, 100, 135200):
            self.assertEqual(data.interval(0, whole)[0], 0)
            self.assertEqual(data.interval(whole, whole)[1], 1)
        self.assertEqual(round(data.interval(0, 100)[1], 4), 0.0370)
        self.assertEqual([round(x, 4) for x in data.interval(5, 10)], [0.2366, 0.7634])

    def test_draws_what_little_there_is_whatever_its_name(self):
        name = "./<script>alert(1)</script>$\\frac{$.so"
        write(self.folder, builds=[], conditions=[], **{
            table: [{"tracer": name}] for table in ("cells", "verdicts", "symmetries", "speed", "tracers")})
        done = draw(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.folder / "index.html").read_text()
        self.assertNotIn("<script", page)
        self.assertIn("./&lt;script&gt;alert(1)&lt;/script&gt;$\\frac{$.so", page)
        self.assertIn("No tracer here is another build", page)
        self.assertFalse((self.folder / "builds.png").exists())


class Labels(unittest.TestCase):
    def test_stand_apart_in_a_crowd(self):
        figure, axes = pyplot.subplots(figsize=(4, 4))
        places = [(1 + i * 0.02, 1 + (i % 3) * 0.01) for i in range(8)]
        axes.plot(*zip(*places), "o")
        axes.set_xlim(0, 3), axes.set_ylim(0, 3)
        figure.canvas.draw()
        labels.place_labels(axes, [(x, y, f"a_tracer_{i}") for i, (x, y) in enumerate(places)], places)
        renderer = figure.canvas.get_renderer()
        boxes = [labels.text_box(text, renderer) for text in axes.texts]
        self.assertEqual(len(boxes), len(places))
        frame = axes.get_window_extent(renderer).extents
        for box in boxes:
            self.assertEqual(labels.outside(box, frame), 0)
        for one, other in itertools.combinations(boxes, 2):
            self.assertEqual(labels.overlap(one, other), 0)
        pyplot.close(figure)


class Trouble(Scratch):
    def assert_refused(self, words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), self.assertRaises(SystemExit) as stopped, \
                unittest.mock.patch("sys.argv", ["tracers_report.py", str(self.folder)]):
            tracers_report.main()
        self.assertEqual((stopped.exception.code, out.getvalue()), (2, ""))
        self.assertRegex(err.getvalue(), rf"\Atracers_report\.py: [^\n]*{words}[^\n]*\n\Z")
        self.assertFalse((self.folder / "index.html").exists())

    def test_of_the_tables_is_one_line(self):
        self.assert_refused(r"cells\.csv: No such file")
        write(self.folder)
        (self.folder / "cells.csv").write_text("tracer,precision\nexact,binary64\n")
        self.assert_refused(r"cells\.csv: no column inputs, dial")
        write(self.folder, verdicts=[])
        self.assert_refused(r"verdicts\.csv: no rows")
        write(self.folder, cells=[{}, {"hits": "many"}])
        self.assert_refused(r"cells\.csv: row 2 isn't what plumbline writes")
        write(self.folder, symmetries=[{"precision": "binary16"}])
        self.assert_refused(r"symmetries\.csv: row 1: precision is neither binary32 nor binary64")
        write(self.folder, speed=[{"way": "hits"}])
        self.assert_refused(r"speed\.csv: exact has no row 'mixed'")
        write(self.folder, verdicts=[{"answers": 0}])
        self.assert_refused(r"verdicts\.csv: no tracer answered anything")
        write(self.folder)
        (self.folder / "run.json").write_text("{")
        self.assert_refused(r"run\.json: isn't JSON")
        (self.folder / "run.json").write_text("{}")
        self.assert_refused(r"run\.json: no command, version")
        (self.folder / "run.json").unlink()
        self.assert_refused(r"run\.json: No such file")

    def assert_not_begun(self, done, *words):
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse(self.folder.exists())

    def test_of_the_verb_leaves_nothing(self):
        self.assert_not_begun(bench(self.folder, "--tracer", "nobody"), "nobody")
        self.assert_not_begun(bench(self.folder, "--dial", "nothing"), "nothing")
        none = plumbline("bench", "tracers", "--tracer", "exact", "--cases", 0, "-o", self.folder)
        self.assert_not_begun(none, "no case")
        self.assert_not_begun(plumbline("bench", "tracers", "--quick"), "-o")
        blocked = self.folder.parent / "file"
        blocked.write_text("mine")
        for folder in (blocked, blocked / "within"):
            self.assert_not_begun(bench(folder), str(folder))
        self.assertEqual(blocked.read_text(), "mine")

    def test_an_interrupted_run_leaves_no_part(self):
        command = [PROGRAM, "bench", "tracers", "--tracer", "exact", "--cases", "1000000", "--quick", "-o", self.folder]
        started = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not list(self.folder.glob("run.json.*")) and started.poll() is None:
            time.sleep(0.05)
        os.kill(started.pid, signal.SIGINT)
        out, err = started.communicate(timeout=60)
        self.assertEqual((started.returncode, out), (2, ""), err)
        self.assertRegex(err, r"\Aplumbline: interrupted: nothing was written[^\n]*\n\Z")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
