"""What the tests of the command line share. PLUMBLINE names the program under test, PLUMBLINE_CORPUS the folder corpus/."""
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["PLUMBLINE"]
CORPUS = pathlib.Path(os.environ["PLUMBLINE_CORPUS"])

UNIT = '"triangle":[[0,0,0],[1,0,0],[0,1,0]]'
DOWN = '"direction":[0,0,-1]'


def question(identity, origin, more=""):
    return f'{{"id":{identity},{UNIT},"origin":{origin},{DOWN}{more}}}\n'


def run(*arguments, text="", **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=text, capture_output=True, encoding="utf-8",
                          timeout=60, **options)


class CliTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def assert_trouble(self, result, *parts):
        """Exit code 2 and one line on stderr that holds all parts."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\Aplumbline: [^\n]*\n\Z")
        for part in parts:
            self.assertIn(part, result.stderr)
