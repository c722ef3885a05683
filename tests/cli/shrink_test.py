"""The verb shrink as a user meets it: from a campaign's finding to a plain case, and trouble told in one line.
Argument: the program."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
UNIT = "triangle 0 0 0  1 0 0  0 1 0\n"
WELL_HIT = "case hit\n" + UNIT + "ray 0.25 0.25 1  0 0 -1\n"


def plumbline(*arguments, text=""):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=120)


class ShrinkTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)

    def campaign(self, tracer, *options, runs=20000):
        folder = self.scratch / tracer
        done = plumbline("fuzz", "--tracer", tracer, "--runs", runs, "-o", folder, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return folder / "findings"

    def assert_trouble(self, done, *parts):
        """Exit code 2, one line on stderr that holds all parts, and no output."""
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, done.stderr)


class RoundTrip(ShrinkTest):
    def check(self, case, tracer, keep):
        simple = self.scratch / "simple.case"
        done = plumbline("shrink", case, "--keep", keep, "-o", simple)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        told = re.fullmatch(r"(\S+): (\S+)\n  before +(\d+) significant bits, severity (\S+) ulps, (\S+)\n"
                            r"  after +(\d+) significant bits, severity (\S+) ulps, (\S+)\n", done.stderr)
        self.assertIsNotNone(told, done.stderr)
        identity, who, bits, severity, signature, bits_after, severity_after, signature_after = told.groups()
        self.assertEqual((identity, who), (case.stem, tracer))
        self.assertEqual(signature, case.stem)
        self.assertLess(int(bits_after), int(bits))
        text = simple.read_text()
        self.assertIn(f"\ncase {case.stem}\n", text)
        self.assertIn(f"# shrunk for {tracer} ({keep}): {bits} -> {bits_after} significant bits\n", text)
        self.assertIn("# found by fuzz", text)  # where it comes from stays said
        self.assertRegex(text, rf"\nknown {tracer} false-(miss|hit)\n")
        # It replays as known; without the line it is a disagreement.
        done = plumbline("replay", simple, "--tracer", tracer)
        self.assertEqual(done.returncode, 0, done.stdout)
        unlisted = self.scratch / "unlisted.case"
        unlisted.write_text(re.sub(r"known .*\n", "", text))
        self.assertEqual(plumbline("replay", unlisted, "--tracer", tracer).returncode, 1)
        # The same again; and from there on it stays as it is, or becomes simpler still.
        self.assertEqual(plumbline("shrink", case, "--keep", keep).stdout, text)
        again = plumbline("shrink", simple, "--keep", keep)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertLessEqual(int(re.search(r"after +(\d+)", again.stderr)[1]), int(bits_after))
        return float(severity), float(severity_after), signature_after

    def worst(self, findings, pattern):
        """The nominal finding of the greatest severity."""
        def severity(path):
            return float(re.search(r"^# severity (\S+)", path.read_text(), re.M)[1])
        return max((p for p in findings.glob("*.case") if re.search(pattern, p.stem)), key=severity)

    def test_ray_space(self):
        for tracer in ("moller_trumbore_f64", "woop_watertight_f32"):
            case = self.worst(self.campaign(tracer), "-nominal-c.$")
            for keep in ("simple", "nominal", "worst"):
                with self.subTest(case=case, keep=keep):
                    before, after, signature = self.check(case, tracer, keep)
                    if keep != "simple":
                        self.assertIn("-nominal-", signature)
                    if keep == "worst":
                        self.assertEqual(signature, case.stem)
                        self.assertGreaterEqual(after, before / 2 * 0.999)

    def test_target_space(self):
        """An aim stays an aim: the ray of the simpler case is that of its target."""
        case = self.worst(self.campaign("moller_trumbore_f64", "--space", "target"), "^false-miss.*-nominal-")
        self.assertRegex(case.read_text(), r"\naim ")
        self.check(case, "moller_trumbore_f64", "nominal")
        self.assertRegex((self.scratch / "simple.case").read_text(), r"\naim ")

    def test_all_of_a_file_or_one(self):
        cases = sorted(self.campaign("plucker_f32", runs=3000).glob("false-*.case"))[:3]
        self.assertEqual(len(cases), 3)
        file = self.scratch / "all.case"
        file.write_text("\n".join(case.read_text() for case in cases))
        def identities(*options):
            done = plumbline("shrink", file, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return re.findall(r"^case (\S+)", done.stdout, re.M)
        self.assertEqual(identities(), [case.stem for case in cases])
        self.assertEqual(identities("--id", cases[1].stem), [cases[1].stem])
        done = plumbline("shrink", "-", "--id", cases[1].stem, text=file.read_text())
        self.assertEqual(re.findall(r"^case (\S+)", done.stdout, re.M), [cases[1].stem])


class Trouble(ShrinkTest):
    def write(self, text):
        path = self.scratch / "x.case"
        path.write_text(text)
        return path

    def test_whose_case(self):
        case = self.write(WELL_HIT)
        self.assert_trouble(plumbline("shrink", case), "x.case", "'hit'", "no line 'known'", "--tracer")
        self.write(WELL_HIT + "known plucker_f32 false-miss\nknown plucker_f64 false-miss\n")
        self.assert_trouble(plumbline("shrink", case), "several lines 'known'", "--tracer")
        self.write(WELL_HIT + "known plucker_f46 false-miss\n")
        self.assert_trouble(plumbline("shrink", case), "plucker_f46")

    def test_a_right_answer(self):
        case = self.write(WELL_HIT + "known plucker_f64 false-miss\n")
        output = self.scratch / "simple.case"
        self.assert_trouble(plumbline("shrink", case, "-o", output), "plucker_f64 gets case 'hit' right")
        self.assertFalse(output.exists())

    def test_what_cannot_be_taken(self):
        case = self.write("case two\n" + UNIT + UNIT + "ray 0.25 0.25 1  0 0 -1\n")
        self.assert_trouble(plumbline("shrink", case, "--tracer", "plucker_f64"), "'two'", "one triangle")
        self.write("case fine\n" + UNIT + "ray 0.1 0.25 1  0 0 -1\n")
        self.assert_trouble(plumbline("shrink", case, "--tracer", "plucker_f32"), "'fine'", "binary32")

    def test_arguments(self):
        case = self.write(WELL_HIT)
        self.assert_trouble(plumbline("shrink", self.scratch / "none.case", "--tracer", "exact"), "none.case")
        self.assert_trouble(plumbline("shrink", case, "--id", "other", "--tracer", "exact"), "no case 'other'")
        self.assert_trouble(plumbline("shrink", case, "--keep", "all"), "--keep")
        self.assert_trouble(plumbline("shrink"), "CASE")
        self.assert_trouble(plumbline("shrink", self.write("case x\nray 1\n"), "--tracer", "exact"), "x.case:2")
        done = plumbline("shrink", "--help")
        self.assertEqual(done.returncode, 0)
        for word in ("simple", "nominal", "worst", "Example"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    unittest.main()
