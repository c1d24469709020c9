"""Runs what is compared and reads its quantities.

A quantity comes `from`
    {summary = "impulse_over_momentum"}                       an entry of summary.json, points between tables
    {series = "dam.csv", column = "front_scaled", reduce = R} a column of a series, R one of `last`, `largest`,
                                                              `smallest`, `integral` (over the first column), `mean`
    {series = ..., column = ..., along = "time_scaled", at = 2.547}  its value there, between rows on a line
    {property = "Suite.Test:key"}                             what a test has recorded
and, with `per`, over that number.
"""
from __future__ import annotations

import json
import math
import os
import subprocess
import time
from pathlib import Path

import numpy

from launcher import ROOT, Failure, build
from launcher.program_environment import program_environment
from launcher.series import read_series
from launcher.validation.comparison import Comparison, Quantity

REDUCTIONS = {
    "last": lambda _along, values: values[-1], "largest": lambda _along, values: values.max(),
    "smallest": lambda _along, values: values.min(),
    "integral": lambda along, values: numpy.trapz(values, along),
    "mean": lambda along, values: numpy.trapz(values, along) / (along[-1] - along[0]),
}


def run_scene(comparison: Comparison, further: tuple[str, ...], folder: Path) -> float:
    """Runs the scene, with further settings, into a folder; seconds it took. Throws Failure with what the run said."""
    command = [str(ROOT / "polynya"), "run", comparison.scene, "--out", str(folder), "--json", "--no-pictures"]
    command += ["--level", comparison.level] if comparison.level else []
    for setting in comparison.settings + further:
        command += ["--set", setting]
    return timed(command)


def run_program(comparison: Comparison, folder: Path) -> float:
    """Runs a program of tests, which writes its properties into a folder; seconds it took. Throws Failure."""
    build.build([comparison.program])
    folder.mkdir(parents=True, exist_ok=True)
    command = [str(build.program_folder() / comparison.program), f"--gtest_output=json:{folder}/properties.json"]
    return timed(command + ([f"--gtest_filter={comparison.filter}"] if comparison.filter else []))


def timed(command: list[str]) -> float:
    start = time.monotonic()
    done = subprocess.run(command, env={**os.environ, **program_environment()}, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-3:]
        raise Failure(f"{' '.join(command)}: exit code {done.returncode}: {' / '.join(last)}")
    return time.monotonic() - start


def value_of(quantity: Quantity, folder: Path) -> float:
    """Throws Failure naming what is not there."""
    where = quantity.where
    if "summary" in where:
        value = summary_entry(folder, where["summary"])
    elif "series" in where:
        value = series_value(folder, where)
    elif "property" in where:
        value = recorded_property(folder, where["property"])
    else:
        raise Failure(f"{quantity.name}: `from` must have summary, series or property; it has {', '.join(where)}")
    value = float(value) / float(where.get("per", 1.0))
    if not math.isfinite(value):
        raise Failure(f"{quantity.name}: is {value}")
    return value


def summary_entry(folder: Path, path: str) -> float:
    entry = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    for key in path.split("."):
        entry = entry.get(key) if isinstance(entry, dict) else None
    if not isinstance(entry, (int, float)):
        raise Failure(f"{folder}/summary.json: {path} is {entry!r}, not a number")
    return entry


def series_value(folder: Path, where: dict) -> float:
    series = read_series(folder / "series" / where["series"])
    if series is None or not series.has(where["column"]):
        raise Failure(f"{folder}/series/{where['series']}: there is no column {where['column']}")
    values = series[where["column"]]
    if "at" in where:
        return float(numpy.interp(where["at"], series[where["along"]], values))
    if where.get("reduce") not in REDUCTIONS:
        raise Failure(f"{where['series']}: reduce must be one of {', '.join(REDUCTIONS)}; it is {where.get('reduce')}")
    return float(REDUCTIONS[where["reduce"]](series[where.get("along", "time")], values))


def recorded_property(folder: Path, path: str) -> float:
    test, _, key = path.rpartition(":")
    suite, _, name = test.partition(".")
    report = json.loads((folder / "properties.json").read_text(encoding="utf-8"))
    for group in report["testsuites"]:
        for each in group["testsuite"]:
            if (group["name"], each["name"]) == (suite, name) and key in each:
                return float(each[key])
    raise Failure(f"{folder}/properties.json: {test} has recorded no {key}")
