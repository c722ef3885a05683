"""The figures come out of what the program writes: PNG and SVG, the same for the same input; trouble is one line and
exit code 2. Argument: the program."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PLOTS = pathlib.Path(__file__).resolve().parents[2] / "analysis" / "plots"
PROGRAM = sys.argv.pop()


def plumbline(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def plot(name, data, directory):
    return subprocess.run(["/usr/bin/python3", "-B", PLOTS / f"{name}.py", data, directory], capture_output=True, text=True)


class Plots(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.data = self.directory / "data.csv"

    def sweep(self, *arguments, count=40):
        plumbline("sweep", "--count", str(count), "--csv", str(self.data), *arguments)

    def assert_drawn(self, name, words):
        files = []
        for into in ("one", "two"):
            done = plot(name, self.data, self.directory / into)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            files.append([(self.directory / into / f"{name}.{kind}").read_bytes() for kind in ("png", "svg")])
        self.assertEqual(files[0], files[1])
        png, svg = files[0]
        self.assertTrue(png.startswith(b"\x89PNG"))
        for word in words:
            self.assertIn(word, svg.decode())

    def assert_refused(self, name, words):
        done = plot(name, self.data, self.directory)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertRegex(done.stderr, rf"\A{name}\.py: .*{words}.*\n\Z")

    def test_success_by_target(self):
        self.sweep("--tracer", "exact", "--tracer", "brlcad_bot_classic", "--tracer", "moller_trumbore_f32")
        self.assert_drawn("success_by_target", ["exact", "brlcad_bot_classic", "vertex/edge", "tolerance 1e-05", "100.0"])

    def test_success_by_standoff(self):
        self.sweep("--tracer", "exact", "--standoff", "0.25", "5", "--offset", "0", "0", "0", "--offset", "1", "2", "3")
        self.assert_drawn("success_by_standoff", ["exact", "(0, 0, 0)", "(1, 2, 3)", "h = 5, 84.8 %"])

    def test_lattice_triangles(self):
        self.data.write_text(plumbline("lattice", "--box", "1", "1", "1", "--step", "1"))
        self.assert_drawn("lattice_triangles", ["56 triangles on 8 lattice points (336 ordered triples)"])

    def test_trouble_is_one_line(self):
        self.assert_refused("lattice_triangles", "No such file")
        self.data.write_text("nonsense\n1\n")
        self.assert_refused("success_by_target", "no column tracer, ")
        self.sweep("--tracer", "exact", "--standoff", "1", "2")
        self.assert_refused("success_by_target", "several standoffs")
        self.sweep(count=0)
        self.assert_refused("success_by_standoff", "no ray was fired")


unittest.main()
