"""What the tests of stores of findings share. The last argument of each is the program."""
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
TRACER = "moller_trumbore_f64"
FALSE_HIT = '{"triangle":[[0,0,0],[1,0,0],[0,1,0]],"origin":[0.75,0.75,1],"direction":[0,0,-1],"hit":true%s}\n'


def plumbline(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


class TriageTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)
        self.store = self.scratch / "found.db"
        self.journal = self.scratch / "found.db.ndjson"

    def run_fine(self, *arguments, **options):
        done = plumbline(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def assert_trouble(self, done, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(str(part), done.stderr)

    def fuzz(self, *options, tracer=TRACER, folder="campaign", runs=2000):
        return self.run_fine("fuzz", "--tracer", tracer, "--runs", runs, "-o", self.scratch / folder, "--findings", self.store,
                             *options)

    def rows(self, *options):
        lines = [json.loads(line) for line in self.run_fine("triage", self.store, "--json", *options).splitlines()]
        return ([line for line in lines if line["row"] == "finding"], [line for line in lines if line["row"] == "search"])

    def dump(self):
        """Of the whole database, up to date."""
        self.run_fine("triage", self.store)
        database = sqlite3.connect(self.store)
        try:
            return list(database.iterdump())
        finally:
            database.close()

    def assert_the_same_when_rebuilt(self):
        before = self.dump()
        self.assertEqual(self.run_fine("triage", "rebuild", self.store), "")
        self.assertEqual(self.dump(), before)
        for suffix in ("", "-wal", "-shm"):
            pathlib.Path(f"{self.store}{suffix}").unlink(missing_ok=True)
        self.assertEqual(self.dump(), before)

    def judge(self, lines, code=1, *options):
        done = plumbline("judge", "-", "--findings", self.store, *options, input=lines)
        self.assertEqual(done.returncode, code, done.stderr)
        return done
