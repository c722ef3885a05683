"""How stores of findings are fed: by fuzz, sweep, judge and collect. Argument: the program."""
import json
import re
import subprocess
import unittest

from triage_case import FALSE_HIT, PROGRAM, TRACER, TriageTest, plumbline


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


if __name__ == "__main__":
    unittest.main()
