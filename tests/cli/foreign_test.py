"""Tracers of other people, plugged in as a user does it: shared libraries by plumbline_tracer.h, built outside the
tree, and programs by a pipe, well-behaved and not.

PLUMBLINE names the program under test, PLUMBLINE_SOURCE the source tree, CC and CXX the compilers. The test of
three.js needs its packages: NODE_PATH_OF_EXAMPLES names a folder with node_modules (default: examples/pipe)."""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
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
            (".version = PLUMBLINE_TRACER_VERSION", ".version = 99", "version 99", "version 2; compile"),
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
            error="my_tracer: trace() answered 2 of 1 rays; all 1 are faults\n")
        self.assertTrue(json.loads(answer)["fault"])

    def test_one_that_dies_loses_its_own_answers_only(self):
        """By every verb that asks: what it dies of is a fault, told once at the end; all else is as before."""
        self.build()
        text = (self.folder / "my_tracer.c").read_text()
        harmless = "if (slope == 0) return 0;"
        self.assertIn(harmless, text)
        (self.folder / "mortal.c").write_text(
            text.replace(harmless, harmless + "\n  if (ray->origin[0] == 0.375) abort();"))
        self.build(source="mortal.c", library="mortal.so")
        lines = "".join(QUESTION.replace("0.25,0.5,2", f"{x},0.5,2") for x in (0.25, 0.375, 0.5, 0.375, 2))
        told = "my_tracer: died of 2 rays (SIGABRT); these are faults\n"
        answers = self.plumbline("trace", "--tracer", "./mortal.so", "-", text=lines, error=told)
        self.assertEqual([json.loads(line)["hit"] for line in answers.splitlines()], [True, None, True, None, False])
        cases = "".join(f"case x{i}\ntriangle 0 0 0  1 0 0  0 1 0\nray {x} 0.5 2  0 0 -1\n\n"
                        for i, x in enumerate((0.25, 0.375, 0.5, 0.375, 2)))
        (self.folder / "x.case").write_text(cases)
        replayed = run("replay", "x.case", "--tracer", "./mortal.so", cwd=self.folder)
        self.assertEqual((replayed.returncode, replayed.stdout), (0, ""))
        self.assertIn("5 answers: 0 not as the files say, 0 known findings, 2 faults", replayed.stderr)
        self.assertIn(told, replayed.stderr)
        explained = run("explain", "--triangle", *"000100010", "--ray", "0.375", *"01001", "--tracer", "./mortal.so",
                        cwd=self.folder)
        self.assertIn("died of 1 ray (SIGABRT)", explained.stderr)

        swept = ("sweep", "--json", "--count", "20", "--tracer")
        mortal = "\n  if (ray->origin[2] > 0 && ray->direction[0] > 0) abort();"
        (self.folder / "mortal.c").write_text(text.replace(harmless, harmless + mortal))
        self.build(source="mortal.c", library="mortal.so")
        rows = {}
        for library, error in (("./libmine.so", ""), ("./mortal.so", None)):
            printed = self.plumbline(*swept, library, error=error)
            rows[library] = [json.loads(line) for line in printed.splitlines()]
        faults = [row["faults"] for row in rows["./mortal.so"]]
        self.assertGreater(sum(faults), 0)
        self.assertLess(sum(faults), sum(row["attempts"] for row in rows["./mortal.so"]))
        self.assertIn(f"my_tracer: died of {sum(faults)} rays (SIGABRT)",
                      run(*swept, "./mortal.so", cwd=self.folder).stderr)
        for whole, mortal_row in zip(rows["./libmine.so"], rows["./mortal.so"]):
            lost = whole["successes"] - mortal_row["successes"]
            self.assertTrue(0 <= lost <= mortal_row["faults"], (whole, mortal_row))

        run("mesh", "make", "sphere", "--triangles", 80, "-o", "sphere.ply", cwd=self.folder)
        scanned = run("scan", "sphere.ply", "--tracer", "./mortal.so", "--rays", 100, "--aim", "uniform", "-o", "scan",
                      "--findings", "store.db", cwd=self.folder)
        self.assertEqual(scanned.returncode, 0, scanned.stderr)
        self.assertRegex(scanned.stderr, r"my_tracer: died of [0-9]+ rays \(SIGABRT\)")
        findings = self.folder / "scan" / "findings" / "my_tracer"
        self.assertIn("# my_tracer dies of this ray", (findings / "death.case").read_text())
        plain = (findings / "death.min.case").read_text()
        self.assertRegex(plain, r"# shrunk: \d+ triangles -> 1,")
        again = run("replay", findings / "death.min.case", "--tracer", "./mortal.so", cwd=self.folder)
        self.assertIn("my_tracer: died of 1 ray (SIGABRT)", again.stderr)
        self.assertIn("death", run("triage", "list", "store.db", cwd=self.folder).stdout)

        compared = run("compare", "./mortal.so", "exact", "--inputs", "binary64", "--family", "random", "--count", 50,
                       cwd=self.folder)
        self.assertEqual(compared.returncode, 0, compared.stderr)
        self.assertRegex(compared.stderr, r"my_tracer: died of [0-9]+ rays \(SIGABRT\)")


