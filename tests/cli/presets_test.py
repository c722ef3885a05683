"""The test presets fail where there is nothing to test: quickstart configures the same folder without tests."""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PRESETS = pathlib.Path(__file__).resolve().parents[2] / "CMakePresets.json"


class Presets(unittest.TestCase):
    def test_no_tests_is_a_failure(self):
        visible = [p for p in json.loads(PRESETS.read_text())["testPresets"] if not p.get("hidden")]
        self.assertTrue(visible)
        for preset in visible:
            with self.subTest(preset["name"]), tempfile.TemporaryDirectory() as folder:
                shutil.copy(PRESETS, folder)
                (pathlib.Path(folder) / "build" / preset["configurePreset"]).mkdir(parents=True)
                done = subprocess.run(["ctest", "--preset", preset["name"]], cwd=folder, capture_output=True, text=True)
                self.assertIn("No tests were found", done.stdout + done.stderr)
                self.assertNotEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
