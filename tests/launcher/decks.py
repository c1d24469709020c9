"""Decks as other codes write them, of published constants (Cronin et al. 2003, 4th European LS-DYNA Conf.)."""
import contextlib
import io
import tempfile
import tomllib
from pathlib import Path

from launcher import command_line, main
from launcher.cards import unit_systems

ROOT = Path(__file__).resolve().parents[2]

# mm, ton, s: the table's own units, density 3700 as in materials/alumina.toml. Columns of 10, comments, a title.
ALUMINA_MM = """\
*KEYWORD
$ a deck
*MAT_JOHNSON_HOLMQUIST_CERAMICS_TITLE
Alumina 99.5
$#     mid        ro         g         a         b         c         m         n
         7   3.70E-9   90160.0      0.93      0.31       0.0      0.60      0.60
$#    eps0         t     sfmax       hel      phel      beta
       1.0     200.0       0.2    2790.0    1460.0       1.0
$#      d1        d2        k1        k2        k3        fs
     0.005       1.0  130950.0       0.0       0.0       0.0
*END
"""
# The same in kg, m, s, free format, Fortran exponents, by number.
ALUMINA_M = """\
*KEYWORD
*mat_110
7,3700.,90.16+9,.93,.31,0,.6,.6
1.0, 2.0d8, 0.2, 2.79E9, 1.46E9, 1.0
.005, 1., 130.95E+09, 0, 0,
*END
"""
GLASS_LONG = "*KEYWORD LONG=Y\n*MAT_110\n" + "\n".join(
    "".join(word.rjust(20) for word in line.split()) for line in (
        "glass 2.53e-6 30.4 0.93 0.088 0.003 0.35 0.77", "0.001 0.15 0.5 5.95 2.92 1.0",
        "0.053 0.85 45.4 -138.0 290.0 0")) + "\n*END\n"  # kg, mm, ms: GPa
ALUMINA_RADIOSS = """\
#RADIOSS STARTER
/BEGIN
any run
      2023         0
                  kg                   m                   s
                  kg                   m                   s
/UNIT/3
ton mm s
                  Mg                  mm                   s
/MAT/JOHN_HOLM/7/3
Alumina 99.5
#              RHO_I               RHO_0
              3.7E-9
#                  G
               90160
#                  a                   b                   m                   n
                 .93                 .31                  .6                  .6
#                  c           EPS_DOT_0         SIGMA_F_MAX
                   0                   1                  .2
#                  T                 HEL                PHEL
                 200                2790                1460
#                 D1                  D2                IDEL             EPS_MAX
                .005                   1                   0                   0
#                 K1                  K2                  K3                BETA
              130950                   0                   0                   1
/END
"""


def polynya(*words: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command, in this process."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        code = main.run_command(command_line.parse(list(words)))
    return code, out.getvalue(), errors.getvalue()


def card_values(text: str) -> dict[str, float]:
    """Every value of a card in SI, read apart from the code under test but for the units."""
    card = tomllib.loads(text)
    return {name: float(unit_systems.quantity(entry["value"])[0] if isinstance(entry["value"], str) else entry["value"])
            for name, entry in card.items() if isinstance(entry, dict)}


def project_card(name: str) -> dict[str, float]:
    return card_values((ROOT / "materials" / f"{name}.toml").read_text())


class Folder:
    """A folder for one test."""

    def __init__(self, test):
        temporary = tempfile.TemporaryDirectory()
        test.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def file(self, name: str, text: str) -> str:
        (self.path / name).write_text(text)
        return str(self.path / name)
