"""What replay writes for machines: JUnit, SARIF, NDJSON and GitHub's annotations against the committed schemas, with
exact margins, and names chosen to break them. Argument: the program."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
import xml.etree.ElementTree as ElementTree

import jsonschema

PROGRAM = os.path.abspath(sys.argv.pop())
SCHEMAS = pathlib.Path(__file__).resolve().parents[1] / "schemas"

# Passes 2^-51 beside vertex b; Moller and Trumbore's test in double hits it.
HAIR = b"case %b\ntriangle 0 0 1  0 0 -0x1.ffffffffffffep+0  1 0 0\nray 0 0 -2  0 1 0\n"
WRONG = "moller_trumbore_f64"
# Goes through the interior.
PLAIN = b"case %b\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n"
# Crosses both triangles of a pair beside their edge; the same test misses both, and hits what lies behind.
PAIR = (b"case %b\ntriangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
        b"triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n"
        b"ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n")
BEHIND = b"triangle -9 -5 2  3 -5 2  -3 9 2\n"
INVALID = b"case %b\ntriangle 0 0 0  1 0 0  0 inf 0\nray 0.25 0.25 1  0 0 -1\n"  # which `exact` doesn't answer

MIXED = b"\n".join([
    b"# A remark.", HAIR % b"new",
    HAIR % b"listed" + b"known moller_trumbore_f64 false-hit\n",
    PLAIN % b"gone" + b"expect interior hit t 1\nknown exact false-miss\n",
    HAIR % b"changed" + b"known moller_trumbore_f64 false-miss\n",
    PLAIN % b"mistaken" + b"expect vertex a t 2\n",
    INVALID % b"unanswered",
])
LINE = {name: MIXED.decode().splitlines().index(f"case {name}") + 1
        for name in ("new", "listed", "gone", "changed", "mistaken", "unanswered")}

# One word each, without '#'; bytes, since a file may hold any.
HOSTILE = [b'"', b"'", b"<script>alert(1)</script>", b"]]>", b"';DROP", b"&amp;", b"%0A%25", b"a:b,c::d", b"\\n\\",
           b"{0}{{", b"$(touch,pwned)`touch,pwned`", b"\x01\x1b[31m\x7f", b"\xff\xc0\xaf\xed\xa0\x80",
           "\ufffe\uffff\u2028\U0001f4a9".encode(), b"--id", b"../../x", b"[x](javascript:1)"]


def schema(name):
    return json.loads((SCHEMAS / f"{name}.schema.json").read_text())


class ReplayTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, content):
        (self.folder / name).write_bytes(content)
        return name

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True,
                              errors="surrogateescape", timeout=120, **options)

    def replay(self, *arguments, code):
        done = self.run_program("replay", *arguments, "--junit", "junit.xml", "--sarif", "x.sarif", "--json",
                                "x.ndjson")
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def rows(self):
        """The JSON lines, by id and tracer."""
        rows = [json.loads(line) for line in (self.folder / "x.ndjson").read_text("utf-8").split("\n")[:-1]]
        for row in rows:
            jsonschema.validate(row, schema("replay"))
        return {(row["id"], row["tracer"]): row for row in rows}

    def sarif(self):
        log = json.loads((self.folder / "x.sarif").read_text("utf-8"))
        jsonschema.validate(log, schema("sarif"))
        run = log["runs"][0]
        for result in run["results"]:
            self.assertEqual(run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"], result["ruleId"])
        return run

    def junit(self):
        path = self.folder / "junit.xml"
        done = subprocess.run(["xmllint", "--nonet", "--noout", "--schema", SCHEMAS / "junit.xsd", path],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        root = ElementTree.parse(path).getroot()
        for suite in root:
            self.assertEqual(int(suite.get("tests")), len(suite))
            self.assertEqual(int(suite.get("failures")), len(suite.findall("testcase/failure")))
            self.assertEqual(int(suite.get("skipped")), len(suite.findall("testcase/skipped")))
        for count in ("tests", "failures"):
            self.assertEqual(int(root.get(count)), sum(int(suite.get(count)) for suite in root))
        return root

    def assert_trouble(self, done, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, done.stderr)


class Reports(ReplayTest):
    def setUp(self):
        super().setUp()
        self.write("mixed.case", MIXED)

    def mixed(self, *options):
        return self.replay("mixed.case", "--tracer", WRONG, "--tracer", "exact", *options, code=1)

    def test_lines_for_people(self):
        done = self.mixed()
        self.assertEqual(done.stdout.splitlines(), [
            f"mixed.case: new: {WRONG}: new false-hit, severity 4.440892098500626e-16 (1 ulps)",
            "mixed.case: gone: exact: known as false-miss, it is now correct; remove the line 'known'",
            f"mixed.case: changed: {WRONG}: known as false-miss, it is now false-hit; look into it and change the "
            "line 'known', severity 4.440892098500626e-16 (1 ulps)",
            "mixed.case: mistaken: expected class vertex, it is interior; expected feature a, it is none; "
            "expected t 0x1p+1, it is 0x1p+0"])
        self.assertEqual(done.stderr,
                         "6 cases in 1 files, 12 answers: 4 not as the files say, 1 known findings, 1 faults\n")

    def test_json(self):
        self.mixed()
        rows = self.rows()
        self.assertEqual(len(rows), 6 * 2 + 2)
        self.assertEqual(rows["new", WRONG],
                         {"file": "mixed.case", "line": LINE["new"], "id": "new", "tracer": WRONG,
                          "verdict": "false-hit", "known": None, "severity": 2.0**-51, "severity_ulps": 1,
                          "signature": rows["new", WRONG]["signature"], "as_stated": False, "rule": "false-hit",
                          "message": "new false-hit, severity 4.440892098500626e-16 (1 ulps)"})
        self.assertTrue(rows["new", WRONG]["signature"].startswith("false-hit-"))
        for key, verdict, known, rule, as_stated in [
                (("listed", WRONG), "false-hit", "false-hit", None, True),
                (("listed", "exact"), "correct", None, None, True),
                (("gone", "exact"), "correct", "false-miss", "known-now-passes", False),
                (("gone", None), None, None, None, True),
                (("changed", WRONG), "false-hit", "false-miss", "false-hit", False),
                (("mistaken", None), None, None, "expectation-differs", False),
                (("unanswered", "exact"), "fault", None, "fault", True)]:
            row = rows[key]
            self.assertEqual((row["verdict"], row["known"], row["rule"], row["as_stated"], row["line"]),
                             (verdict, known, rule, as_stated, LINE[key[0]]), key)

    def test_json_alone_on_standard_output(self):
        self.mixed()
        done = self.run_program("replay", "mixed.case", "--tracer", WRONG, "--tracer", "exact", "--json", "-")
        self.assertEqual((done.returncode, done.stdout), (1, (self.folder / "x.ndjson").read_text()))

    def test_sarif(self):
        self.mixed()
        run = self.sarif()
        self.assertEqual([rule["id"] for rule in run["tool"]["driver"]["rules"]],
                         ["false-miss", "false-hit", "fault", "known-now-passes", "expectation-differs", "leak",
                          "wrong-nearest"])
        signature = self.rows()["new", WRONG]["signature"]
        told = []
        for result in run["results"]:
            place = result["locations"][0]
            physical = place["physicalLocation"]
            self.assertEqual(physical["artifactLocation"]["uri"], "mixed.case")
            told.append((result["ruleId"], result["level"], place["logicalLocations"][0]["name"],
                         physical["region"]["startLine"], result["partialFingerprints"]["plumblineSignature/v1"]))
        self.assertEqual(told, [
            ("false-hit", "error", "new", LINE["new"], f"{WRONG} {signature}"),
            ("known-now-passes", "error", "gone", LINE["gone"], "exact known-now-passes"),
            ("false-hit", "error", "changed", LINE["changed"], f"{WRONG} {signature}"),
            ("expectation-differs", "error", "mistaken", LINE["mistaken"], "expectation-differs"),
            ("fault", "warning", "unanswered", LINE["unanswered"], "exact fault")])
        self.assertIn(f"new: {WRONG}: new false-hit, severity 4.440892098500626e-16 (1 ulps)\n",
                      run["results"][0]["message"]["text"])

    def test_junit(self):
        self.mixed()
        root = self.junit()
        self.assertEqual([suite.get("name") for suite in root], ["what the files expect", WRONG, "exact"])
        self.assertEqual([[case.get("name") for case in suite] for suite in root],
                         [["gone", "mistaken"], list(LINE), list(LINE)])
        self.assertEqual([(case.get("name"), case.find("failure").get("type")) for case in root.iter("testcase")
                          if case.find("failure") is not None],
                         [("mistaken", "expectation-differs"), ("new", "false-hit"), ("changed", "false-hit"),
                          ("gone", "known-now-passes")])
        skipped = [case.get("name") for case in root.iter("testcase") if case.find("skipped") is not None]
        self.assertEqual(skipped, ["unanswered"])
        new = root[1][0]
        self.assertEqual((new.get("classname"), new.get("file"), new.get("line")),
                         ("mixed.case", "mixed.case", str(LINE["new"])))
        failure = new.find("failure")
        self.assertEqual(failure.get("message"), "new false-hit, severity 4.440892098500626e-16 (1 ulps)")
        self.assertIn("severity   4.440892098500626e-16", failure.text)
        self.assertIn("= 1 ulps of the largest coordinate", failure.text)
        command = f"\nplumbline explain mixed.case --id new --tracer {WRONG}\n"
        self.assertTrue(failure.text.endswith(command), failure.text)

    def test_github(self):
        done = self.run_program("replay", "mixed.case", "--tracer", WRONG, "--tracer", "exact", "--github")
        self.assertEqual(done.returncode, 1)
        lines = done.stdout.splitlines()
        self.assertEqual([line.split("::")[1] for line in lines],
                         [f"error file=mixed.case,line={LINE['new']},title=plumbline false-hit",
                          f"error file=mixed.case,line={LINE['gone']},title=plumbline known-now-passes",
                          f"error file=mixed.case,line={LINE['changed']},title=plumbline false-hit",
                          f"error file=mixed.case,line={LINE['mistaken']},title=plumbline expectation-differs",
                          f"warning file=mixed.case,line={LINE['unanswered']},title=plumbline fault"])
        self.assertTrue(lines[0].split("::", 2)[2].startswith(
            f"new: {WRONG}: new false-hit, severity 4.440892098500626e-16 (1 ulps)%0A"), lines[0])

    def test_all_as_stated(self):
        listed = HAIR % b"listed" + b"known moller_trumbore_f64 false-hit\n"
        self.write("fine.case", listed + PLAIN % b"plain")
        done = self.replay("fine.case", "--tracer", WRONG, code=0)
        self.assertEqual(done.stdout, "")
        self.assertEqual(self.sarif()["results"], [])
        self.assertEqual(self.junit().get("failures"), "0")
        self.assertEqual([row["as_stated"] for row in self.rows().values()], [True, True])
        done = self.run_program("replay", "fine.case", "--tracer", WRONG, "--github")
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_a_fault_fails_where_it_is_said_to(self):
        self.write("x.case", INVALID % b"y")
        self.assertEqual(self.replay("x.case", "--tracer", "exact", code=0).stdout, "")
        done = self.replay("x.case", "--tracer", "exact", "--no-faults", code=1)
        self.assertRegex(done.stdout, r"^x.case: y: exact: .*fault")
        self.write("x.case", INVALID % b"y" + b"known exact fault\n")
        self.replay("x.case", "--tracer", "exact", "--no-faults", code=0)

    def test_a_known_fault_that_answers_now(self):
        self.write("x.case", PLAIN % b"x" + b"known exact fault\n" + INVALID % b"y" + b"known exact fault\n")
        done = self.replay("x.case", "--tracer", "exact", code=1)
        self.assertEqual(done.stdout,
                         "x.case: x: exact: known as fault, it is now correct; remove the line 'known'\n")
        self.write("x.case", INVALID % b"x" + b"known exact false-miss\n")
        done = self.replay("x.case", "--tracer", "exact", code=1)
        self.assertIn("known as false-miss, it is now fault; look into it", done.stdout)
        self.assertEqual([result["level"] for result in self.sarif()["results"]], ["error"])

    def test_the_same_in_every_run(self):
        """Wherever the files are named from, and however often: the reports are equal, byte for byte."""
        (self.folder / "deep" / "er").mkdir(parents=True)
        shutil.copy(self.folder / "mixed.case", self.folder / "deep" / "er")
        reports = []
        for path in ("deep", "./deep/er/mixed.case", "deep/../deep/er", self.folder / "deep" / "er" / "mixed.case"):
            self.replay(path, "--tracer", WRONG, code=1)
            reports.append([(self.folder / name).read_bytes() for name in ("junit.xml", "x.sarif", "x.ndjson")])
            self.assertIn(b'"uri":"deep/er/mixed.case"', reports[-1][1])
        self.assertEqual(reports[1:], reports[:1] * 3)

    def test_standard_input(self):
        done = self.run_program("replay", "-", "--tracer", WRONG, "--json", "-", input=MIXED.decode())
        row = json.loads(done.stdout.splitlines()[0])
        self.assertEqual((done.returncode, row["file"], row["line"]), (1, "stdin", LINE["new"]))


class Hostile(ReplayTest):
    """Names that would mean something in the form that holds them."""

    # A program that hits everything; its own command is its name.
    NAME = ("""pipe:%s -B hits.py # "quotes" <script>alert(1)</script> ]]> &lt; %%0A {0} ::error::\n"""
            "'; DROP TABLE x; -- \x01\x1b[0m\t")
    FOLDER = """a b%"<x>,':&{}#?"""

    def setUp(self):
        super().setUp()
        self.write("hits.py", b"import json, sys\nfor line in sys.stdin:\n"
                   b"    print(json.dumps({'id': json.loads(line)['id'], 'hit': True}), flush=True)\n")
        self.tracer = self.NAME % shlex.quote(sys.executable)
        (self.folder / self.FOLDER).mkdir()
        self.file = f"{self.FOLDER}/x.case"
        self.write(self.file, b"".join(HAIR % name for name in HOSTILE))

    @staticmethod
    def shown(name, xml=False):
        """As UTF-8 has it, and XML."""
        text = "".join(map(chr, name)) if name == b"\x01\x1b[31m\x7f" else None
        text = text or re.sub("[\udc80-\udcff]", "\ufffd", name.decode("utf-8", "surrogateescape"))
        return re.sub("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", "\ufffd", text) if xml else text

    def test_json(self):
        self.replay(self.FOLDER, "--tracer", self.tracer, code=1)
        self.assertEqual(list(self.rows()), [(self.shown(name), self.tracer) for name in HOSTILE])
        self.assertEqual({row["file"] for row in self.rows().values()}, {self.file})

    def test_sarif(self):
        self.replay(self.FOLDER, "--tracer", self.tracer, code=1)
        results = self.sarif()["results"]
        self.assertEqual([result["locations"][0]["logicalLocations"][0]["name"] for result in results],
                         [self.shown(name) for name in HOSTILE])
        for result, name in zip(results, HOSTILE):
            uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
            self.assertEqual(uri, "a%20b%25%22%3Cx%3E%2C%27%3A%26%7B%7D%23%3F/x.case")
            text = result["message"]["text"]
            undoubled = text.replace("{{", "{").replace("}}", "}")
            self.assertTrue(undoubled.startswith(f"{self.shown(name)}: {self.tracer}: new"), text)
            fingerprint = result["partialFingerprints"]["plumblineSignature/v1"]
            self.assertTrue(fingerprint.startswith(f"{self.tracer} false-hit-"), fingerprint)

    def test_junit(self):
        self.replay(self.FOLDER, "--tracer", self.tracer, code=1)
        suite = self.junit()[0]
        self.assertEqual(suite.get("name"), re.sub("[\x01\x1b]", "\ufffd", self.tracer))
        self.assertEqual([case.get("name") for case in suite], [self.shown(name, xml=True) for name in HOSTILE])
        self.assertEqual({case.get("file") for case in suite}, {self.file})

    def test_github(self):
        done = self.run_program("replay", self.FOLDER, "--tracer", self.tracer, "--github")
        self.assertEqual(done.returncode, 1)
        lines = done.stdout.split("\n")[:-1]
        self.assertEqual(len(lines), len(HOSTILE))
        for line, name in zip(lines, HOSTILE):
            form = r"::error file=([^:,]*),line=[0-9]+,title=plumbline false-hit::([^\r\n]*)"
            file, message = map(urllib.parse.unquote, re.fullmatch(form, line).groups())
            self.assertEqual(file, self.file)
            self.assertTrue(message.startswith(f"{self.shown(name)}: {self.tracer}: new false-hit"), message)

    def test_the_command_explains(self):
        """What a failure says is typed into a shell: of names that a shell would have liked to read otherwise."""
        self.replay(self.FOLDER, "--tracer", WRONG, code=1)
        texts = [case.find("failure").text for case in self.junit().iter("testcase")]
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "plumbline").symlink_to(PROGRAM)
        for name, text in zip(HOSTILE, texts):
            if name != self.shown(name, xml=True).encode() or name.startswith(b"--"):
                continue  # the form can't hold it, or explain takes it for an option
            command = text[text.rindex("\nplumbline explain") + 1:]
            with self.subTest(command=command):
                done = subprocess.run(command, shell=True, cwd=self.folder, capture_output=True, text=True,
                                      env=os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"})
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"case {name.decode()}\n", done.stdout)
                self.assertIn("verdict    false-hit", done.stdout)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         sorted([self.FOLDER, "bin", "hits.py", "junit.xml", "x.ndjson", "x.sarif"]))


