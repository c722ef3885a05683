"""The verb watertight as others call it. Argument: the program."""
import csv
import io
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


class Watertight(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def rows(self, text):
        return {(r["tracer"], r["precision"], r["test"]): r for r in csv.DictReader(io.StringIO(text))}

    def test_one_command_tells_leaks_and_double_hits(self):
        file = self.directory / "leaks.csv"
        done = plumbline("watertight", "--tracer", "moller_trumbore_f32", "--tracer", "exact", "--rays", "200",
                         "-o", str(file))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for title in ("closed spheres", "sheets, overlaps, a lattice, grazing rays"):
            self.assertIn(title + ": 200 rays a column", done.stdout)
        rows = self.rows(file.read_text())
        self.assertEqual(len(rows), 14 + 2 * 14)  # of binary64 inputs exact alone
        self.assertGreater(int(rows["moller_trumbore_f32", "binary32", "pair, ulp"]["leaks"]), 0)
        self.assertGreater(int(rows["moller_trumbore_f32", "binary32", "fan, ulp"]["doubles"]), 0)
        for (tracer, *_), row in rows.items():
            self.assertEqual(row["rays"], "200")
            if tracer == "exact":
                self.assertEqual({row[k] for k in row if k not in ("tracer", "precision", "test", "rays")}, {"0"})

    def test_neither_jobs_nor_the_file_change_the_counts(self):
        one, two = self.directory / "one.csv", self.directory / "two.csv"
        common = ("watertight", "--tracer", "plucker_f32", "--rays", "100", "--seed", "3")
        first = plumbline(*common, "--jobs", "1", "-o", str(one))
        second = plumbline(*common, "--jobs", "3", "-o", str(two))
        self.assertEqual((first.returncode, first.stdout), (second.returncode, second.stdout))
        self.assertEqual(one.read_text(), two.read_text())
        self.assertNotEqual(plumbline(*common[:-1], "4").stdout, first.stdout)

    def test_markdown_is_the_same_table(self):
        file = self.directory / "leaks.md"
        plumbline("watertight", "--tracer", "exact", "--rays", "16", "--markdown", str(file))
        self.assertRegex(file.read_text(), r"\| tracer +\| pair, ulp \|")

    def test_interrupted_it_prints_what_is_done(self):
        file = self.directory / "leaks.csv"
        try:
            ours, theirs = pty.openpty()  # so that its progress tells when it is under way
        except OSError:
            self.skipTest("this machine has no pseudoterminals")
        running = subprocess.Popen([PROGRAM, "watertight", "--tracer", "exact", "--rays", "1000000", "-o", str(file)],
                                   stdout=subprocess.PIPE, stderr=theirs, text=True)
        os.close(theirs)
        told = b""
        while b"% of" not in told:
            told += os.read(ours, 4096)
        running.send_signal(signal.SIGINT)
        table, _ = running.communicate()
        while b"interrupted after" not in told:
            told += os.read(ours, 4096)
        self.assertEqual(running.returncode, 2)
        self.assertIn("exact", table)
        self.assertIn(b"no file is written", told)
        self.assertEqual(list(self.directory.iterdir()), [])

    def test_bad_input(self):
        for arguments, told in ((("--tracer", "moller_trumbor_f32"), "moller_trumbore_f32"),
                                (("--tracer", "exact", "--tracer", "exact"), "twice"),
                                (("--tracer", "exact", "--rays", "0"), "--rays"),
                                (("--tracer", "exact", "--rays", "-1"), "whole number"),
                                (("--tracer", "exact", "--jobs", "0"), "--jobs"),
                                (("--tracer", "exact", "-o", str(self.directory / "none" / "x.csv")), "none")):
            done = plumbline("watertight", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(told, done.stderr)

    def test_help_teaches(self):
        done = plumbline("watertight", "--help")
        self.assertEqual(done.returncode, 0)
        for word in ("leak", "double hit", "apart", "Examples", "--seed"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    unittest.main()
