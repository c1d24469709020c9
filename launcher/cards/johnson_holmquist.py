"""The neutral form: the constants of Johnson & Holmquist's second law as Polynya's cards name them, in SI."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from launcher import WrongInput
from launcher.cards import numbers
from launcher.cards.unit_systems import DENSITY, NONE, PRESSURE, RATE, Dimension

LAW = "johnson_holmquist_2"


@dataclass(frozen=True)
class Parameter:
    name: str  # of the value in a card
    symbol: str  # in the law's literature
    dimension: Dimension
    bound: str  # "positive", "not negative", "free" or "optional" (positive where it is there)


PARAMETERS = {parameter.name: parameter for parameter in (
    Parameter("density", "rho", DENSITY, "positive"),
    Parameter("shear_modulus", "G", PRESSURE, "positive"),
    Parameter("bulk_modulus", "K1", PRESSURE, "positive"),
    Parameter("bulk_modulus_2", "K2", PRESSURE, "free"),
    Parameter("bulk_modulus_3", "K3", PRESSURE, "free"),
    Parameter("hugoniot_elastic_limit", "HEL", PRESSURE, "positive"),
    Parameter("pressure_at_hugoniot_elastic_limit", "P_HEL", PRESSURE, "positive"),
    Parameter("intact_strength_constant", "A", NONE, "positive"),
    Parameter("intact_strength_exponent", "N", NONE, "positive"),
    Parameter("strain_rate_constant", "C", NONE, "not negative"),
    Parameter("reference_strain_rate", "eps0", RATE, "positive"),
    Parameter("fractured_strength_constant", "B", NONE, "not negative"),
    Parameter("fractured_strength_exponent", "M", NONE, "positive"),
    Parameter("maximum_fractured_strength", "SFMAX", NONE, "optional"),
    Parameter("maximum_tensile_pressure", "T", PRESSURE, "positive"),
    Parameter("damage_constant", "D1", NONE, "not negative"),
    Parameter("damage_exponent", "D2", NONE, "not negative"),
    Parameter("bulking_fraction", "beta", NONE, "not negative"))}


@dataclass
class Material:
    name: str
    summary: str
    values: dict[str, Fraction]  # by the names of PARAMETERS
    origin: dict[str, str]
    beyond: list[str] = field(default_factory=list)  # further values of the card, which no deck has a field for


def check(values: dict[str, Fraction], place: Callable[[str], str]) -> None:
    """Raises WrongInput at the first value with which the law cannot be. `place` says where a value stands."""

    def refuse(name: str, sentence: str) -> None:
        shown = f"{numbers.shortest(values[name])}" if name in values else "missing"
        raise WrongInput(f"{place(name)}: {PARAMETERS[name].symbol} is {shown}; {sentence}")

    for name, parameter in PARAMETERS.items():
        if parameter.bound == "optional" and name not in values:
            continue
        if name not in values:
            refuse(name, "the law needs it")
        if parameter.bound in ("positive", "optional") and values[name] <= 0:
            refuse(name, "must be above 0")
        if parameter.bound == "not negative" and values[name] < 0:
            refuse(name, "must be 0 or above")
    if values["bulking_fraction"] > 1:
        refuse("bulking_fraction", "must lie between 0 and 1")
    limit, pressure = values["hugoniot_elastic_limit"], values["pressure_at_hugoniot_elastic_limit"]
    if pressure >= limit:
        refuse("pressure_at_hugoniot_elastic_limit", f"must be below HEL ({numbers.shortest(limit)}): sigma_HEL = "
                                                     "1.5 (HEL - P_HEL) is the strength's scale")
    k1, k2, k3 = (values[name] for name in ("bulk_modulus", "bulk_modulus_2", "bulk_modulus_3"))
    for percent in range(31):  # as far as the solvers ask for it (core/continuum/cards.cpp)
        mu = Fraction(percent, 100)
        if k1 + 2 * k2 * mu + 3 * k3 * mu * mu <= 0:
            refuse("bulk_modulus_2", f"with K3 it lets the pressure fall at a compression mu of {float(mu):g}; "
                                     "K1 + 2 K2 mu + 3 K3 mu^2 must be above 0 up to 0.3")


def pressure_at_limit(values: dict[str, Fraction]) -> Fraction:
    """P_HEL from HEL = P(mu) + 4/3 G mu / (1 + mu), P = K1 mu + K2 mu^2 + K3 mu^3, to 12 digits: what LS-DYNA does
    where PHEL is 0 on input (manual, volume II, *MAT_110). Raises ValueError where no mu up to 2 reaches HEL."""
    k1, k2, k3, g, limit = (float(values[name]) for name in (
        "bulk_modulus", "bulk_modulus_2", "bulk_modulus_3", "shear_modulus", "hugoniot_elastic_limit"))

    def pressure(mu: float) -> float:
        return mu * (k1 + mu * (k2 + mu * k3))

    def stress(mu: float) -> float:
        return pressure(mu) + 4 / 3 * g * mu / (1 + mu)

    upper = next((step / 1000 for step in range(1, 2001) if stress(step / 1000) >= limit), None)
    if upper is None or limit <= 0:
        raise ValueError("HEL is reached at no compression mu up to 2, so PHEL cannot be derived")
    lower = upper - 0.001
    for _ in range(60):
        middle = 0.5 * (lower + upper)
        lower, upper = (middle, upper) if stress(middle) < limit else (lower, middle)
    return Fraction(numbers.rounded(Fraction(pressure(upper)), 12))
