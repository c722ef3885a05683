"""The command line as a user meets it: output, exit codes, and one clear line for every kind of trouble.

PLUMBLINE names the program under test, PLUMBLINE_CORPUS the folder corpus/."""
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["PLUMBLINE"]
CORPUS = pathlib.Path(os.environ["PLUMBLINE_CORPUS"])

UNIT = '"triangle":[[0,0,0],[1,0,0],[0,1,0]]'
DOWN = '"direction":[0,0,-1]'


def question(identity, origin, more=""):
    return f'{{"id":{identity},{UNIT},"origin":{origin},{DOWN}{more}}}\n'


def run(*arguments, text="", **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=text, capture_output=True, encoding="utf-8",
                          timeout=60, **options)


class CliTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def assert_trouble(self, result, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, result.stderr)


class Classify(CliTest):
    def classify(self, text, *options):
        result = run("classify", *options, "-", text=text)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_golden(self):
        self.assertEqual(
            self.classify(question(1, "[0.25,0.25,1]") + question('"e"', "[0.5,0,3]") + question("null", "[0,1,-1]") +
                          question("true", "[2,2,1]")),
            '{"id":1,"class":"interior","feature":null,"hit":true,"t":1,"u":0.25,"v":0.25,"t_exact":"1/1"}\n'
            '{"id":"e","class":"edge","feature":"ab","hit":true,"t":3,"u":0.5,"v":0,"t_exact":"3/1"}\n'
            '{"id":null,"class":"vertex","feature":"c","hit":false,"t":-1,"u":0,"v":1,"t_exact":"-1/1"}\n'
            '{"id":true,"class":"exterior","feature":null,"hit":false,"t":1,"u":2,"v":2,"t_exact":"1/1"}\n')

    def test_flat(self):
        across = '"direction":[1,0,0]'
        lines = self.classify(f'{{{UNIT},"origin":[-1,0.25,0],{across}}}\n{{{UNIT},"origin":[-1,2,0],{across}}}\n'
                              f'{{{UNIT},"origin":[-1,0,1],{across}}}\n'
                              f'{{"triangle":[[0,0,0],[1,1,1],[2,2,2]],"origin":[1,1,5],{DOWN}}}\n')
        nothing = {"id": None, "feature": None, "t": None, "u": None, "v": None, "t_exact": None}
        self.assertEqual([json.loads(line) for line in lines.splitlines()],
                         [nothing | {"class": "coplanar", "hit": None}, nothing | {"class": "coplanar", "hit": False},
                          nothing | {"class": "parallel", "hit": False},
                          nothing | {"class": "degenerate", "hit": None}])

    def test_invalid_goes_on(self):
        lines = self.classify(question(1, '["nan",0,1]') + question(2, "[1e999,0,1]") +
                              f'{{"id":3,{UNIT},"origin":[0,0,1],"direction":[0,0,0]}}\n' + question(4, "[0,0,1]"))
        answers = [json.loads(line) for line in lines.splitlines()]
        self.assertEqual([a["class"] for a in answers], ["invalid", "invalid", "invalid", "vertex"])
        self.assertEqual([a.get("reason") for a in answers],
                         ["a coordinate of the origin is NaN or infinite"] * 2 + ["the direction is zero", None])
        self.assertIsNone(answers[0]["hit"])
        self.assertNotIn("reason", answers[3])

    def test_range_ends_belong_to_it(self):
        lines = self.classify(question(1, "[0.25,0.25,1]", ',"t_min":1,"t_max":1') +
                              question(2, "[0.25,0.25,1]", ',"t_max":"0x1.fffffffffffffp-1"') +
                              question(3, "[0.25,0.25,-1]") + question(4, "[0.25,0.25,-1]", ',"t_min":"-inf"'))
        self.assertEqual([json.loads(line)["hit"] for line in lines.splitlines()], [True, False, False, True])

    def test_beyond_binary64_is_null(self):
        line = json.loads(self.classify(f'{{{UNIT},"origin":[0.25,0.25,1e300],"direction":[0,0,-1e-300]}}\n'))
        self.assertIsNone(line["t"])
        self.assertEqual((line["class"], line["hit"], line["u"]), ("interior", True, 0.25))

    def test_without_t_exact(self):
        self.assertNotIn("t_exact", self.classify(question(1, "[0,0,1]"), "--no-t-exact"))

    def test_nothing_in_nothing_out(self):
        self.assertEqual(self.classify(""), "")

    def test_answers_line_by_line(self):
        with subprocess.Popen([PROGRAM, "classify", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              encoding="utf-8") as process:
            for identity in (1, 2):
                process.stdin.write(question(identity, "[0,0,1]"))
                process.stdin.flush()
                self.assertEqual(json.loads(process.stdout.readline())["id"], identity)

    def test_trouble(self):
        good = question(1, "[0,0,1]")
        for text, *parts in [
            (good + '{"id":2,"tri', ":2:", "malformed JSON"),
            (good + good.replace("origin", "orgin"), "<stdin>:2:46: unknown key 'orgin'; did you mean 'origin'?"),
            (good + "\n[]\n", "<stdin>:3:1: not a JSON object"),
            ('{"origin":[0,0,0],"direction":[0,0,1]}', "no triangle"),
            (question(1, '["one",0,1]'), ":1:56:", "'origin'", '"one"'),
            (f'{{"triangles":[{UNIT[11:]},{UNIT[11:]}],"origin":[0,0,1],{DOWN}}}', ":1:1: 2 triangles"),
            (question(1, "[0.1,0,1]", ',"precision":"binary32"'), "0.1 is no binary32 number"),
        ]:
            with self.subTest(text=text):
                self.assert_trouble(run("classify", "-", text=text), *parts)

    def test_what_precedes_trouble_is_answered(self):
        result = run("classify", "-", text=question(1, "[0,0,1]") + "}")
        self.assertEqual(result.stdout.count("\n"), 1)


class Trace(CliTest):
    def test_exact(self):
        result = run("trace", "--tracer", "exact", "-", text=question(1, "[0.25,0.5,2]") + question(2, "[2,2,2]"))
        self.assertEqual(
            result.stdout,
            '{"id":1,"tracer":"exact","hit":true,"t":2,"u":0.25,"v":0.5,"in":null,"out":null}\n'
            '{"id":2,"tracer":"exact","hit":false,"t":null,"u":null,"v":null,"in":null,"out":null}\n')
        self.assertEqual(result.returncode, 0)

    def test_exact_has_no_answer_to_what_is_invalid(self):
        result = run("trace", "--tracer", "exact", "-", text=question(1, '["nan",0,2]') +
                     f'{{{UNIT},"origin":[0,0,1],"direction":[0,0,0]}}\n')
        self.assertEqual([(json.loads(line)["hit"], json.loads(line)["fault"]) for line in result.stdout.splitlines()],
                         [(None, True)] * 2)

    def test_segments(self):
        plate = ',"mode":"plate","thickness":0.5,"position":"centred","cosine":true,"orientation":"none"'
        result = run("trace", "--tracer", "brlcad_bot_classic", "-", text=question(1, "[0.25,0.25,2]", plate))
        self.assertEqual({k: v for k, v in json.loads(result.stdout).items() if k in ("hit", "in", "out")},
                         {"hit": True, "in": 1.75, "out": 2.25})

    def test_merged_is_what_judge_reads(self):
        result = run("trace", "--merged", "--tracer", "moller_trumbore_f32", "-", text=question(1, "[0.1,0.1,2]"))
        merged = json.loads(result.stdout)
        self.assertEqual((merged["triangle"], merged["origin"]), ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [0.1, 0.1, 2]))
        judged = run("judge", "-", text=result.stdout)
        self.assertEqual((judged.returncode, json.loads(judged.stdout)["verdict"]), (0, "correct"))

    def test_trouble(self):
        self.assert_trouble(run("trace", "--tracer", "mueller_trumbore", "-"),
                            "unknown tracer 'mueller_trumbore'", "exact")
        self.assert_trouble(run("trace", "--tracer", "plucker_f23", "-"),
                            "unknown tracer 'plucker_f23'; did you mean 'plucker_f32'?")
        self.assert_trouble(run("trace", "-"), "--tracer is required", "plumbline trace --help")