class Program(ForeignTest):
    """Programs behind --tracer pipe:CMD, most of which don't keep to the rules."""

    # Answers each line rightly, but for what is put in place of MISCHIEF; `n` counts the lines from 0, the easy case
    # that is asked first not among them.
    SCRIPT = """
import json, os, sys, time
n = -2
for line in sys.stdin:
    n += 1
    case = json.loads(line)
    x, y = case["origin"][0], case["origin"][1]
    out = json.dumps({"id": case["id"], "hit": x >= 0 and y >= 0 and x + y <= 1}) + "\\n"
    MISCHIEF
    sys.stdout.write(out)
    sys.stdout.flush()
"""

    def program(self, mischief="pass"):
        path = self.folder / "program.py"
        path.write_text(self.SCRIPT.replace("MISCHIEF", mischief))
        return f"pipe:{shlex.quote(sys.executable)} -B {path}"

    def cases(self, xs):
        text = "".join(f"case x{i}\ntriangle 0 0 0  1 0 0  0 1 0\nray {x} 0.25 1  0 0 -1\n\n"
                       for i, x in enumerate(xs))
        path = self.folder / "x.case"
        path.write_text(text)
        return path

    def trace(self, tracer, xs, *options):
        lines = "".join(QUESTION.replace("0.25,0.5,2", f"{x},0.5,2") for x in xs)
        result = run("trace", "--tracer", tracer, *options, "-", text=lines)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [json.loads(line)["hit"] for line in result.stdout.splitlines()], result.stderr

    def test_right_answers(self):
        self.assertEqual(self.trace(self.program(), [0.25, 2, 0.5, -1]), ([True, False, True, False], ""))
        result = run("replay", self.cases([0.25, 2]), "--tracer", self.program())
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertIn("2 cases in 1 files, 2 answers: 0 not as the files say, 0 known findings, 0 faults",
                      result.stderr)
        self.assertEqual(self.trace(self.program(), [0.1]), ([True], ""))
        self.assertEqual(self.trace(self.program('assert case.get("precision") is None'), [0.1]), ([True], ""))

    def test_it_is_judged_by_its_contract(self):
        """Edges are missed and what is a hair outside is hit: wrong by default, right by what it says of itself."""
        tracer = self.program('out = out.replace("true", "false") if x == 0 else out; '
                              'out = out.replace("false", "true") if x == -0.125 else out')
        cases = self.cases([0, 0.25, -0.125])
        for contract, *told in [
            ("", "x0: NAME: new false-miss", "x2: NAME: new false-hit"),
            ("[edges=open]", "x2: NAME: new false-hit"),
            ("[edges=unspecified,slack_absolute=0.125]",),
            ("[slack_relative=0.01]", "x0: NAME: new false-miss", "x2: NAME: new false-hit"),
        ]:
            with self.subTest(contract):
                name = tracer.replace("pipe:", f"pipe{contract}:")
                result = run("replay", cases, "--tracer", name)
                self.assertEqual(result.returncode, 1 if told else 0, result.stderr)
                self.assertEqual(result.stdout.count("new "), len(told))
                for part in told:
                    self.assertIn(part.replace("NAME", name), result.stdout)
        answers = run("trace", "-", "--merged", "--tracer", tracer, text=QUESTION.replace("0.25,0.5", "0,0.5")).stdout
        for contract, verdict in [("", "false-miss"), ("[edges=open]", "correct"),
                                  ("[edges=one_owner]", "unspecified")]:
            judged = run("judge", "-", "--tracer", tracer.replace("pipe:", f"pipe{contract}:"), text=answers)
            self.assertEqual(json.loads(judged.stdout)["verdict"], verdict, judged.stderr)

    def test_a_contract_that_cant_be_read(self):
        for name, *parts in [
            ("pipe[edges=opn]:cat", "pipe[edges=opn]:cat: edges can't be 'opn'; did you mean 'open'?"),
            ("pipe32[edge=open]:cat", "a contract has no 'edge'; did you mean 'edges'?"),
            ("pipe[edges=open:cat", "no ']:' behind the '['"),
            ("pipe[edges=open]:", "no command"),
        ]:
            self.assert_trouble(run("trace", "-", "--tracer", name), *parts)

    def test_binary32(self):
        tracer = self.program('assert case["precision"] == "binary32" and (n < 0 or x == 0.10000000149011612)')
        self.assertEqual(self.trace(tracer.replace("pipe:", "pipe32:"), [0.1]), ([True], ""))

    def test_each_misdeed_is_a_fault_of_its_case_alone(self):
        bad = 'if x == 0.375: '
        for mischief, *told in [
            ("os._exit(3)", "ended without an answer (exit code 3)"),
            ("os.kill(os.getpid(), 11)", "ended without an answer (signal 11: Segmentation fault)"),
            ("out = 'gibberish\\n'", "its output:", "not a JSON object"),
            ("out = out[:9] + '\\n'", "malformed JSON"),
            ("out = json.dumps({'id': case['id']}) + '\\n'", "an answer without 'hit'"),
            ("out = out.replace('hit', 'hitt')", "unknown key 'hitt'; did you mean 'hit'?"),
            ("out = json.dumps({'id': 77777, 'hit': True}) + '\\n'", "an answer with the id 77777, and the cases"),
            ("out = json.dumps({'hit': True}) + '\\n'", "an answer with the id null"),
            ("out = json.dumps({'id': case['id'], 'hit': True, 'triangle_index': 1}) + '\\n'",
             "triangle_index 1 of 1 triangles; they count from 0"),
            ("out *= 2", "more lines than cases; answer each line once"),
        ]:
            with self.subTest(mischief):
                hits, error = self.trace(self.program(bad + mischief), [0.25, 0.375, 2, 0.5])
                self.assertEqual(hits, [True, None, False, True], error)
                for part in told:
                    self.assertIn(part, error)
                self.assertIn('a fault: {"id":0,"triangle":', error)
                self.assertIn('"origin":[0.375,0.5,2]', error)

    def test_in_a_batch_too(self):
        swept = ("sweep", "--mode", "surface", "--json", "--count", "20", "--tracer")
        right = [json.loads(line) for line in self.plumbline(*swept, "exact").splitlines()]
        self.assertGreater(sum(row["attempts"] for row in right), 64)
        attempts = {}
        for mischief, told in [("pass", ""), ("if n > 0 and n % 40 == 39: os._exit(1)", "it is started anew"),
                               ("if n == 30: out *= 2", "two answers with the id"),
                               ("if n == 30: out = 'x\\n'", "it is started anew")]:
            with self.subTest(mischief):
                tracer = self.program(mischief)
                text = self.plumbline(*swept, tracer, "--jobs", "1", error=None)
                rows = [json.loads(line) for line in text.splitlines()]
                self.assertEqual(sum(row["faults"] for row in rows), 0)
                attempts[mischief] = [(row["attempts"], row["successes"]) for row in rows]
                self.assertEqual(attempts[mischief], attempts["pass"])
                self.assertIn(told, run(*swept, tracer, "--jobs", "1").stderr)

    def test_answers_in_any_order(self):
        (self.folder / "shuffle.py").write_text(
            "import json, sys\n"
            "lines = []\n"
            "while True:\n"
            "    lines.append(json.loads(sys.stdin.readline() or sys.exit()))\n"
            "    if len(lines) == (1 if lines[0]['id'] == 1 else 64):\n"
            "        for case in reversed(lines):\n"
            "            print(json.dumps({'id': str(case['id']), 'hit': False}))\n"
            "        sys.stdout.flush()\n"
            "        lines = []\n")
        text = self.plumbline("sweep", "--json", "--count", "20", "--jobs", "1", "--tracer",
                              f"pipe:{sys.executable} -B {self.folder}/shuffle.py")
        self.assertEqual(sum(json.loads(line)["faults"] for line in text.splitlines()), 0)

    def test_time_runs_out(self):
        tracer = self.program("if x == 0.375: time.sleep(60)")
        hits, error = self.trace(tracer, [0.25, 0.375, 2], "--tracer-timeout", "0.4")
        self.assertEqual(hits, [True, None, False])
        self.assertIn("no answer within 0.4 s; does it flush its output after each line?", error)

    def test_it_is_given_up(self):
        hits, error = self.trace(self.program("if x == 0.375: os._exit(1)"), [0.375] * 40)
        self.assertEqual(hits, [None] * 40)
        self.assertIn("20 faults in a row: given up", error)

    def test_one_that_ends_after_each_answer(self):
        tracer = self.program("sys.stdout.write(out); sys.stdout.flush(); os._exit(0)")
        self.assertEqual(self.trace(tracer, [0.25, 2])[0], [True, False])

    def test_standard_error_passes_through(self):
        self.assertIn("hello", self.trace(self.program("sys.stderr.write('hello\\n')"), [0.25])[1])

    def test_trouble_is_told_at_once(self):
        for command, *parts in [
            ("./none", "pipe:./none: it ended without an answer (exit code 127); try: echo '{\"id\":1,"),
            ("", "pipe:: no command; write --tracer 'pipe:./my_program'"),
            ("cat", "an answer without 'hit'"),
            ("sleep 60", "no answer within 0.3 s"),
        ]:
            with self.subTest(command):
                result = run("trace", "-", "--tracer", f"pipe:{command}", "--tracer-timeout", "0.3", cwd=self.folder)
                self.assertEqual(result.returncode, 2)
                for part in parts:
                    self.assertIn(part, result.stderr.splitlines()[-1])
        self.assert_trouble(run("trace", "-", "--tracer", "pipe:cat", "--tracer-timeout", "0"), "--tracer-timeout")


