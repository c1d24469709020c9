"""Decks and cards that cannot be: one sentence with file, line, field and what would be right, exit code 2."""
import unittest

from tests.launcher.decks import ALUMINA_M, ALUMINA_MM, ALUMINA_RADIOSS, ROOT, Folder, card_values, polynya

ALUMINA = (ROOT / "materials" / "alumina.toml").read_text()


class Wrong(unittest.TestCase):
    def setUp(self):
        self.folder = Folder(self)

    def refused(self, expected: list[str], *words: str) -> None:
        code, out, errors = polynya("card", *words)
        self.assertEqual((code, out), (2, ""), errors)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        for text in expected:
            self.assertIn(text, errors)

    def refused_deck(self, deck: str, *expected: str, words=("--units", "ton,mm,s")) -> None:
        self.refused(list(expected), "import", self.folder.file("deck.k", deck), *words)

    def test_values_of_mat_110_name_line_columns_and_bound(self):
        for old, new, expected in (
                ("   3.70E-9", "  -3.70E-9", ("deck.k:6: field RO (columns 11 to 20)", "must be above 0")),
                ("   90160.0", "       0.0", ("deck.k:6: field G (columns 21 to 30)", "must be above 0")),
                ("   90160.0", "   9016O.0", ("deck.k:6: field G (columns 21 to 30)", "'9016O.0' is no number")),
                ("   90160.0", "   &shear ", ("deck.k:6: field G", "is a parameter")),
                ("      0.31", "     -0.31", ("deck.k:6: field B (columns 41 to 50)", "must be 0 or above")),
                ("    1460.0", "    2790.0", ("deck.k:8: field PHEL (columns 41 to 50)", "must be below HEL")),
                ("     200.0", "          ", ("deck.k:8: field T (columns 11 to 20)", "must be above 0")),
                ("    1460.0       1.0", "    1460.0       1.5", ("deck.k:8: field BETA", "between 0 and 1")),
                ("  130950.0       0.0", "  130950.0 -400000.0", ("deck.k:10: field K2", "mu of 0.17")),
                ("         7   3.70", "             3.70", ("deck.k:6: field MID", "must be the material's id"))):
            self.assertIn(old, ALUMINA_MM)
            self.refused_deck(ALUMINA_MM.replace(old, new), *expected)

    def test_reference_rate_is_needed_where_rates_count(self):
        deck = ALUMINA_MM.replace("0.31       0.0", "0.31     0.003")
        deck = deck.replace("       1.0     200.0", " " * 15 + "200.0")
        self.refused_deck(deck, "deck.k:8: field EPS0 (columns 1 to 10)", "must be above 0")

    def test_lines_that_are_no_card(self):
        short = ALUMINA_MM.replace("     0.005       1.0  130950.0       0.0       0.0       0.0\n", "")
        self.refused_deck(short, "deck.k:3: *MAT_110 ends after 2 of 3", "line 3 must hold D1, D2, K1, K2, K3, FS")
        self.refused_deck(ALUMINA_MM.replace("   90160.0", "\t90160.0"), "deck.k:6: a tab")
        self.refused_deck(ALUMINA_M.replace(".6,.6", ".6,.6,.6"), "deck.k:3: 9 fields between commas; must be MID, RO")
        self.refused_deck("*KEYWORD\n*MAT_ELASTIC\n1,2,3\n", "no *MAT_110 or", "it has *MAT_ELASTIC (line 2)")
        self.refused_deck("nothing\n", "no keyword in it")

    def test_two_materials_need_a_choice(self):
        two = ALUMINA_MM.replace("*END\n", "") + ALUMINA_M.replace("7,3700", "8,3700")
        self.refused_deck(two, "2 materials, 7 (line 3), 8 (line 12); choose one with --id")
        self.refused_deck(two, "no *MAT_110 with id 9; it has 7 (line 3), 8", words=("--units", "kg,m,s", "--id", "9"))

    def test_units_must_be_named_and_known(self):
        self.refused_deck(ALUMINA_MM, "deck.k:3: the deck does not say its units", "--units ton,mm,s", words=())
        self.refused_deck(ALUMINA_MM, "--units: 'mm' is no unit of mass; must be one such",
                          words=("--units", "mm,kg,s"))
        self.refused_deck(ALUMINA_MM, "must be three units", words=("--units", "kg,m"))
        self.refused_deck(ALUMINA_RADIOSS, "--units kg,m,s: the deck itself says Mg,mm,s", words=("--units", "kg,m,s"))

    def test_erosion_is_another_law_unless_asked_for(self):
        deck = ALUMINA_MM.replace("0.0       0.0       0.0\n*END", "0.0       0.0      0.35\n*END")
        self.refused_deck(deck, "deck.k:10: field FS (columns 51 to 60)", "beyond a plastic strain of 0.35", "--lossy")
        file = self.folder.file("deck.k", deck)
        code, out, errors = polynya("card", "import", file, "--units", "ton,mm,s", "--lossy")
        self.assertEqual((code, card_values(out)["bulk_modulus"]), (0, 130.95e9))
        self.assertIn("not carried: ", errors)
        idle = "                   1                   0                   0\n"
        self.assertIn(idle, ALUMINA_RADIOSS)
        for number, words in ((1, "P* + T* < 0"), (2, "EPSMAX"), (3, "damage is 1")):
            deck = ALUMINA_RADIOSS.replace(idle, idle[:39] + f"{number}\n")
            self.refused_deck(deck, "field IDEL (columns 51 to 60)", words, words=())

    def test_decks_of_radioss(self):
        self.refused_deck(ALUMINA_RADIOSS.replace("/7/3", "/7/4"), "deck.k:10: unit 4 is defined by no /UNIT/4",
                          words=())
        self.refused_deck(ALUMINA_RADIOSS.replace("/7/3", ""), "deck.k:10: the id of the material is missing", words=())
        self.refused_deck(ALUMINA_RADIOSS.replace("                  Mg  ", "                  Mx  "),
                          "deck.k:9: 'Mx' is no unit of mass", words=())
        self.refused_deck(ALUMINA_RADIOSS.replace("              3.7E-9", "              3.7E-9              3.5E-9"),
                          "deck.k:13: field RHO_0 (columns 21 to 40)", "--lossy", words=())
        self.refused_deck(ALUMINA_RADIOSS.replace("                1460", "                   0"),
                          "deck.k:21: field PHEL (columns 41 to 60)", "must be above 0", words=())
        lines = ALUMINA_RADIOSS.splitlines(keepends=True)
        self.refused_deck("".join(lines[:-2]), "deck.k:10: /MAT/LAW79 ends after 6 of 7", "K1, K2, K3, BETA", words=())

    def test_cards_that_no_deck_can_hold(self):
        self.refused(["law: is j2_plastic"], "export", "copper", "--format", "mat_110")
        exponent = '\n[strain_rate_exponent]\nvalue = 0.15\norigin = "assumed: test"\n'
        power = self.folder.file("power.toml", ALUMINA + exponent)
        self.refused(["power.toml: strain_rate_exponent: no field for it", "--lossy"],
                     "export", power, "--format", "law79")
        code, deck, errors = polynya("card", "export", power, "--format", "law79", "--lossy")
        self.assertEqual(code, 0)
        self.assertIn("# not carried: strain_rate_exponent", deck)
        self.assertIn("not carried: strain_rate_exponent", errors)

    def test_cards_that_are_wrong_name_file_line_and_value(self):
        for old, new, expected in (('"90.16 GPa"', '"90.16 kg"', "bad.toml:8: shear_modulus: \"90.16 kg\" has ano"),
                                   ('"90.16 GPa"', '"-1 GPa"', "bad.toml:8: shear_modulus: G is -1.0e9"),
                                   ('"90.16 GPa"', '"1 Gpa"', "bad.toml:8: shear_modulus: unknown unit \"Gpa\""),
                                   ('law = ', 'lw = ', "bad.toml: law: missing")):
            card = self.folder.file("bad.toml", ALUMINA.replace(old, new))
            self.refused([expected], "export", card, "--format", "mat_110")
        self.refused(["no card 'alumna'", "alumina"], "show", "alumna")

    def test_options_that_lead_nowhere(self):
        file = self.folder.file("deck.k", ALUMINA_MM)
        self.refused(["a card is a file NAME.toml"], "import", file, "--units", "ton,mm,s", "-o", "card.txt")
        self.refused(["--origin: must say which after 'literature: '"], "import", file, "--origin", "somebody")
        self.refused(["no.k: No such file"], "import", "no.k")


if __name__ == "__main__":
    unittest.main()