class Judge(CliTest):
    def judge(self, *answers, tracer=None):
        text = "".join(question(i, "[0.25,0.25,1]", "," + a) for i, a in enumerate(answers))
        return run("judge", *(["--tracer", tracer] if tracer else []), "-", text=text)

    def test_agreement(self):
        result = self.judge('"hit":true,"t":1', '"hit":null')
        self.assertEqual(result.returncode, 0)
        self.assertEqual(
            result.stdout.splitlines()[0],
            '{"id":0,"verdict":"correct","class":"interior","feature":null,"hit":true,"severity":null,'
            '"severity_ulps":null,"condition":null}')
        self.assertEqual(json.loads(result.stdout.splitlines()[1])["verdict"], "fault")
        self.assertEqual(result.stderr, "2 answers: 1 correct, 0 false-miss, 0 false-hit, 0 unspecified, 1 fault\n")

    def test_disagreement(self):
        result = self.judge('"hit":false')
        self.assertEqual(result.returncode, 1)
        line = json.loads(result.stdout)
        self.assertEqual((line["verdict"], line["severity"], line["condition"]), ("false-miss", 0.25, "nominal"))
        self.assertEqual(line["severity_ulps"], 0.25 * 2**52)

    def test_contract(self):
        behind = ',"t_min":2,"hit":true'
        for more, tracer, code in [
            (behind, None, 1),
            (behind, "brlcad_bot_classic", 0),  # reads no t_min
            (behind + ',"tracer":"brlcad_bot_classic"', None, 0),
            (behind + ',"tracer":"brlcad_bot_classic"', "exact", 1),
            (behind + ',"tracer":"unheard_of"', None, 1),
        ]:
            with self.subTest(more=more, tracer=tracer):
                self.assertEqual(self.judge(more[1:], tracer=tracer).returncode, code)

    def test_unknown_tracer_is_warned_of_once(self):
        result = self.judge(*['"hit":true,"tracer":"plucker_f23"'] * 3, '"hit":true,"tracer":"plucker_f64"')
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr.splitlines()[:-1],
                         ["warning: 'plucker_f23' is no tracer of this build: judged by the default contract; "
                          "did you mean 'plucker_f32'?"])
        self.assertNotIn("warning", self.judge('"hit":true,"tracer":"plucker_f23"', tracer="exact").stderr)

    def test_trouble(self):
        self.assert_trouble(run("judge", "-"), "nothing to judge")
        self.assert_trouble(run("judge", "-", text="\n\n"), "nothing to judge")
        self.assert_trouble(run("judge", "-", text=question(1, "[0,0,1]")), "<stdin>:1:1: no answer to judge")
        self.assert_trouble(self.judge('"hit":true', '"hit":1'), "<stdin>:2:", "expected true, false or null, not 1")
        self.assert_trouble(self.judge('"hit":true', tracer="nobody"), "unknown tracer 'nobody'")


