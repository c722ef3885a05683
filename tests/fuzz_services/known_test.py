"""What fuzzing services take for known, and the build script that hands it to them: each case is a finding of its
tracer, and every target of the script is a tracer with such a file. Argument: plumbline."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

PLUMBLINE = sys.argv.pop()
ROOT = pathlib.Path(__file__).resolve().parents[2]
KNOWN = sorted((ROOT / "fuzz" / "known").glob("*.case"))
SCRIPT = ROOT / ".clusterfuzzlite" / "build.sh"


def tracer_of(target):
    return target.removesuffix("_target").removesuffix("_full")


class Known(unittest.TestCase):
    def test_the_targets_of_the_script_are_known(self):
        targets = re.search(r'^targets="([^"]*)"', SCRIPT.read_text(), re.M)[1].split()
        self.assertGreater(len(targets), 8)
        self.assertEqual(sorted(targets), [path.stem for path in KNOWN])
        listed = subprocess.run([PLUMBLINE, "tracers", "--json"], capture_output=True, text=True, check=True).stdout
        names = {json.loads(line)["tracer"] for line in listed.splitlines()}
        self.assertLessEqual({tracer_of(target) for target in targets}, names)

    def test_each_case_is_a_finding(self):
        for path in KNOWN:
            with self.subTest(path.name):
                cases = path.read_text().count("\ncase ")
                done = subprocess.run([PLUMBLINE, "replay", path, "--tracer", tracer_of(path.stem)],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn(f"{cases} cases in 1 files, {cases} answers: 0 not as the files say", done.stderr)
                known = int(re.search(r", (\d+) known findings", done.stderr)[1])
                self.assertEqual(known, len(re.findall(r"^known ", path.read_text(), re.M)))
                self.assertGreater(known, 10)


class Script(unittest.TestCase):
    def test_it_is_one(self):
        self.assertEqual(subprocess.run(["bash", "-n", SCRIPT], check=False).returncode, 0)
        self.assertEqual([path for path in ROOT.glob("*/build.sh")], [SCRIPT])
        for folder in (".clusterfuzzlite", "oss-fuzz"):
            image = (ROOT / folder / "Dockerfile").read_text()
            self.assertIn("plumbline/.clusterfuzzlite/build.sh $SRC/build.sh", image)

    def test_it_leaves_the_flags_to_the_image(self):
        lines = [line for line in SCRIPT.read_text().splitlines() if not line.startswith("#")]
        self.assertNotRegex("\n".join(lines), r"-fsanitize|-O\d|-stdlib|clang|libFuzzingEngine")


if __name__ == "__main__":
    unittest.main()
