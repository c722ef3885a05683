"""The verb export as a maintainer meets it: each program is built with nothing but the library it is about, says that
the library is wrong and exits with 1 (or, of a case that the library gets right, with 0); each proof proves.
Argument: the program. EXPORT_ALL: every tracer, every kind of finding."""
import contextlib
import functools
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
ALL = "EXPORT_ALL" in os.environ
CORPUS = pathlib.Path(__file__).resolve().parents[2] / "corpus"
MANUAL = CORPUS.parent / "docs" / "repros.md"
COMPILERS = [c for c in ("g++", "clang++-19", "clang++") if shutil.which(c)][:2]
UNIT = "triangle 0 0 0  1 0 0  0 1 0\n"
HIT = "case hit\nprecision binary32\n" + UNIT + "ray 0.25 0.25 1  0 0 -1\n"
MISS = "case miss\nprecision binary32\n" + UNIT + "ray 2 0.25 1  0 0 -1\n"
EDGE = "case edge\nprecision binary32\n" + UNIT + "ray 0.5 0 1  0 0 -1\n"
FORMS = ("cpp-plain", "cpp-embree", "cpp-cgal", "cpp-bullet", "cpp-glm", "js-three", "c-librt", "python-proof", "obj",
         "ply", "asc")
PREFIXES = {"embree_": "cpp-embree", "cgal_": "cpp-cgal", "bullet_": "cpp-bullet", "glm_": "cpp-glm"}
# Some of each library, and each kernel in one precision: what there is time for in every run.
SOME = ("moller_trumbore_f64", "woop_watertight_f32", "plucker_f64", "baldwin_weber_f32", "embree_robust",
        "bullet_f32", "glm_f32")
SCRATCH = tempfile.TemporaryDirectory()


def plumbline(*arguments, text=""):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=120)


def present_tracers():
    rows = map(json.loads, plumbline("tracers", "--json").stdout.splitlines())
    return [row["tracer"] for row in rows if row["present"]]


def form_of(tracer):
    return next((form for prefix, form in PREFIXES.items() if tracer.startswith(prefix)), "cpp-plain")


def exportable(tracer):
    kernels = ("moller_trumbore", "woop_watertight", "plucker", "baldwin_weber")
    return form_of(tracer) != "cpp-plain" or re.fullmatch("(%s)_f(32|64)" % "|".join(kernels), tracer)


TRACERS = [t for t in present_tracers() if exportable(t) and (ALL or t in SOME)]


def blocks(path):
    """The cases of a file: id, text."""
    for block in re.split(r"^(?=case )", path.read_text(), flags=re.M)[1:]:
        yield block.split()[1], block


@functools.cache
def findings_of(tracer, domain="nominal"):
    """Those of a short search."""
    folder = pathlib.Path(SCRATCH.name) / tracer / domain
    done = plumbline("fuzz", "--tracer", tracer, "--runs", 20000, "--domain", domain, "-o", folder)
    assert done.returncode == 0, done.stderr
    return sorted((folder / "findings").glob("*.case"))


class ExportTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)

    def write(self, text, name="x.case"):
        path = self.scratch / name
        path.write_text(text)
        return path

    def export(self, case, form, *options):
        done = plumbline("export", case, "--as", form, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), (case, form, options))
        return done.stdout

    def assert_trouble(self, done, *parts):
        """Exit code 2, one line on stderr that holds all parts, and no output."""
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, done.stderr)

    def build_and_run(self, text, compiler):
        """By the command that stands at its top, with that compiler. Exit code and what it prints."""
        source = self.write(text, "repro.cpp")
        command = re.search(r"^//     (g\+\+ .*) && \./repro", text, re.M)[1]
        command = re.sub(r"\Ag\+\+", compiler + " -w", command)
        built = subprocess.run(command, shell=True, cwd=self.scratch, capture_output=True, text=True, timeout=600)
        self.assertEqual(built.returncode, 0, built.stderr)
        ran = subprocess.run([self.scratch / "repro"], capture_output=True, text=True, timeout=60)
        source.unlink()
        return ran.returncode, ran.stdout + ran.stderr