class Replay(CliTest):
    CASE = "case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n"

    def replay(self, text, *options):
        return run("replay", *options, self.write("x.case", text))

    def test_corpus(self):
        for folder in ("hard", "adapters"):
            result = run("replay", CORPUS / folder)
            self.assertEqual((result.returncode, result.stdout), (0, ""))
            self.assertRegex(result.stderr, r"\A\d+ cases in \d+ files, .* 0 not as the files say, \d+ known findings")

    def test_corpus_and_every_tracer(self):
        """The files list what each gets wrong, but for the large libraries, which few builds have; and kernels that
        hang on what the compiler contracts and reassociates are listed as clang 19 builds them."""
        result = run("replay", CORPUS, "--tracer", "all")
        apart = r": (vtk_\w+|brlcad_librt|\w+_fma|\w+_fast_math): "
        unlisted = [line for line in result.stdout.splitlines() if not re.search(apart, line)]
        self.assertEqual(unlisted, [])
        self.assertNotIn("unknown to this build", result.stderr)

    def test_agreement(self):
        result = self.replay(self.CASE + "expect interior hit t 1 u 0.25 v 0.25\n")
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_expectation_that_is_not_the_truth(self):
        result = self.replay(self.CASE + "expect vertex a miss t 2\n", "--tracer", "exact")
        self.assertEqual(result.returncode, 1)
        self.assertEqual([line.split(": ", 1)[1] for line in result.stdout.splitlines()],
                         ["x: expected class vertex, it is interior; expected feature a, it is none; "
                          "expected answer miss, it is hit; expected t 0x1p+1, it is 0x1p+0"])

    def test_new_and_gone_findings(self):
        hard = (CORPUS / "hard" / "brlcad.case").read_text()
        self.assertEqual(self.replay(hard, "--tracer", "brlcad_bot_hlbvh").returncode, 0)
        unlisted = self.replay(hard.replace("known brlcad_bot_hlbvh false-miss\n", ""), "--tracer", "brlcad_bot_hlbvh")
        self.assertEqual(unlisted.returncode, 1)
        self.assertIn("hlbvh-upper-face: brlcad_bot_hlbvh: new false-miss", unlisted.stdout)
        gone = self.replay(self.CASE + "known exact false-miss\n")
        self.assertEqual(gone.returncode, 1)
        self.assertIn("x: exact: known as false-miss, it is now correct; remove the line 'known'", gone.stdout)

    def test_known_findings_of_unknown_tracers(self):
        result = self.replay(self.CASE + "known plucker_f23 false-miss\nknown exact false-miss\n",
                             "--tracer", "plucker_f64")
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertRegex(result.stderr, r"\A.*, 1 known findings of tracers not asked\n"
                         r"warning: 1 known findings of 'plucker_f23', which is unknown to this build; "
                         r"did you mean 'plucker_f32'\?\n\Z")

    def test_folders_are_searched_to_the_bottom(self):
        (self.folder / "deep").mkdir()
        self.write("deep/a.case", self.CASE)
        self.write("b.case", self.CASE)
        self.write("c.txt", "no case")
        self.assertRegex(run("replay", self.folder, "--tracer", "exact", "--tracer", "plucker_f64").stderr,
                         r"\A2 cases in 2 files, 4 answers")

    def test_trouble(self):
        self.assert_trouble(self.replay(self.CASE.replace("0.25", "nan")), "x.case:3:5: a NaN")
        self.assert_trouble(self.replay(self.CASE.replace("ray", "rya")),
                            "x.case:3:1: unknown key 'rya'; did you mean 'ray'?")
        self.assert_trouble(self.replay(self.CASE + "triangle 0 0 0 1 0 0 0 0 1\nmode solid"), "a solid of 2 triangles")
        self.assert_trouble(self.replay(question(1, "[0,0,1]")), "x.case:1:1: this is JSON, and .case text is expected")
        self.assert_trouble(self.replay("x" * 100), "x.case:1:1: unknown key '" + "x" * 40 + "...'; known: case,")
        self.assert_trouble(self.replay(""), "no case in this file")
        self.assert_trouble(run("replay", self.folder / "none"), "none: cannot be opened: No such file")
        (self.folder / "empty").mkdir()
        self.assert_trouble(run("replay", self.folder / "empty"), "no *.case file")
        self.assert_trouble(self.replay(self.CASE, "--tracer", "nobody"), "unknown tracer 'nobody'")
        self.assert_trouble(run("replay"), "PATH is required")


