"""/MAT/LAW79 (/MAT/JOHN_HOLM) of Radioss and OpenRadioss starter decks, fixed fields of 20 characters.

Layout and meanings: Altair's Radioss reference guide, /MAT/LAW79, /UNIT and /BEGIN; OpenRadioss, hm_read_mat79.F (IDEL,
EPSMAX and FCUT from input version 2023 on) and sigeps79.F. T, HEL, PHEL, G and K1 to K3 are stresses, SFMAX is
normalised by sigma_HEL. Units are those of /UNIT where the card names one, else the input units of /BEGIN.
"""
from __future__ import annotations

from pathlib import Path

from launcher import WrongInput
from launcher.cards import deck, unit_systems
from launcher.cards.deck import DeckCard, Field, Loss
from launcher.cards.johnson_holmquist import Material
from launcher.cards.unit_systems import UnitSystem

KIND = "/MAT/LAW79"
KEYWORDS = ("LAW79", "JOHN_HOLM")
WIDTH = 20
CARDS = ((("RHO_I", 20), ("RHO_0", 20)), (("G", 20),), (("A", 20), ("B", 20), ("M", 20), ("N", 20)),
         (("C", 20), ("EPS0", 20), ("SFMAX", 20), ("FCUT", 20)), (("T", 20), ("HEL", 20), ("PHEL", 20)),
         (("D1", 20), ("D2", 20), ("", 10), ("IDEL", 10), ("EPSMAX", 20)),
         (("K1", 20), ("K2", 20), ("K3", 20), ("BETA", 20)))
FIELDS = {"density": "RHO_I", "shear_modulus": "G", "bulk_modulus": "K1", "bulk_modulus_2": "K2",
          "bulk_modulus_3": "K3", "hugoniot_elastic_limit": "HEL", "pressure_at_hugoniot_elastic_limit": "PHEL",
          "intact_strength_constant": "A", "intact_strength_exponent": "N", "strain_rate_constant": "C",
          "reference_strain_rate": "EPS0", "fractured_strength_constant": "B", "fractured_strength_exponent": "M",
          "maximum_fractured_strength": "SFMAX", "maximum_tensile_pressure": "T", "damage_constant": "D1",
          "damage_exponent": "D2", "bulking_fraction": "BETA"}
EROSION = {1: "erodes elements where P* + T* < 0, and drops the tensile limit of the pressure",
           2: "erodes elements beyond a plastic strain of EPSMAX (nearest: ice.critical_strain of a scene)",
           3: "erodes elements whose damage is 1"}
# sigeps79.F (commit 0c91c23) adds (1 - scale) q / (3 sqrt(3) G), the law (1 - scale) q / (3 G).
SLOWER_DAMAGE = ("OpenRadioss (source of 2023) counts 1/sqrt(3) of the law's plastic strain, so with the same D1 its "
                 "damage grows more slowly by that factor; D1 is left as it is")

Block = tuple[list[str], str, list[tuple[int, str]]]


def read(file: Path) -> list[DeckCard]:
    """Every card of this law in a deck. Raises WrongInput naming file, line and field."""
    found = blocks(file)
    input_units, local_units, cards, others = None, {}, [], []
    for words, place, lines in found:
        if words[0] == "BEGIN" and len(lines) > 2:
            input_units = units_of(lines[2], file)
        elif words[0] == "UNIT" and len(words) > 1:
            if len(lines) < 2:
                raise WrongInput(f"{place}: /UNIT/{words[1]} must have a line of units after its title")
            local_units[words[1]] = units_of(lines[1], file)
    for words, place, lines in found:
        if words[0] == "MAT" and words[1:2] and words[1] in KEYWORDS:
            cards.append(card_of(file, words, place, lines))
            cards[-1].units = input_units
            if len(words) > 3 and words[3] not in ("", "0"):
                if words[3] not in local_units:
                    raise WrongInput(f"{place}: unit {words[3]} is defined by no /UNIT/{words[3]} of this file")
                cards[-1].units = local_units[words[3]]
        elif words[0] == "MAT":
            others.append(f"/{'/'.join(words[:2])} (line {place.rsplit(':', 1)[1]})")
    if not cards:
        raise WrongInput(f"{file}: no /MAT/LAW79 or /MAT/JOHN_HOLM in it" +
                         (f"; it has {', '.join(others)}" if others else ""))
    return cards


