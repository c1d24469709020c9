"""The summary of a run as a table on the terminal."""
from __future__ import annotations

from pathlib import Path

from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from launcher import units

# What is shown: label, key of the summary, unit ("%": a share; "n": a count).
MOTION = (("initial speed", "initial_speed", "m/s"), ("residual speed", "residual_speed", "m/s"),
          ("peak deceleration", "peak_deceleration", "m/s²"), ("mean deceleration", "mean_deceleration", "m/s²"),
          ("peak head stress", "peak_head_stress", "Pa"), ("first contact", "first_contact_time", "s"),
          ("through", "through_time", "s"), ("shoulder clear, after contact", "shoulder_clear_time", "s"),
          ("broken ice", "broken_ice_mass", "kg"))
HEALTH = (("energy error", "energy_error", "%"), ("momentum error", "momentum_error", "%"),
          ("mass error", "mass_error", "%"), ("leak fraction", "leak_fraction", "%"), ("steps", "steps", "n"),
          ("fluid cells", "cells", "n"), ("elements", "elements", "n"), ("converted", "converted_elements", "n"),
          ("particles", "particles", "n"), ("exchange", "exchange_share", "%"), ("wall time", "wall_time", "wall"))

NOT_SHOWN = {"end_time", "filter_frequency", "shoulder_clear_speed", "windows", "free_windows", "spans", "overlap_cuts",
             "overlap_cells", "overlap_cells_exact", "overlap_cells_two_bodies",
             "overlap_cells_united", "overlap_cells_united_exactly", "overlap_cells_doubted",
             "overlap_triangles_kept", "largest_energy_error", "largest_momentum_error", "deepest_contact", "peak_wall_pressure"}


def value(summary: dict, key: str, unit: str) -> str:
    number = summary.get(key)
    if not isinstance(number, (int, float)):
        return "–"
    if unit == "%":
        return f"{units.number(100 * number, 2)} %"
    if unit == "n":
        return units.count(number)
    if unit == "wall":
        return units.duration(number)
    if unit == "kg":
        return f"{units.number(1000 * number)} g"
    if unit == "s":
        return f"{units.number(1000 * number)} ms"
    if unit.startswith("m/s"):
        return f"{units.number(number, 4)} {unit}" if abs(number) < 1e4 else f"{units.count(number)} {unit}"
    return units.readable(number, unit)


def two_columns(summary: dict) -> Table:
    """Motion left, health right; rows that mean nothing in this run are left out."""
    known = [[row for row in rows if summary.get(row[1]) is not None] for rows in (MOTION, HEALTH)]
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    for style in ("dim", "bold", "dim", "bold"):
        table.add_column(style=style, no_wrap=True, justify="left" if style == "dim" else "right")
    for i in range(max(len(rows) for rows in known)):
        cells: list[str] = []
        for rows in known:
            cells += [rows[i][0], value(summary, *rows[i][1:])] if i < len(rows) else ["", ""]
        table.add_row(*cells)
    return table


def other_findings(summary: dict) -> Table:
    """Numbers that a solver reports on its own account, as the beam and the tube do: by their names, in SI."""
    known = {row[1] for row in MOTION + HEALTH} | NOT_SHOWN
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    table.add_column(style="dim")
    table.add_column(style="bold", justify="right")
    for key, found in summary.items():
        if key not in known and isinstance(found, (int, float)) and not isinstance(found, bool):
            table.add_row(key.replace("_", " "), units.number(found, 4))
    return table


def process_table(processes: dict[str, dict]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), header_style="dim", pad_edge=False)
    table.add_column("process")
    for heading in ("wall time", "processor time", "waiting", "threads", "memory"):
        table.add_column(heading, justify="right")
    for name, report in processes.items():
        times = [units.duration(report.get(key)) for key in ("wall_time", "cpu_time", "waiting_time")]
        table.add_row(name, *times, str(report.get("threads", "–")), units.memory(report.get("peak_memory")))
    return table


def effects_table(effects: dict[str, dict]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), header_style="dim", pad_edge=False)
    table.add_column("effect", no_wrap=True)
    table.add_column("")
    table.add_column("because")
    for name, effect in effects.items():
        state = Text(effect["state"], style="green" if effect["state"] == "on" else "dim")
        table.add_row(name.replace("_", " "), state, effect.get("reason") or "")
    return table


def print_summary(summary: dict, pictures: list[Path]) -> None:
    """To standard output; width follows the terminal."""
    console = Console(highlight=False)
    heading = summary.get("title") or summary.get("scene") or "run"
    level = f"  [dim]{summary['level']}[/]" if summary.get("level") else ""
    console.print()
    console.print(f"[bold]{heading}[/]{level}")
    if summary["state"] == "failed":
        console.print("[bold red]failed[/]; what was found until then:")
    if summary.get("end_reason"):
        console.print(f"[dim]ended at {units.readable(summary.get('end_time'), 's')}: {summary['end_reason'].replace('_', ' ')}[/]")
    console.print(Padding(two_columns(summary), (1, 0)))
    others = other_findings(summary)
    if others.row_count:
        console.print(others)
    if summary["processes"]:
        console.print(process_table(summary["processes"]))
    console.print(f"[dim]results[/]   {summary['run']}", soft_wrap=True)
    for picture in pictures:
        console.print(f"[dim]picture[/]   {picture}", soft_wrap=True)