class SeveralTriangles(ReplayTest):
    def replayed(self, *cases, code):
        self.write("several.case", b"\n".join(cases))
        done = self.replay("several.case", "--tracer", WRONG, "--tracer", "exact", code=code)
        return done, self.rows()

    def test_the_first_hit_is_judged(self):
        done, rows = self.replayed(PAIR % b"leak", PAIR % b"behind" + BEHIND, HAIR % b"beside" + BEHIND, code=1)
        for id, rule, signature in (("leak", "leak", "leak-interior"),
                                    ("behind", "wrong-nearest", "wrong-nearest-interior-through"),
                                    ("beside", "false-hit", "false-hit")):
            row = rows[id, WRONG]
            self.assertEqual((row["rule"], row["verdict"], row["signature"], row["as_stated"]),
                             (rule, rule, signature, False))
            self.assertGreater(row["severity"], 0)
            self.assertRegex(row["message"], rf"\Anew {rule}, severity \S+ \(\S+ ulps\)\Z")
            self.assertEqual((rows[id, "exact"]["verdict"], rows[id, "exact"]["rule"]), ("correct", None))
        self.assertEqual(len(done.stdout.splitlines()), 3)
        rules = {result["ruleId"] for result in self.sarif()["results"]}
        self.assertEqual(rules, {"leak", "wrong-nearest", "false-hit"})
        failures = [f for f in self.junit().iter("failure")]
        self.assertEqual([f.get("type") for f in failures], ["leak", "wrong-nearest", "false-hit"])
        self.assertIn("plumbline explain several.case --id leak --tracer " + WRONG, failures[0].text)

    def test_known_lines(self):
        _, rows = self.replayed(PAIR % b"listed" + b"known moller_trumbore_f64 leak\n",
                                PAIR % b"other" + BEHIND + b"known moller_trumbore_f64 wrong-nearest\n", code=0)
        self.assertEqual({row["known"] for row in rows.values()}, {"leak", "wrong-nearest", None})
        done, rows = self.replayed(PAIR % b"changed" + BEHIND + b"known moller_trumbore_f64 leak\n",
                                   PAIR % b"gone" + b"known exact leak\nknown moller_trumbore_f64 leak\n", code=1)
        self.assertEqual(rows["changed", WRONG]["rule"], "wrong-nearest")
        self.assertEqual(rows["gone", "exact"]["rule"], "known-now-passes")
        self.assertIn("known as leak, it is now correct; remove the line 'known'", done.stdout)

    def test_explain_has_the_reason(self):
        self.write("several.case", PAIR % b"pair" + BEHIND)
        done = self.run_program("explain", "several.case", "--tracer", WRONG)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for line in (r"crossed    3 of 3 triangles, which are counted from 0; in the exact order of t",
                     r"hit 1      t = \d+/\d+", r"hit 3      t = \d+/\d+",
                     r"           triangle 2: interior, from the (front|back)",
                     r"answer     hit", r"verdict    wrong-nearest: another triangle has to be hit first",
                     r"severity   \S+ .* ulps of the largest coordinate", r"signature  wrong-nearest-interior"):
            self.assertRegex(done.stdout, "(?m)^" + line)
        self.assertRegex(done.stdout, r"\Acase pair\n\ntracer     moller_trumbore_f64\nverdict    wrong-nearest")
        alone = self.run_program("explain", "several.case")
        self.assertIn("crossed    3 of 3", alone.stdout)
        self.assertNotIn("verdict", alone.stdout)
        self.assertEqual(re.findall(r"(?m)^triangle (\d+)$", alone.stdout), ["0", "1", "2"])
        self.write("many.case", PAIR % b"pair" + BEHIND + b"triangle 9 9 9  9 9 8  9 8 9\n" * 9)
        done = self.run_program("explain", "many.case", "--tracer", WRONG)
        self.assertEqual(set(re.findall(r"(?m)^triangle (\d+)$", done.stdout)), {"0", "1", "2"})
        self.assertIn("\n9 of 12 triangles are left out, which matter less: --all tells of each\n", done.stdout)
        done = self.run_program("explain", "many.case", "--all")
        self.assertEqual(len(re.findall(r"(?m)^triangle \d+$", done.stdout)), 12)
        self.assertNotIn("left out", done.stdout)
        self.write("solid.case", PAIR % b"pair" + b"mode solid\n")
        self.assert_trouble(self.run_program("explain", "solid.case", "--tracer", WRONG), "a solid of 2 triangles")


