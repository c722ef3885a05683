"""Stores of findings as a user meets them: fed by fuzz, sweep, judge and collect; listed, shown, settled, asked again,
promoted; and whole after kills, full disks and damage. Argument: the program. TRIAGE_KILLS: how often a process of two
campaigns is killed (5)."""
import json
import os
import pathlib
import random
import re
import resource
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop()
KILLS = int(os.environ.get("TRIAGE_KILLS", 5))
SEED = int(os.environ.get("PLUMBLINE_SEED", 20260101))
TRACER = "moller_trumbore_f64"
FALSE_HIT = '{"triangle":[[0,0,0],[1,0,0],[0,1,0]],"origin":[0.75,0.75,1],"direction":[0,0,-1],"hit":true%s}\n'
# A pair of triangles that moller_trumbore_f64 misses beside their edge, and one behind them that it hits.
PAIR = ("case %s\ntriangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
        "triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n"
        "ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n")
BEHIND = "triangle -9 -5 2  3 -5 2  -3 9 2\n"
HOSTILE = ["pipe:./x \"y\"", "a\nb", "'; DROP TABLE finding; --", "<script>alert(1)</script>", "\x1b[2Jx", "../../up",
           "nul\0behind", "./libx.so", "a" * 300, "\u202etxt"]


def plumbline(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


class TriageTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)
        self.store = self.scratch / "found.db"
        self.journal = self.scratch / "found.db.ndjson"

    def run_fine(self, *arguments, **options):
        done = plumbline(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def assert_trouble(self, done, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(str(part), done.stderr)

    def fuzz(self, *options, tracer=TRACER, folder="campaign", runs=2000):
        return self.run_fine("fuzz", "--tracer", tracer, "--runs", runs, "-o", self.scratch / folder, "--findings", self.store,
                             *options)

    def rows(self, *options):
        lines = [json.loads(line) for line in self.run_fine("triage", self.store, "--json", *options).splitlines()]
        return ([line for line in lines if line["row"] == "finding"], [line for line in lines if line["row"] == "search"])

    def dump(self):
        """Of the whole database, up to date."""
        self.run_fine("triage", self.store)
        database = sqlite3.connect(self.store)
        try:
            return list(database.iterdump())
        finally:
            database.close()

    def assert_the_same_when_rebuilt(self):
        before = self.dump()
        self.assertEqual(self.run_fine("triage", "rebuild", self.store), "")
        self.assertEqual(self.dump(), before)
        for suffix in ("", "-wal", "-shm"):
            pathlib.Path(f"{self.store}{suffix}").unlink(missing_ok=True)
        self.assertEqual(self.dump(), before)

    def judge(self, lines, code=1, *options):
        done = plumbline("judge", "-", "--findings", self.store, *options, input=lines)
        self.assertEqual(done.returncode, code, done.stderr)
        return done


class Feeding(TriageTest):
    def test_fuzz(self):
        self.fuzz()
        findings, searches = self.rows()
        summary = json.loads((self.scratch / "campaign" / "summary.json").read_text())
        self.assertEqual({f["signature"] for f in findings}, {p.stem for p in (self.scratch / "campaign/findings").glob("*.case")})
        self.assertEqual([(s["tracer"], s["executions"], s["worst_nominal_ulps"], s["least_margin_ulps"], s["signatures"])
                          for s in searches],
                         [(TRACER, 2000, summary["worst_nominal_severity"], summary["least_margin"], summary["signatures"])])
        self.assertGreater(summary["least_margin"], 0)
        lines = [json.loads(line) for line in (self.scratch / "campaign/findings.ndjson").read_text().splitlines()]
        self.assertGreaterEqual(sum(f["count"] for f in findings), len(lines))  # more: what grew by less than twice
        for f in findings:
            told = [line["severity_ulps"] for line in lines if line["signature"] == f["signature"]]
            self.assertIn(f["count"] - len(told), (0, 1))
            worst = (self.scratch / "campaign/findings" / (f["signature"] + ".case")).read_text()
            worst = float(re.search(r"^# severity (\S+)", worst, re.M)[1])  # six digits
            self.assertAlmostEqual(f["worst_ulps"], worst, delta=1e-5 * worst)
            self.assertLessEqual(f["simplest_bits"], f["worst_bits"])
        self.assert_the_same_when_rebuilt()

    def test_going_on_counts_its_own_executions(self):
        self.fuzz()
        self.fuzz(runs=500)
        self.assertEqual([s["executions"] for s in self.rows()[1]], [2000, 500])

    def test_a_clean_campaign_says_what_was_searched(self):
        out = self.fuzz(tracer="exact", runs=500)
        self.assertRegex(out, r"as near as \S+ ulps to another answer")
        out = self.run_fine("triage", self.store)
        self.assertIn("No open findings.", out)
        self.assertRegex(out, r"exact +1 +500 +0 +[0-9.e-]+ +20")

    def test_sweep(self):
        out = self.run_fine("sweep", "--findings", self.store, "--tracer", TRACER, "--tracer", "brlcad_bot_classic", "--tracer", "exact",
                            "--json")
        wrong = {}
        for row in map(json.loads, out.splitlines()):
            wrong[row["tracer"]] = wrong.get(row["tracer"], 0) + row["false_misses"] + row["false_hits"]
        findings, searches = self.rows()
        self.assertEqual([(s["tracer"], s["source"], s["executions"]) for s in searches],
                         [("brlcad_bot_classic", "sweep", 21504), ("exact", "sweep", 21504), (TRACER, "sweep", 21504)])
        found = {f["tracer"] for f in findings}
        self.assertEqual(found, {tracer for tracer, count in wrong.items() if count > 0})
        self.assertIn("brlcad_bot_classic", found)
        for f in findings:
            self.assertIn(f["kind"], ("false-miss", "false-hit"))
        self.assert_the_same_when_rebuilt()
        # Without a store the table is the same.
        self.assertEqual(self.run_fine("sweep", "--tracer", TRACER, "--tracer", "brlcad_bot_classic", "--tracer", "exact", "--json"), out)

    def test_judge(self):
        right = FALSE_HIT.replace("true", "false")
        self.judge(FALSE_HIT % ',"tracer":"theirs"' + right % ',"tracer":"theirs"' + FALSE_HIT % "")
        findings, searches = self.rows()
        self.assertEqual([(f["tracer"], f["signature"], f["count"]) for f in findings],
                         [(t, "false-hit-bc-nominal-c0", 1) for t in ("theirs", "unnamed")])
        self.assertEqual([(s["tracer"], s["executions"], s["signatures"]) for s in searches], [("theirs", 2, 1), ("unnamed", 1, 1)])
        self.judge(right % "", 0)
        self.assertEqual(self.rows()[1][-1]["worst_nominal_ulps"], 0)

    def test_judge_asks_a_known_tracer_again(self):
        """Its false misses are then signed with the test that it missed by."""
        self.fuzz()
        lines = [line for line in (self.scratch / "campaign/findings.ndjson").read_text().splitlines() if "-by-" in line]
        asked = []
        for finding in map(json.loads, lines):
            if finding["kind"] == "false-miss":
                case = {key: finding[key] for key in ("triangle", "origin", "direction", "t_min", "t_max", "tracer")}
                asked.append(json.dumps({**case, "hit": False}) + "\n")
        self.assertTrue(asked)
        self.store = self.scratch / "other.db"
        self.judge("".join(asked))
        self.assertTrue(all("-by-" in f["signature"] for f in self.rows()[0]))
        # What the tracer doesn't say now is signed by what the line says.
        self.store = self.scratch / "third.db"
        self.judge(FALSE_HIT % f',"tracer":"{TRACER}"')
        self.assertEqual([f["signature"] for f in self.rows()[0]], ["false-hit-bc-nominal-c0"])

    def test_collect(self):
        self.fuzz()
        before = {f["signature"]: f["worst_ulps"] for f in self.rows()[0]}
        self.store = self.scratch / "other.db"
        done = plumbline("triage", "collect", self.store, self.scratch / "campaign")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = {f["signature"]: f["worst_ulps"] for f in self.rows()[0]}
        self.assertEqual(set(after), set(before))
        for signature, ulps in before.items():  # the case that a campaign keeps is the worst, told or not
            self.assertTrue(ulps <= after[signature] * (1 + 1e-12) <= 2 * ulps * (1 + 1e-9), signature)
        self.assertIn(", 0 cases that", done.stderr)
        # Nothing is believed: neither that a case is wrong, nor who is to be run.
        (self.scratch / "lies.case").write_text("case hit\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n"
                                                f"known {TRACER} false-miss\nknown pipe:touch${{IFS}}{self.scratch}/ran false-hit\n")
        self.store = self.scratch / "third.db"
        done = plumbline("triage", "collect", self.store, self.scratch / "lies.case")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("0 findings, 1 cases", done.stderr)
        self.assertIn("skipped: 1 cases of 'pipe:touch", done.stderr)
        self.assertFalse((self.scratch / "ran").exists())
        self.assertEqual(self.rows()[0], [])
        (self.scratch / "bad.ndjson").write_text("{}\n")
        self.assert_trouble(plumbline("triage", "collect", self.store, self.scratch / "bad.ndjson"), "bad.ndjson:1")
        self.assert_trouble(plumbline("triage", "collect", self.store, self.scratch / "nowhere.case"), "nowhere.case")

    def test_two_writers_at_once(self):
        both = [subprocess.Popen([PROGRAM, "fuzz", "--tracer", TRACER, "--runs", "2000", "--seed", str(seed), "-o",
                                  self.scratch / str(seed), "--findings", self.store, "--jobs", "2"],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for seed in (1, 2)]
        for one in both:
            self.assertEqual((one.communicate(timeout=300)[1], one.returncode), ("", 0))
        findings, searches = self.rows()
        self.assertEqual([s["executions"] for s in searches], [2000, 2000])
        told = sum(len((self.scratch / seed / "findings.ndjson").read_text().splitlines()) for seed in "12")
        self.assertGreaterEqual(sum(f["count"] for f in findings), told)
        self.assert_the_same_when_rebuilt()


class Triage(TriageTest):
    def test_empty_store(self):
        (self.scratch / "none.case").write_text("case c\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n")
        self.assertEqual(plumbline("triage", "collect", self.store, self.scratch / "none.case").returncode, 0)
        self.assertEqual(self.run_fine("triage", self.store), "No open findings.\n\nNo search has ended yet.\n")
        self.assertEqual(self.run_fine("triage", self.store, "--json"), "")
        self.assert_trouble(plumbline("triage", "show", self.store, 1), "no finding 1")
        self.assert_trouble(plumbline("promote", self.store, 1, self.scratch), "no finding 1")

    def test_list(self):
        self.fuzz()
        out = self.run_fine("triage", self.store)
        self.assertEqual(self.run_fine("triage", "list", self.store), out)
        table, searched = out.split("\n\n")
        rows = [re.split(" {2,}", line.strip()) for line in table.splitlines()[2:-1]]
        findings = self.rows()[0]
        self.assertEqual([(row[0], row[3], row[4]) for row in rows], [(str(f["id"]), TRACER, f["signature"]) for f in findings])
        nominal = [f["conditioning"] == "nominal" for f in findings]
        self.assertEqual(nominal, sorted(nominal, reverse=True))
        worst = [f["worst_ulps"] for f in findings if f["conditioning"] == "nominal"]
        self.assertEqual(worst, sorted(worst, reverse=True))
        self.assertIn(f"{len(findings)} open findings of 1 tracers, {len(findings)} of them new", table)
        self.assertRegex(searched, rf"{TRACER} +1 +2000 ")
        done = plumbline("triage", self.store, "--tracer", "exact")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("has nothing of 'exact'; it has: ", done.stderr)

    def test_new(self):
        self.fuzz()
        first = {f["signature"] for f in self.rows("--new")[0]}
        self.fuzz(runs=3000)
        new = {f["signature"] for f in self.rows("--new")[0]}
        self.assertTrue(new)
        self.assertFalse(new & first)
        self.assertEqual({f["signature"] for f in self.rows()[0]}, new | first)

    def test_show(self):
        self.fuzz()
        for finding in self.rows()[0][:5]:
            out = self.run_fine("triage", "show", self.store, finding["id"])
            for part in (finding["signature"], finding["tracer"], finding["first_seen"], "det", "build      plumbline "):
                self.assertIn(part, out)
            case = self.scratch / "shown.case"
            text = out.split("significant bits\n\n", 1)[1].split("\n\n", 1)[0] + "\n"
            case.write_text(text)
            done = plumbline("replay", case, "--tracer", TRACER)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr + text)

    def test_set(self):
        self.fuzz()
        before = self.rows()[0]
        ids = [f["id"] for f in before]
        self.run_fine("triage", "set", self.store, ids[0], ids[1], "fixed")
        self.run_fine("triage", "set", self.store, ids[2], f"dup-of:{ids[3]}")
        self.run_fine("triage", "set", self.store, ids[4], "wontfix")
        self.run_fine("triage", "set", self.store, ids[5], "invalid")
        self.assertEqual([f["id"] for f in self.rows()[0]], [i for i in ids if i not in (ids[0], ids[1], ids[2], ids[4], ids[5])])
        status = {f["id"]: (f["status"], f["duplicate_of"]) for f in self.rows("--all")[0]}
        self.assertEqual([status[i] for i in ids[:6]], [("fixed", None), ("fixed", None), ("dup", ids[3]), ("open", None),
                                                         ("wontfix", None), ("invalid", None)])
        self.run_fine("triage", "set", self.store, *ids[:6], "open")
        self.assertEqual(self.rows()[0], before)
        self.assert_the_same_when_rebuilt()
        events = self.journal.read_text()
        for wrong, part in ((("1", "closed"), "no status"), (("x", "fixed"), "no ID"), (("0", "fixed"), "no ID"),
                            (("1", "99999", "fixed"), "no finding 99999"), (("1", "dup-of:1"), "itself"),
                            (("1", "dup-of:99999"), "99999"), (("1", "dup-of:"), "no ID"), (("fixed",), "which findings")):
            with self.subTest(wrong=wrong):
                self.assert_trouble(plumbline("triage", "set", self.store, *wrong), part)
                self.assertEqual(self.journal.read_text(), events)

    def test_retest(self):
        self.fuzz(runs=500)
        count = len(self.rows()[0])
        # An answer that the tracer doesn't give now, and one of somebody who isn't there.
        self.judge(FALSE_HIT % f',"tracer":"plucker_f64"' + FALSE_HIT % ',"tracer":"theirs"')
        gone = next(f["id"] for f in self.rows()[0] if f["tracer"] == "plucker_f64")
        failing = next(f["id"] for f in self.rows()[0] if f["id"] != gone and f["tracer"] == TRACER)
        self.run_fine("triage", "set", self.store, failing, "fixed")
        done = plumbline("triage", "retest", self.store)
        self.assertEqual(done.returncode, 0)
        self.assertIn(f"fixed {gone} ", done.stdout)
        self.assertIn(f"reopened {failing} ", done.stdout)
        self.assertIn(f"{count + 1} findings asked again: {count} fail, 1 of them reopened; 1 closed as fixed", done.stdout)
        self.assertIn("skipped: 1 findings of 'theirs'", done.stderr)
        self.assertEqual({f["id"]: f["status"] for f in self.rows("--all")[0]}[gone], "fixed")
        self.assert_the_same_when_rebuilt()

    def test_promote(self):
        self.fuzz()
        finding = next(f for f in self.rows()[0] if f["kind"] == "false-hit")
        folder = self.scratch / "regressions"
        path = pathlib.Path(self.run_fine("promote", self.store, finding["id"], folder).strip())
        self.assertEqual(path, folder / f"{TRACER}-{finding['signature']}.case")
        text = path.read_text()
        for part in (f"known {TRACER} false-hit", "expect exterior", "shrunk from ", "by fuzz: space ray", finding["first_seen"][:4]):
            self.assertIn(part, text)
        self.assertEqual(plumbline("replay", folder, "--tracer", TRACER).returncode, 0)
        self.assertEqual(self.run_fine("promote", self.store, finding["id"], folder).strip(), str(path))
        path.write_text("case other\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n")
        other = path.read_text()
        again = pathlib.Path(self.run_fine("promote", self.store, finding["id"], folder).strip())
        self.assertEqual(again.name, f"{TRACER}-{finding['signature']}-2.case")
        self.assertEqual(path.read_text(), other)
        # What the tracer gets right now is no regression; what it can't be asked is promoted as it is.
        self.judge(FALSE_HIT % f',"tracer":"{TRACER}"' + FALSE_HIT % ',"tracer":"theirs"')
        ids = {f["tracer"]: f["id"] for f in self.rows()[0] if f["signature"] == "false-hit-bc-nominal-c0"}
        self.assert_trouble(plumbline("promote", self.store, ids[TRACER], folder), "triage retest")
        done = plumbline("promote", self.store, ids["theirs"], folder)
        self.assertEqual(done.returncode, 0)
        self.assertIn("not shrunk", done.stderr)
        self.assertIn("known theirs false-hit", pathlib.Path(done.stdout.strip()).read_text())

    def collect_several(self):
        cases = self.scratch / "several.case"
        cases.write_text(PAIR % "pair" + f"known {TRACER} leak\nknown exact leak\n" +
                         PAIR % "behind" + BEHIND + f"known {TRACER} wrong-nearest\n")
        done = plumbline("triage", "collect", self.store, cases)
        self.assertEqual((done.returncode, done.stderr), (0, "2 findings, 1 cases that their tracer gets right now\n"))
        return {f["kind"]: f for f in self.rows()[0]}

    def test_several_triangles(self):
        found = self.collect_several()
        self.assertEqual({f["signature"] for f in found.values()}, {"leak-interior", "wrong-nearest-interior-through"})
        self.assertEqual({(f["element"], f["conditioning"]) for f in found.values()}, {("none", "nominal")})
        self.assertGreater(found["leak"]["worst_ulps"], 0)
        self.assertIn("leak-interior", self.run_fine("triage", self.store))
        self.assert_the_same_when_rebuilt()
        shown = self.run_fine("triage", "show", self.store, found["wrong-nearest"]["id"])
        for part in ("crossed    3 of 3 triangles", "triangle 2: interior, from the ", "answer     hit",
                     "verdict    wrong-nearest", f"&& plumbline replay regressions --tracer {TRACER}\n"):
            self.assertIn(part, shown)
        self.assertIn("2 fail, 0 of them reopened; 0 closed as fixed", self.run_fine("triage", "retest", self.store))

    def test_several_triangles_are_promoted(self):
        for kind, finding in self.collect_several().items():
            folder = self.scratch / kind
            path = pathlib.Path(self.run_fine("promote", self.store, finding["id"], folder).strip())
            text = path.read_text()
            known = kind if text.count("\ntriangle ") > 1 else "false-miss"  # what a leak of one triangle is
            self.assertIn(f"\nknown {TRACER} {known}\n", text)
            self.assertIn("# shrunk from ", text)
            done = plumbline("replay", folder, "--tracer", TRACER)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            self.run_fine("promote", self.store, finding["id"], folder / "failing", "--failing")
            done = plumbline("replay", folder / "failing", "--tracer", TRACER)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"new {known}, severity ", done.stdout)

    def test_hostile_names(self):
        self.judge("".join(FALSE_HIT % f',"tracer":{json.dumps(name)}' for name in HOSTILE))
        findings = self.rows()[0]
        self.assertEqual({f["tracer"] for f in findings}, set(HOSTILE))
        out = self.run_fine("triage", self.store)
        self.assertEqual(re.sub(r"[^\x00-\x1f\x7f]", "", out), "\n" * out.count("\n"))  # no control character
        self.assertEqual(sum("false-hit-bc-nominal-c0" in line for line in out.splitlines()), len(HOSTILE))
        self.assertEqual(plumbline("triage", "retest", self.store).returncode, 0)
        folder = self.scratch / "regressions"
        for f in findings:
            shown = self.run_fine("triage", "show", self.store, f["id"])
            self.assertNotRegex(shown, r"[\x00-\x09\x0b-\x1f\x7f]")
            done = plumbline("promote", self.store, f["id"], folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            path = pathlib.Path(done.stdout.strip())
            self.assertEqual(path.parent, folder)
            self.assertRegex(path.name, r"\A[A-Za-z0-9_.-]+\Z")
            self.assertEqual(plumbline("explain", path).returncode, 0)
        self.assertEqual(len(list(folder.iterdir())), len(HOSTILE))
        self.assertEqual([p.name for p in self.scratch.iterdir() if p.name.startswith("up")], [])
        self.assert_the_same_when_rebuilt()


class Kept(TriageTest):
    """Whatever happens to processes, disks and files, what was acknowledged is there."""

    def told(self):
        """Of each signature, how many lines of the journal tell it: these are acknowledged."""
        counts = {}
        text = self.journal.read_bytes()
        for line in text[:text.rfind(b"\n") + 1].splitlines()[1:]:
            event = json.loads(line)
            if event["event"] == "finding":
                key = (event["tracer"], event["signature"])
                counts[key] = counts.get(key, 0) + 1
        return counts

    def test_kill_loses_no_finding(self):
        chance = random.Random(SEED)
        print(f"seed {SEED}, {KILLS} kills")
        tracers = (TRACER, "woop_watertight_f32")

        def start(n, generation):
            return subprocess.Popen([PROGRAM, "fuzz", "--tracer", tracers[n], "--time", "60", "--seed", str(generation), "-o",
                                     self.scratch / f"{n}-{generation}", "--findings", self.store],
                                    start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        running = [start(0, 0), start(1, 0)]
        try:
            before = {}
            for kill in range(KILLS):
                time.sleep(chance.uniform(0.02, 1))
                if chance.random() < 0.5:  # a reader that is killed while it folds, as well
                    reader = subprocess.Popen([PROGRAM, "triage", self.store], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    time.sleep(chance.uniform(0, 0.05))
                    reader.kill()
                    reader.wait()
                n = chance.randrange(2)
                os.killpg(running[n].pid, signal.SIGKILL)
                running[n].wait()
                with self.subTest(kill=kill):
                    if self.journal.exists():
                        told = self.told()
                        for key, count in before.items():
                            self.assertGreaterEqual(told.get(key, 0), count)
                        rows = {(f["tracer"], f["signature"]): f["count"] for f in self.rows("--all")[0]}
                        for key, count in told.items():
                            self.assertGreaterEqual(rows.get(key, 0), count)
                        before = told
                running[n] = start(n, kill + 1)
        finally:
            for one in running:
                os.killpg(one.pid, signal.SIGKILL)
                one.wait()
        self.assertEqual({(f["tracer"], f["signature"]): f["count"] for f in self.rows("--all")[0]}, self.told())
        self.assertGreater(len(self.told()), 10)
        # What a campaign has in its folder, it had told before.
        for folder in self.scratch.glob("[01]-*"):
            tracer = tracers[int(folder.name[0])]
            for case in (folder / "findings").glob("*.case"):
                self.assertIn((tracer, case.stem), self.told())
        self.assert_the_same_when_rebuilt()

    def test_where_files_can_grow_no_further(self):
        self.fuzz(runs=500)
        text, dump = self.journal.read_bytes(), self.dump()
        for room in (0, len(text) + 100):
            limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            done = plumbline("fuzz", "--tracer", TRACER, "--runs", 1000, "--seed", 2, "-o", self.scratch / "two", "--findings", self.store,
                             preexec_fn=limit)
            self.assert_trouble(done, self.store, "make room")
            self.assertEqual(self.journal.read_bytes(), text)
            self.assertEqual(self.dump(), dump)

    def fill(self, disk, leave):
        file = os.open(disk / "filler", os.O_WRONLY | os.O_CREAT)
        try:
            while True:
                os.write(file, b"x" * 4096)
        except OSError:
            os.ftruncate(file, os.fstat(file).st_size - leave)
        os.close(file)

    def test_a_full_disk(self):
        disk = self.scratch / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", disk], capture_output=True).returncode != 0:
            self.skipTest("a small disk can't be mounted here")
        self.addCleanup(lambda: subprocess.run(["umount", "-l", disk], check=True))
        self.store, self.journal = disk / "found.db", disk / "found.db.ndjson"
        self.fuzz(runs=200)
        before, text = self.rows(), self.journal.read_bytes()
        self.fill(disk, 0)
        for verb in (("judge", "-"), ("fuzz", "--tracer", TRACER, "--runs", 10, "-o", self.scratch / "no")):
            done = plumbline(*verb, "--findings", self.store, input=FALSE_HIT % "")
            self.assert_trouble(done, "make room")
            self.assertEqual(self.journal.read_bytes(), text)
        # Room for some lines, and the database's own files are there.
        (disk / "filler").unlink()
        held = sqlite3.connect(self.store)
        held.execute("SELECT count(*) FROM finding").fetchall()
        self.fill(disk, 8192)
        done = plumbline("fuzz", "--tracer", TRACER, "--runs", 2000, "--seed", 2, "-o", self.scratch / "two", "--findings", self.store)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*make room[^\n]*\n\Z")
        after = self.journal.read_bytes()
        self.assertTrue(after.startswith(text))
        self.assertGreater(len(after), len(text))
        self.assertTrue(after.endswith(b"\n"))
        held.close()
        # With room again, all is there that was told, and the campaign's folder has the rest.
        (disk / "filler").unlink()
        rows = {f["signature"]: f["count"] for f in self.rows()[0]}
        self.assertEqual(rows, {signature: count for (tracer, signature), count in self.told().items()})
        self.assertLessEqual({f["signature"] for f in before[0]}, set(rows))
        self.assertEqual(plumbline("triage", "collect", self.store, self.scratch / "two").returncode, 0)
        cases = {p.stem for p in (self.scratch / "two" / "findings").glob("*.case")}
        self.assertFalse(cases <= set(rows))
        self.assertLessEqual(cases, {f["signature"] for f in self.rows()[0]})
        self.assert_the_same_when_rebuilt()

    def test_a_database_that_is_no_good(self):
        self.fuzz(runs=500)
        dump = self.dump()
        whole = self.store.read_bytes()
        for spoilt in (b"x" * len(whole), whole[:len(whole) // 2 // 4096 * 4096], whole[:1000]):
            with self.subTest(size=len(spoilt)):
                for suffix in ("-wal", "-shm"):
                    pathlib.Path(f"{self.store}{suffix}").unlink(missing_ok=True)
                self.store.write_bytes(spoilt)
                journal = self.journal.read_bytes()
                for verb in (("triage", self.store), ("triage", "show", self.store, 1), ("promote", self.store, 1, self.scratch / "p"),
                             ("fuzz", "--tracer", TRACER, "--runs", 10, "-o", self.scratch / "no", "--findings", self.store)):
                    self.assert_trouble(plumbline(*verb), self.store, f"'plumbline triage rebuild {self.store}'")
                self.assertFalse((self.scratch / "no").exists())
                self.run_fine("triage", "rebuild", self.store)
                self.assertEqual(self.dump(), dump)
                self.assertEqual(self.journal.read_bytes(), journal)

    def test_another_programs_files(self):
        database = sqlite3.connect(self.store)
        database.execute("CREATE TABLE bookmarks (url)")
        database.commit()
        database.close()
        before = self.store.read_bytes()
        for verb in (("triage", self.store), ("triage", "rebuild", self.store),
                     ("fuzz", "--tracer", TRACER, "--runs", 10, "-o", self.scratch / "no", "--findings", self.store)):
            self.assert_trouble(plumbline(*verb), self.store, "no journal")
        self.assertEqual(self.store.read_bytes(), before)
        self.assertFalse(self.journal.exists())

    def test_a_damaged_line(self):
        self.fuzz(runs=500)
        count = len(self.rows()[0])
        with open(self.journal, "a") as journal:
            journal.write('{"event":"finding","tra\n')
        lines = self.journal.read_text().count("\n")
        self.assert_trouble(plumbline("triage", self.store), f"{self.journal}:{lines}: ", "triage rebuild")
        done = plumbline("triage", "rebuild", self.store)
        self.assertEqual(done.returncode, 0)
        self.assertIn(f"warning: skipped {self.journal}:{lines}: ", done.stderr)
        self.assertEqual(len(self.rows()[0]), count)
        self.assertEqual(self.journal.read_text().count("\n"), lines)

    def test_nothing_there(self):
        for verb in (("triage", self.store), ("triage", "show", self.store, 1), ("triage", "set", self.store, 1, "fixed"),
                     ("triage", "retest", self.store), ("triage", "rebuild", self.store), ("promote", self.store, 1, self.scratch)):
            with self.subTest(verb=verb[:2]):
                self.assert_trouble(plumbline(*verb), self.store, "no such store")
        self.assert_trouble(plumbline("triage"), "which store")
        self.assertEqual(list(self.scratch.iterdir()), [])

    def test_help_teaches(self):
        for verb in (("triage",), ("triage", "list"), ("triage", "show"), ("triage", "set"), ("triage", "retest"), ("triage", "rebuild"),
                     ("triage", "collect"), ("promote",)):
            out = self.run_fine(*verb, "--help")
            self.assertIn("DB", out)
            if verb != ("triage", "list"):
                self.assertIn("Example", out)
        for verb in ("fuzz", "sweep", "judge"):
            self.assertIn("--findings", self.run_fine(verb, "--help"))


if __name__ == "__main__":
    unittest.main()
