"""`polynya card`: material cards from and to decks of LS-DYNA and Radioss, and what stands in a card."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from types import ModuleType

from launcher import DONE, WrongInput
from launcher.cards import card_file, deck, law79, mat_110, unit_systems
from launcher.cards.johnson_holmquist import LAW, PARAMETERS
from launcher.cards.unit_systems import UnitSystem

FORMATS = {"mat_110": mat_110, "law79": law79}
SI = "kg,m,s"


def run(arguments: argparse.Namespace) -> int:
    return {"import": import_card, "export": export_card, "show": show_card}[arguments.action](arguments)


def import_card(arguments: argparse.Namespace) -> int:
    file, output = Path(arguments.file), Path(arguments.output) if arguments.output else None
    if output and output.suffix != ".toml":
        raise WrongInput(f"-o {output}: a card is a file NAME.toml")
    if arguments.origin and not any(arguments.origin.startswith(start) and len(arguments.origin) > len(start)
                                    for start in card_file.ORIGINS):
        raise WrongInput(f"--origin: must say which after {', '.join(map(repr, card_file.ORIGINS))}")
    form = FORMATS[arguments.format] if arguments.format else format_of(file)
    card = deck.choose(form.read(file), arguments.id, file, form.KIND)
    if not arguments.lossy:
        deck.refuse_another_law(card.losses)
    material, remarks = form.material(card, units_of_deck(card, arguments.units), arguments.origin,
                                      output.stem if output else file.stem)
    tell([f"not carried: {loss.place}: {loss.sentence}" for loss in card.losses] + remarks)
    put(card_file.write(material), output)
    if output:
        print(f"{output}: ice.material = \"{material.name}\" in a scene, with the card in a folder materials beside it "
              "or in the project's own")
    return DONE


def format_of(file: Path) -> ModuleType:
    """By the first keyword: LS-DYNA's start with *, Radioss's with /."""
    for line in deck.lines_of(file):
        if line.startswith(("*", "/")):
            return mat_110 if line[0] == "*" else law79
    raise WrongInput(f"{file}: no keyword in it; a deck of LS-DYNA or Radioss must have *MAT_110 or /MAT/LAW79")


def units_of_deck(card: deck.DeckCard, asked: str | None) -> UnitSystem:
    named = units_of(asked) if asked else None
    if card.units and named and named.factors != card.units.factors:
        raise WrongInput(f"--units {asked}: the deck itself says {card.units} ({card.place})")
    if not (card.units or named):
        raise WrongInput(f"{card.place}: the deck does not say its units; name those of mass, length and time, such as "
                         "--units kg,m,s or --units ton,mm,s")
    return card.units or named


def units_of(text: str) -> UnitSystem:
    try:
        return unit_systems.system(text.split(","))
    except ValueError as error:
        raise WrongInput(f"--units: {error}") from None


def export_card(arguments: argparse.Namespace) -> int:
    file = card_file.find(arguments.card)
    material = card_file.read(file)
    if not arguments.lossy:
        deck.refuse_another_law(deck.losses_of(material), f"{file}: ")
    text, remarks = FORMATS[arguments.format].write(material, units_of(arguments.units or SI), arguments.id,
                                                    arguments.long)
    tell(remarks)
    put(text, Path(arguments.output) if arguments.output else None)
    if arguments.output:
        print(arguments.output)
    return DONE


def tell(remarks: list[str]) -> None:
    for remark in remarks:
        print(f"polynya: {remark}", file=sys.stderr)


def put(text: str, output: Path | None) -> None:
    if output is None:
        print(text, end="")
        return
    try:
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        raise WrongInput(f"-o {output}: {error.strerror}") from None


def show_card(arguments: argparse.Namespace) -> int:
    file = card_file.find(arguments.card)
    card = card_file.load(file)
    print(f"{file}\n{card['law']}: {card['summary']}\n")
    rows = [(name, PARAMETERS[name].symbol if card["law"] == LAW and name in PARAMETERS else "",
             str(entry.get("value", "-")), str(entry.get("origin", "-")))
            for name, entry in card.items() if isinstance(entry, dict)]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for row in rows:
        print("  ".join(word.ljust(width) for word, width in zip(row, widths)) + f"  {row[3]}")
    return DONE
