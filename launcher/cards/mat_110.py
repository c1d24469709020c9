"""*MAT_110 (*MAT_JOHNSON_HOLMQUIST_CERAMICS) of LS-DYNA decks.

Layout and meanings: LS-DYNA keyword user's manual, volume II (material models), *MAT_110; formats of lines: volume I,
"Getting started". T, HEL, PHEL, G and K1 to K3 are stresses, SFMAX is normalised by sigma_HEL, EPS0 is a rate in the
deck's unit of time. A deck does not say its units.
"""
from __future__ import annotations

import re
from pathlib import Path

from launcher import WrongInput
from launcher.cards import deck
from launcher.cards.deck import DeckCard, Field, Loss
from launcher.cards.johnson_holmquist import Material, pressure_at_limit
from launcher.cards.numbers import rounded
from launcher.cards.unit_systems import UnitSystem

KIND = "*MAT_110"
KEYWORDS = ("*MAT_110", "*MAT_JOHNSON_HOLMQUIST_CERAMICS")
CARDS = (("MID", "RO", "G", "A", "B", "C", "M", "N"), ("EPS0", "T", "SFMAX", "HEL", "PHEL", "BETA"),
         ("D1", "D2", "K1", "K2", "K3", "FS"))
FIELDS = {"density": "RO", "shear_modulus": "G", "bulk_modulus": "K1", "bulk_modulus_2": "K2", "bulk_modulus_3": "K3",
          "hugoniot_elastic_limit": "HEL", "pressure_at_hugoniot_elastic_limit": "PHEL",
          "intact_strength_constant": "A", "intact_strength_exponent": "N", "strain_rate_constant": "C",
          "reference_strain_rate": "EPS0", "fractured_strength_constant": "B", "fractured_strength_exponent": "M",
          "maximum_fractured_strength": "SFMAX", "maximum_tensile_pressure": "T", "damage_constant": "D1",
          "damage_exponent": "D2", "bulking_fraction": "BETA"}
STANDARD, LONG = 10, 20


def read(file: Path) -> list[DeckCard]:
    """Every card of this law in a deck. Raises WrongInput naming file, line and field."""
    cards, others, long_deck = [], [], False
    for keyword, place, lines in blocks(file):
        words = keyword.upper().split()
        name, suffix = re.fullmatch(r"(.*?)([+%-]?)", words[0]).groups()
        if name == "*KEYWORD":
            long_deck = "LONG=Y" in words[1:]
        base = name.removesuffix("_TITLE")
        if base in KEYWORDS:
            suffix = suffix or next((word for word in words[1:] if word in "+-%"), "")
            width = {"+": LONG, "-": STANDARD}.get(suffix, LONG if long_deck else STANDARD)
            cards.append(card_of(file, place, lines, width, titled=base != name))
        elif base.startswith("*MAT_"):
            others.append(f"{base} (line {place.rsplit(':', 1)[1]})")
    if not cards:
        raise WrongInput(f"{file}: no {' or '.join(KEYWORDS)} in it" +
                         (f"; it has {', '.join(others)}" if others else ""))
    return cards


def blocks(file: Path) -> list[tuple[str, str, list[tuple[int, str]]]]:
    """Keyword, place and numbered lines of each block, without comments, up to *END."""
    found: list[tuple[str, str, list[tuple[int, str]]]] = []
    for number, line in enumerate(deck.lines_of(file), 1):
        if line.startswith("$"):
            continue
        if line.startswith("*"):
            if line.upper().split()[0] == "*END":
                break
            found.append((line, f"{file}:{number}", []))
        elif found:
            found[-1][2].append((number, line))
    return found


def card_of(file: Path, place: str, lines: list[tuple[int, str]], width: int, titled: bool) -> DeckCard:
    title = lines[0][1].strip() if titled and lines else ""
    lines = lines[1:] if titled else lines
    if len(lines) < len(CARDS):
        raise WrongInput(f"{place}: {KIND} ends after {len(lines)} of {len(CARDS)} lines of fields; line "
                         f"{len(lines) + 1} must hold {', '.join(CARDS[len(lines)])}")
    fields: dict[str, Field] = {}
    for (number, line), names in zip(lines, CARDS):
        fields |= fields_of(line, names, width, f"{file}:{number}")
    card = DeckCard(KIND, fields["MID"].text.strip(), title, place, fields)
    if not card.identifier:
        raise WrongInput(f"{fields['MID'].place}: blank, must be the material's id")
    criterion = fields["FS"].number
    if criterion != 0:
        meaning = ("erodes elements where P* + T* < 0" if criterion < 0 else
                   f"erodes elements beyond a plastic strain of {float(criterion):g} (nearest: ice.critical_strain of "
                   "a scene)")
        card.losses.append(Loss(fields["FS"].place, f"{meaning}; a card has no such criterion", True))
    return card


def fields_of(line: str, names: tuple[str, ...], width: int, where: str) -> dict[str, Field]:
    """A line with a comma is in free format, any other one in columns."""
    if "," not in line:
        return deck.cut(line, [(name, width) for name in names], where)
    parts = [part.strip() for part in line.split(",")]
    while parts and not parts[-1]:
        parts.pop()
    if len(parts) > len(names):
        raise WrongInput(f"{where}: {len(parts)} fields between commas; must be {', '.join(names)}")
    parts += [""] * (len(names) - len(parts))
    return {name: Field(name, part, f"{where}: field {name} ({index} of the line)")
            for index, (name, part) in enumerate(zip(names, parts), 1)}


def material(card: DeckCard, units: UnitSystem, origin: str | None, name: str) -> tuple[Material, list[str]]:
    """The neutral form and remarks. PHEL 0 is derived as LS-DYNA does. Raises WrongInput."""
    given = card.fields["PHEL"]
    if given.number != 0:
        return deck.to_material(card, units, FIELDS, origin, name)
    values = {value: card.fields[symbol].number for value, symbol in FIELDS.items()}
    try:
        derived = pressure_at_limit(values)
    except ValueError as error:
        raise WrongInput(f"{given.place}: {error}") from None
    card.fields["PHEL"] = Field("PHEL", str(rounded(derived)), given.place)
    found, remarks = deck.to_material(card, units, FIELDS, origin, name)
    found.origin["pressure_at_hugoniot_elastic_limit"] = (
        f"assumed: PHEL is 0 in {KIND} {card.identifier}; derived from HEL, G and K1 to K3 as LS-DYNA does, "
        "HEL = P(mu) + 4/3 G mu / (1 + mu)")
    return found, [*remarks, f"{given.place}: 0, derived from HEL, G and K1 to K3 as LS-DYNA does"]


def write(material: Material, units: UnitSystem, identifier: int, long: bool = False) -> tuple[str, list[str]]:
    """The deck, and remarks on what it does not hold."""
    width = LONG if long else STANDARD
    fields, off = deck.texts(material, units, FIELDS, width)
    fields |= {"MID": str(identifier), "FS": "0.0"}
    remarks = deck.remarks_of(material, units, deck.losses_of(material), off, width)
    lines = ["*KEYWORD", *deck.comments(material, FIELDS, units, remarks, "$"),
             KEYWORDS[1] + "_TITLE" + ("+" if long else ""), f"{material.name}"[:70]]
    for names in CARDS:
        lines += ["$#" + "".join(name.lower().rjust(width) for name in names)[2:],
                  "".join(fields[name].rjust(width) for name in names)]
    return "\n".join([*lines, "*END"]) + "\n", remarks
