"""The search is the same whoever drives it: libFuzzer, or a plain loop. Arguments: the two programs."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

LOOP = sys.argv.pop()
FUZZER = sys.argv.pop()
# Of all that a summary holds, what is no time.
SAME = ("tracer", "space", "domain", "seed", "executions", "first_disagreement", "signatures",
        "worst_nominal_severity", "cells", "fingerprint")


class Drivers(unittest.TestCase):
    def search(self, program, *options):
        with tempfile.TemporaryDirectory() as folder:
            summary = pathlib.Path(folder) / "summary.json"
            done = subprocess.run([program, f"--summary={summary}", *options], capture_output=True, text=True,
                                  timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(summary.read_text())

    def test_both_spaces(self):
        prints = set()
        for space, tracer in (("ray", "moller_trumbore_f64"), ("target", "woop_watertight_f32")):
            for domain in ("nominal", "full"):
                for seed in (1, 2):
                    options = (f"--tracer={tracer}", f"--space={space}", f"--domain={domain}", f"--seed={seed}",
                               f"--runs={20000 if domain == 'nominal' else 2000}")
                    one, other = self.search(FUZZER, *options), self.search(LOOP, *options)
                    with self.subTest(options=options):
                        self.assertEqual({k: one[k] for k in SAME}, {k: other[k] for k in SAME})
                        self.assertGreater(one["cells"], 100)
                    prints.add(one["fingerprint"])
        self.assertEqual(len(prints), 8)


if __name__ == "__main__":
    unittest.main()
