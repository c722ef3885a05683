"""The command line as a user meets it: output, exit codes, and one clear line for every kind of trouble.

Environment: cli_case.py."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from cli_case import CORPUS, PROGRAM, CliTest, question, run


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
