"""The README's way from a tracer to a failing test, command by command as it is printed there, with an installed program.
Arguments: the build folder, the C compiler."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

COMPILER = sys.argv.pop()
BUILD = pathlib.Path(sys.argv.pop())
ROOT = pathlib.Path(__file__).resolve().parents[2]


def commands():
    section = (ROOT / "README.md").read_text().split("## From a tracer to a failing test", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"^    (.*)$", section, re.M)


class FiveCommands(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name) / "mine"
        self.folder.mkdir()
        prefix = pathlib.Path(scratch.name) / "prefix"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], stdout=subprocess.DEVNULL, check=True)
        self.environment = os.environ | {"PATH": f"{prefix / 'bin'}:{os.environ['PATH']}"}
        example = ROOT / "examples" / "c_abi" / "my_tracer.c"
        self.header = ROOT / "float_tracer"
        subprocess.run([COMPILER, "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-I", self.header, "-o",
                        self.folder / "libmine.so", example, "-lm"], check=True)

    def run_command(self, command):
        return subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, timeout=300, check=False)

    def run_fine(self, command):
        done = self.run_command(command)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_lead_to_a_page_a_proof_a_program_and_a_failing_test(self):
        search, pages, promote, export, test = commands()
        self.run_fine(search.replace("--time 10", "--runs 20000"))
        self.run_fine(pages)
        self.assertIn("my_tracer", (self.folder / "pages" / "index.html").read_text())
        self.assertTrue(list((self.folder / "pages").glob("finding-*.html")))
        case = self.folder / self.run_fine(promote).strip()
        text = case.read_text()
        self.assertIn("shrunk from", text)
        self.assertNotIn("known", text)
        self.run_fine(export)
        proof = self.run_fine("/usr/bin/python3 proof/proof.py")
        self.assertIn("wrong", proof)
        program = f"{COMPILER} -g proof/repro.c -I {self.header} -ldl -o proof/repro"
        self.run_fine(program)
        done = self.run_command("proof/repro")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("WRONG", done.stdout)
        self.assertEqual(self.run_command("TRACER=./libnot.so proof/repro").returncode, 2)
        done = self.run_command(test)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(f"regressions.{case.stem}", done.stdout)
        self.assertIn("ulps", done.stdout)
        done = self.run_command("plumbline promote found.db worst elsewhere --failing")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("--tracer", done.stderr)


if __name__ == "__main__":
    unittest.main()
