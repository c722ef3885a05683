"""The verb triage html as a user meets it: from campaigns and .case files to pages, and trouble told in one line.
Argument: the program."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
# This kernel misses it, though it meets the edge bc exactly: one third isn't a binary32 number.
THIRDS = ("case thirds\nprecision binary32\ntriangle 2 -1 0  1 0 1  0 0 0\nray -1 1 0  1.5 -1 0.5\n"
          "known woop_watertight_f32 false-miss\n")


def plumbline(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, **options)


class TriageHtmlTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)
        self.pages = self.scratch / "pages"

    def campaign(self, tracer, runs=3000):
        folder = self.scratch / tracer
        done = plumbline("fuzz", "--tracer", tracer, "--runs", runs, "-o", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def write(self, text, name="x.case"):
        path = self.scratch / name
        path.write_text(text)
        return path

    def html(self, *arguments, **options):
        return plumbline("triage", "html", *arguments, "-o", self.pages, **options)

    def assert_trouble(self, done, *parts):
        """Exit code 2, one line on stderr that holds all parts, and no output."""
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_campaigns(self):
        campaigns = [self.campaign("woop_watertight_f32"), self.campaign("moller_trumbore_f64")]
        signatures = sum(len(list((c / "findings").glob("*.case"))) for c in campaigns)
        done = self.html(*campaigns, "--pages", 5)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout,
                         f"{self.pages}/index.html: {signatures} findings, 5 of them with pages of their own\n")
        names = sorted(p.name for p in self.pages.iterdir())
        self.assertEqual(len([n for n in names if re.fullmatch(r"finding-\d+\.html", n)]), 5)
        self.assertEqual(len([n for n in names if re.fullmatch(r"finding-\d+\.case", n)]), 5)
        self.assertEqual(len(names), 11)
        index = (self.pages / "index.html").read_text()
        self.assertIn("Searched: 2 searches, 6 000 executions, of 2 tracers.", index)
        self.assertIn(f"Found: {signatures} ways to be wrong, in 2 tracers.", index)
        # The same again, byte for byte.
        before = {p.name: p.read_bytes() for p in self.pages.iterdir()}
        self.assertEqual(self.html(*campaigns, "--pages", 5).returncode, 0)
        self.assertEqual({p.name: p.read_bytes() for p in self.pages.iterdir()}, before)
        # What a page offers is a finding still.
        for case in self.pages.glob("*.case"):
            tracer = re.search(r"plumbline replay \S+ --tracer (\S+?)<", case.with_suffix(".html").read_text())[1]
            if "known" in case.read_text():
                self.assertEqual(plumbline("replay", case, "--tracer", tracer).returncode, 0)

    def test_displaced_findings_have_no_known_line_and_are_there(self):
        campaign = self.campaign("woop_watertight_f32", 20000)
        self.assertTrue(list((campaign / "findings").glob("displaced-*.case")))
        self.html(campaign, "--pages", 0)
        self.assertIn('"displaced-', (self.pages / "index.html").read_text())

    def test_case_files(self):
        done = self.html(self.write(THIRDS))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.pages / "finding-1.html").read_text()
        self.assertIn("<code>woop_watertight_f32</code> misses this; the ray meets edge BC exactly, where it promises "
                      "a hit", page)
        self.assertIn("It meets the border exactly.", page)
        self.assertIn("No search is recorded", (self.pages / "index.html").read_text())

    def test_a_tracer_of_ones_own(self):
        program = self.write("#!/usr/bin/python3\nimport json, sys\nfor line in sys.stdin:\n"
                             "    print(json.dumps({'id': json.loads(line)['id'], 'hit': True}), flush=True)\n", "hits")
        program.chmod(0o755)
        name = f"pipe:{program}"
        done = plumbline("fuzz", "--tracer", name, "--runs", 300, "-o", self.scratch / "mine")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.html(self.scratch / "mine", "--tracer", name, "--pages", 2)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = next(self.pages.glob("finding-*.html")).read_text()
        self.assertIn(f"<code>{name}</code> calls this a hit", page)
        self.assertIn(f"--tracer {name}<", page)
        self.assertIn("cases beside it, one ulp away", page)
        # Without it, its cases can't be asked.
        self.assertIn("not in this build", self.html(self.scratch / "mine").stderr)

    def test_a_clean_campaign(self):
        campaign = self.campaign("exact", 500)
        done = self.html(campaign)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        index = (self.pages / "index.html").read_text()
        self.assertIn("No wrong answer was found", index)
        self.assertIn("500 executions", index)

    def test_what_is_left_out_is_told(self):
        done = self.html(self.write(THIRDS + "known plucker_f46 false-miss\nknown exact false-miss\n"))
        self.assertEqual(done.returncode, 0)
        self.assertIn("plucker_f46: not in this build; 1 of its cases left out (did you mean 'plucker_f64'?)",
                      done.stderr)
        self.assertIn("1 cases left out: their tracers get them right", done.stderr)
        self.assertIn("1 findings", done.stdout)

    def test_hostile_names_of_files(self):
        name = "'; rm -rf <b>$(x)\n"
        folder = self.scratch / name
        folder.mkdir()
        (folder / "a.case").write_text(THIRDS.replace("case thirds", "case <script>alert(1)</script>"))
        self.pages = self.scratch / (name + "pages")
        self.assertEqual(self.html(folder).returncode, 0)
        self.assertNotIn("<script>alert", (self.pages / "finding-1.html").read_text())

    def test_several_triangles(self):
        pair = ("case pair\ntriangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
                "triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n"
                "ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n"
                "known moller_trumbore_f64 leak\n")
        done = self.html(self.write(pair))
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.pages / "finding-1.html").read_text()
        for part in ("misses triangles of which the ray has to hit one", "All that the ray meets, in order",
                     "The verdict: <strong>leak</strong>", "repro-ply", "repro-obj"):
            self.assertIn(part, page)
        again = plumbline("replay", self.pages / "finding-1.case", "--tracer", "moller_trumbore_f64")
        self.assertEqual(again.returncode, 0, again.stdout)

    def test_trouble(self):
        self.assert_trouble(self.html(self.scratch / "none.case"), "none.case")
        self.assert_trouble(self.html(self.write("case x\nray 1\n")), "x.case:2")
        two = "triangle 0 0 0  1 0 0  0 1 0\n" * 2
        solid = self.write("case two\nmode solid\n" + two + "ray 0 0 1  0 0 -1\nknown exact leak\n")
        self.assert_trouble(self.html(solid), "'two'", "a solid of 2 triangles")
        self.assert_trouble(plumbline("triage", "html", self.write(THIRDS)), "--output")
        self.assert_trouble(self.html(), "PATH")
        self.assert_trouble(self.html(self.write(THIRDS), "--pages", "-1"), "--pages")
        self.assert_trouble(self.html(self.write(THIRDS), "--tracer", "exakt"), "exakt", "exact")
        self.assert_trouble(plumbline("triage"), "triage")
        self.assertFalse(self.pages.exists())
        self.pages = self.write("", "file")
        self.assert_trouble(self.html(self.write(THIRDS)), "file", "name another")
        broken = self.campaign("plucker_f32", 500)
        (broken / "summary.json").write_text("{")
        self.assert_trouble(self.html(broken), "summary.json")

    def test_help_teaches(self):
        done = plumbline("triage", "html", "--help")
        self.assertEqual(done.returncode, 0)
        for word in ("Example", "--pages", "index.html", "finding-ID.html", "known"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    unittest.main()
