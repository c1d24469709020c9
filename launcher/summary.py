"""RUN/summary.json: what the run found and what it cost, from the coupler's summary, the series and the processes."""
from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path

import numpy

from launcher import critical_path, definitions, effect_times
from launcher.run_folder import read_json, write_json
from launcher.series import Series, read_series
from launcher.supervise import Outcome

# Quantities that the processes find themselves: key of the summary, column that has it if the summary is missing
# (a run that failed), and which value of the column it is.
MEASURED = {
    "peak_head_stress": ("head_stress", "largest"),
    "broken_ice_mass": ("broken_ice_mass", "last"),
    "energy_error": ("energy_error", "last"),
    "momentum_error": ("momentum_error", "last"),
    "mass_error": ("mass_error", "last"),
    "leak_fraction": ("leak_fraction", "last"),
    "converted_elements": ("converted_elements", "last"),
    "particles": ("particles", "last"),
    "cells": (None, None),
    "elements": (None, None),
    "steps": ("window", "last"),
}
NEED_ICE = ("broken_ice_mass", "converted_elements", "particles")
VEHICLE_ALONE = {"speed_z": "vehicle_speed", "centre_of_mass_z": "vehicle_position"}
COUNTS = ("converted_elements", "particles", "cells", "elements", "steps")
OF_ALL = ("cells", "elements")  # added up over the processes
PASSAGE = tuple(definitions.Passage.__dataclass_fields__)


def series_path(folder: Path, names: list[str]) -> Path:
    """The series that tells the progress: the coupler's, or that of the only solver."""
    return folder / "series" / ("coupler.csv" if len(names) > 1 else f"{names[0]}.csv")


def progress(folder: Path, names: list[str]) -> Series | None:
    """The series of the run; the names that the vehicle's solver has for its motion become the coupler's."""
    series = read_series(series_path(folder, names))
    return series.renamed(VEHICLE_ALONE) if series and names == ["structure"] else series


def passage_of(scene: dict, series: Series | None) -> definitions.Passage | None:
    """The quantities of the passage; None without a vehicle or without its speed in the series."""
    vehicle, ice = scene.get("vehicle"), scene.get("ice")
    if not vehicle or series is None or not series.has("time", "vehicle_speed"):
        return None
    series = series.ordered("vehicle_speed")
    time, speed = series["time"], series["vehicle_speed"]
    if not len(time):
        return None
    shoulder = upper_face = None
    if ice and series.has("vehicle_position"):
        nose = definitions.nose_position(time, series["vehicle_position"], speed, vehicle["nose_position"])
        shoulder, upper_face = nose - vehicle["head_length"], ice["lower_face"] + ice["thickness"]
    force = series["contact_force"] if ice and series.has("contact_force") else None
    return definitions.passage(time, speed, scene["run"]["filter_frequency"], contact_force=force, shoulder=shoulder,
                               upper_face=upper_face, initial_speed=vehicle.get("speed"))


def measured(found: dict, series: Series | None, processes: dict[str, dict], has_ice: bool) -> dict:
    """What the processes measured, else the series; None where there is nothing to measure."""
    sources = [found, *(words for words in (found.get("participants") or {}).values() if isinstance(words, dict))]
    counts = [report.get("counts") or {} for report in processes.values()]
    values = {}
    for key, (column, which) in MEASURED.items():
        value = next((source[key] for source in sources if source.get(key) is not None), None)
        if key in OF_ALL and key not in found:
            parts = [count[key] for count in counts if key in count]
            value = sum(parts) if parts else value
        if value is None and series is not None and column and series.has(column):
            value = series.last(column) if which == "last" else largest(series, column)
        if key in COUNTS and isinstance(value, float) and math.isfinite(value):
            value = int(value)
        values[key] = None if key in NEED_ICE and not has_ice else value
    if values["steps"] is None and len(processes) == 1:
        values["steps"] = next((int(count["steps"]) for count in counts if "steps" in count), None)
    return values


def largest(series: Series, column: str) -> float | None:
    values = series[column][numpy.isfinite(series[column])]
    return float(values.max()) if len(values) else None


def process_reports(folder: Path, outcome: Outcome) -> dict[str, dict]:
    """Per process its own report; what the system counted stands in for a process that could not write one."""
    return {name: {**usage, **read_json(folder / "logs" / f"{name}.json")} for name, usage in outcome.usage.items()}


def effect_reports(scene: dict, found: dict, processes: dict[str, dict]) -> dict[str, dict]:
    """Per effect its final state, the reason, and the time it took in all processes."""
    reports = {}
    for name, effect in (scene.get("effects") or {}).items():
        latest = {**effect, **((found.get("effects") or {}).get(name) or {})}
        time, note = effect_times.time_of(name, bool(latest.get("active")), processes)
        reports[name] = {"state": "on" if latest.get("active") else "off", "requested": latest.get("requested"),
                         "reason": latest.get("reason"), "time": time, **({"time_note": note} if note else {})}
    return reports


def merge(folder: Path, scene: dict, names: list[str], outcome: Outcome, wall_time: float) -> dict:
    """Writes RUN/summary.json and returns it. All in SI; every key is there whatever happened, null if it means nothing."""
    speaker = "coupler" if len(names) > 1 else names[0]
    found = read_json(folder / f"{speaker}_summary.json")
    series = progress(folder, names)
    passage = passage_of(scene, series)
    processes = process_reports(folder, outcome)
    summary = {
        "state": "failed" if outcome.exit_code else "done",
        "reason": outcome.reason,
        "scene": scene.get("name"), "title": scene.get("title"), "level": scene.get("level"),
        "run": str(folder),
        "end_reason": found.get("end_reason"),
        "end_time": found.get("end_time", series.last("time") if series else None),
        **(asdict(passage) if passage else dict.fromkeys(PASSAGE)),
        "filter_frequency": (scene.get("run") or {}).get("filter_frequency"),
        **measured(found, series, processes, bool(scene.get("ice"))),
        "wall_time": wall_time,
        **(critical_path.summary(folder, processes) or critical_path.UNTOLD),
        "processes": processes,
        "effects": effect_reports(scene, found, processes),
    }
    summary.update({key: value for key, value in found.items() if key not in summary})
    summary = without_nan(summary)
    write_json(folder / "summary.json", summary)
    return summary


def without_nan(value: object) -> object:
    """JSON knows no nan and no infinity: null."""
    if isinstance(value, dict):
        return {key: without_nan(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [without_nan(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
