"""The verb compare as others call it. Argument: the program."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


class Compare(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def test_tells_who_is_right_where_two_disagree(self):
        done = plumbline("compare", "moller_trumbore_f32", "exact", "--family", "edge_ulps", "--count", "300")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("who is right", done.stdout)

    def test_files_replay(self):
        where = self.directory / "new"
        done = plumbline("compare", "plucker_f32", "exact", "--count", "200", "--json", "-o", str(where))
        self.assertEqual(done.returncode, 0)
        self.assertEqual(sorted(p.name for p in where.iterdir()), ["compare.json", "table.md", "worst.case"])
        self.assertEqual((where / "compare.json").read_text(), done.stdout)
        replayed = plumbline("replay", str(where / "worst.case"), "--tracer", "plucker_f32")
        self.assertEqual((replayed.returncode, replayed.stdout), (0, ""))

    def test_binary64_inputs_are_for_tracers_that_read_them(self):
        done = plumbline("compare", "--inputs", "binary64", "--family", "ulp51", "--count", "20", "--json")
        tracers = {json.loads(line).get("tracer") for line in done.stdout.splitlines()}
        self.assertIn("plucker_f64", tracers)
        self.assertNotIn("plucker_f32", tracers)

    def test_bad_input(self):
        for arguments, told in ((("compare", "exact", "--inputs", "binary64", "--family", "none"), "none"),
                                (("compare", "moller_trumbor_f32"), "moller_trumbore_f32"),
                                (("compare", "plucker_f32", "--inputs", "binary64"), "plucker_f32"),
                                (("compare", "exact", "exact"), "twice"),
                                (("compare", "exact", "--count", "0"), "count")):
            done = plumbline(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main()
