"""What the formats of decks share: fields with their place, the way from fields to the neutral form and back."""
from __future__ import annotations

import textwrap
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from launcher import WrongInput
from launcher.cards import numbers
from launcher.cards.johnson_holmquist import PARAMETERS, Material, check
from launcher.cards.unit_systems import RATE, UnitSystem

UNLIMITED = Fraction(10) ** 20  # SFMAX from here on, and 0, is what both codes take for no limit
NOT_IN_A_DECK = {
    "fracture_energy": "only used by effects.damage_regularisation of a scene, the law without it is the same"}


@dataclass(frozen=True)
class Field:
    """One field of a deck: its text and where it stands, "deck.k:12: field G (columns 21 to 30)"."""

    name: str
    text: str
    place: str

    @property
    def number(self) -> Fraction:
        """0 where the field is blank, as both codes read it. Raises WrongInput."""
        if not self.text.strip():
            return Fraction(0)
        if self.text.strip().startswith("&"):
            raise WrongInput(f"{self.place}: '{self.text.strip()}' is a parameter; write its number")
        try:
            return numbers.parse(self.text)
        except ValueError as error:
            raise WrongInput(f"{self.place}: {error}; must be one such as 9.016E+10") from None


@dataclass
class Loss:
    """What the other form has no room for. `changes_law`: without it the law is another one."""

    place: str
    sentence: str
    changes_law: bool


@dataclass
class DeckCard:
    """One material of a deck. `fields` by their names in that format, `losses` what a card cannot hold of it."""

    kind: str  # "*MAT_110", "/MAT/LAW79"
    identifier: str
    title: str
    place: str  # "deck.k:11"
    fields: dict[str, Field] = field(default_factory=dict)
    units: UnitSystem | None = None
    losses: list[Loss] = field(default_factory=list)


def lines_of(file: Path) -> list[str]:
    try:
        return file.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise WrongInput(f"{file}: {error.strerror}") from None


def cut(line: str, columns: list[tuple[str, int]], where: str) -> dict[str, Field]:
    """A line of fields of fixed widths; where it is too short they are blank. A name "" is a gap. Raises WrongInput."""
    if "\t" in line:
        raise WrongInput(f"{where}: a tab; fields stand in columns, which must be filled up with blanks")
    fields, start = {}, 0
    for name, width in columns:
        if name:
            place = f"{where}: field {name} (columns {start + 1} to {start + width})"
            fields[name] = Field(name, line[start:start + width], place)
        start += width
    return fields


def choose(cards: list[DeckCard], identifier: str | None, file: Path, what: str) -> DeckCard:
    """The card asked for, or the only one. Raises WrongInput."""
    listed = ", ".join(f"{card.identifier} (line {card.place.rsplit(':', 1)[1]})" for card in cards)
    if not cards:
        raise WrongInput(f"{file}: no {what} in it")
    chosen = [card for card in cards if identifier in (None, card.identifier)]
    if not chosen:
        raise WrongInput(f"{file}: no {what} with id {identifier}; it has {listed}")
    if len(chosen) > 1:
        raise WrongInput(f"{file}: {len(chosen)} materials, {listed}; " + (
            "choose one with --id" if identifier is None else "ids must differ"))
    return chosen[0]


def to_material(card: DeckCard, units: UnitSystem, names: dict[str, str], origin: str | None,
                name: str) -> tuple[Material, list[str]]:
    """The neutral form, and remarks for the user. `names`: value of a card -> field. Raises WrongInput."""
    source = f"{card.kind} {card.identifier} of {Path(card.place.rsplit(':', 1)[0]).name}"
    material = Material(name, card.title or f"Imported from {source}.", {}, {})
    remarks: list[str] = []
    for value, symbol in names.items():
        given = card.fields[symbol]
        material.values[value] = given.number * units.factor(PARAMETERS[value].dimension)
        found = f"{source}, field {symbol} = {given.text.strip() or 'blank'}, units {units}"
        material.origin[value] = f"{origin} ({found})" if origin else f"assumed: imported from {found}"
    fill_what_means_nothing(material, names, card)
    remarks += doubts(material, units, card.fields[names["reference_strain_rate"]])
    check(material.values, lambda value: card.fields[names[value]].place)
    return material, remarks