class Explain(CliTest):
    def test_command_line(self):
        result = run("explain", "--triangle", *"0 0 0 1.5 0 0 0 1.5 0".split(),
                     "--ray", *"0.75 0.75 5 0 0 -0x1p0".split(), "--range", "-inf", "inf", "--tracer", "exact")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for part in ("-9 * 2^-2", "edge bc", "(-inf, inf)", "verdict    correct"):
            self.assertIn(part, result.stdout)

    def test_numbers_are_no_options(self):
        result = run("explain", "--triangle", *"-.5 -.25 -0x1p-1 1 0 0 0 1 -.5".split(),
                     "--ray", *"1 -.25 0 1 -.5 0".split(), "--range", "1", "-inf")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for part in ("(-0.5, -0.25, -0.5)", "(0, 1, -0.5)", "(1, -0.25, 0)", "(1, -0.5, 0)", "(1, -inf)"):
            self.assertIn(part, result.stdout)

    def test_nan_is_invalid(self):
        for triangle, ray, reason in [("0 0 0 nan 0 0 0 1 0", "0 0 1 0 0 1", "coordinate of the triangle is NaN"),
                                      ("0 0 0 1 0 0 0 1 0", "0 0 1 0 0 nan", "coordinate of the direction is NaN")]:
            result = run("explain", "--triangle", *triangle.split(), "--ray", *ray.split(), "--tracer", "exact")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("invalid: a " + reason, result.stdout)

    def test_file(self):
        path = CORPUS / "hard" / "brlcad.case"
        everything = run("explain", path).stdout
        self.assertIn("case entry-nudge-interior", everything)
        one = run("explain", path, "--id", "hlbvh-upper-face", "--tracer", "brlcad_bot_hlbvh").stdout
        self.assertNotIn("entry-nudge", one)
        self.assertIn("verdict    false-miss", one)

    def test_trouble(self):
        self.assert_trouble(run("explain"), "--triangle and --ray")
        self.assert_trouble(run("explain", "--triangle", *"000000000"), "--triangle requires --ray")
        self.assert_trouble(run("explain", "--triangle", "1", "2"), "--triangle: 9 required X Y Z")
        self.assert_trouble(run("explain", "--triangle", *"000010001", "--ray", *"0010", "--tracer", "exact"),
                            "--ray: 6 numbers X Y Z  X Y Z, before '--tracer'")
        self.assert_trouble(run("explain", "--triangle", *"00010001x", "--ray", *"001001"),
                            "--triangle: 'x' is no number")
        self.assert_trouble(run("explain", CORPUS / "hard" / "brlcad.case", "--id", "nix"), "no case 'nix'")


