"""Cards of Johnson & Holmquist from and to decks: values, units, digits, round trips."""
import tomllib
import unittest
from fractions import Fraction

from launcher.cards import numbers
from tests.launcher.decks import (ALUMINA_M, ALUMINA_MM, ALUMINA_RADIOSS, GLASS_LONG, ROOT, Folder, card_values,
                                  polynya, project_card)

JH2_CARDS = ("alumina", "glass.float", "ice.paper", "ice.fresh", "ice.baltic")


class Decks(unittest.TestCase):
    def setUp(self):
        self.folder = Folder(self)

    def imported(self, deck: str, *words: str) -> dict[str, float]:
        code, out, errors = polynya("card", "import", self.folder.file("deck.txt", deck), *words)
        self.assertEqual(code, 0, errors)
        return card_values(out)

    def test_alumina_as_published_is_the_card_that_comes_along_in_every_format_and_unit(self):
        expected = project_card("alumina")
        for deck, units in ((ALUMINA_MM, ["--units", "ton,mm,s"]), (ALUMINA_M, ["--units", "kg,m,s"]),
                            (ALUMINA_RADIOSS, []), (ALUMINA_MM, ["--units", "1000,0.001,1"])):
            self.assertEqual(self.imported(deck, *units), expected)

    def test_float_glass_with_long_fields_and_milliseconds_is_the_card_that_comes_along(self):
        self.assertEqual(self.imported(GLASS_LONG, "--units", "kg,mm,ms"), project_card("glass.float"))

    def test_long_fields_by_a_plus_behind_the_keyword(self):
        deck = GLASS_LONG.replace(" LONG=Y", "").replace("*MAT_110", "*MAT_110+")
        self.assertEqual(self.imported(deck, "--units", "kg,mm,ms"), project_card("glass.float"))

    def test_radioss_takes_the_input_units_where_the_card_names_none(self):
        deck = ALUMINA_RADIOSS.replace("/7/3", "/7")
        deck = deck.replace("  kg                   m  ", "  Mg                  mm  ", 1)
        self.assertEqual(self.imported(deck), project_card("alumina"))

    def test_every_value_says_where_it_is_from(self):
        file = self.folder.file("deck.k", ALUMINA_MM)
        _, out, _ = polynya("card", "import", file, "--units", "ton,mm,s")
        card = tomllib.loads(out)
        self.assertEqual(card["summary"], "Alumina 99.5")
        self.assertEqual(card["hugoniot_elastic_limit"]["origin"],
                         "assumed: imported from *MAT_110 7 of deck.k, field HEL = 2790.0, units ton,mm,s")
        _, out, _ = polynya("card", "import", file, "--units", "ton,mm,s", "--origin", "literature: Cronin 2003")
        self.assertTrue(tomllib.loads(out)["density"]["origin"].startswith("literature: Cronin 2003 (*MAT_110 7 of"))

    def test_no_limit_of_fractured_strength_is_an_absent_value(self):
        for limit in ("       0.0", "          ", "     1.E20", "     1.E30"):
            deck = ALUMINA_MM.replace("       0.2    2790.0", limit + "    2790.0")
            self.assertNotIn("maximum_fractured_strength", self.imported(deck, "--units", "ton,mm,s"))

    def test_fields_that_are_idle_may_be_blank(self):
        deck = ALUMINA_MM.replace("       1.0     200.0", "               200.0")  # EPS0, with C = 0
        self.assertEqual(self.imported(deck, "--units", "ton,mm,s")["reference_strain_rate"], 1)

    def test_reference_rate_of_one_per_millisecond_is_doubted(self):
        deck = GLASS_LONG.replace("0.001".rjust(20), "1.0".rjust(20))
        code, out, errors = polynya("card", "import", self.folder.file("deck.k", deck), "--units", "kg,mm,ms")
        self.assertEqual((code, card_values(out)["reference_strain_rate"]), (0, 1000))
        self.assertIn("a reference rate of 1000 1/s", errors)

    def test_units_that_give_no_material_are_doubted(self):
        _, _, errors = polynya("card", "import", self.folder.file("deck.k", ALUMINA_MM), "--units", "kg,m,s")
        self.assertIn("are the units kg,m,s?", errors)


