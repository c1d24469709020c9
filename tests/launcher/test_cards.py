"""Cards of the Johnson-Holmquist law from and to decks of other codes."""
import contextlib
import io
import json
import os
import shutil
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from launcher import ROOT, WrongInput
from launcher.cards import card_file, law79, mat_110
from launcher.cards.unit_systems import system
from launcher.command_line import build_parser
from launcher.commands import card_command

# Float glass, Holmquist, Johnson et al. 1995 as printed by Cronin, Bui, Kaufmann et al. 2003, in ton, mm, s.
GLASS = """*KEYWORD
$ a comment
*MAT_JOHNSON_HOLMQUIST_CERAMICS_TITLE
float glass
$#     mid        ro         g         a         b         c         m         n
         7  2.530E-9   30400.0      0.93     0.088     0.003      0.35      0.77
$#    eps0         t     sfmax       hel      phel      beta
       1.0     150.0       0.5    5950.0    2920.0       1.0
$#      d1        d2        k1        k2        k3        fs
     0.053      0.85   45400.0 -138000.0  290000.0       0.0
*END
"""
RADIOSS = """/UNIT/3
units of glass
                  Mg                  mm                   s
/MAT/LAW79/7/3
float glass
#              RHO_I
            2.530E-9
             30400.0
                0.93               0.088                0.35                0.77
               0.003                 1.0                 0.5
               150.0              5950.0              2920.0
               0.053                0.85
             45400.0           -138000.0            290000.0                 1.0
"""


class CardTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def command(self, *words):
        """Exit code, standard output and remarks."""
        out, remarks = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(remarks):
            code = card_command.run(build_parser().parse_args(["card", *map(str, words)]))
        return code, out.getvalue(), remarks.getvalue()

    def written(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def imported(self, deck, *words):
        """The values in SI of the card that a deck gives."""
        card = self.folder / "imported.toml"
        self.command("import", deck, "-o", card, *words)
        return card_file.read(card).values

    def refused(self, deck, *words):
        with self.assertRaises(WrongInput) as caught:
            self.command("import", deck, *words)
        return str(caught.exception)


class Import(CardTest):
    def test_gives_the_published_constants_in_si(self):
        glass = self.imported(self.written("glass.k", GLASS), "--units", "ton,mm,s")
        for name, value in (("density", 2530), ("shear_modulus", 30.4e9), ("maximum_tensile_pressure", 150e6),
                            ("hugoniot_elastic_limit", 5.95e9), ("pressure_at_hugoniot_elastic_limit", 2.92e9),
                            ("bulk_modulus", 45.4e9), ("bulk_modulus_2", -138e9), ("bulk_modulus_3", 290e9),
                            ("intact_strength_constant", 0.93), ("fractured_strength_constant", 0.088),
                            ("strain_rate_constant", 0.003), ("fractured_strength_exponent", 0.35),
                            ("intact_strength_exponent", 0.77), ("damage_constant", 0.053), ("damage_exponent", 0.85),
                            ("maximum_fractured_strength", 0.5), ("bulking_fraction", 1)):
            self.assertAlmostEqual(float(glass[name]) / value, 1, 14, name)

    def test_gives_the_same_from_both_codes_and_in_any_units(self):
        first = self.imported(self.written("glass.k", GLASS), "--units", "ton,mm,s")
        self.assertEqual(self.imported(self.written("glass.rad", RADIOSS)), first)
        si = GLASS.replace("2.530E-9   30400.0", "   2530.   3.04e10").replace("1.0     150.0       0.5    5950.0    2920.0",
                           "1.0    1.50e8       0.5    5.95e9    2.92e9").replace(
                           "45400.0 -138000.0  290000.0", "4.54e10  -1.38e11    2.9e11")
        self.assertEqual(self.imported(self.written("si.k", si), "--units", "kg,m,s"), first)

    def test_reads_fields_between_commas_and_long_ones(self):
        lines = [",".join(line.split()) if line[0] == " " else line for line in GLASS.splitlines()]
        first = self.imported(self.written("glass.k", GLASS), "--units", "ton,mm,s")
        self.assertEqual(self.imported(self.written("free.k", "\n".join(lines)), "--units", "ton,mm,s"), first)
        wide = ["".join(word.rjust(20) for word in line.split()) if line[0] == " " else line
                for line in GLASS.splitlines()]
        wide[0] = "*KEYWORD LONG=Y"
        self.assertEqual(self.imported(self.written("wide.k", "\n".join(wide)), "--units", "ton,mm,s"), first)

    def test_derives_the_pressure_at_the_limit_where_it_is_left_out(self):
        glass = self.imported(self.written("glass.k", GLASS.replace("2920.0", "   0.0")), "--units", "ton,mm,s")
        pressure, limit = (float(glass[name]) for name in ("pressure_at_hugoniot_elastic_limit",
                                                           "hugoniot_elastic_limit"))
        mu = min((abs(45.4e9 * m - 138e9 * m * m + 290e9 * m ** 3 - pressure), m)
                 for m in (step * 1e-6 for step in range(200_000)))[1]
        self.assertAlmostEqual((pressure + 4 / 3 * 30.4e9 * mu / (1 + mu)) / limit, 1, 4)

    def test_needs_the_units_of_a_deck_that_does_not_say_them(self):
        self.assertIn("--units kg,m,s", self.refused(self.written("glass.k", GLASS)))
        self.assertIn("the deck itself says", self.refused(self.written("glass.rad", RADIOSS), "--units", "kg,m,s"))
        self.assertIn("--units", self.refused(self.written("glass.k", GLASS), "--units", "stone,mm,s"))

    def test_names_line_and_field_at_fault(self):
        for old, new, parts in (
                ("2.530E-9", " density", (":6", "RO", "density")),
                ("2.530E-9", "-2.53E-9", ("RO", "must be above 0")),
                ("    5950.0    2920.0", "    2920.0    5950.0", ("PHEL", "must be below HEL")),
                ("   45400.0 -138000.0  290000.0", "   45400.0 -938000.0  290000.0", ("K2", "fall")),
                ("     0.053      0.85   45400.0 -138000.0  290000.0       0.0\n", "", ("D1, D2", "ends after 2")),
                ("*MAT_JOHNSON_HOLMQUIST_CERAMICS_TITLE", "*MAT_ELASTIC_TITLE", ("*MAT_110", "*MAT_ELASTIC")),
                ("290000.0       0.0", "290000.0       0.2", ("FS", "erodes"))):
            with self.subTest(new):
                message = self.refused(self.written("wrong.k", GLASS.replace(old, new)), "--units", "ton,mm,s")
                for part in ("wrong.k", *parts):
                    self.assertIn(part, message)

    def test_asks_which_of_several(self):
        two = self.written("two.k", GLASS.replace("*END\n", "") + GLASS.replace("         7  ", "         8  "))
        message = self.refused(two, "--units", "ton,mm,s")
        self.assertIn("--id", message)
        self.assertIn("7", message)
        self.assertEqual(len(self.imported(two, "--units", "ton,mm,s", "--id", "8")), 18)


class Export(CardTest):
    def test_comes_back_within_the_digits_of_the_format(self):
        for name in ("alumina", "glass.float", "ice.fresh", "ice.baltic", "ice.paper"):
            card = card_file.read(card_file.find(name)).values
            for form, units, words, error in (("mat_110", "ton,mm,s", (), 5e-4), ("mat_110", "g,mm,ms", ("--long",), 0),
                                              ("law79", "kg,mm,ms", (), 0)):
                deck = self.folder / "deck"
                self.command("export", name, "--format", form, "--units", units, "-o", deck, *words)
                back = self.imported(deck, *(() if form == "law79" else ("--units", units)))
                for key, value in back.items():
                    expected = float(card.get(key, 0))
                    with self.subTest(f"{name} {form} {key}"):
                        self.assertLessEqual(abs(float(value) - expected), (error + 1e-15) * abs(expected))

    def test_says_what_a_deck_does_not_hold(self):
        _, deck, remarks = self.command("export", "ice.fresh", "--format", "mat_110")
        for text in (" ".join(line.strip("$ ") for line in deck.splitlines()), remarks):
            self.assertIn("not carried: fracture_energy", text)
        with self.assertRaisesRegex(WrongInput, "j2_plastic"):
            self.command("export", "copper", "--format", "law79")

    def test_keeps_every_field_in_its_columns(self):
        _, deck, _ = self.command("export", "glass.float", "--format", "mat_110", "--units", "ton,mm,s")
        lines = [line for line in deck.splitlines() if line[0] == " "]
        self.assertEqual([len(line) for line in lines], [80, 60, 60])
        self.assertAlmostEqual(float(lines[0][10:20]) / 2.53e-9, 1, 3)


class ImportedCard(CardTest):
    """Read by the compiled reader: the same law as the card the deck was made from."""

    def test_is_read_beside_its_scene(self):
        programs = Path(os.environ.get("POLYNYA_PROGRAMS", ROOT / "build/release/bin"))
        if not (programs / "resolve_scene").exists():
            self.skipTest("the programs are not built")
        shutil.copy(ROOT / "cases/ice_ball/scene.toml", self.folder)
        (self.folder / "materials").mkdir()
        deck = self.folder / "fresh.k"
        self.command("export", "ice.fresh", "--format", "mat_110", "--units", "ton,mm,s", "--long", "-o", deck)
        self.command("import", deck, "--units", "ton,mm,s", "-o", self.folder / "materials/mine.toml")

        def values(name):
            found = subprocess.run([programs / "resolve_scene", self.folder, "--set", f"ice.material={name}"],
                                   capture_output=True, text=True, check=True, cwd=ROOT)
            return json.loads(found.stdout)["materials"][name]["values"]

        mine, original = values("mine"), values("ice.fresh")
        for key, value in mine.items():
            self.assertAlmostEqual(value, original.get(key, 0), delta=1e-15 * abs(value), msg=key)
        with open(self.folder / "materials/mine.toml", "rb") as file:
            self.assertIn("imported from *MAT_110", tomllib.load(file)["density"]["origin"])


class Units(unittest.TestCase):
    def test_are_told_apart(self):
        self.assertEqual(system(["Mg", "mm", "s"]).factors, system(["ton", "mm", "s"]).factors)
        for form in (mat_110, law79):
            self.assertEqual(set(form.FIELDS), set(mat_110.FIELDS))


if __name__ == "__main__":
    unittest.main()