class Tracers(CliTest):
    def test_table_and_json(self):
        tracers = [json.loads(line) for line in run("tracers", "--json").stdout.splitlines()]
        present = [tracer for tracer in tracers if tracer["present"]]
        absent = [tracer for tracer in tracers if not tracer["present"]]
        self.assertEqual(present + absent, tracers)
        exact = present[-1]
        self.assertEqual((exact["tracer"], exact["package"], exact["isolation"], exact["own_queries"]),
                         ("exact", None, "in-process", False))
        for tracer in present:
            self.assertIn(tracer["isolation"], ("in-process", "child"))
            self.assertIs(type(tracer["own_queries"]), bool)
            self.assertEqual(len(tracer), len(exact))
        for tracer in absent:
            needs = re.fullmatch("absent: needs (.+)", tracer["summary"]).group(1)
            self.assertRegex(needs, r"\Acmake/install-dependencies (tracers|vtk)|BRLCAD_ROOT|processor")
            self.assert_trouble(run("trace", "--tracer", tracer["tracer"], "-"), "it needs " + needs)
        rows = run("tracers").stdout.splitlines()[2:]
        self.assertEqual([row.split()[0] for row in rows], [tracer["tracer"] for tracer in tracers])

    def test_embree_is_present_or_named_with_its_package(self):
        tracers = [json.loads(line) for line in run("tracers", "--json").stdout.splitlines()]
        embree = [tracer for tracer in tracers if tracer["tracer"].startswith("embree_")]
        self.assertEqual([tracer["tracer"] for tracer in embree][:2], ["embree_default", "embree_robust"])
        for tracer in embree:
            self.assertRegex(tracer["package"], r"\Alibembree-dev\b")


