"""The command line. Standard library only: it is read before any package is installed."""
from __future__ import annotations

import argparse
import json
import math
import sys
from typing import NoReturn

from launcher import ROOT, WRONG_INPUT

NEED_PACKAGES = {"build", "run", "resume", "replay", "explain", "test", "bench", "draw", "conform", "validate",
                 "card"}


class Parser(argparse.ArgumentParser):
    """Wrong input is one line on stderr and exit code 2."""

    def error(self, message: str) -> NoReturn:
        print(f"polynya: {message} (see `{self.prog} --help`)", file=sys.stderr)
        sys.exit(WRONG_INPUT)


def positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError
    return number


positive.__name__ = "positive number"


def seconds(text: str) -> float:
    number = float(text)
    if not 0 < number < float("inf"):
        raise ValueError
    return number


seconds.__name__ = "number of seconds"


def assignment(text: str) -> str:
    key, equals, _ = text.partition("=")
    if not equals or not key.strip():
        raise argparse.ArgumentTypeError(f"'{text}' is not key=value, for example vehicle.speed=60")
    return text


def magnitude(text: str) -> float:
    number = float(text)
    if not 0 <= number < math.inf:
        raise ValueError
    return number


magnitude.__name__ = "number from 0 on"


def presets() -> list[str]:
    described = json.loads((ROOT / "CMakePresets.json").read_text())
    return [entry["name"] for entry in described["configurePresets"] if not entry.get("hidden")]


def add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", metavar="SCENE", help="a scene file, or a folder of cases/ or examples/")
    add_scene_options(parser)


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--level", metavar="L", help="one of the scene's levels of resolution, e.g. quick")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], type=assignment, dest="settings",
                        help="change one value of the scene, e.g. vehicle.speed=60 or ice.thickness='20 mm'")
    parser.add_argument("--json", action="store_true", help="one line of JSON on standard output")


def add_resume(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("run", metavar="RUN", help="folder of a run with a checkpoint")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], type=assignment, dest="settings",
                        help="another end, e.g. run.end_time='2 ms'; checkpoints and threads may change as well")
    parser.add_argument("--threads", metavar="N", type=positive, help="threads to use (default: all cores)")
    parser.add_argument("--json", action="store_true", help="one line of JSON on standard output")
    parser.add_argument("--no-pictures", action="store_false", dest="pictures", help="do not draw at the end")