class Examples(ForeignTest):
    def judge(self, command, *generate):
        cases = self.plumbline("generate", *generate)
        answers = subprocess.run(command, shell=True, input=cases, capture_output=True, encoding="utf-8", timeout=120,
                                 cwd=self.folder)
        self.assertEqual((answers.returncode, answers.stderr), (0, ""))
        self.assertEqual(answers.stdout.count("\n"), cases.count("\n"))
        result = run("judge", "-", text=answers.stdout)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result.stderr

    def sweep(self, *tracers):
        options = [word for tracer in tracers for word in ("--tracer", tracer)]
        return [json.loads(line) for line in self.plumbline("sweep", "--json", *options).splitlines()]

    def test_python(self):
        command = f"{sys.executable} -B {EXAMPLES}/pipe/ray_tracer.py"
        self.assertIn("100 answers: 100 correct", self.judge(command, "random", "--count", "100"))
        for source in ("full_range", "coplanar", "exact_edge51", SOURCE / "corpus" / "hard"):
            self.judge(command, source, "--count", "200")
        rows = self.sweep(f"pipe:{command}")
        self.assertEqual([(row["successes"], row["faults"]) for row in rows if row["target"] == "interior"],
                         [(1344, 0)])

    def test_c(self):
        built = run("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-ffp-contract=off", "-o", "tracer",
                    EXAMPLES / "pipe" / "tracer.c", program=CC, cwd=self.folder)
        self.assertEqual((built.returncode, built.stderr), (0, ""))
        single = ("--precision", "binary32", "--count", "200")
        self.assertIn("200 answers: 200 correct", self.judge("./tracer", "random", *single))
        for source in ("full_range", "coplanar", "exact_edge23", SOURCE / "corpus" / "hard"):
            self.judge("./tracer", source, *single)
        rows = self.sweep("pipe32:./tracer")
        self.assertEqual([(row["successes"], row["faults"]) for row in rows if row["target"] == "interior"],
                         [(1344, 0)])

    def test_three_js(self):
        folder = pathlib.Path(os.environ.get("NODE_PATH_OF_EXAMPLES", EXAMPLES / "pipe"))
        if not shutil.which("node"):
            self.skipTest("node is not there: install nodejs")
        if not (folder / "node_modules" / "three-187").is_dir():
            self.skipTest(f"three.js is not there: run 'npm install' in {folder}")
        shutil.copy(EXAMPLES / "pipe" / "three.mjs", self.folder)
        (self.folder / "node_modules").symlink_to(folder / "node_modules")
        old, new = (f"pipe:node three.mjs three-{version}" for version in (160, 187))
        rows = self.sweep(old, new)
        wrong = {tracer: sum(row["false_misses"] + row["false_hits"] for row in rows if row["tracer"] == tracer)
                 for tracer in (old, new)}
        self.assertEqual(sum(row["faults"] for row in rows), 0)
        self.assertGreater(wrong[old], wrong[new])  # 0.187 has the watertight test

    def test_three_js_says_what_is_missing(self):
        if not shutil.which("node"):
            self.skipTest("node is not there: install nodejs")
        shutil.copy(EXAMPLES / "pipe" / "three.mjs", self.folder)
        result = run("trace", "-", "--tracer", "pipe:node three.mjs three-160", cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("the package 'three-160' is missing: run 'npm install'", result.stderr)


class Generate(ForeignTest):
    def cases(self, *arguments):
        return [json.loads(line) for line in self.plumbline("generate", *arguments).splitlines()]

    def test_families(self):
        self.assertEqual(len(self.cases("random")), 1000)
        first = self.plumbline("generate", "ulp51", "--count", "5", "--seed", "3")
        self.assertEqual(first, self.plumbline("generate", "ulp51", "--count", "5", "--seed", "3"))
        self.assertNotEqual(first, self.plumbline("generate", "ulp51", "--count", "5", "--seed", "4"))
        self.assertEqual([json.loads(line)["id"] for line in first.splitlines()], [f"ulp51-3-{i}" for i in range(5)])
        classes = self.plumbline("classify", "-", text=self.plumbline("generate", "exact_edge23", "--count", "50"))
        self.assertLessEqual({json.loads(line)["class"] for line in classes.splitlines()}, {"edge", "vertex"})
        self.assertEqual(self.cases("random", "--count", "0"), [])

    def test_every_source_is_read_again(self):
        named = run("generate", "nothing").stderr
        names = named.split("known: ")[1].strip().split(", ")
        self.assertIn("lattice", names)
        for name in names:
            self.assertIn(name, run("generate", "--help").stdout)
            for precision in ("binary32", "binary64"):
                cases = self.plumbline("generate", name, "--count", "20", "--precision", precision)
                self.assertEqual(self.plumbline("classify", "-", text=cases).count("\n"), 20)

    def test_the_lattice_is_the_sweep(self):
        cases = self.plumbline("generate", "lattice")
        self.assertEqual(cases.count("\n"), 21504)
        first = json.loads(cases.splitlines()[0])
        self.assertEqual((first["target"], first["wish"], first["standoff"]), ("interior", "hit", 5))
        traced = self.plumbline("trace", "--merged", "--tracer", "moller_trumbore_f64", "-", text=cases)
        judged = run("judge", "-", text=traced)
        counts = [json.loads(line)["verdict"] for line in judged.stdout.splitlines()]
        swept = self.plumbline("sweep", "--json", "--tracer", "moller_trumbore_f64")
        rows = [json.loads(line) for line in swept.splitlines()]
        self.assertEqual((counts.count("false-miss"), counts.count("false-hit")),
                         (sum(row["false_misses"] for row in rows), sum(row["false_hits"] for row in rows)))

    def test_files(self):
        (self.folder / "deep").mkdir()
        text = "case {}\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.1 0.25 1  0 0 -1\n"
        (self.folder / "deep" / "a.case").write_text(text.format("a"))
        (self.folder / "b.case").write_text(text.format("b"))
        self.assertEqual([case["id"] for case in self.cases(".")], ["b", "a"])
        self.assertEqual([case["id"] for case in self.cases(".", "--count", "1")], ["b"])
        self.assertEqual(self.cases("b.case", "--precision", "binary32")[0]["origin"][0], 0.10000000149011612)

    def test_trouble(self):
        self.assert_trouble(run("generate", "latice"), "unknown source 'latice'", "did you mean 'lattice'?")
        self.assert_trouble(run("generate", "./none.case"), "./none.case: cannot be opened: No such file")
        self.assert_trouble(run("generate", self.folder), "no *.case file in this folder")
        self.assert_trouble(run("generate"), "SOURCE is required")
        self.assert_trouble(run("generate", "random", "--count", "-1"), "--count", "no whole number")
        self.assert_trouble(run("generate", "random", "--precision", "float"), "--precision")


if __name__ == "__main__":
    unittest.main()
