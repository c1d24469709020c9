"""A run that goes on replaces its scene and its summaries only once its programs have taken up the state."""

import json
import tempfile
import unittest
from pathlib import Path

from launcher import WrongInput, run_folder


class GoingOn(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        for name in ("scene.json", "summary.json", "fluid_summary.json"):
            (self.folder / name).write_text(json.dumps({"of": name}))
        self.before = self.content()

    def tearDown(self):
        self.temporary.cleanup()

    def content(self):
        return {file.name: file.read_text() for file in self.folder.iterdir()}

    def test_a_refusal_leaves_the_run_as_it_was(self):
        run_folder.replace_told(self.folder, {"run": {"end_time": 2.0}})
        self.assertEqual(run_folder.read_json(self.folder / "scene.json"), {"run": {"end_time": 2.0}})
        self.assertFalse((self.folder / "summary.json").exists())
        run_folder.restore_told(self.folder)
        self.assertEqual(self.content(), self.before)

    def test_a_run_that_went_on_keeps_its_new_scene_alone(self):
        run_folder.replace_told(self.folder, {"run": {"end_time": 2.0}})
        run_folder.drop_aside(self.folder)
        self.assertEqual(list(self.content()), ["scene.json"])

    def test_a_killed_attempt_brings_no_older_summary_back(self):
        run_folder.replace_told(self.folder, {"attempt": 1})
        run_folder.replace_told(self.folder, {"attempt": 2})
        run_folder.restore_told(self.folder)
        self.assertEqual(run_folder.read_json(self.folder / "scene.json"), {"attempt": 1})
        self.assertFalse((self.folder / "summary.json").exists())

    def test_only_one_at_a_time_holds_the_folder(self):
        with run_folder.hold(self.folder), self.assertRaises(WrongInput):
            run_folder.hold(self.folder)


if __name__ == "__main__":
    unittest.main()
