"""The verb scan as users call it: the table, the folder, taking up what was cut off, clear words for bad input.
Argument: the program."""
import csv
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop()


def plumbline(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != code:
        raise AssertionError(f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def rows_of(folder):
    with open(folder / "scan.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Scan(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.mesh = cls.folder / "sphere.ply"
        plumbline("mesh", "make", "sphere", "--triangles", 5000, "--jitter", 0.01, "--precision", "binary32", "-o", cls.mesh)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def scan(self, name, *arguments, code=0):
        return plumbline("scan", self.mesh, "--tracer", "moller_trumbore_f32", "--tracer", "exact", "-o", self.folder / name,
                         *arguments, code=code)

    def findings(self, name):
        """The severity of each."""
        cases = (self.folder / name / "findings").glob("*/*.case")
        return {case.name: float(re.search(r"severity (\S+) ulps", case.read_text())[1]) for case in cases}

    def test_everything_is_in_the_folder(self):
        done = self.scan("all", "--rays", 20000)
        folder = self.folder / "all"
        self.assertEqual(done.stderr, "")
        # Times apart, the file holds what is printed.
        self.assertEqual(re.sub(r"-+ *$", "", (folder / "scan.txt").read_text(), flags=re.M),
                         re.sub(r"-+ *$", "", done.stdout, flags=re.M))
        rows = rows_of(folder)
        self.assertEqual(len(rows), 10)
        self.assertEqual(sum(int(r["rays"]) for r in rows), 40000)
        for row in rows:
            truth = [int(row[f"truth_{k}"]) for k in ("inside", "edge", "vertex", "nothing")]
            self.assertEqual(sum(truth), int(row["rays"]))
            if row["tracer"] == "exact":
                self.assertEqual([row[k] for k in ("leak", "false-hit", "wrong-nearest", "fault")], ["0"] * 4)
        found = sum(int(r["leak"]) + int(r["wrong-nearest"]) + int(r["false-hit"]) for r in rows)
        self.assertGreater(found, 10)
        cases = list((folder / "findings" / "moller_trumbore_f32").glob("*.case"))
        self.assertGreater(len(cases), 2)
        self.assertEqual(list((folder / "findings").iterdir()), [folder / "findings" / "moller_trumbore_f32"])
        for case in (c for c in cases if c.name.endswith(".min.case")):
            text = case.read_text()
            self.assertRegex(text, r"# shrunk: \d+ triangles -> [12], \d+ -> \d+ significant bits")
            self.assertRegex(text, r"# found by scan: \S+sphere\.ply, seed 1, \w+, ray \d+")
            self.assertRegex(text, r"\nknown moller_trumbore_f32 (leak|wrong-nearest|false-hit|false-miss)\n")
        replayed = plumbline("replay", folder / "findings", "--tracer", "moller_trumbore_f32")
        self.assertNotIn("now passes", replayed.stdout)
        again = self.scan("all", "--rays", 20000)
        self.assertRegex(again.stderr, r"all: this scan is complete; nothing is traced again")

    def test_counts_depend_on_the_seed_alone(self):
        self.scan("one", "--rays", 10000, "--jobs", 1, "--no-shrink")
        self.scan("three", "--rays", 10000, "--jobs", 3, "--no-shrink")
        self.scan("other", "--rays", 10000, "--seed", 2, "--no-shrink")
        one, three, other = (rows_of(self.folder / n) for n in ("one", "three", "other"))
        self.assertEqual(one, three)
        self.assertNotEqual(one, other)

    def test_what_was_cut_off_is_taken_up(self):
        self.scan("whole", "--rays", 400000, "--no-shrink")
        for how in (signal.SIGINT, signal.SIGKILL):
            name = f"cut{how}"
            running = subprocess.Popen([PROGRAM, "scan", self.mesh, "--tracer", "moller_trumbore_f32", "--tracer", "exact",
                                        "--rays", "400000", "--no-shrink", "-o", self.folder / name],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            state = self.folder / name / "scan.state"
            while not state.exists() and running.poll() is None:
                time.sleep(0.01)
            running.send_signal(how)
            out, said = running.communicate()
            if how == signal.SIGINT and running.returncode != 0:
                self.assertEqual(running.returncode, 2)
                self.assertRegex(said, r"interrupted: this is of the rays done only; the same command takes it up in ")
                self.assertIn("What the tracers say", out)
            self.scan(name, "--rays", 400000, "--no-shrink")
            self.assertEqual(rows_of(self.folder / name), rows_of(self.folder / "whole"))
            # And nothing that was found is lost, or made less of.
            self.assertEqual(self.findings(name), self.findings("whole"))

    def test_grids_of_shotlines(self):
        done = plumbline("scan", self.mesh, "--tracer", "exact", "--view", 0, 0, 0.1, "--view", -90, 30, 0.25,
                         "-o", self.folder / "grids")
        self.assertIn("view 0 0 0.1", done.stdout)
        rows = rows_of(self.folder / "grids")
        self.assertEqual([r["set"] for r in rows], ["view 0 0 0.1", "view -90 30 0.25"])
        self.assertTrue(361 <= int(rows[0]["rays"]) <= 484)
        both = plumbline("scan", self.mesh, "--tracer", "exact", "--view", 0, 0, 0.1, "--aim", "uniform", "--rays", 100)
        self.assertRegex(both.stdout, r"\nuniform .*\nview 0 0 0\.1 ")

    def test_bad_input(self):
        for arguments, said in (
                (["nowhere.ply"], r"nowhere\.ply: "),
                ([self.mesh, "--tracer", "exakt"], r"did you mean 'exact'"),
                ([self.mesh, "--rays", "-5"], r"--rays"),
                ([self.mesh, "--aim", "corner"], r"--aim"),
                ([self.mesh, "--view", "0", "0", "0"], r"cells of 0: name a positive length"),
                ([self.mesh, "--view", "0", "0", "1e-9"], r"take larger cells"),
                ([self.mesh, "-o", self.mesh], r"sphere\.ply")):
            done = plumbline("scan", *arguments, code=2)
            self.assertRegex(done.stderr, said)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_two_scans_at_once_in_one_folder(self):
        command = [PROGRAM, "scan", self.mesh, "--tracer", "exact", "--rays", "100000000", "-o", self.folder / "twice"]
        first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / "twice" / "scan.state").exists() and first.poll() is None:
            time.sleep(0.01)
        second = subprocess.run(command, capture_output=True, text=True)
        first.kill()
        first.wait()
        self.assertEqual(second.returncode, 2)
        self.assertRegex(second.stderr, r"twice: another scan is at work in it; wait for its end, or name a new folder\n\Z")

    def test_another_scan_in_the_folder_is_left_alone(self):
        self.scan("mine", "--rays", 1000, "--no-shrink")
        before = (self.folder / "mine" / "scan.state").read_text()
        done = self.scan("mine", "--rays", 2000, "--no-shrink", code=2)
        self.assertRegex(done.stderr, r"mine: holds a scan of another mesh, seed, choice of rays or tracers")
        self.assertEqual((self.folder / "mine" / "scan.state").read_text(), before)
        (self.folder / "mine" / "scan.state").write_text(before[:-20] + "x\n")
        done = self.scan("mine", "--rays", 1000, "--no-shrink", code=2)
        self.assertRegex(done.stderr, r"scan\.state: is damaged; remove it")


if __name__ == "__main__":
    unittest.main()
