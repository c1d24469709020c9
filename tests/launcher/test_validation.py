"""Comparisons with references: what is read, what is measured, what is written."""
import json
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from launcher import Failure, WrongInput
from launcher.validation import comparison, draw, measure, results

GOOD = """
title = "A fall"
about = "In a vacuum."
minutes = 0.5
scene = "cases/fall"

[[quantity]]
name = "speed"
from = {summary = "speed"}
reference = 10.0
relative_tolerance = 0.1
unit = "m/s"
source = "Galilei"

[[quantity]]
name = "depth"
from = {series = "fall.csv", column = "depth", along = "time", at = 0.5}
range = [1.0, 1.3]
source = "tower"

[[curve]]
series = "fall.csv"
along = "time"
column = "depth"
labels = ["time in s", "depth in m"]

[curve.references]
"tower" = [[0.0, 0.0], [1.0, 5.0]]
"""


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def read(self, text, name="fall"):
        file = self.folder / f"{name}.toml"
        file.write_text(text, encoding="utf-8")
        return comparison.read(file)

    def run_folder(self, summary=None, rows=((0, 0), (0.4, 0.8), (0.6, 1.8), (1, 5))):
        run = self.folder / "run"
        (run / "series").mkdir(parents=True)
        (run / "summary.json").write_text(json.dumps(summary or {"speed": 9.81}))
        text = "time [s],depth [m]\n" + "".join(f"{t},{z}\n" for t, z in rows)
        (run / "series" / "fall.csv").write_text(text)
        return run


class Comparisons(Folder):
    def test_that_come_along_are_complete_and_sorted_by_cost(self):
        every = comparison.read_all()
        self.assertGreater(len(every), 5)
        self.assertEqual([each.minutes for each in every], sorted(each.minutes for each in every))
        for each in every:
            self.assertTrue(all(quantity.source for quantity in each.quantities), each.name)

    def test_tolerances_are_relative_absolute_or_a_range(self):
        speed, depth = self.read(GOOD).quantities
        self.assertAlmostEqual(speed.reference.low, 9.0)
        self.assertTrue(speed.reference.holds(9.81) and not speed.reference.holds(8.99))
        self.assertEqual((depth.reference.low, depth.reference.high, depth.reference.value), (1.0, 1.3, None))
        absolute = self.read(GOOD.replace("relative_tolerance = 0.1", "tolerance = 0.1"))
        self.assertAlmostEqual(absolute.quantities[0].reference.high, 10.1)

    def test_mistakes_are_named_with_file_and_key(self):
        for wrong, words in ((GOOD.replace("minutes = 0.5", ""), "minutes is missing"),
                             (GOOD.replace('scene = "cases/fall"', ""), "either a scene or a program"),
                             (GOOD.replace("unit =", "units ="), "quantity 1: unknown key units"),
                             (GOOD.replace("reference = 10.0", 'reference = "ten"'), "quantity 1: reference must be a number"),
                             (GOOD.replace("relative_tolerance = 0.1", ""), "quantity 1: tolerance is missing"),
                             (GOOD.replace("[[quantity]]", "[[quantity]"), "line")):
            with self.assertRaises(WrongInput) as caught:
                self.read(wrong)
            self.assertIn(words, str(caught.exception))
            self.assertIn("fall.toml", str(caught.exception))

    def test_names_that_do_not_exist_are_refused(self):
        with self.assertRaisesRegex(WrongInput, "no comparison 'flight'; there are fall"):
            comparison.choose(["flight"], [self.read(GOOD)])


class Measured(Folder):
    def value(self, where, **run):
        quantity = comparison.Quantity("depth", where, comparison.Reference(0, 1, None), "")
        return measure.value_of(quantity, self.run_folder(**run))

    def test_summary_entries(self):
        self.assertEqual(self.value({"summary": "a.b", "per": 2}, summary={"a": {"b": 3}}), 1.5)

    def test_between_rows(self):
        self.assertAlmostEqual(self.value({"series": "fall.csv", "column": "depth", "along": "time", "at": 0.5}), 1.3)

    def test_integrals(self):
        where = {"series": "fall.csv", "column": "depth", "reduce": "integral"}
        self.assertAlmostEqual(self.value(where, rows=((0, 0), (1, 1), (2, 4))), 3.0)

    def test_properties_of_tests(self):
        report = {"testsuites": [{"name": "Fall", "testsuite": [{"name": "Ends", "speed": "9.5"}]}]}
        (self.folder / "properties.json").write_text(json.dumps(report))
        self.assertEqual(measure.recorded_property(self.folder, "Fall.Ends:speed"), 9.5)
        with self.assertRaisesRegex(Failure, "Fall.Ends has recorded no depth"):
            measure.recorded_property(self.folder, "Fall.Ends:depth")

    def test_what_is_no_number_fails(self):
        for where in ({"summary": "nothing"}, {"series": "fall.csv", "column": "width", "reduce": "last"},
                      {"series": "fall.csv", "column": "depth", "reduce": "most"}, {"guess": 1}):
            with self.subTest(where=where), tempfile.TemporaryDirectory() as folder:
                self.folder = Path(folder)
                with self.assertRaises(Failure):
                    self.value(where)

    def test_programs_that_fail_say_why(self):
        with self.assertRaisesRegex(Failure, "exit code 3: it fell"):
            measure.timed(["sh", "-c", "echo it fell >&2; exit 3"])


class Written(Folder):
    def test_results_say_what_agrees_and_are_kept_until_the_comparison_changes(self):
        each = self.read(GOOD)
        with mock.patch.multiple(results, FOLDER=self.folder / "docs", PAGE=self.folder / "validation.md"):
            pictures = draw.draw(each, self.run_folder(), results.FOLDER)
            results.write(results.result(each, [[7.5, 1.1], [8.5, 1.1]], 3.2, pictures))
            self.assertEqual([q["agrees"] for q in results.kept(each)["quantities"]], [False, True])
            results.write_page([each])
            page = results.PAGE.read_text()
            self.assertTrue((results.FOLDER / "fall.png").stat().st_size > 1000)
            self.assertIsNone(results.kept(self.read(GOOD.replace("tower", "mast"))))
        self.assertIn("1 of 2 quantities", page)
        self.assertIn("The runs lie 1 m/s apart in speed.", page)
        self.assertIn("| speed | 8 m/s | 10 | 9 to 11 | **no** | Galilei |", page)
        self.assertIn("![A fall](validation/fall.png)", page)


if __name__ == "__main__":
    unittest.main()