class Trouble(ReplayTest):
    def test_nothing_is_written(self):
        """Whatever is wrong is seen before a tracer is asked; a report of an earlier run stays."""
        self.write("fine.case", PLAIN % b"x")
        self.write("empty.case", b"")
        self.write("remark.case", b"# nothing but this\n")
        self.write("two.case", PLAIN % b"x" + b"triangle 0 0 0  1 0 0  0 1 0\nmode solid\n")
        self.write("broken.case", PLAIN % b"x" + b"rya 1\n")
        (self.folder / "none").mkdir()
        self.write("none/x.txt", PLAIN % b"x")
        (self.folder / "folder.case").mkdir()
        self.write("old.xml", b"old")
        for arguments, *parts in [
                (("empty.case",), "empty.case", "no case in this file"), (("remark.case",), "no case in this file"),
                (("none",), "none: no *.case file in this folder"), (("folder.case",), "no *.case file"),
                (("missing.case",), "missing.case: cannot be opened"),
                (("two.case",), "case 'x' is a solid of 2 triangles"),
                (("broken.case",), "broken.case:4:1: unknown key 'rya'"), (("fine.case", "two.case"), "two.case"),
                (("fine.case", "--tracer", "nobody"), "unknown tracer 'nobody'"),
                (("fine.case", "--tracer", "pipe:"), "no command"),
                (("fine.case", "--sarif", "missing/x.sarif"), "missing/x.sarif", "make its folder first"),
                (("fine.case", "--json", "none"), "none", "Is a directory"),
                (("fine.case", "--github", "--json", "-"), "--github", "--json -")]:
            with self.subTest(arguments=arguments):
                done = self.run_program("replay", *arguments, "--junit", "old.xml")
                self.assert_trouble(done, *parts)
                self.assertEqual((self.folder / "old.xml").read_bytes(), b"old")
                self.assertEqual([p.name for p in self.folder.glob("*.part")], [])
        self.assert_trouble(self.run_program("replay"), "PATH is required")
        self.assert_trouble(self.run_program("replay", "fine.case", "--junit", "/dev/full"), "/dev/full", "No space")

    def test_help_teaches(self):
        done = self.run_program("replay", "--help")
        self.assertEqual(done.returncode, 0)
        for word in ("--junit", "--sarif", "--json", "--github", "Exit codes", "known-now-passes", "as_stated",
                     "Example"):
            self.assertIn(word, done.stdout)


