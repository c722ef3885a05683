"""The verb self-hits as others call it. Argument: the program."""
import csv
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop()
QUICK = ("self-hits", "--tracer", "moller_trumbore_f32", "--tracer", "exact", "--rays", "20")


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def catches_interrupts(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    caught = next(line for line in status.splitlines() if line.startswith("SigCgt")).split()[1]
    return int(caught, 16) >> (signal.SIGINT - 1) & 1


class SelfHits(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.file = pathlib.Path(scratch.name) / "self_hits.csv"

    def rows(self):
        with self.file.open(newline="") as text:
            return list(csv.DictReader(text))

    def test_exact_never_hits_its_own_triangle_falsely(self):
        done = plumbline(*QUICK, "-o", str(self.file))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = self.rows()
        self.assertEqual(len(rows), 2 * 6 * 3 * 2)  # tracers, families, points, ways of leaving
        exact = [row for row in rows if row["tracer"] == "exact"]
        self.assertTrue(all(row["false_hits"] == "0" and row["origin_excess_worst"] == "0" for row in exact))
        self.assertGreater(sum(int(row["beyond_hits"]) for row in exact), 0)
        self.assertGreater(sum(int(row["false_hits"]) for row in rows), 0)
        for name in ("near", "small", "far10", "far20", "sliver", "grazing", "rounded", "steep"):
            self.assertIn(name, done.stdout)

    def test_the_same_whatever_the_jobs(self):
        two = (*QUICK, "--family", "sliver", "--family", "near")
        one, three = (plumbline(*two, "--jobs", jobs) for jobs in "13")
        self.assertEqual((one.returncode, three.stdout), (0, one.stdout))
        self.assertNotEqual(plumbline(*two, "--seed", "2").stdout, one.stdout)

    def test_what_is_done_survives_an_interrupt(self):
        # Not caught by this process: between fork and exec the other is seen with its signals. And no file, for which
        # the program catches them too, and earlier.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        self.addCleanup(signal.signal, signal.SIGINT, signal.default_int_handler)
        process = subprocess.Popen([PROGRAM, "self-hits", "--rays", "1000000000", "--jobs", "1", "--tracer", "exact",
                                    "-o", "/dev/stdout"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not catches_interrupts(process):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        written, told = process.communicate()
        self.assertEqual(process.returncode, 2)
        self.assertIn("interrupted after 0 of 6", told)
        self.assertEqual(told.count("\n"), 1)
        self.assertTrue(written.startswith("tracer,precision,family,"), written)
        self.assertIn("\ntracer  point", written)

    def test_bad_input(self):
        for arguments, told in ((("--tracer", "moller_trumbor_f32"), "moller_trumbore_f32"),
                                (("--tracer", "exact", "--tracer", "exact"), "twice"),
                                (("--tracer", "exact", "--rays", "0"), "1 or more"),
                                (("--tracer", "exact", "--rays", "-1"), "rays"),
                                (("--tracer", "exact", "--family", "nowhere"), "nowhere"),
                                (("--tracer", "exact", "--rays", "1", "-o", "/nowhere/all.csv"), "/nowhere/all.csv")):
            done = plumbline("self-hits", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(told, done.stderr)

    def test_help_teaches(self):
        told = plumbline("self-hits", "--help").stdout
        for word in ("behind %", "false %", "ulps", "far20", "Examples:", "plumbline self-hits --tracer"):
            self.assertIn(word, told)


if __name__ == "__main__":
    unittest.main()
