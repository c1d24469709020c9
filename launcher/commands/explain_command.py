"""`polynya explain`: what a run would consist of and cost, without running it."""
from __future__ import annotations

import argparse
import json
import shlex

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from launcher import DONE, build, processes, report, swap, units
from launcher import scene as scenes


def run(arguments: argparse.Namespace) -> int:
    file = scenes.find(arguments.scene)
    build.build(["resolve_scene"])
    scene = scenes.resolve(file, arguments.level, arguments.settings, explain=True)
    names = scenes.participants(scene)
    programs = processes.programs_for(scene, names)
    commands = {name: words for name in names for words, setting, _ in
                [swap.front(scene, name, processes.PROGRAMS[name])] if setting}
    if arguments.json:
        keys = ("name", "title", "level", "symmetry", "estimate", "effects")
        print(json.dumps({**{key: scene.get(key) for key in keys}, "bodies": bodies_of(scene), "processes": programs,
                          "commands": commands}))
    else:
        print_explanation(scene, programs, commands)
    scenes.refuse_what_does_not_fit(scene)
    return DONE


def print_explanation(scene: dict, programs: list[str], commands: dict[str, list[str]]) -> None:
    console = Console(highlight=False)
    console.print(f"\n[bold]{scene.get('title')}[/]  [dim]{scene.get('level')}, {scene.get('symmetry')} model[/]")
    console.print(f"[dim]processes[/]  {', '.join(programs)}")
    for name, words in commands.items():
        console.print(f"[dim]{name:<9}[/]  {escape(shlex.join(words))}", soft_wrap=True)
    console.print()
    if bodies_of(scene):
        console.print(bodies_table(bodies_of(scene)))
        console.print()
    estimate = scene.get("estimate") or {}
    console.print(cost_table(estimate))
    verdict = "[green]fits[/]" if estimate.get("fits") else "[bold red]does not fit[/]"
    console.print(f"{verdict}: {estimate.get('reason')}. [dim]{estimate.get('note', '')}[/]\n")
    effects = {name: {**effect, "state": "on" if effect["active"] else "off"}
               for name, effect in (scene.get("effects") or {}).items()}
    console.print(report.effects_table(effects))


def bodies_of(scene: dict) -> dict[str, dict]:
    """Bodies whose motion the scene prescribes, by name."""
    return (scene.get("fluid") or {}).get("bodies") or {}


def bodies_table(bodies: dict[str, dict]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="dim")
    for title in ("body", "shape", "volume", "at [mm]", "velocity [m/s]", "turns [rad/s]"):
        table.add_column(title, no_wrap=title == "velocity [m/s]")
    for name, body in bodies.items():
        velocities = [body["velocity"][i:i + 3] for i in range(0, len(body["velocity"]), 3)]
        table.add_row(
            escape(name), body["shape"], f"{body['volume'] * 1e6:.4g} cm³", triple(body["position"], 1e3),
            over_time(body["times"], [triple(velocity) for velocity in velocities]),
            f"{body['rotation_axis']}: " + over_time(body["rotation_times"], [f"{r:g}" for r in body["rotation_rate"]])
            if any(body["rotation_rate"]) else "no")
    return table


def triple(values: list[float], factor: float = 1.0) -> str:
    return ", ".join(f"{value * factor:g}" for value in values)


def over_time(times: list[float], words: list[str]) -> str:
    """A table of a motion: its entries with their times; one that stays is said once."""
    if len(words) == 1:
        return words[0]
    return "\n".join(f"{word} at {units.readable(time, 's')}" for time, word in zip(times, words))


def steps_line(estimate: dict) -> str:
    steps = [f"{name} {units.readable(estimate[key], 's')}" for name, key in (
        ("ice", "ice_step"), ("vehicle", "vehicle_step"), ("fluid", "fluid_span")) if estimate.get(key)]
    return ", ".join(steps)


def cost_table(estimate: dict) -> Table:
    """Size on the left, cost on the right; parts that the scene does not have are left out."""
    size = [(label, units.count(estimate.get(key))) for label, key in (
        ("fluid cells", "cells"), ("ice elements", "ice_elements"), ("vehicle elements", "vehicle_elements"),
        ("windows", "windows"), ("field frames", "frames")) if estimate.get(key)]
    cost = [("time", f"{units.duration(estimate.get('wall_time'))} on {estimate.get('cores')} cores"),
            ("memory", f"{units.memory(estimate.get('memory'))} of {units.memory(estimate.get('available_memory'))}"),
            ("disk", f"{units.memory(estimate.get('disk'))} of {units.memory(estimate.get('available_disk'))}"),
            ("steps", steps_line(estimate))]
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    for justify in ("right", "left"):
        table.add_column(style="dim", no_wrap=True)
        table.add_column(style="bold", no_wrap=justify == "right", justify=justify)
    for i in range(max(len(size), len(cost))):
        table.add_row(*(word for column in (size, cost) for word in (column[i] if i < len(column) else ("", ""))))
    return table