class Schemas(ReplayTest):
    def test_judge(self):
        triangle = '"triangle":[[0,0,0],[1,0,0],[0,1,0]],"direction":[0,0,-1]'
        lines = "".join(f'{{"id":{i},{triangle},"origin":{origin},"hit":{hit}}}\n' for i, origin, hit in [
            (1, "[0.25,0.25,1]", "true"), ('"<a>"', "[0.5,0,1]", "false"), ("null", "[0,0,1e300]", "false"),
            ("true", "[2,2,1]", "true"), (2.5, '["nan",0,1]', "true"), (3, "[0.25,0.25,1]", "null")])
        done = self.run_program("judge", "-", input=lines)
        verdicts = [json.loads(line) for line in done.stdout.splitlines()]
        for verdict in verdicts:
            jsonschema.validate(verdict, schema("judge"))
        self.assertEqual([v["verdict"] for v in verdicts],
                         ["correct", "false-miss", "false-miss", "false-hit", "unspecified", "fault"])

    def test_findings(self):
        for tracer, space in ((WRONG, "ray"), ("plucker_f32", "target")):
            done = self.run_program("fuzz", "--tracer", tracer, "--space", space, "--domain", "full", "--runs",
                                    "2000", "-o", space)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = (self.folder / space / "findings.ndjson").read_text().splitlines()
            self.assertGreater(len(lines), 3)
            for line in lines:
                jsonschema.validate(json.loads(line), schema("findings"))

    def test_they_can_fail(self):
        self.write("mixed.case", MIXED)
        self.replay("mixed.case", "--tracer", WRONG, code=1)
        log = json.loads((self.folder / "x.sarif").read_text())
        row = json.loads((self.folder / "x.ndjson").read_text().splitlines()[0])
        result = log["runs"][0]["results"][0]
        for kind, document, place, value in [
                ("replay", row, row, {"verdict": "wrong"}), ("replay", row, row, {"file": "/x.case"}),
                ("replay", row, row, {"as_stated": True}), ("replay", row, row, {"message": None}),
                ("replay", row, row, {"more": 1}), ("sarif", log, log, {"version": "2.0.0"}),
                ("sarif", log, result, {"ruleId": "x"}), ("sarif", log, result, {"message": "x"}),
                ("sarif", log, result, {"partialFingerprints": {}}), ("sarif", log, result, {"locations": []})]:
            with self.subTest(value=value):
                before = dict(place)
                place.update(value)
                with self.assertRaises(jsonschema.ValidationError):
                    jsonschema.validate(document, schema(kind))
                place.clear()
                place.update(before)
        text = (self.folder / "junit.xml").read_text()
        for before, after in [("<testsuites ", "<testsuites x='1' "), ('type="false-hit"', 'type="x"'),
                              ("</failure>", "</failure><failure/>")]:
            self.assertIn(before, text)
            self.write("junit.xml", text.replace(before, after, 1).encode())
            with self.assertRaises(AssertionError):
                self.junit()


if __name__ == "__main__":
    unittest.main()
