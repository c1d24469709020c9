"""Units of mass, length and time that a deck counts in, and of quantities in a material card; all factors exact."""
from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction

from launcher.cards import numbers

Dimension = tuple[int, int, int]  # exponents of mass, length and time
NONE, DENSITY, PRESSURE, RATE = (0, 0, 0), (1, -3, 0), (1, -1, -2), (0, 0, -1)

PREFIXES = {"": 0, "y": -24, "z": -21, "a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "mu": -6, "m": -3,
            "c": -2, "d": -1, "da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15, "E": 18}
TONNE = ("ton", "tonne", "t")
KINDS = (("mass", "g", Fraction(1, 1000), "kg, g, mg, ton (also Mg)"), ("length", "m", Fraction(1), "m, cm, mm, um"),
         ("time", "s", Fraction(1), "s, ms, us"))
# Of quantities in cards: factor and dimension; a prefix may stand before those that are True (core/scene/units.cpp).
QUANTITIES = {"m": (Fraction(1), (0, 1, 0), True), "g": (Fraction(1, 1000), (1, 0, 0), True),
              "t": (Fraction(1000), (1, 0, 0), False), "s": (Fraction(1), (0, 0, 1), True),
              "min": (Fraction(60), (0, 0, 1), False), "h": (Fraction(3600), (0, 0, 1), False),
              "Hz": (Fraction(1), RATE, True), "N": (Fraction(1), (1, 1, -2), True),
              "Pa": (Fraction(1), PRESSURE, True), "bar": (Fraction(100000), PRESSURE, True),
              "atm": (Fraction(101325), PRESSURE, False), "J": (Fraction(1), (1, 2, -2), True),
              "%": (Fraction(1, 100), NONE, False), "1": (Fraction(1), NONE, False)}
QUANTITY_PREFIXES = ("n", "u", "µ", "m", "c", "k", "M", "G")


@dataclass(frozen=True)
class UnitSystem:
    names: tuple[str, str, str]
    factors: tuple[Fraction, Fraction, Fraction]  # of the units of mass, length and time, in kg, m and s

    def factor(self, dimension: Dimension) -> Fraction:
        """A number of this system times this is one in SI."""
        product = Fraction(1)
        for unit, exponent in zip(self.factors, dimension):
            product *= unit ** exponent
        return product

    def __str__(self) -> str:
        return ",".join(self.names)


def unit_factor(name: str, kind: int) -> Fraction:
    """Of a unit of mass (0), length (1) or time (2) or a number of kg, m or s. Raises ValueError."""
    word, base, factor, examples = KINDS[kind]
    if kind == 0 and name in TONNE:
        return Fraction(1000)
    if name.endswith(base) and name[:-1] in PREFIXES:
        return factor * Fraction(10) ** PREFIXES[name[:-1]]
    try:
        value = numbers.parse(name)
    except ValueError:
        value = Fraction(0)
    if value > 0:
        return value
    raise ValueError(f"'{name}' is no unit of {word}; must be one such as {examples}, or its size in SI")


def system(names: list[str]) -> UnitSystem:
    """From units of mass, length and time, in this order. Raises ValueError."""
    names = [name.strip() for name in names]
    if len(names) != 3:
        raise ValueError(f"'{','.join(names)}' must be three units, of mass, length and time, such as ton,mm,s")
    return UnitSystem(tuple(names), tuple(unit_factor(name, kind) for kind, name in enumerate(names)))


def quantity(text: str) -> tuple[Fraction, Dimension | None]:
    """ "90.16 GPa" -> its value in SI and its dimension, None where there is no unit. Raises ValueError."""
    match = re.match(r"\s*([+-]?[0-9.]+(?:[eE][+-]?\d+)?)(.*)", text)
    if not match:
        raise ValueError(f"\"{text}\" does not start with a number")
    value, dimension, rest = numbers.parse(match[1]), [0, 0, 0], match[2].strip()
    if not rest:
        return value, None
    for operator, symbol, power in re.findall(r"([*/]?)\s*([^\s*/^]+)(?:\^(-?\d+))?", rest):
        factor, exponents = quantity_unit(symbol)
        exponent = int(power or 1) * (-1 if operator == "/" else 1)
        value *= factor ** exponent
        dimension = [old + exponent * new for old, new in zip(dimension, exponents)]
    return value, tuple(dimension)


def quantity_unit(symbol: str) -> tuple[Fraction, Dimension]:
    if symbol in QUANTITIES:
        return QUANTITIES[symbol][:2]
    base = QUANTITIES.get(symbol[1:])
    if base and base[2] and symbol[0] in QUANTITY_PREFIXES:
        return Fraction(10) ** PREFIXES[symbol[0]] * base[0], base[1]
    raise ValueError(f"unknown unit \"{symbol}\"")