class RoundTrips(unittest.TestCase):
    def setUp(self):
        self.folder = Folder(self)

    def there_and_back(self, name: str, form: str, units: str, *words: str) -> tuple[dict[str, float], str]:
        code, deck, remarks = polynya("card", "export", name, "--format", form, "--units", units, *words)
        self.assertEqual(code, 0, remarks)
        back = [] if form == "law79" else ["--units", units]
        code, card, errors = polynya("card", "import", self.folder.file("deck.txt", deck), *back)
        self.assertEqual(code, 0, errors)
        return card_values(card), remarks

    def test_of_all_cards_are_exact_in_all_formats_and_units(self):
        for name in JH2_CARDS:
            expected = project_card(name)
            expected.pop("fracture_energy", None)
            for form in ("mat_110", "law79"):
                for units in ("kg,m,s", "ton,mm,s", "kg,mm,ms", "g,mm,ms", "g,cm,us"):
                    self.assertEqual(self.there_and_back(name, form, units)[0], expected, (name, form, units))

    def test_of_many_digits_are_off_by_the_width_of_the_fields_and_say_so(self):
        text = (ROOT / "materials" / "alumina.toml").read_text().replace('"90.16 GPa"', '"90.1612345678 GPa"')
        card = self.folder.file("many.toml", text)
        values, remarks = self.there_and_back(card, "mat_110", "kg,m,s")
        self.assertEqual(values["shear_modulus"], 90.16123e9)  # 9016123.e4
        self.assertIn("fields of 10 characters in kg,m,s round G by 5.1e-08", remarks)
        for form, words in (("mat_110", ["--long"]), ("law79", [])):
            values, remarks = self.there_and_back(card, form, "kg,m,s", *words)
            self.assertEqual(values["shear_modulus"], 90.1612345678e9)
            self.assertNotIn("round", remarks)

    def test_columns_are_as_wide_as_the_formats_say(self):
        _, deck, _ = polynya("card", "export", "ice.fresh", "--format", "mat_110", "--id", "12")
        lines = [line for line in deck.splitlines() if not line.startswith(("$", "*"))]
        self.assertEqual([len(line) for line in lines[1:]], [80, 60, 60])
        self.assertEqual((lines[1][:10].strip(), float(lines[1][60:70]), float(lines[2][30:40])), ("12", 1.2, 5.2e9))
        _, deck, _ = polynya("card", "export", "ice.fresh", "--format", "law79", "--id", "12")
        self.assertIn("\n/MAT/LAW79/12/12\n", deck)
        lines = [line for line in deck.split("/MAT/")[1].splitlines()[2:] if not line.startswith("#")]
        self.assertEqual([len(line) for line in lines], [20, 20, 80, 60, 60, 60, 80])
        self.assertEqual((float(lines[2][40:60]), lines[5][50:60].strip(), float(lines[6][60:])), (1.2, "0", 0))

    def test_what_a_deck_cannot_hold_is_said_in_it_and_on_the_terminal(self):
        _, deck, remarks = polynya("card", "export", "ice.fresh", "--format", "mat_110")
        for text in (" ".join(line.lstrip("$ ") for line in deck.splitlines() if line.startswith("$ ")), remarks):
            self.assertIn("not carried: fracture_energy", text)
        self.assertTrue(all(len(line) <= 80 for line in deck.splitlines()))

    def test_units_of_radioss_decks_are_written_as_radioss_knows_them(self):
        _, deck, _ = polynya("card", "export", "alumina", "--format", "law79", "--units", "ton,um,us")
        self.assertEqual(deck.split("/UNIT/1\n")[1].splitlines()[1].split(), ["Mg", "mum", "mus"])


class Numbers(unittest.TestCase):
    def test_as_fortran_writes_them_are_read_exactly(self):
        for text, value in (("9.016E+10", 90160000000), (" 9.016d10", 90160000000), ("9.016+10", 90160000000),
                            (".5", Fraction(1, 2)), ("-138.", -138), ("3.7-9", Fraction(37, 10 ** 10))):
            self.assertEqual(numbers.parse(text), value)
        for text in ("1,5", "1 2", "nan", "inf", "0x10", "e5", "1e999", "--1", "."):
            with self.assertRaises(ValueError, msg=text):
                numbers.parse(text)

    def test_fill_a_field_with_as_many_digits_as_fit(self):
        for value, text in ((Fraction(2, 3), "0.66666667"), (Fraction(-2, 3), "-0.6666667"),
                            (Fraction(1234567891), "1.234568e9"), (Fraction(90161234568), "9016123.e4"), (Fraction(37, 10 ** 10), "3.7e-9"),
                            (Fraction(-123456, 10 ** 14), "-1.2346e-9"), (Fraction(0), "0.0")):
            self.assertEqual(numbers.fit(value, 10), text)


if __name__ == "__main__":
    unittest.main()