def fill_what_means_nothing(material: Material, names: dict[str, str], card: DeckCard) -> None:
    """A field that is 0 because another one makes it idle gets the value that changes nothing."""
    values, origin = material.values, material.origin
    if values["maximum_fractured_strength"] == 0 or values["maximum_fractured_strength"] >= UNLIMITED:
        del values["maximum_fractured_strength"], origin["maximum_fractured_strength"]
    for idle, owner in (("reference_strain_rate", "strain_rate_constant"),
                        ("fractured_strength_exponent", "fractured_strength_constant")):
        if values[idle] == 0 and values[owner] == 0:
            values[idle] = Fraction(1)
            origin[idle] = (f"assumed: any, {names[idle]} is 0 in {card.kind} {card.identifier} and {names[owner]} = 0 "
                            "makes it idle")


def doubts(material: Material, units: UnitSystem, rate: Field) -> list[str]:
    """Signs of units other than those named."""
    found = []
    density, modulus = (float(material.values[name]) for name in ("density", "shear_modulus"))
    if density > 0 and not 50 <= density <= 25000:
        found.append(f"a density of {density:g} kg/m^3: are the units {units}?")
    if modulus > 0 and not 1e5 <= modulus <= 1e12:
        found.append(f"a shear modulus of {modulus:g} Pa: are the units {units}?")
    if rate.number == 1 and units.factor(RATE) != 1 and material.values["strain_rate_constant"] != 0:
        found.append(f"{rate.place}: 1 in {units} is a reference rate of {float(units.factor(RATE)):g} 1/s; if 1/s is "
                     "meant, the deck is wrong")
    return found


def losses_of(material: Material) -> list[Loss]:
    """What no deck has a field for."""
    return [Loss(name, NOT_IN_A_DECK.get(name, "no field for it, the exported law is another one without it"),
                 name not in NOT_IN_A_DECK) for name in material.beyond]


def refuse_another_law(losses: list[Loss], where: str = "") -> None:
    """Raises WrongInput for the first loss that changes the law."""
    for loss in losses:
        if loss.changes_law:
            raise WrongInput(f"{where}{loss.place}: {loss.sentence}; --lossy leaves it out")


def texts(material: Material, units: UnitSystem, names: dict[str, str], width: int) -> tuple[dict[str, str], list[str]]:
    """The text of every field, and by how much fields are off because of their width."""
    fields, off = {}, []
    for value, symbol in names.items():
        number = material.values.get(value, Fraction(0)) / units.factor(PARAMETERS[value].dimension)
        try:
            fields[symbol] = numbers.fit(number, width)
        except ValueError as error:
            raise WrongInput(f"{material.name}: {value}: {error} in units {units}") from None
        error = abs(numbers.parse(fields[symbol]) - number) / abs(number) if number else Fraction(0)
        if error > Fraction(1, 10 ** 15):
            off.append(f"{symbol} by {float(error):.1e}")
    return fields, off


def remarks_of(material: Material, units: UnitSystem, losses: list[Loss], off: list[str], width: int) -> list[str]:
    said = [f"not carried: {loss.place}: {loss.sentence}" for loss in losses]
    if "maximum_fractured_strength" not in material.values:
        said.append("SFMAX 0.0: the strength of fractured material is unlimited, the default of the format")
    if off:
        said.append(f"fields of {width} characters in {units} round {', '.join(off)} (relative)")
    return said


def comments(material: Material, names: dict[str, str], units: UnitSystem, remarks: list[str], mark: str) -> list[str]:
    """The head of a deck: what it is, in which units, what is not in it, where its values are from."""
    origins: dict[str, list[str]] = {}
    for value, symbol in names.items():
        if value in material.origin:
            origins.setdefault(material.origin[value], []).append(symbol)
    paragraphs = [f"{material.name}: {material.summary}", f"Units: {units}", *remarks,
                  *(f"{', '.join(symbols)}: {origin}" for origin, symbols in origins.items())]
    lines = []
    for paragraph in paragraphs:
        ascii_only = paragraph.encode("ascii", "replace").decode()
        lines += textwrap.wrap(ascii_only, 76, initial_indent=f"{mark} ", subsequent_indent=f"{mark}   ")
    return lines
