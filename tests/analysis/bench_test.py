"""`plumbline bench oracle` from outside: its rows, and that what calls itself exact is right. Counts are asserted,
times are not. Argument: the program."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
KEYS = ["workload", "method", "isa", "t_max", "answers", "exact", "cases", "ns_median", "ratio_to_naive_batch",
        "ratio_to_naive_scalar", "undecided", "wrong"]
EVERYWHERE = {"naive_scalar", "naive_batch", "exact_batch", "exact_single"}
IN_CACHE = {"exact_batch_without_filter", "integer", "accumulate", "full_truth", "truth_and_severity", "mpq_class"}
OF_ONE = {"naive_batch_one_triangle", "exact_batch_one_triangle"}
OPTIONAL = {"epick_orientations", "epeck_do_intersect", "epeck_ft", "cpp_rational"}
UNPAIRED = {"random", "random_memory", "lattice", "wide", "full_range"}
WORKLOADS = UNPAIRED | {"random_hits", "small_far", "exact_edge12", "exact_edge23", "exact_edge51", "ulp12", "ulp51",
                        "coplanar", "degenerate", "mixed40", "wide_edge"}


def bench(*arguments):
    return subprocess.run([PROGRAM, "bench", "oracle", "--quick", *arguments], capture_output=True, text=True)


def rows_of(*arguments):
    done = bench("--json", *arguments)
    assert (done.returncode, done.stderr) == (0, ""), done
    return [json.loads(line) for line in done.stdout.splitlines()]


class BenchOracle(unittest.TestCase):
    def check_rows(self, rows):
        for row in rows:
            with self.subTest(workload=row["workload"], method=row["method"], isa=row["isa"], t_max=row["t_max"]):
                self.assertEqual(list(row), KEYS)
                self.assertGreater(row["cases"], 0)
                self.assertGreater(row["ns_median"], 0)
                self.assertGreater(row["ratio_to_naive_batch"], 0)
                self.assertEqual(row["exact"],
                                 row["method"] != "epick_orientations" and not row["method"].startswith("naive"))
                if row["exact"]:
                    self.assertEqual(row["wrong"], 0)
                if row["undecided"] is not None:
                    self.assertTrue(0 <= row["undecided"] <= 1)

    def test_every_workload_by_every_method(self):
        rows = rows_of("--search", "0")
        self.check_rows(rows)
        self.assertEqual({row["workload"] for row in rows}, WORKLOADS)
        for workload in WORKLOADS:
            expected = EVERYWHERE | (OF_ONE if workload in UNPAIRED else set())
            if workload != "random_memory":
                expected |= IN_CACHE
            methods = {row["method"] for row in rows if row["workload"] == workload}
            self.assertEqual(methods - OPTIONAL, expected, workload)
        found = {(row["workload"], row["method"]): row for row in rows}
        self.assertEqual(found["random", "exact_batch"]["undecided"], 0)
        self.assertEqual(found["exact_edge51", "exact_batch"]["undecided"], 1)
        self.assertEqual(found["exact_edge23", "exact_batch_without_filter"]["undecided"], 0)
        self.assertEqual(found["full_range", "integer"]["undecided"], 1)
        self.assertEqual(found["full_range", "accumulate"]["undecided"], None)
        self.assertEqual(found["random", "naive_batch"]["wrong"], 0)
        self.assertGreater(found["exact_edge51", "naive_batch"]["wrong"], 0)

    def test_rays_that_end_at_the_hit(self):
        rows = rows_of("--search", "0", "--t-max", "1", "--isa", "portable")
        self.check_rows(rows)
        self.assertEqual({(row["t_max"], row["isa"]) for row in rows}, {(1, "portable")})

    def test_worst_case_can_be_replayed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "worst.case"
            worst = rows_of("--workload", "random", "--search", "0.2")[-1]
            self.assertEqual((worst["workload"], worst["wrong"], worst["cases"]), ("worst_found", 0, 1))
            self.assertGreater(worst["tried"], 0)
            path.write_text(worst["case"])
            done = subprocess.run([PROGRAM, "replay", str(path)], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 2, done.stderr)

    def test_table_says_where_it_comes_from(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "table.txt"
            done = bench("--search", "0", "--workload", "lattice", "-o", str(path))
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            head = path.read_text().splitlines()[:4]
        self.assertEqual([line.split()[0] for line in head], ["machine", "isa", "compiler", "command"])
        self.assertIn("--workload lattice --quick", head[3])

    def test_bad_input_is_one_line(self):
        for arguments, words in ((["--workload", "nobody"], "--workload"), (["--isa", "mmx"], "--isa"),
                                 (["--t-max", "0"], "less than 1"), (["--t-max", "nan"], "less than 1"),
                                 (["--search", "-1"], "--search"), (["-o", "/nowhere/at/all"], "/nowhere/at/all")):
            done = bench(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertRegex(done.stderr, r"\Aplumbline: [^\n]*\n\Z", arguments)
            self.assertIn(words, done.stderr)


class BenchInterface(unittest.TestCase):
    def test_every_way_of_every_size(self):
        done = subprocess.run([PROGRAM, "bench", "interface", "--quick"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = [line.split() for line in done.stdout.splitlines()[2:]]
        self.assertEqual(len(rows), 4 * 5)
        self.assertEqual({row[0] for row in rows}, {"1", "64", "1024", "65536"})


unittest.main()