class Programs(ExportTest):
    def findings(self, tracer):
        """The first of each kind that a short search finds; EXPORT_ALL: in either domain."""
        some = {}
        for domain in ("nominal", "full") if ALL else ("nominal",):
            for path in findings_of(tracer, domain):
                kind = re.match(r"false-hit|false-miss|displaced|not-finite", path.stem)
                if kind:
                    some.setdefault((domain, kind[0]), path)
        return some

    def test_are_wrong_while_the_library_is(self):
        number = 0
        for tracer in TRACERS:
            found = self.findings(tracer)
            if not found:
                self.assertIn(tracer, ("cgal_epick", "cgal_epeck"), "a search that finds nothing")
            for kind, path in found.items():
                compiler = COMPILERS[number % len(COMPILERS)]
                number += 1
                with self.subTest(tracer=tracer, kind=kind, compiler=compiler):
                    text = self.export(path, form_of(tracer), "--tracer", tracer)
                    self.assertRegex(text, rf"\A// {tracer} (hits|misses) [^\n]*\n")
                    code, printed = self.build_and_run(text, compiler)
                    self.assertEqual(code, 1, printed + text)
                    self.assertIn("WRONG", printed)
        self.assertGreater(number, len(TRACERS) - 3)

    def test_are_right_where_it_is(self):
        for tracer in TRACERS:
            number = 0
            for case in (HIT, MISS, EDGE):
                if not ALL and tracer not in ("plucker_f64", "embree_robust", "bullet_f32"):
                    continue
                compiler = COMPILERS[number % len(COMPILERS)]
                number += 1
                with self.subTest(tracer=tracer, case=case, compiler=compiler):
                    text = self.export(self.write(case), form_of(tracer), "--tracer", tracer)
                    code, printed = self.build_and_run(text, compiler)
                    self.assertEqual(code, 0, printed + text)
                    self.assertNotIn("WRONG", printed)

    def test_of_the_corpus(self):
        """What the lines 'known' say, in the words of the library itself."""
        number = 0
        for path in sorted(CORPUS.glob("*/*.case")) if ALL else [CORPUS / "adapters" / "glm.case"]:
            for identity, block in blocks(path):
                for tracer, kind in re.findall(r"^known (\S+) (false-\S+)", block, re.M):
                    if tracer not in TRACERS:
                        continue
                    done = plumbline("export", path, "--as", form_of(tracer), "--id", identity, "--tracer", tracer)
                    if "not binary32" in done.stderr:
                        continue
                    with self.subTest(case=identity, tracer=tracer):
                        self.assertEqual(done.returncode, 0, done.stderr)
                        self.assertIn(kind.replace("-", " "), done.stdout.splitlines()[0])
                        code, printed = self.build_and_run(done.stdout, COMPILERS[number % len(COMPILERS)])
                        self.assertEqual(code, 1, printed)
                    number += 1
        self.assertGreater(number, 0)

    def test_of_three(self):
        """Where node finds three.js: in NODE_PATH's folder."""
        modules = os.environ.get("NODE_PATH", "")
        if not shutil.which("node") or not (pathlib.Path(modules) / "three").is_dir():
            self.skipTest("needs node, and NODE_PATH=DIR/node_modules with npm's three in it")
        (self.scratch / "node_modules").symlink_to(pathlib.Path(modules).resolve())
        beside = ("case beside-a\ntriangle 0x1.4p-7 0 0  0x1.d7a9dddce1c59p+1 -0x1.de28b4362de88p+1"
                  " -0x1.717f5a744c85bp+1  0 0x1.fffffffffffffp-1 0\n"
                  "ray -0x1.a375035c54be2p+1 0x1.66a3fe3d3553bp+0 0x1.a8487a9bfc6aep+1"
                  "  0x1.5949dba4167a8p-1 -0x1.265933e860e42p-2 -0x1.5c3936307dda2p-1\n")
        displaced = ("case displaced\ntriangle 0x1.a6a7a606dd9bdp+2 -0x1.d4270707c0d2bp+2 -0x1.4789153abaf22p+2"
                     "  0x1.d7a9dddce1c59p+1 -0x1.de28b4362de88p+1 0x1.8820590bf4722p+1"
                     "  0 0x1.90ae257155633p-1 -0x1.205c296c84c3ap-4\n"
                     "ray -0x1.14a69a53b75bp-2 0x1.1d24d2cf751cep+0 0x1.16b395a0c714p-3"
                     "  0x1.a6a7a606dd9bap+2 -0x1.031e65daf5bfcp+3 -0x1.4307a49508df8p+2\n")
        for case, code in ((HIT, 0), (MISS, 0), (EDGE, 0), (beside, 1), (displaced, 1)):
            text = self.export(self.write(case), "js-three")
            script = self.write(text, "repro.mjs")
            ran = subprocess.run(["node", script], capture_output=True, text=True, cwd=self.scratch, timeout=60)
            self.assertEqual(ran.returncode, code, ran.stdout + ran.stderr)
            self.assertEqual("WRONG" in ran.stdout, code == 1, ran.stdout)


