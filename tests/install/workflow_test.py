"""The reusable workflow, as far as that can be told without GitHub: its keys, that every input is used and every one
used is there, that inputs reach shells as variables only; and its steps that build a tracer and replay, run by a
shell in a folder like a checkout. Arguments: the program, the C compiler."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
CC, PROGRAM = sys.argv.pop(), pathlib.Path(sys.argv.pop())
PATH = ROOT / ".github" / "workflows" / "plumbline-regressions.yml"


class Workflow(unittest.TestCase):
    def setUp(self):
        self.text = PATH.read_text()
        self.workflow = yaml.safe_load(self.text)
        self.inputs = self.workflow[True]["workflow_call"]["inputs"]  # YAML 1.1 reads `on` as true
        self.steps = self.workflow["jobs"]["replay"]["steps"]

    def test_keys(self):
        self.assertEqual(set(self.workflow), {"name", True, "permissions", "jobs"})
        self.assertEqual(self.workflow["permissions"], {"contents": "read", "security-events": "write"})
        self.assertEqual(set(self.workflow["jobs"]["replay"]), {"runs-on", "container", "steps"})
        self.assertEqual([key for key, value in self.inputs.items() if value.get("required")],
                         ["plumbline-repository", "plumbline-ref", "corpus", "tracer"])
        for key, value in self.inputs.items():
            self.assertEqual(value["type"], "string", key)
            self.assertTrue(value["description"], key)
            self.assertEqual("default" in value, not value.get("required"), key)

    def test_inputs_are_used_and_there(self):
        self.assertEqual(set(re.findall(r"inputs\.([\w-]+)", self.text)), set(self.inputs))

    def test_steps(self):
        for step in self.steps:
            self.assertEqual(("run" in step) + ("uses" in step), 1, step)
            self.assertLessEqual(set(step), {"name", "run", "uses", "with", "env", "if", "working-directory"}, step)
        self.assertEqual([step["uses"] for step in self.steps if "uses" in step],
                         ["actions/checkout@v4", "actions/checkout@v4", "github/codeql-action/upload-sarif@v3",
                          "actions/upload-artifact@v4"])

    def test_no_input_is_pasted_into_a_shell(self):
        for step in self.steps:
            self.assertNotIn("${{", step.get("run", ""), step)

    def test_build_and_replay(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        checkout = pathlib.Path(scratch.name)
        shutil.copy(ROOT / "examples" / "c_abi" / "my_tracer.c", checkout)
        shutil.copytree(ROOT / "tests" / "install" / "consumer" / "corpus", checkout / "corpus")
        (checkout / ".plumbline" / "build" / "release" / "cli").mkdir(parents=True)
        (checkout / ".plumbline" / "build" / "release" / "cli" / "plumbline").symlink_to(PROGRAM)
        (checkout / ".plumbline" / "float_tracer").symlink_to(ROOT / "float_tracer")
        given = {"inputs.corpus": "corpus/plain.case corpus/small.case", "inputs.tracer": "./libmine.so",
                 "inputs.tracer-build": f'{CC} -O2 -ffp-contract=off -shared -fPIC -I "$PLUMBLINE_INCLUDE" '
                                        "-o libmine.so my_tracer.c -lm"}

        def run(name):
            step = next(step for step in self.steps if step.get("name") == name)
            variables = {key: given[re.fullmatch(r"\$\{\{ (.*) \}\}", value)[1]]
                         for key, value in step["env"].items()}
            return subprocess.run(["sh", "-e", "-c", step["run"]], cwd=checkout, env=os.environ | variables,
                                  capture_output=True, text=True)

        built = run("Build the tracer")
        self.assertEqual(built.returncode, 0, built.stderr)
        done = run("Replay")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertTrue((checkout / "plumbline.sarif").exists() and (checkout / "plumbline.xml").exists())
        with open(checkout / "corpus" / "plain.case", "a") as file:
            file.write("known my_tracer false-miss\n")
        done = run("Replay")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"\A::error file=corpus/plain.case,line=6,title=plumbline known-now-passes::")


if __name__ == "__main__":
    unittest.main()
