"""The verb fuzz as a user meets it: what a campaign's folder holds, going on, kills, full disks, and trouble told in
one line. Argument: the program. FUZZ_KILLS: how often a campaign is killed (5)."""
import collections
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop()
KILLS = int(os.environ.get("FUZZ_KILLS", 5))
SEED = int(os.environ.get("PLUMBLINE_SEED", 20260101))
TRACER = "moller_trumbore_f64"
FIELDS = ["tracer", "space", "domain", "seed", "executions", "seconds", "executions_per_s", "first_disagreement",
          "signatures", "worst_nominal_severity", "least_margin", "cells", "fingerprint"]


def plumbline(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, **options)


def start(*arguments):
    """In a process group of its own, as a terminal does it."""
    return subprocess.Popen([PROGRAM, *map(str, arguments)], start_new_session=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def commands():
    """The command line of every process."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            yield (process / "cmdline").read_bytes()
        except OSError:  # it has ended
            pass


class FuzzTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name) / "campaign"

    def fuzz(self, *options, tracer=TRACER, **more):
        return plumbline("fuzz", "--tracer", tracer, "-o", self.folder, *options, **more)

    def assert_fine(self, done):
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def assert_trouble(self, done, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, done.stderr)

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def told(self):
        """Of each signature, the severities told, in order."""
        log = self.folder / "findings.ndjson"
        told = collections.defaultdict(list)
        for line in log.read_text().splitlines() if log.exists() else []:
            finding = json.loads(line)
            told[finding["signature"]].append(finding["severity_ulps"])
        return told

    def cases(self):
        return {path.stem for path in (self.folder / "findings").glob("*.case")}

    def severity(self, signature):
        """As its case says it."""
        for line in (self.folder / "findings" / f"{signature}.case").read_text().splitlines():
            if line.startswith("# severity "):
                return float(line.split()[2])
        self.fail(f"{signature}.case names no severity")

    def assert_nothing_lost(self, told):
        """Every signature told is there, as a case at least as bad as it was told."""
        for signature, severities in told.items():
            self.assertIn(signature, self.cases())
            # The case has six digits.
            self.assertGreaterEqual(self.severity(signature), max(severities) * (1 - 1e-5), signature)

    def assert_replays(self, tracer=TRACER):
        done = plumbline("replay", self.folder / "findings", "--tracer", tracer)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Folder(FuzzTest):
    def test_summary_and_findings(self):
        done = self.fuzz("--runs", 5000, "--seed", 3)
        self.assert_fine(done)
        summary = self.summary()
        self.assertEqual(list(summary), FIELDS)
        self.assertEqual({k: summary[k] for k in ("tracer", "space", "domain", "seed", "executions")},
                         {"tracer": TRACER, "space": "ray", "domain": "nominal", "seed": 3, "executions": 5000})
        self.assertAlmostEqual(summary["executions_per_s"], summary["executions"] / summary["seconds"], delta=1)
        self.assertGreater(summary["worst_nominal_severity"], 1)
        self.assertTrue(1 <= summary["first_disagreement"] <= 1000)
        self.assertEqual(summary["signatures"], len(self.cases()))
        self.assertEqual(summary["cells"], len(list((self.folder / "elites").iterdir())))
        told = self.told()
        self.assertEqual(set(told), self.cases())
        self.assert_nothing_lost(told)
        self.assertAlmostEqual(max(self.severity(s) for s in self.cases() if "-nominal-" in s),
                               summary["worst_nominal_severity"], delta=1e-5 * summary["worst_nominal_severity"])
        for severities in told.values():
            for before, after in zip(severities, severities[1:]):
                self.assertGreaterEqual(after, 2 * before)
        self.assert_replays()
        self.assertIn(f"{TRACER}: 5000 executions", done.stdout)
        self.assertIn(f"{summary['signatures']} signatures", done.stdout)

    def test_lines_are_cases(self):
        self.assert_fine(self.fuzz("--runs", 500))
        findings = [json.loads(line) for line in (self.folder / "findings.ndjson").read_text().splitlines()]
        keys = ("triangle", "origin", "direction", "t_min", "t_max")
        cases = [json.dumps({key: finding[key] for key in keys}) + "\n" for finding in findings]
        done = plumbline("classify", "-", input="".join(cases))
        self.assert_fine(done)
        for finding, truth in zip(findings, map(json.loads, done.stdout.splitlines()), strict=True):
            self.assertEqual(finding["tracer"], TRACER)
            self.assertTrue(finding["signature"].startswith(finding["kind"]))
            if finding["kind"] in ("false-miss", "false-hit"):
                self.assertEqual(truth["hit"], finding["kind"] == "false-miss")

    def test_the_same_seed_is_the_same_search(self):
        prints, files = [], []
        for name, seed in (("one", 7), ("two", 7), ("three", 8)):
            self.folder = self.folder.with_name(name)
            self.assert_fine(self.fuzz("--runs", 2000, "--seed", seed))
            prints.append(self.summary()["fingerprint"])
            paths = [*(self.folder / "elites").iterdir(), *(self.folder / "findings").iterdir()]
            files.append({path.name: path.read_bytes() for path in paths})
        self.assertEqual(prints[0], prints[1])
        self.assertEqual(files[0], files[1])
        self.assertNotEqual(prints[0], prints[2])

    def test_every_space_and_domain(self):
        for space in ("ray", "target"):
            for domain in ("nominal", "full"):
                with self.subTest(space=space, domain=domain):
                    self.folder = self.folder.with_name(f"{space}-{domain}")
                    self.assert_fine(self.fuzz("--runs", 500, "--space", space, "--domain", domain,
                                               tracer="woop_watertight_f32"))
                    summary = self.summary()
                    self.assertEqual([summary[k] for k in ("space", "domain", "executions")], [space, domain, 500])
                    self.assertEqual(summary["signatures"], len(self.cases()))
                    if self.cases():
                        self.assert_replays("woop_watertight_f32")

    def test_nothing_found(self):
        done = self.fuzz("--runs", 500, tracer="exact")
        self.assert_fine(done)
        self.assertIn("Nothing found.", done.stdout)
        self.assertEqual((self.summary()["signatures"], self.summary()["first_disagreement"]), (0, None))
        self.assertFalse((self.folder / "findings.ndjson").exists())
        self.assert_fine(self.fuzz("--runs", 500, tracer="exact"))

    def test_seeds_are_begun_with(self):
        self.assert_fine(self.fuzz("--runs", 2000))
        worst = {s: self.severity(s) for s in self.cases()}
        seeds = self.folder / "findings"
        self.folder = self.folder.with_name("other")
        self.assert_fine(self.fuzz("--runs", len(worst) + 10, "--seed", 9, "--seeds", seeds))
        self.assertLessEqual(set(worst), self.cases())
        self.assertEqual(self.summary()["executions"], len(worst) + 10)


class GoingOn(FuzzTest):
    def test_executions_add_up(self):
        self.assert_fine(self.fuzz("--runs", 500))
        first, told = self.summary(), self.told()
        self.assert_fine(self.fuzz("--runs", 1500))
        both = self.summary()
        self.assertEqual(both["executions"], 2000)
        self.assertGreater(both["seconds"], first["seconds"])
        self.assertEqual(both["first_disagreement"], first["first_disagreement"])
        self.assertGreaterEqual(both["worst_nominal_severity"], first["worst_nominal_severity"])
        self.assertGreaterEqual(both["cells"], first["cells"])
        self.assertGreaterEqual(both["signatures"], first["signatures"])
        # What was told before isn't told again unless it is twice as severe.
        for signature, severities in self.told().items():
            self.assertEqual(severities[:len(told[signature])], told[signature])
            for before, after in zip(severities, severities[1:]):
                self.assertGreaterEqual(after, 2 * before, signature)
        self.assert_nothing_lost(self.told())

    def test_going_on_draws_other_numbers(self):
        self.assert_fine(self.fuzz("--runs", 500))
        one = self.summary()["fingerprint"]
        self.assert_fine(self.fuzz("--runs", 500))
        self.assertNotEqual(self.summary()["fingerprint"], one)

    def test_more_and_fewer_jobs(self):
        self.assert_fine(self.fuzz("--runs", 1001, "--jobs", 2))
        self.assertEqual(self.summary()["executions"], 1001)
        self.assertEqual(sorted(p.name for p in (self.folder / "jobs").glob("*.json")), ["0.json", "1.json"])
        self.assert_replays()
        self.assert_nothing_lost(self.told())
        self.assert_fine(self.fuzz("--runs", 500))
        self.assertEqual(self.summary()["executions"], 1501)
        self.assert_fine(self.fuzz("--runs", 600, "--jobs", 3))
        self.assertEqual(self.summary()["executions"], 2101)

    def test_jobs_search_differently(self):
        self.assert_fine(self.fuzz("--runs", 1000, "--jobs", 2))
        prints = {json.loads(p.read_text())["fingerprint"] for p in (self.folder / "jobs").glob("*.json")}
        self.assertEqual(len(prints), 2)

    def test_another_campaigns_folder_is_refused(self):
        self.assert_fine(self.fuzz("--runs", 500))
        before = {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file() and p.suffix != ".log"}
        for options, tracer in (((), "moller_trumbore_f32"), (("--space", "target"), TRACER),
                                (("--domain", "full"), TRACER), (("--jobs", "2"), "plucker_f64")):
            with self.subTest(options=options, tracer=tracer):
                self.assert_trouble(self.fuzz("--runs", 1000, *options, tracer=tracer), str(self.folder), TRACER,
                                    "space ray, domain nominal", "name another folder")
                self.assertEqual({p: p.read_bytes() for p in self.folder.rglob("*")
                                  if p.is_file() and p.suffix != ".log"}, before)

    def test_a_spoilt_state_is_named(self):
        self.assert_fine(self.fuzz("--runs", 500))
        (self.folder / "jobs" / "0.json").write_text('{"tracer": ')
        self.assert_trouble(self.fuzz("--runs", 1000), "0.json", "no summary of a campaign")

    def test_two_at_once(self):
        """Two campaigns with one folder, of different seeds: each goes on, and what either finds is there."""
        command = ["fuzz", "--tracer", TRACER, "-o", self.folder, "--time", "2"]
        both = [start(*command, "--seed", seed) for seed in ("1", "2")]
        for one in both:
            _, trouble = one.communicate(timeout=60)
            self.assertEqual((one.returncode, trouble), (0, ""))
        seeds = {json.loads(line)["seed"] for line in (self.folder / "findings.ndjson").read_text().splitlines()}
        self.assertEqual(seeds, {1, 2})
        self.assertEqual(set(self.told()), self.cases())
        self.assert_replays()
        self.assertEqual(self.summary()["signatures"], len(self.cases()))


class Killed(FuzzTest):
    def test_kill_loses_no_finding(self):
        chance = random.Random(SEED)
        print(f"seed {SEED}, {KILLS} kills")
        executions = 0
        for kill in range(KILLS):
            campaign = start("fuzz", "--tracer", TRACER, "-o", self.folder, "--time", "60")
            time.sleep(chance.uniform(0.05, 2))
            os.killpg(campaign.pid, signal.SIGKILL)
            campaign.communicate()
            told, cases = self.told(), self.cases()
            with self.subTest(kill=kill):
                if cases:
                    self.assert_replays()
                self.assert_nothing_lost(told)
                self.assert_fine(self.fuzz("--runs", 200, "--seed", 2 + kill))
                self.assertLessEqual(cases, self.cases())
                self.assertLessEqual(set(told), self.cases())
                after = self.told()
                for signature, severities in told.items():
                    self.assertEqual(after[signature][:len(severities)], severities)
                self.assert_nothing_lost(after)
                self.assert_replays()
                self.assertGreaterEqual(self.summary()["executions"], executions + 200)
            executions = self.summary()["executions"]
        self.assertGreater(len(self.cases()), 20)

    def test_processes_end_with_their_parent(self):
        campaign = start("fuzz", "--tracer", TRACER, "-o", self.folder, "--time", "60")
        while not self.cases():
            time.sleep(0.05)
        campaign.kill()
        campaign.communicate()
        until = time.monotonic() + 60
        while any(str(self.folder).encode() in command for command in commands()):
            self.assertLess(time.monotonic(), until)
            time.sleep(0.05)
        state = json.loads((self.folder / "jobs" / "0.json").read_text())  # and they have written what they came to
        self.assertGreater(state["executions"], 0)

    def test_ctrl_c(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                campaign = start("fuzz", "--tracer", TRACER, "-o", self.folder, "--time", "60")
                time.sleep(1)
                while not self.cases():  # on a busy machine
                    time.sleep(0.05)
                os.killpg(campaign.pid, number)
                out, trouble = campaign.communicate(timeout=20)
                self.assertEqual((campaign.returncode, trouble), (0, ""))
                self.assertIn(f"{TRACER}: {self.summary()['executions']} executions", out)
                self.assertGreater(self.summary()["executions"], 0)
                self.assert_replays()


class Trouble(FuzzTest):
    def test_a_folder_that_cannot_be(self):
        file = self.folder.with_name("file")
        file.write_text("")
        for self.folder in (file, file / "campaign", pathlib.Path("/proc/campaign")):
            self.assert_trouble(self.fuzz("--runs", 100), str(self.folder), "name another")

    def test_no_finding_is_lost_where_files_can_grow_no_further(self):
        self.assert_fine(self.fuzz("--runs", 500))
        told, cases = self.told(), self.cases()
        # As on a full disk: the log of findings can't grow, cases can.
        log = (self.folder / "findings.ndjson").stat().st_size
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (log, log))
        done = self.fuzz("--runs", 5000, "--seed", 2, preexec_fn=limit)
        self.assert_trouble(done, "not everything could be written")
        self.assertLessEqual(cases, self.cases())
        self.assert_nothing_lost(told)
        self.assert_replays()
        # With room again, the same command goes on.
        self.assert_fine(self.fuzz("--runs", 500, "--seed", 2))
        self.assert_nothing_lost(self.told())
        for line in (self.folder / "findings.ndjson").read_text().splitlines():
            json.loads(line)

    def test_no_finding_is_lost_where_nothing_can_be_written(self):
        self.assert_fine(self.fuzz("--runs", 500))
        told, cases = self.told(), self.cases()
        nothing = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
        done = self.fuzz("--runs", 5000, "--seed", 2, preexec_fn=nothing)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(self.cases(), cases)
        self.assertEqual(self.told(), told)
        self.assert_nothing_lost(told)
        self.assert_fine(self.fuzz("--runs", 500, "--seed", 2))
        self.assert_nothing_lost(self.told())

    def test_arguments(self):
        self.assert_trouble(self.fuzz("--runs", 100, tracer="moller_trumbore_f46"), "moller_trumbore_f46",
                            "moller_trumbore_f64")
        self.assertFalse(self.folder.exists())
        for wrong in (("--runs", "-1"), ("--runs", "x"), ("--time", "0"), ("--jobs", "0"), ("--space", "time"),
                      ("--domain", "whole"), ("--seed", "1.5"), ("--runs", "1", "--time", "1")):
            with self.subTest(wrong=wrong):
                self.assert_trouble(self.fuzz(*wrong), wrong[0])
                self.assertFalse(self.folder.exists())
        self.assert_trouble(plumbline("fuzz", "--tracer", TRACER), "--output")
        self.assert_trouble(plumbline("fuzz", "-o", self.folder), "--tracer")
        self.assert_trouble(self.fuzz("--runs", 100, "--seeds", "nowhere"), "nowhere")

    def test_help_teaches(self):
        done = plumbline("fuzz", "--help")
        self.assert_fine(done)
        for word in ("--space", "--domain", "--runs", "--time", "--jobs", "--seed", "summary.json", "findings.ndjson",
                     "Ctrl-C", "Example"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    unittest.main()