def blocks(file: Path) -> list[Block]:
    """Words of the keyword line, place and numbered lines of each block, without comments, up to /END."""
    found: list[Block] = []
    for number, line in enumerate(deck.lines_of(file), 1):
        if line.startswith(("#", "$")):
            continue
        if line.startswith("/"):
            words = line.strip()[1:].upper().split("/")
            if words[0] == "END":
                break
            found.append((words, f"{file}:{number}", []))
        elif found:
            found[-1][2].append((number, line))
    return found


def units_of(line: tuple[int, str], file: Path) -> UnitSystem:
    try:
        return unit_systems.system(line[1].split())
    except ValueError as error:
        raise WrongInput(f"{file}:{line[0]}: {error}") from None


def card_of(file: Path, words: list[str], place: str, lines: list[tuple[int, str]]) -> DeckCard:
    if len(words) < 3 or not words[2].isdigit():
        raise WrongInput(f"{place}: the id of the material is missing; must be such as {KIND}/1")
    title, data = (lines[0][1].strip(), lines[1:]) if lines else ("", [])
    if len(data) < len(CARDS):
        names = [name for name, _ in CARDS[len(data)] if name]
        raise WrongInput(f"{place}: {KIND} ends after {len(data)} of {len(CARDS)} lines of fields; line "
                         f"{len(data) + 1} after the title must hold {', '.join(names)}")
    fields: dict[str, Field] = {}
    for (number, line), columns in zip(data, CARDS):
        fields |= deck.cut(line, list(columns), f"{file}:{number}")
    card = DeckCard(KIND, words[2], title, place, fields)
    add_losses(card)
    return card


def add_losses(card: DeckCard) -> None:
    """Erosion, a reference density of its own and the filter of strain rates have no value in a card."""
    fields = card.fields
    erosion = min(max(int(fields["IDEL"].number), 0), 3)
    if erosion:
        card.losses.append(Loss(fields["IDEL"].place, f"{EROSION[erosion]}; a card has no such criterion", True))
    if fields["RHO_0"].number not in (0, fields["RHO_I"].number):
        card.losses.append(Loss(fields["RHO_0"].place, "a reference density other than the initial one is an initial "
                                                       "pressure; a card has one density", True))
    if fields["FCUT"].number != 0:
        card.losses.append(Loss(fields["FCUT"].place, "strain rates are not filtered here", False))


def material(card: DeckCard, units: UnitSystem, origin: str | None, name: str) -> tuple[Material, list[str]]:
    """The neutral form and remarks. Raises WrongInput."""
    found, remarks = deck.to_material(card, units, FIELDS, origin, name)
    return found, [*remarks, SLOWER_DAMAGE]


def write(material: Material, units: UnitSystem, identifier: int, long: bool = False) -> tuple[str, list[str]]:
    """The deck, to be included in a starter file, and remarks on what it does not hold. `long`: fields always are."""
    fields, off = deck.texts(material, units, FIELDS, WIDTH)
    fields["IDEL"] = "0"
    remarks = [*deck.remarks_of(material, units, deck.losses_of(material), off, WIDTH), SLOWER_DAMAGE]
    lines = [*deck.comments(material, FIELDS, units, remarks, "#"),
             f"/UNIT/{identifier}", f"units of {material.name}"[:100],
             "".join(radioss_name(name).rjust(WIDTH) for name in units.names),
             f"{KIND}/{identifier}/{identifier}", material.name[:100]]
    for columns in CARDS:
        columns = [(name, width) for name, width in columns if name not in ("RHO_0", "FCUT", "EPSMAX")]
        lines += ["#" + "".join(name.rjust(width) for name, width in columns)[1:],
                  "".join(fields.get(name, "").rjust(width) for name, width in columns)]
    return "\n".join(lines) + "\n", remarks


def radioss_name(unit: str) -> str:
    """Radioss knows prefixes, but no tonne."""
    return {"ton": "Mg", "tonne": "Mg", "t": "Mg", "us": "mus", "um": "mum", "µs": "mus", "µm": "mum"}.get(unit, unit)
