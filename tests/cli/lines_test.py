"""classify, trace and judge: lines of JSON in, lines of JSON out. Environment: cli_case.py."""
import json
import subprocess
import unittest

from cli_case import DOWN, PROGRAM, UNIT, CliTest, question, run


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


if __name__ == "__main__":
    unittest.main()
