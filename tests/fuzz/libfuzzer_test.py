"""The fuzz program as services for fuzzing run it: abort mode and its baseline, short runs from nothing, merging of
corpora, and the replay program over the seeds of the corpus. Arguments: the fuzz program, the replay program,
plumbline, the folder of seeds."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SEEDS = pathlib.Path(sys.argv.pop())
PLUMBLINE = sys.argv.pop()
REPLAY = sys.argv.pop()
FUZZER = sys.argv.pop()
TRACER = "moller_trumbore_f64"
LIBFUZZERS_CRASH = 77


class LibFuzzerTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)

    def run_program(self, program, *arguments):
        return subprocess.run([program, *map(str, arguments)], cwd=self.scratch, capture_output=True, text=True,
                              timeout=300)

    def fuzz(self, *arguments, tracer=TRACER):
        return self.run_program(FUZZER, f"--tracer={tracer}", *arguments)

    def campaign(self, *options, runs=20000):
        """Its folder."""
        folder = self.scratch / "campaign"
        done = self.fuzz(f"--campaign={folder}", f"--runs={runs}", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def worst_nominal(self, *arguments):
        summary = self.scratch / "summary.json"
        done = self.fuzz(f"--summary={summary}", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(summary.read_text())["worst_nominal_severity"]

    def assert_alarm(self, done):
        """The class that it tells."""
        self.assertNotEqual(done.returncode, 0)
        told = re.search(r"^plumbline: Assertion `(\w+)' failed\nDEDUP_TOKEN: (\w+)\n", done.stderr, re.M)
        self.assertIsNotNone(told, done.stderr)
        self.assertEqual(told[1], told[2])
        self.assertIn("\ncase ", done.stderr)
        return told[1]


def class_of(case):
    kind, element = re.match(r"(false-miss|false-hit|displaced|not-finite|death)-"
                             r"(?:(ab|bc|ca|a|b|c|plane|t_min|t_max)-)?", case.stem).groups()
    return kind, element, "-nominal" in case.stem


class Abort(LibFuzzerTest):
    def test_at_the_first_finding(self):
        done = self.fuzz("--abort", "--runs=20000")
        token = self.assert_alarm(done)
        self.assertEqual(done.returncode, LIBFUZZERS_CRASH)  # its handler of SIGABRT
        self.assertRegex(token, r"^false_(miss|hit)_(ab|bc|ca|a|b|c|plane|t_min|t_max)_(nominal|ill_conditioned)$")
        # The input that libFuzzer leaves raises the same alarm.
        crash, = self.scratch.glob("crash-*")
        self.assertEqual(crash.stat().st_size, 136)
        self.assertEqual(self.assert_alarm(self.fuzz("--abort", crash)), token)
        self.assertEqual(self.fuzz("--record", crash).returncode, 0)

    def test_by_sigabrt(self):
        done = self.fuzz("--abort", "--runs=20000", "-handle_abrt=0")
        self.assert_alarm(done)
        self.assertEqual(done.returncode, -6)

    def test_the_case_is_one(self):
        done = self.fuzz("--abort", "--runs=20000")
        self.assert_alarm(done)
        text = done.stderr.split("DEDUP_TOKEN: ", 1)[1].split("\n", 1)[1].split("==", 1)[0]
        file = self.scratch / "alarm.case"
        file.write_text(text)
        done = self.run_program(PLUMBLINE, "replay", file, "--tracer", TRACER)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_not_at_what_is_known(self):
        known = self.campaign() / "findings"
        count = len(list(known.glob("*.case")))
        self.assertGreater(count, 20)
        self.assert_alarm(self.fuzz("--abort", f"--seeds={known}", f"--runs={count}"))
        done = self.fuzz("--abort", f"--baseline={known}", f"--seeds={known}", f"--runs={count}")
        self.assertEqual(done.returncode, 0, done.stderr)
        # Less the only one of its class, at that one.
        classes = [class_of(case) for case in known.glob("*.case")]
        alone = [case for case in sorted(known.glob("*-nominal-*.case")) if classes.count(class_of(case)) == 1]
        self.assertTrue(alone)
        for case in alone[:3]:
            fewer = self.scratch / "fewer"
            shutil.copytree(known, fewer, ignore=shutil.ignore_patterns(case.name))
            done = self.fuzz("--abort", f"--baseline={fewer}", f"--seeds={known}", f"--runs={count}")
            self.assert_alarm(done)
            self.assertIn(f"\ncase {case.stem}\n", done.stderr)
            shutil.rmtree(fewer)

    def test_at_what_is_twice_as_severe(self):
        lines = (self.campaign() / "findings.ndjson").read_text().splitlines()
        told = {}
        for line in lines:
            told.setdefault(json.loads(line)["signature"], []).append(line)
        tried = 0
        for signature, several in told.items():
            if len(several) < 2:
                continue
            mild, severe = self.scratch / "mild.case", self.scratch / "severe.case"
            for file, line in ((mild, several[0]), (severe, several[-1])):
                case = {key: value for key, value in json.loads(line).items()
                        if key in ("precision", "triangle", "origin", "direction", "t_min", "t_max")}
                case["id"] = signature
                converted = subprocess.run([PLUMBLINE, "convert", "-"], input=json.dumps(case) + "\n",
                                           capture_output=True, text=True)
                self.assertEqual(converted.returncode, 0, converted.stderr)
                file.write_text(converted.stdout)
            def run(known, seed):
                return self.fuzz("--abort", f"--baseline={known}", f"--seeds={seed}", "--runs=1")
            self.assertEqual(run(mild, mild).returncode, 0)
            self.assert_alarm(run(mild, severe))
            self.assertEqual(run(severe, mild).returncode, 0)
            tried += 1
            if tried == 4:
                break
        self.assertEqual(tried, 4)

    @unittest.skipUnless(shutil.which("gdb"), "no gdb")
    def test_each_class_has_a_function_of_its_own_on_top(self):
        tops = {}
        for case in sorted((self.campaign() / "findings").glob("*.case")):
            named = re.match(r"(false-(?:miss|hit)-\w+)-.*?(nominal|$)", case.stem)
            kind = named.groups() if named else None
            if kind is None or kind in tops or len(tops) == 4:
                continue
            done = self.run_program("gdb", "-batch", "-ex", "run", "-ex", "bt", "--args", FUZZER,
                                    f"--tracer={TRACER}", "--abort", f"--seeds={case}", "--runs=1", "-handle_abrt=0")
            frames = re.findall(r"^#\d+ .*?(?:in )?(plumbline::.*) \(", done.stdout, re.M)
            if not frames and "SIGABRT" not in done.stdout:
                self.skipTest("gdb can't run programs here")
            tops[kind] = frames[:2]
            self.assertRegex(frames[0], r"fail<\d+")
            self.assertIn("raise_alarm", frames[1])
        self.assertEqual(len({top[0] for top in tops.values()}), len(tops))
        self.assertEqual(len(tops), 4)


class Services(LibFuzzerTest):
    def test_four_runs_from_nothing(self):
        for mode in ("--abort", "--record"):
            for tracer in (TRACER, "woop_watertight_f32", "brlcad_bot_classic"):
                for space in ("ray", "target"):
                    done = self.fuzz(mode, f"--space={space}", "-seed=1337", "-runs=4", tracer=tracer)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertIn("Done 4 runs", done.stderr)

    def test_a_corpus_folder_is_the_archive(self):
        corpus = self.scratch / "corpus"
        corpus.mkdir()
        first = self.worst_nominal("--runs=5000", corpus)
        files = len(list(corpus.iterdir()))
        self.assertGreater(files, 100)
        self.assertGreaterEqual(self.worst_nominal("--runs=1", corpus), first)

    def test_trouble(self):
        for arguments, said in ((["--tracer=none"], "none"), (["--space=time", f"--tracer={TRACER}"], "--space"),
                                ([], "--tracer"), ([f"--tracer={TRACER}", "--seeds=nowhere"], "nowhere")):
            done = self.run_program(FUZZER, *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)

    def test_merging_keeps_the_elites(self):
        elites = self.campaign() / "elites"
        worst = self.worst_nominal("--runs=1", elites)
        for flag in ("-merge=1", "-set_cover_merge=1"):
            with self.subTest(flag=flag):
                merged = self.scratch / "merged"
                merged.mkdir()
                done = self.fuzz(flag, merged, elites)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertGreater(len(list(merged.iterdir())), len(list(elites.iterdir())) // 4)
                # What it keeps of the cells is told apart by eighths of an octave.
                self.assertGreaterEqual(self.worst_nominal("--runs=1", merged), worst / 1.125)
                shutil.rmtree(merged)


class Replay(LibFuzzerTest):
    def test_the_seeds(self):
        tracers = sorted(folder.name for folder in SEEDS.iterdir())
        self.assertGreaterEqual(len(tracers), 3)
        for tracer in tracers:
            with self.subTest(tracer=tracer):
                campaign = self.scratch / tracer
                seeds = {path.stem for path in (SEEDS / tracer).iterdir()}
                done = self.run_program(REPLAY, f"--tracer={tracer}", f"--campaign={campaign}", SEEDS / tracer)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual(done.stdout,
                                 f"{len(seeds)} of {len(seeds)} inputs are of the right size and were run\n")
                # Each is still the finding that its name tells.
                self.assertEqual({case.stem for case in (campaign / "findings").glob("*.case")}, seeds)

    def test_trouble(self):
        (self.scratch / "empty").mkdir()
        (self.scratch / "short").write_bytes(bytes(5))
        for path, code in (("empty", 2), ("nowhere", 2), ("short", 0)):
            done = self.run_program(REPLAY, f"--tracer={TRACER}", path)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "0 of 1 inputs are of the right size and were run\n")
        self.assertEqual(self.run_program(REPLAY, f"--tracer={TRACER}").returncode, 2)
        self.assertEqual(self.run_program(REPLAY, "--tracer=none").returncode, 2)

    def test_aborts_as_the_fuzzer_does(self):
        folder = self.campaign()
        done = self.run_program(REPLAY, f"--tracer={TRACER}", "--abort", folder / "elites")
        self.assert_alarm(done)
        self.assertEqual(done.returncode, -6)
        done = self.run_program(REPLAY, f"--tracer={TRACER}", "--abort", f"--baseline={folder / 'findings'}",
                                folder / "elites")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
