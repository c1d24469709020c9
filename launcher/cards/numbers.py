"""Numbers of decks, exactly: a decimal of a deck times a unit is a fraction, and only writing it down rounds."""
from __future__ import annotations

import re
from decimal import Context, Decimal
from fractions import Fraction

# What Fortran reads: 1.5, .5, 9.016E+10, 9.016d10 and 9.016+10.
NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]([+-]?\d+)|([+-]\d+))?")
LARGEST_EXPONENT = 300
MOST_DIGITS = 17  # that a double tells apart


def parse(text: str) -> Fraction:
    """Raises ValueError for what is no finite decimal number of a double's range."""
    match = NUMBER.fullmatch(text.strip())
    if not match:
        raise ValueError(f"'{text.strip()}' is no number")
    exponent = int(match[2] or match[3] or 0)
    if abs(exponent) > LARGEST_EXPONENT:
        raise ValueError(f"'{text.strip()}' is beyond what a double holds")
    return Fraction(Decimal(match[1])) * Fraction(10) ** exponent


def rounded(value: Fraction, digits: int = MOST_DIGITS) -> Decimal:
    """To so many significant digits, without trailing zeros."""
    context = Context(prec=digits)
    return context.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(context)


def plain(number: Decimal) -> str:
    """90160.0"""
    text = format(number, "f")
    return text if "." in text else text + ".0"


def scientific(number: Decimal) -> str:
    """9.016e4"""
    sign, digits, exponent = number.as_tuple()
    text = "".join(map(str, digits))
    return f"{'-' if sign else ''}{text[0]}.{text[1:] or '0'}e{exponent + len(digits) - 1}"


def whole_mantissa(number: Decimal) -> str:
    """9016.e1"""
    sign, digits, exponent = number.as_tuple()
    return f"{'-' if sign else ''}{''.join(map(str, digits))}.e{exponent}"


def fit(value: Fraction, width: int) -> str:
    """The decimal text nearest to the value among those that fit a field, with a point."""
    if value == 0:
        return "0.0"
    for digits in range(MOST_DIGITS, 0, -1):
        number = rounded(value, digits)
        forms = [plain(number), scientific(number)]
        if not -4 <= number.adjusted() < 12:
            forms.reverse()
        forms.append(whole_mantissa(number))  # 9016123.e4: a digit more than 9.01612e10
        for text in forms:
            if len(text) <= width:
                return text
    raise ValueError(f"{float(value):g} does not fit {width} characters")


def shortest(value: Fraction) -> str:
    """For people and TOML: plain from 0.001 to 1e6, else scientific."""
    if value == 0:
        return "0.0"
    number = rounded(value)
    return plain(number) if -3 <= number.adjusted() < 6 else scientific(number)
