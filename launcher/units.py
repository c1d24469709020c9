"""Numbers with units as people read them."""
from __future__ import annotations

import math

PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def readable(value: float | None, unit: str, digits: int = 3) -> str:
    """0.00042, "s" -> "0.42 ms" (a prefix that leaves 0.1 to 1000); "-" for nothing."""
    if value is None or not math.isfinite(value):
        return "-"
    if value == 0:
        return f"0 {unit}".strip()
    exponent = 3 * math.floor(math.log10(abs(value) * 1.000001) / 3)
    exponent = min(max(exponent, min(PREFIXES)), max(PREFIXES))
    return f"{number(value / 10.0 ** exponent, digits)} {PREFIXES[exponent]}{unit}".rstrip()


def number(value: float, digits: int = 3) -> str:
    """A number with so many significant digits and without a power of ten from 0.01 to 1e6."""
    if value == 0:
        return "0"
    size = math.floor(math.log10(abs(value)))
    if not -3 <= size < 6:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - size)}f}"


def count(value: float | None) -> str:
    """1234567 -> "1 234 567"."""
    return "-" if value is None else f"{int(value):,}".replace(",", "\u202f")


def duration(seconds: float | None) -> str:
    """Wall time: "0.8 s", "42 s", "3 min 05 s", "2 h 10 min"."""
    if seconds is None or not math.isfinite(seconds):
        return "-"
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def memory(size: float | None) -> str:
    """Bytes as kB, MB or GB."""
    if size is None:
        return "-"
    for limit, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if size >= limit:
            return f"{number(size / limit)} {unit}"
    return f"{size:.0f} B"
