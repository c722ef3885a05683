"""Stores of findings as a user meets them: listed, shown, settled, asked again, promoted. Argument: the program."""
import json
import pathlib
import re
import unittest

from triage_case import FALSE_HIT, TRACER, TriageTest, plumbline

# A pair of triangles that moller_trumbore_f64 misses beside their edge, and one behind them that it hits.
PAIR = ("case %s\ntriangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
        "triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n"
        "ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n")
BEHIND = "triangle -9 -5 2  3 -5 2  -3 9 2\n"
HOSTILE = ["pipe:./x \"y\"", "a\nb", "'; DROP TABLE finding; --", "<script>alert(1)</script>", "\x1b[2Jx", "../../up",
           "nul\0behind", "./libx.so", "a" * 300, "\u202etxt"]


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
