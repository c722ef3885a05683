"""Stores of findings after kills, full disks and damage. Argument: the program. TRIAGE_KILLS: how often a process of two
campaigns is killed (5)."""
import json
import os
import pathlib
import random
import resource
import signal
import sqlite3
import subprocess
import time
import unittest

from triage_case import FALSE_HIT, PROGRAM, TRACER, TriageTest, plumbline

KILLS = int(os.environ.get("TRIAGE_KILLS", 5))
SEED = int(os.environ.get("PLUMBLINE_SEED", 20260101))


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


if __name__ == "__main__":
    unittest.main()