class Convert(CliTest):
    # origin, direction, a, b, c, t_min, t_max
    RAY = (0.25, 0.5, 1, -0.0, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0, float("-inf"), 8)
    TEXT = ("case {}\nprecision {}\n"
            "triangle 0x0p+0 0x0p+0 0x0p+0   0x1p+0 0x0p+0 0x0p+0   0x0p+0 0x1p+0 0x0p+0\n"
            "ray 0x1p-2 0x1p-1 0x1p+0   -0x0p+0 0x0p+0 -0x1p+0\nrange -inf 0x1p+3\n")

    def convert(self, *arguments, text=""):
        result = run("convert", *arguments, text=text)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def write_bytes(self, name, form, *numbers):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(struct.pack(form, *numbers))
        return path

    def test_bytes_to_text_and_back(self):
        for form, precision in [("<17f", "binary32"), ("<17d", "binary64")]:
            with self.subTest(precision=precision):
                ray = self.write_bytes(precision, form, *self.RAY)
                text = self.convert(ray)
                self.assertEqual(text, self.TEXT.format(precision, precision))
                self.convert(self.write("ray.case", text), "--to", "bytes", "-o", self.folder / "made" / "out")
                self.assertEqual((self.folder / "made" / "out" / precision).read_bytes(), ray.read_bytes())

    def test_bytes_to_ndjson_and_back(self):
        ray = self.write_bytes("a", "<17d", *self.RAY)
        lines = self.convert(ray, "--to", "ndjson")
        self.assertEqual(json.loads(lines)["origin"], [0.25, 0.5, 1])
        for path in (self.write("a.ndjson", lines), self.write("a.jsonl", lines), "-"):
            self.convert(path, "--to", "bytes", "-o", self.folder / "out", text=lines)
            self.assertEqual((self.folder / "out" / "a").read_bytes(), ray.read_bytes())
        self.assertEqual(self.convert("-", text=lines), self.TEXT.format("a", "binary64"))

    def test_the_reports_rays_in_the_target_space(self):
        rays = run("generate", "lattice", "--count", "640").stdout
        self.convert("-", "--to", "bytes", "--space", "target", "-o", self.folder / "rays", text=rays)
        files = sorted((self.folder / "rays").iterdir())
        self.assertEqual([path.stat().st_size for path in files], [96] * 640)
        back = self.convert(self.folder / "rays", "--to", "ndjson")
        self.assertEqual(sorted(back.splitlines()), sorted(rays.splitlines()))
        # a, b, c, tolerance, standoff, target
        self.assertEqual(struct.unpack("<11dQ", (self.folder / "rays" / "lattice-10-10").read_bytes()),
                         (0, 0, 0, 0, 0, 1.5, 0, 1.5, 0, 0.1, 5, 10))

    def test_a_folder_of_all_forms(self):
        self.write_bytes("in/a", "<17f", *self.RAY)
        self.write("in/b.case", self.TEXT.format("b", "binary32") + "\n" + self.TEXT.format("c", "binary64"))
        self.write("in/d.ndjson", question('"d"', "[0,0,1]"))
        text = self.convert(self.folder / "in")
        self.assertEqual([line for line in text.splitlines() if line.startswith("case")],
                         ["case a", "case b", "case c", "case d"])
        self.convert(self.folder / "in", "--to", "bytes", "-o", self.folder / "out")
        self.assertEqual({path.name: path.stat().st_size for path in (self.folder / "out").iterdir()},
                         {"a": 68, "b": 68, "c": 136, "d": 136})

    def test_domains(self):
        huge = self.write_bytes("huge", "<17d", 2.0**20, *self.RAY[1:])
        self.assertIn("ray 0x1p-40 ", self.convert(huge))
        text = self.convert(huge, "--domain", "full")
        self.assertIn("ray 0x1p+20 ", text)
        path = self.write("huge.case", text)
        self.assert_trouble(run("convert", path, "--to", "bytes", "-o", self.folder / "out"),
                            "huge.case: case 'huge'", "beyond the nominal domain; add --domain full")
        self.convert(path, "--to", "bytes", "--domain", "full", "-o", self.folder / "out")
        self.assertEqual((self.folder / "out" / "huge").read_bytes(), huge.read_bytes())

    def test_the_corpus_survives(self):
        for path in sorted((CORPUS / "hard").glob("*.case")):
            out = self.folder / path.stem
            self.convert(path, "--to", "bytes", "--domain", "full", "-o", out)
            back = self.convert(out, "--domain", "full", "--to", "ndjson")
            straight = [json.loads(line) for line in self.convert(path, "--to", "ndjson").splitlines()]
            aimless = [{k: v for k, v in case.items() if k not in ("target", "tolerance", "standoff", "wish")}
                       for case in straight]
            self.assertEqual([json.loads(line) for line in back.splitlines()], sorted(aimless, key=lambda c: c["id"]))

    def test_trouble(self):
        odd = self.write_bytes("odd", "<16d", *self.RAY[:16])
        flat = self.write_bytes("flat", "<12d", *[0] * 12)
        good = self.write("good.case", self.TEXT.format("x", "binary64"))
        two = self.write("two.case", good.read_text().replace("ray", "triangle 0 0 0 1 0 0 0 1 0\nray"))
        tenth = self.write("tenth.case", good.read_text().replace("0x1p-2", "0.1"))
        (self.folder / "empty").mkdir()
        self.write_bytes("same/x", "<17d", *self.RAY)
        (self.folder / "same" / "y.case").write_text(good.read_text())
        to_bytes = ("--to", "bytes", "-o", self.folder / "out")
        for arguments, *parts in [
            ((odd,), "odd: 128 bytes", "68 (ray space, binary32), 136 (ray space, binary64), 48 (target", ".case"),
            ((odd, "--space", "target", "--precision", "binary32"), "has 48 (target space, binary32); name"),
            ((flat,), "flat: case 'flat'", "a NaN (ray origin, x)", "or use --to ndjson"),
            ((good, "--to", "bytes"), "add -o with a folder"),
            ((good, *to_bytes, "--space", "target"), "good.case: case 'x' is no input of the target space in",
             "the aim that leads to the ray", "try another --space"),
            ((two, *to_bytes), "two.case: case 'x' is no input of the ray space", "one triangle"),
            ((tenth, *to_bytes, "--precision", "binary32"), "tenth.case: case 'x'", "binary32", "--precision"),
            ((self.folder / "empty",), "empty: no file in this folder"),
            ((self.folder / "same",), "y.case: a second case 'x'; rename"),
            ((self.folder / "same", *to_bytes), "y.case: a second case 'x'; rename"),
            ((self.folder / "absent",), "absent: cannot be opened"),
            ((good, "--to", "xml"), "--to", "xml"),
        ]:
            with self.subTest(arguments=arguments):
                self.assert_trouble(run("convert", *arguments), *parts)
        for identity in ("../x", "", ".", "x.case"):
            with self.subTest(identity=identity):
                self.assert_trouble(run("convert", "-", *to_bytes, text=question(json.dumps(identity), "[0,0,1]")),
                                    f"case '{identity}': no name for a file of bytes; rename")
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["x"])


