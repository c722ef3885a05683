"""The verbs sweep and lattice as others call them: the JSON contract, files that appear whole or not at all, one line
and exit code 2 for bad input. Argument: the program."""
import csv
import io
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop()
KEYS = {"tracer", "target", "tolerance", "attempts", "successes", "exact_successes", "harness_errors", "false_misses",
        "false_hits", "lucky", "unspecified", "faults"}


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


class Sweep(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def test_json_of_every_tracer(self):
        done = plumbline("sweep", "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = [json.loads(line) for line in done.stdout.splitlines()]
        for row in rows:
            self.assertLessEqual(KEYS, row.keys())
            self.assertEqual(row["tolerance"] is None, row["target"] != "tolerance")
            self.assertEqual(row["harness_errors"], row["attempts"] - row["exact_successes"])
        self.assertEqual([row["successes"] for row in rows if row["tracer"] == "brlcad_bot_classic"],
                         [1344, 1710, 5802, 5772, 5528])
        self.assertEqual([(row["target"], row["tolerance"]) for row in rows[:5]],
                         [("interior", None), ("vertex_edge", None), ("tolerance", 0.1), ("tolerance", 0.001),
                          ("tolerance", 1e-05)])

    def test_defaults_are_the_reports(self):
        spelt_out = plumbline("sweep", "--box", "2", "2", "2", "--step", "1.5", "--tolerance", "0.1", "--tolerance",
                              "0.001", "--tolerance", "0.00001", "--standoff", "5", "--normal", "divide", "--mode",
                              "plate", "--thickness", "0.1", "--offset", "0", "0", "0", "--jobs", "3", "--json")
        self.assertEqual(spelt_out.stdout, plumbline("sweep", "--json").stdout)

    def test_files_hold_what_is_printed(self):
        where = self.directory / "a" / "b"
        done = plumbline("sweep", "--tracer", "exact", "--count", "50", "--json", "-o", str(where), "--csv",
                         str(self.directory / "x.csv"), "--markdown", str(self.directory / "x.md"))
        self.assertEqual(done.returncode, 0)
        self.assertEqual(sorted(path.name for path in where.iterdir()), ["sweep.csv", "sweep.json", "table.md"])
        self.assertEqual((where / "sweep.json").read_text(), done.stdout)
        self.assertEqual((where / "sweep.csv").read_text(), (self.directory / "x.csv").read_text())
        self.assertEqual((where / "table.md").read_text(), (self.directory / "x.md").read_text())
        self.assertEqual(len(list(csv.DictReader(io.StringIO((where / "sweep.csv").read_text())))), 5)

    def test_bad_input_is_one_line_and_leaves_nothing(self):
        into = self.directory / "out"
        for arguments, words in (
                (["--step", "0"], "step along x: 0 is not positive; give"),
                (["--step", "-1"], "step along x: -1 is not positive; give"),
                (["--step", "3"], "larger than the box"),
                (["--step", "1", "1"], "--step: two numbers; give one, or"),
                (["--step", "nan"], "--step 'nan': not a decimal number"),
                (["--box", "2", "two", "2"], "--box 'two': not a decimal number"),
                (["--tolerance", "0"], "tolerance 0: not positive"),
                (["--standoff", "-5"], "standoff -5: not positive"),
                (["--tracer", "nobody"], "nobody"),
                (["--tracer", "exact", "exact"], "given twice"),
                (["--jobs", "0"], "--jobs"),
                (["--normal", "unit"], "--normal"),
                (["--mode", "blob"], "--mode"),
                (["--first", "512"], "triples [0, 512)"),
                (["--box", "2", "--step", "1"], "--box: 3 numbers X Y Z, before '--step'"),
                (["--offset", "1", "-.5", "--json"], "--offset: 3 numbers X Y Z, before '--json'"),
                (["--first", "-1"], "--first: '-1' is no whole number below 2^64; write digits alone, like 1000"),
                (["--first", "99999999999999999999"], "--first: '99999999999999999999' is no whole number below 2^64"),
                (["--count", "1e3"], "--count: '1e3' is no whole number"),
                (["--count", "513"], "only 512"),
                (["--csv", str(self.directory / "no" / "x.csv")], "x.csv: cannot be opened for writing: No such"),
                (["--csv", "/dev/full"], "/dev/full: cannot be written: No space left on device; make room"),
                (["--csv", "-"], "-: goes where the table goes; name another file"),
                (["--csv", "same", "--markdown", "./same"], "./same: goes where same goes"),
                (["--csv", str(into / "sweep.csv")], "goes where")):
            done = plumbline("sweep", "-o", str(into), *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z", arguments)
            self.assertIn(words, done.stderr)
            self.assertEqual(list(into.iterdir()) if into.exists() else [], [], arguments)

    def test_folder_that_cannot_be_made(self):
        done = plumbline("sweep", "-o", "/dev/null/x")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (
            2, "", "plumbline: /dev/null/x: cannot be made a folder: Not a directory; write elsewhere\n"))

    def test_interrupted_says_where_to_go_on(self):
        sweep = [PROGRAM, "sweep", "--step", "0.05", "--tracer", "exact", "--json", "-o", str(self.directory)]
        sweep += ["--first", "1000", "--count", "300000000000"]
        with subprocess.Popen(sweep, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
            with self.assertRaises(subprocess.TimeoutExpired):
                running.wait(1)
            running.send_signal(signal.SIGINT)
            out, err = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 2)
        said = re.fullmatch(r"plumbline: interrupted: this is of the triples \[1000, (\d+)\) only, .* "
                            r"--first (\d+) --count (\d+)\n", err)
        self.assertTrue(said, err)
        end, first, count = map(int, said.groups())
        self.assertEqual((first, first + count), (end, 300000001000))
        self.assertEqual(len(out.splitlines()), 5)
        self.assertEqual(list(self.directory.iterdir()), [])

    def test_ended_leaves_no_unfinished_file(self):
        for signals in ([signal.SIGTERM], [signal.SIGINT, signal.SIGINT]):
            with self.subTest(signals), subprocess.Popen(
                    [PROGRAM, "sweep", "--step", "0.05", *(["--standoff"] + [str(h) for h in range(1, 2000)]),
                     "-o", str(self.directory)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as running:
                with self.assertRaises(subprocess.TimeoutExpired):
                    running.wait(1)
                self.assertEqual(len(list(self.directory.iterdir())), 3)
                for number in signals:
                    running.send_signal(number)
                    time.sleep(0.1)
                self.assertEqual(running.wait(timeout=60), -signals[-1])
                self.assertEqual(list(self.directory.iterdir()), [])

    def test_negative_offset(self):
        rows = plumbline("lattice", "--offset", "-.5", "-.25", "-1", "--first", "10", "--count", "1").stdout
        self.assertEqual(rows.splitlines()[1], "10,-0.5,-0.25,-1,-0.5,-0.25,0.5,-0.5,1.25,-1")

    def test_lattice_prints_every_triangle(self):
        rows = list(csv.DictReader(io.StringIO(plumbline("lattice").stdout)))
        self.assertEqual(len(rows), 336)
        self.assertEqual(list(rows[0].values()), ["10", "0", "0", "0", "0", "0", "1.5", "0", "1.5", "0"])
        part = plumbline("lattice", "--first", "10", "--count", "1").stdout
        self.assertEqual(part, "index,ax,ay,az,bx,by,bz,cx,cy,cz\n10,0,0,0,0,0,1.5,0,1.5,0\n")


unittest.main()
