"""Polynya's own material cards (TOML) to and from the neutral form."""
from __future__ import annotations

import re
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

from launcher import ROOT, WrongInput
from launcher.cards import numbers, unit_systems
from launcher.cards.johnson_holmquist import LAW, PARAMETERS, Material, check
from launcher.cards.unit_systems import DENSITY, PRESSURE, RATE, Dimension

UNIT = {DENSITY: "kg/m^3", RATE: "1/s"}
ORIGINS = ("literature: ", "calibrated: ", "assumed: ")


def find(words: str) -> Path:
    """A card by its file, or by its name in the project's materials/. Raises WrongInput."""
    project = ROOT / "materials" / f"{words}.toml"
    for file in (Path(words), project):
        if file.is_file():
            return file
    known = ", ".join(sorted(file.stem for file in (ROOT / "materials").glob("*.toml")))
    raise WrongInput(f"no card '{words}': give a file, or one of {known}")


def load(file: Path) -> dict:
    """The card as it stands, numbers as decimals. Raises WrongInput naming file and what is wrong."""
    try:
        card = tomllib.loads(file.read_text(encoding="utf-8"), parse_float=Decimal)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise WrongInput(f"{file}: {getattr(error, 'strerror', None) or error}") from None
    for key in ("law", "summary"):
        if not isinstance(card.get(key), str):
            raise WrongInput(f"{file}: {key}: missing, must be a text")
    return card


def read(file: Path) -> Material:
    """A card of LAW. Raises WrongInput naming file, line and value."""
    card = load(file)
    if card["law"] != LAW:
        raise WrongInput(f"{file}: law: is {card['law']}; only {LAW} has a card in other codes' formats here")
    entries = {name: entry for name, entry in card.items() if isinstance(entry, dict)}
    known = [name for name in entries if name in PARAMETERS]
    places = {name: place(file, name) for name in PARAMETERS}
    material = Material(name=file.stem, summary=card["summary"], beyond=[n for n in entries if n not in PARAMETERS],
                        values={name: value(entries[name], PARAMETERS[name].dimension, places[name]) for name in known},
                        origin={name: str(entries[name].get("origin", "")) for name in known})
    check(material.values, places.__getitem__)
    return material


def place(file: Path, name: str) -> str:
    for line, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if text.strip() == f"[{name}]":
            return f"{file}:{line}: {name}"
    return f"{file}: {name}"


def value(entry: dict, dimension: Dimension, where: str) -> Fraction:
    given = entry.get("value")
    if isinstance(given, bool) or not isinstance(given, (int, Decimal, str)):
        raise WrongInput(f"{where}: value: missing, must be a number in SI or a text with a unit")
    if not isinstance(given, str):
        if isinstance(given, Decimal) and not given.is_finite():
            raise WrongInput(f"{where}: {given} is no finite number")
        return Fraction(given)
    try:
        number, found = unit_systems.quantity(given)
    except ValueError as error:
        raise WrongInput(f"{where}: {error}") from None
    if found is not None and found != dimension:
        raise WrongInput(f"{where}: \"{given}\" has another dimension than {UNIT.get(dimension, 'Pa')}")
    return number


def write(material: Material) -> str:
    """The text of the card, every value with its origin; numbers to 17 digits."""
    lines = [f"law = {quoted(LAW)}", f"summary = {quoted(material.summary)}"]
    for name, parameter in PARAMETERS.items():
        if name in material.values:
            lines += ["", f"[{name}]", f"value = {written(material.values[name], parameter.dimension)}",
                      f"origin = {quoted(material.origin[name])}"]
    return "\n".join(lines) + "\n"


def written(number: Fraction, dimension: Dimension) -> str:
    """As the cards of the project write it: "90.16 GPa", "3700.0 kg/m^3", 0.93."""
    if dimension == PRESSURE:
        size = abs(number)
        exponent = next((e for e in (9, 6, 3) if size >= 10 ** e), 0)
        return f"\"{numbers.shortest(number / 10 ** exponent)} { {9: 'G', 6: 'M', 3: 'k', 0: ''}[exponent]}Pa\""
    unit = UNIT.get(dimension)
    return f"\"{numbers.shortest(number)} {unit}\"" if unit else numbers.shortest(number)


def quoted(text: str) -> str:
    """A basic string of TOML."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", " ", escaped) + '"'
