"""The reusable workflow, as far as that can be told without GitHub: its keys, that every input is used and every one
used is there, that inputs reach shells as variables only, and that its commands are ones that exist."""
import pathlib
import re
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
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

    def test_commands_exist(self):
        replay = (ROOT / "cli" / "replay.cpp").read_text()
        commands = "\n".join(step.get("run", "") for step in self.steps)
        for option in ("--tracer", "--github", "--sarif", "--junit"):
            self.assertIn(option, commands)
            self.assertIn(f'"{option}"', replay)
        self.assertTrue((ROOT / "cmake" / "install-dependencies").exists())
        self.assertIn("cmake/install-dependencies core", commands)


if __name__ == "__main__":
    unittest.main()
