"""Tracers of other people, plugged in as a user does it: shared libraries by plumbline_tracer.h, built outside the tree.

PLUMBLINE names the program under test, PLUMBLINE_SOURCE the source tree, CC and CXX the compilers."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["PLUMBLINE"]
SOURCE = pathlib.Path(os.environ["PLUMBLINE_SOURCE"])
EXAMPLES = SOURCE / "examples"
CC, CXX = os.environ["CC"], os.environ["CXX"]

QUESTION = '{"id":7,"triangle":[[0,0,0],[1,0,0],[0,1,0]],"origin":[0.25,0.5,2],"direction":[0,0,-1]}\n'


def run(*arguments, text="", program=PROGRAM, **options):
    return subprocess.run([program, *map(str, arguments)], input=text, capture_output=True, encoding="utf-8",
                          timeout=120, **options)


class ForeignTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def plumbline(self, *arguments, text="", code=0, error=""):
        result = run(*arguments, text=text, cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stderr)
        if error is not None:
            self.assertEqual(result.stderr, error)
        return result.stdout

    def assert_trouble(self, result, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, result.stderr)


class SharedLibrary(ForeignTest):
    def setUp(self):
        super().setUp()
        shutil.copy(SOURCE / "float_tracer" / "plumbline_tracer.h", self.folder)
        shutil.copy(EXAMPLES / "c_abi" / "my_tracer.c", self.folder)

    def build(self, *options, source="my_tracer.c", library="libmine.so"):
        built = run("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-ffp-contract=off", "-shared",
                    "-fPIC", *options, "-o", library, source, "-lm", program=CC, cwd=self.folder)
        self.assertEqual((built.returncode, built.stderr), (0, ""))

    def test_every_verb(self):
        self.build()
        for name in ("./libmine.so", "libmine.so", self.folder / "libmine.so"):
            answer = json.loads(self.plumbline("trace", "--tracer", name, "-", text=QUESTION))
            self.assertEqual({key: answer[key] for key in ("id", "tracer", "hit", "t", "u", "v")},
                             {"id": 7, "tracer": "my_tracer", "hit": True, "t": 2, "u": 0.25, "v": 0.5})
        swept = self.plumbline("sweep", "--json", "--tracer", "./libmine.so")
        rows = [json.loads(line) for line in swept.splitlines()]
        self.assertEqual({row["tracer"] for row in rows}, {"my_tracer"})
        self.assertEqual(sum(row["attempts"] for row in rows), 21504)
        self.assertEqual([row["false_misses"] + row["false_hits"] for row in rows if row["target"] == "interior"], [0])

        merged = self.plumbline("trace", "--merged", "--tracer", "./libmine.so", "-", text=QUESTION)
        judged = self.plumbline("judge", "--tracer", "./libmine.so", "-", text=merged, error=None)
        self.assertEqual(json.loads(judged)["verdict"], "correct")
        explained = self.plumbline("explain", "--triangle", *"000100010", "--ray", *"001001", "--tracer", "libmine.so")
        self.assertIn("tracer     my_tracer", explained)

    def test_replay_with_known_findings(self):
        self.build()
        case = self.folder / "x.case"
        case.write_text("case tiny\ntriangle 0 0 0  0x1p-500 0 0  0 0x1p-500 0\nray 0x1p-499 0x1p-499 1  0 0 -1\n")
        found = self.plumbline("replay", "x.case", "--tracer", "./libmine.so", code=1, error=None)
        self.assertIn("tiny: my_tracer: new false-hit", found)
        case.write_text(case.read_text() + "known my_tracer false-hit\n")
        self.assertEqual(self.plumbline("replay", "x.case", "--tracer", "./libmine.so", error=None), "")

    def test_by_its_own_cmake(self):
        if not shutil.which("cmake"):
            self.skipTest("cmake is not there")
        shutil.copy(EXAMPLES / "c_abi" / "CMakeLists.txt", self.folder)
        for step in (("-S", ".", "-B", "build", f"-DPLUMBLINE_INCLUDE={self.folder}", f"-DCMAKE_C_COMPILER={CC}"),
                     ("--build", "build")):
            done = run(*step, program="cmake", cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn('"hit":true', self.plumbline("trace", "--tracer", "build/libmine.so", "-", text=QUESTION))

    def test_the_header_is_c_plus_plus_too(self):
        (self.folder / "alone.cpp").write_text('#include "plumbline_tracer.h"\n')
        done = run("-std=c++11", "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", "alone.cpp", program=CXX,
                   cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_trouble(self):
        ask = ("trace", "-", "--tracer")
        self.assert_trouble(run(*ask, "./libmine.so", cwd=self.folder),
                            "./libmine.so: cannot be opened: No such file or directory; build it")
        (self.folder / "empty.so").write_text("")
        self.assert_trouble(run(*ask, "empty.so", cwd=self.folder), "empty.so: cannot be loaded: file too short; link")
        (self.folder / "other.c").write_text("int other(void);\nint other(void) { return 1; }\n")
        self.build(source="other.c", library="other.so")
        self.assert_trouble(run(*ask, "./other.so", cwd=self.folder), "./other.so: exports no function")
        (self.folder / "missing.c").write_text("int nowhere(void);\nint other(void);\n"
                                               "int other(void) { return nowhere(); }\n")
        self.build(source="missing.c", library="missing.so")
        self.assert_trouble(run(*ask, "./missing.so", cwd=self.folder), "undefined symbol: nowhere; link")

        text = (self.folder / "my_tracer.c").read_text()
        for old, new, *parts in [
            (".version = PLUMBLINE_TRACER_VERSION", ".version = 99", "version 99", "version 1; compile"),
            (".trace_f64 = trace", ".trace_f64 = 0", "'trace_f64' is NULL; fill it in"),
            ("into->precision = 64", "(void)into", "precision to 0; set 32 or 64"),
            ('"my_tracer"', '"exact"', "calls itself 'exact', as another tracer here does; give it"),
        ]:
            with self.subTest(new):
                (self.folder / "wrong.c").write_text(text.replace(old, new))
                run("-std=c99", "-shared", "-fPIC", "-w", "-o", "wrong.so", "wrong.c", "-lm", program=CC,
                    cwd=self.folder)
                self.assert_trouble(run(*ask, "./wrong.so", cwd=self.folder), "./wrong.so: ", *parts)

    def test_lies_are_told_and_faults(self):
        text = (self.folder / "my_tracer.c").read_text()
        (self.folder / "liar.c").write_text(text.replace("return count;", "return count + 1;"))
        self.build(source="liar.c", library="liar.so")
        answer = self.plumbline(
            "trace", "--tracer", "./liar.so", "-", text=QUESTION,
            error="warning: ./liar.so: trace() answered 2 of 1 rays; all 1 are faults\n")
        self.assertTrue(json.loads(answer)["fault"])


if __name__ == "__main__":
    unittest.main()