def add_replay(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("run", metavar="RUN", help="folder of a run that was started with --record")
    parser.add_argument("--only", required=True, choices=("structure_solver", "ice_solver", "fluid_solver"))
    parser.add_argument("--from", metavar="TIME", dest="from_time",
                        help="compare, write frames and, with --gdb, stop from here on, e.g. '20 us'")
    parser.add_argument("--until", metavar="TIME", dest="until_time", help="end with the window that reaches this time")
    parser.add_argument("--tolerance", metavar="R", type=magnitude,
                        help="largest difference relative to the largest value of an array (default: not one bit)")
    parser.add_argument("--keep-going", action="store_true", help="past differences; the largest is told at the end")
    parser.add_argument("--gdb", action="store_true", help="start the solver under gdb")
    parser.add_argument("--preset", default="release", choices=presets(), help="default: release")
    parser.add_argument("--out", metavar="DIR", help="folder of the replay (default RUN/replay/NAME)")
    parser.add_argument("--threads", metavar="N", type=positive, help="threads to use (default: all cores)")


def add_card(parser: argparse.ArgumentParser) -> None:
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    units = dict(metavar="M,L,T", help="units of mass, length and time, e.g. kg,m,s or ton,mm,s")
    bring = actions.add_parser("import", help="a card from a deck")
    bring.add_argument("file", metavar="FILE", help="a deck of LS-DYNA or Radioss")
    bring.add_argument("--format", choices=("mat_110", "law79"), help="default: by the deck's keywords")
    bring.add_argument("--units", **units)
    bring.add_argument("--id", metavar="ID", help="which material, where the deck has several")
    bring.add_argument("--origin", metavar="TEXT", help="of every value, e.g. \"literature: Cronin et al. 2003\"")
    bring.add_argument("-o", metavar="OUT.toml", dest="output", help="default: standard output")
    export = actions.add_parser("export", help="a deck from a card")
    export.add_argument("card", metavar="CARD", help="a name in materials/, or a file")
    export.add_argument("--format", choices=("mat_110", "law79"), required=True)
    export.add_argument("--units", **units)
    export.add_argument("--id", metavar="ID", type=positive, default=1, help="of the material in the deck; default: 1")
    export.add_argument("--long", action="store_true", help="fields of 20 characters in *MAT_110")
    export.add_argument("-o", metavar="OUT", dest="output", help="default: standard output")
    for action in (bring, export):
        action.add_argument("--lossy", action="store_true", help="also where the result is another law")
    show = actions.add_parser("show", help="the values of a card and where they are from")
    show.add_argument("card", metavar="CARD", help="a name in materials/, or a file")


def build_parser() -> argparse.ArgumentParser:
    parser = Parser(prog="./polynya", description="Water exit of a vehicle through floating ice.",
                    epilog="Exit codes: 0 done, 1 failed, 2 wrong input.")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    run = commands.add_parser("run", help="build what is missing, run a scene, draw it")
    add_scene(run)
    run.add_argument("--out", metavar="DIR", help="run folder (default runs/NAME-LEVEL-DATE-TIME)")
    run.add_argument("--threads", metavar="N", type=positive, help="threads to use (default: all cores)")
    run.add_argument("--record", action="append_const", dest="settings", const="record.interface=true",
                     help="write down every message for ./polynya replay, the same as --set record.interface=true")
    run.add_argument("--no-pictures", action="store_false", dest="pictures", help="do not draw at the end")

    add_resume(commands.add_parser("resume", help="go on with a run that was killed, or that is to end later"))

    add_replay(commands.add_parser("replay", help="one solver of a run against the run's record, no other process"))

    add_scene(commands.add_parser("explain", help="what a run would do and cost, without running it"))

    build = commands.add_parser("build", help="build every program")
    build.add_argument("--preset", default="release", choices=presets(), help="default: release")

    test = commands.add_parser("test", help="build everything and run the tests")
    test.add_argument("--long", action="store_true", help="the long tests as well")
    test.add_argument("-R", metavar="REGEX", dest="regex", help="only tests whose name matches")

    bench = commands.add_parser("bench", help="measure the speed of the kernels")
    bench.add_argument("name", metavar="NAME", nargs="?", help="one bench (default: all)")
    bench.add_argument("--json", action="store_true", help="one line of JSON on standard output")

    validate = commands.add_parser("validate", help="compare with theory, experiments and papers")
    validate.add_argument("names", metavar="NAME", nargs="*", help="comparisons (default: all, the cheapest first)")
    validate.add_argument("--list", action="store_true", help="what there is, and what was found last")
    validate.add_argument("--again", action="store_true", help="also what was found with these very sources")
    validate.add_argument("--json", action="store_true", help="one line of JSON on standard output")

    conform = commands.add_parser("conform", help="whether a solver follows docs/protocol.md",
                                  usage="./polynya conform [options] -- COMMAND ...")
    conform.add_argument("participant", metavar="COMMAND", nargs="+", help="the program and its first arguments")
    conform.add_argument("--role", choices=("solid", "fluid"), default="solid", help="default: solid")
    conform.add_argument("--name", choices=("structure", "ice", "fluid"), help="default: structure, or fluid")
    conform.add_argument("--scene", metavar="SCENE", help="default: cases/vehicle_drop, cases/vehicle_in_water")
    add_scene_options(conform)
    conform.add_argument("--out", metavar="DIR", help="keep the run folders and logs of the conversations here")
    conform.add_argument("--patience", metavar="SECONDS", type=seconds, default=60.0,
                         help="for each answer; default: 60")
    conform.add_argument("--slow", metavar="SECONDS", type=seconds, default=2.0,
                         help="for which the coupler once says nothing; default: 2")

    add_card(commands.add_parser("card", help="material cards from and to decks of LS-DYNA and Radioss"))

    draw = commands.add_parser("draw", help="draw the pictures of a run again")
    draw.add_argument("run", metavar="RUN", help="a run folder")

    commands.add_parser("list", help="scenes and runs at hand")
    return parser


def parse(words: list[str]) -> argparse.Namespace:
    """The parsed command line; leaves with exit code 2 if it makes no sense, 0 after --help."""
    parser = build_parser()
    if not words:
        parser.print_help()
        sys.exit(WRONG_INPUT)
    return parser.parse_args(words)