class Everywhere(CliTest):
    VERBS = ("sweep", "lattice", "classify", "trace", "judge", "replay", "explain", "tracers", "generate",
             "convert")

    def test_help_and_version(self):
        self.assertRegex(run("--version").stdout, r"\Aplumbline \d+\.\d+\.\d+\n\Z")
        for verb in self.VERBS:
            result = run(verb, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertRegex(result.stdout, rf"(?s)\n  -h,--help .*plumbline {verb}\b")  # an example
            self.assertIn(verb, run("--help").stdout)

    def test_wrong_command_line(self):
        self.assert_trouble(run(), "subcommand is required")
        self.assert_trouble(run("clasify", "-"), "unknown verb 'clasify'; did you mean 'classify'?")
        self.assert_trouble(run("classify", "--bogus", "-"), "--bogus")
        self.assert_trouble(run("classify", "no.ndjson"), "no.ndjson: cannot be opened: No such file or directory")
        self.assert_trouble(run("classify", self.folder), "Is a directory")

    def test_output_file_appears_whole(self):
        path = self.folder / "out.ndjson"
        self.assertEqual(run("classify", "-", "-o", path, text=question(1, "[0,0,1]")).returncode, 0)
        whole = path.read_text()
        self.assertEqual(whole.count("\n"), 1)
        self.assert_trouble(run("classify", "-", "-o", path, text=question(1, "[1,0,1]") + "}"))
        self.assertEqual(path.read_text(), whole)
        self.assertEqual(os.listdir(self.folder), ["out.ndjson"])

    def test_output_through_links_keeps_them(self):
        (self.folder / "deep").mkdir()
        for target in ("deep/there", "deep/not_yet"):
            with self.subTest(target):
                link, further = self.folder / f"{target[5:]}.link", self.folder / f"{target[5:]}.further"
                link.symlink_to(target)
                further.symlink_to(link)
                if target == "deep/there":
                    self.write(target, "old")
                self.assertEqual(run("classify", "-", "-o", further, text=question(1, "[0,0,1]")).returncode, 0)
                self.assertEqual((os.readlink(link), os.readlink(further)), (target, str(link)))
                self.assertEqual((self.folder / target).read_text().count("\n"), 1)
        self.assertEqual(sorted(os.listdir(self.folder / "deep")), ["not_yet", "there"])
        (self.folder / "ring").symlink_to("ring")
        self.assert_trouble(run("classify", "-", "-o", self.folder / "ring"), "Too many levels of symbolic links")

    def test_output_to_a_pipe_by_name(self):
        result = run("classify", "-", "-o", "/dev/stdout", text=question(1, "[0,0,1]"))
        self.assertEqual((result.returncode, result.stderr, result.stdout.count("\n")), (0, "", 1))

    def test_signals_leave_no_unfinished_file(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number), subprocess.Popen([PROGRAM, "classify", "-", "-o", self.folder / "out"],
                                                        stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                while not os.listdir(self.folder):
                    time.sleep(0.01)
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), -number)
                self.assertEqual(os.listdir(self.folder), [])

    def test_output_trouble(self):
        text = question(1, "[0,0,1]")
        self.assert_trouble(run("classify", "-", "-o", self.folder / "no" / "out", text=text),
                            "No such file or directory; make its folder first")
        self.assert_trouble(run("classify", "-", "-o", self.folder, text=text), "Is a directory; name a file in it")
        self.assert_trouble(run("classify", "-", "-o", "/dev/full", text=text),
                            "/dev/full: cannot be written: No space left on device; make room, or write elsewhere")
        for arguments in (["classify", "-"], ["tracers"], ["--help"], ["sweep", "--tracer", "exact", "--json"]):
            with self.subTest(arguments), open("/dev/full", "w", encoding="utf-8") as full:
                result = subprocess.run([PROGRAM, *arguments], input=text, stdout=full, stderr=subprocess.PIPE,
                                        encoding="utf-8", timeout=60)
                self.assert_trouble(result, "standard output: cannot be written: No space left")

    def test_closed_pipe(self):
        path = self.write("many.ndjson", question(1, "[0,0,1]") * 5000)
        with subprocess.Popen([PROGRAM, "classify", str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              encoding="utf-8") as process:
            process.stdout.readline()
            process.stdout.close()
            error = process.stderr.read()
            self.assertEqual(process.wait(timeout=60), 2)
        self.assertEqual(error, "plumbline: standard output: cannot be written: Broken pipe\n")


if __name__ == "__main__":
    unittest.main()