class Proofs(ExportTest):
    def prove(self, text):
        """In this process: what it prints. A step that doesn't hold is an AssertionError."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(text, "proof.py", "exec"), {"__name__": "__main__"})
        return printed.getvalue()

    def test_prove_the_corpus(self):
        """Each as a finding of a tracer that gets it wrong, if there is one, or else as a truth alone."""
        present, truths = set(present_tracers()), set()
        for path in sorted(CORPUS.glob("*/*.case")):
            for identity, block in blocks(path):
                known = [t for t in re.findall(r"^known (\S+) false", block, re.M) if t in present]
                for tracer in [None, *known] if ALL else known[:1] or [None]:
                    with self.subTest(case=identity, tracer=tracer):
                        done = plumbline("export", path, "--as", "python-proof", "--id", identity,
                                         *(["--tracer", tracer] if tracer else []))
                        if "not binary32" in done.stderr:
                            continue
                        self.assertEqual(done.returncode, 0, done.stderr)
                        printed = self.prove(done.stdout)
                        truths.add(re.search(r"^Truth: (.*)$", printed, re.M)[1])
                        if tracer:
                            self.assertRegex(printed, r"\nIt said: a (hit|miss)[^\n]*\nThat is wrong: ")
        self.assertGreater(len(truths), 6, truths)

    def test_prove_each_class(self):
        families = ("exact_edge23", "coplanar", "degenerate", "lattice_points", "ulp51", "full_range", "tiny", "huge",
                    "sliver")
        truths = set()
        for family in families:
            cases = plumbline("generate", family, "--count", 40 if ALL else 4).stdout
            path = self.write(plumbline("convert", "-", text=cases).stdout)
            for identity, _ in blocks(path):
                with self.subTest(family=family, case=identity):
                    printed = self.prove(self.export(path, "python-proof", "--id", identity))
                    truths.add(re.search(r"^Truth: (.*)$", printed, re.M)[1])
        self.assertGreater(len(truths), 7, truths)

    def test_prove_the_ends_of_a_range(self):
        for ends, truth in (("0 1", "the ray crosses"), ("1 2", "the ray crosses"), ("0 0.5", "behind t_max"),
                            ("1.5 inf", "before t_min"), ("-inf inf", "the ray crosses"),
                            ("-inf 1", "the ray crosses"), ("2 1", "before t_min")):
            printed = self.prove(self.export(self.write(HIT + f"range {ends}\n"), "python-proof"))
            self.assertIn(truth, printed, ends)

    def test_prove_findings_of_every_kind(self):
        kinds = set()
        for tracer in ("moller_trumbore_f64", "embree_robust", "bullet_f32", "glm_f32", "cgal_cartesian_f64"):
            if tracer not in present_tracers():
                continue
            findings = findings_of(tracer)
            for path in findings if ALL else findings[::12]:
                with self.subTest(finding=path.stem, tracer=tracer):
                    printed = self.prove(self.export(path, "python-proof", "--tracer", tracer))
                    self.assertIn("\nThat is wrong: ", printed)
                    kinds.add(re.match(r"[a-z]+-?(hit|miss|finite)?", path.stem)[0])
        self.assertLessEqual({"false-hit", "false-miss"}, kinds)

    def test_the_one_of_the_manual(self):
        """docs/repros.md shows what is really written and printed."""
        case, proof, printed = re.findall(r"^```(?:python)?\n(.*?)^```$", MANUAL.read_text(), re.M | re.S)
        self.assertEqual(self.export(self.write(case), "python-proof"), proof)
        self.assertEqual(self.prove(proof), printed)

    def test_stand_alone(self):
        """As a stranger runs it; and it can fail."""
        text = self.export(self.write(HIT), "python-proof", "--tracer", "plucker_f32")
        proof = self.write(text, "proof.py")
        ran = subprocess.run(["/usr/bin/python3", "-I", proof], capture_output=True, text=True, timeout=60)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertIn("Truth: the ray crosses the interior.\n", ran.stdout)
        self.assertIn("It said: a hit at t = 0x1p+0 (1), u = 0x1p-2 (0.25), v = 0x1p-2 (0.25).\n", ran.stdout)
        self.assertEqual(re.findall(r"^(?:from|import) (\S+)", text, re.M), ["fractions"])
        for wrong in ('B = exact("0x1p-3", ', 'B = exact("-0x1p+0", '):
            with self.assertRaises(AssertionError):
                self.prove(text.replace('B = exact("0x1p+0", ', wrong))


class Choices(ExportTest):
    def test_every_form(self):
        case = self.write(HIT)
        for form in FORMS:
            needs = next((p for p, f in PREFIXES.items() if f == form), "")
            if any(t.startswith(needs) for t in present_tracers()):
                self.assertIn("hit", self.export(case, form), form)

    def test_whose_finding(self):
        case = self.write(HIT + "known woop_watertight_f32 false-miss\nknown embree_robust false-miss\n")
        self.assertIn("woop_watertight_f32 gets this ray right", self.export(case, "cpp-plain"))
        self.assertIn("plucker_f32 gets this ray right", self.export(case, "cpp-plain", "--tracer", "plucker_f32"))
        self.assertIn("Where a ray meets a triangle", self.export(case, "python-proof"))
        self.assertIn("moller_trumbore_f32 gets", self.export(self.write(HIT), "cpp-plain"))
        case = self.write(HIT.replace("precision binary32\n", ""))
        self.assertIn("moller_trumbore_f64 gets", self.export(case, "cpp-plain"))

    def test_a_tracer_of_ones_own(self):
        foreign = "pipe:sed -u 's/^.\"id\":\\([0-9]*\\).*/{\"id\":\\1,\"hit\":false}/'"
        done = plumbline("export", self.write(HIT), "--as", "cpp-plain", "--tracer", foreign)
        self.assert_trouble(done, "cpp-plain", "python-proof")
        text = self.export(self.write(HIT), "python-proof", "--tracer", foreign)
        self.assertIn("It said: a miss.", text)
        self.assertIn("That is wrong: the ray hits.", text)

    def test_output_and_id(self):
        case, output = self.write(HIT + "\n" + MISS), self.scratch / "out"
        done = plumbline("export", case, "--as", "obj", "--id", "miss", "-o", output)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertIn("# case miss\n", output.read_text())
        done = plumbline("export", "-", "--as", "obj", text=HIT)
        self.assertIn("v 0.25 0.25 1\n", done.stdout)

    def test_hostile_names(self):
        """They stay in comments: the same program, and it builds."""
        hostile = ("# */ int main() { return 7; } /* \\\n# '\"\"\"; DROP TABLE x; <script>alert(1)</script>\n"
                   "# @MAIN@ ??/\n" + HIT.replace("case hit", "case */'\"\"\";<script>\\"))
        code, printed = self.build_and_run(self.export(self.write(hostile), "cpp-plain"), COMPILERS[0])
        self.assertEqual(code, 0, printed)
        proof = self.write(self.export(self.write(hostile), "python-proof"), "proof.py")
        self.assertEqual(subprocess.run(["/usr/bin/python3", proof], capture_output=True, timeout=60).returncode, 0)


class Trouble(ExportTest):
    def test_arguments(self):
        case = self.write(HIT)
        self.assert_trouble(plumbline("export", case), "--as")
        self.assert_trouble(plumbline("export", case, "--as", "fortran"), "--as", "python-proof")
        self.assert_trouble(plumbline("export", case, "--as", "obj", "--id", "other"), "no case 'other'")
        self.assert_trouble(plumbline("export", self.scratch / "none.case", "--as", "obj"), "none.case")
        self.assert_trouble(plumbline("export", case, "--as", "cpp-plain", "--tracer", "pluker_f32"), "plucker_f32")
        self.assert_trouble(plumbline("export", self.write(""), "--as", "obj"), "no case")
        self.assert_trouble(plumbline("export", self.write(HIT + MISS), "--as", "obj"), "2 cases", "--id")
        self.assert_trouble(plumbline("export", self.write("case x\nray 1\n"), "--as", "obj"), "x.case:2")
        done = plumbline("export", "--help")
        self.assertEqual(done.returncode, 0)
        for form in FORMS:
            self.assertIn(form, done.stdout)
        self.assertIn("Example", done.stdout)

    def test_a_proof_of_several_triangles(self):
        pair = ("case pair\ntriangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
                "triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n%s"
                "ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n")
        behind = "triangle -9 -5 2  3 -5 2  -3 9 2\n"
        square = ("case square\ntriangle 0 0 0  1 0 0  0 1 0\ntriangle 1 0 0  1 1 0  0 1 0\n"
                  "triangle 0 0 0  1 0 0  0 0 1\nray 0.5 0.5 1  0 0 -1\nrange 0 1\n")
        for text, tracer, said, truth in (
                (pair % "", "moller_trumbore_f64", "a miss", "the ray crosses 2 of them, first "),
                (pair % behind, "moller_trumbore_f64", "of triangle 2", "the ray crosses 3 of them, first "),
                (square, "exact", "of triangle 0", "the ray crosses 2 of them, first [0, 1]."),
                (square.replace("range 0 1", "range 2 3"), "", None, "the ray crosses none.")):
            with self.subTest(text=text):
                options = ["--tracer", tracer] if tracer else []
                proof = plumbline("export", self.write(text), "--as", "python-proof", *options)
                self.assertEqual((proof.returncode, proof.stderr), (0, ""))
                done = subprocess.run(["/usr/bin/python3", "-c", proof.stdout], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("Truth: " + truth, done.stdout)
                self.assertEqual("It said" in done.stdout, said is not None)
                self.assertIn(said or "", done.stdout)
                self.assertEqual("That is wrong" in done.stdout, tracer.startswith("moller"))
                # A proof of something else doesn't hold.
                forged = proof.stdout.replace('== [(', '== [(7, "vertex a"), (') if said else proof.stdout.replace(
                    "== []", '== [(0, "interior")]')
                self.assertNotEqual(subprocess.run(["/usr/bin/python3", "-c", forged], capture_output=True).returncode, 0)

    def test_what_cannot_be_told(self):
        output = self.scratch / "out"
        output.write_text("as before")
        two = self.write(HIT + UNIT)
        for form in FORMS:
            if form not in ("python-proof", "obj", "ply", "asc"):
                done = plumbline("export", two, "--as", form, "-o", output)
                self.assertEqual((done.returncode, output.read_text()), (2, "as before"), form)
        for form, mark in (("obj", "f 4 5 6"), ("ply", "element face 2"), ("asc", "F { { 0 1 2 } { 3 4 5 } }")):
            done = plumbline("export", two, "--as", form)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn(mark, done.stdout)
            self.assertIn("crossed    2 of 2 triangles", done.stdout)
        done = plumbline("export", two, "--as", "cpp-plain", "-o", output)
        self.assert_trouble(done, "2 triangles", "python-proof, obj")
        self.assertEqual(output.read_text(), "as before")
        tenth = self.write(HIT.replace("precision binary32\n", "").replace("0.25 0.25", "0.1 0.25"))
        done = plumbline("export", tenth, "--as", "cpp-plain", "--tracer", "plucker_f32")
        self.assert_trouble(done, "binary32", "generate")
        several = self.write(HIT + "known plucker_f32 false-miss\nknown plucker_f64 false-miss\n")
        self.assert_trouble(plumbline("export", several, "--as", "cpp-plain"), "several lines 'known'", "--tracer")
        still = self.write(HIT.replace("0 0 -1", "0 0 0"))
        self.assert_trouble(plumbline("export", still, "--as", "cpp-plain"), "direction is zero")
        done = plumbline("export", self.write(HIT), "--as", "cpp-plain", "--tracer", "exact")
        self.assert_trouble(done, "cpp-plain", "moller_trumbore")


if __name__ == "__main__":
    unittest.main()
