"""Results: docs/validation/NAME.json, and docs/validation.md made of all of them."""
from __future__ import annotations

import datetime
import json
import os
import platform
import subprocess
from pathlib import Path

from launcher import ROOT
from launcher.validation.comparison import Comparison, Quantity

FOLDER = ROOT / "docs" / "validation"
PAGE = ROOT / "docs" / "validation.md"


def commit() -> str:
    """Of the sources that ran, with a plus behind it if they differ from the commit; what is written here apart."""
    def git(*words: str) -> str:
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs", ":!tests/validation")
    return (git("rev-parse", "--short=12", "HEAD") or "unknown") + ("+" if changed else "")


def machine() -> str:
    model = next((line.partition(":")[2].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), platform.machine())
    return f"{model}, {len(os.sched_getaffinity(0))} cores"


def path(comparison: Comparison) -> Path:
    return FOLDER / f"{comparison.name}.json"


def kept(comparison: Comparison) -> dict | None:
    """What was found before for this very comparison; None if there is nothing, or the comparison has changed."""
    try:
        found = json.loads(path(comparison).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if found.get("fingerprint") == comparison.fingerprint else None


def result(comparison: Comparison, runs: list[list[float]], seconds: float, pictures: list[str]) -> dict:
    """runs: [runs][quantities]."""
    return {"name": comparison.name, "title": comparison.title, "about": comparison.about,
            "command": f"./polynya validate {comparison.name}", "runs": what_runs(comparison),
            "fingerprint": comparison.fingerprint, "commit": commit(), "machine": machine(),
            "date": datetime.date.today().isoformat(), "wall_time": round(seconds, 2), "pictures": pictures,
            "quantities": [outcome(quantity, values) for quantity, values in zip(comparison.quantities, zip(*runs))]}


def what_runs(comparison: Comparison) -> str:
    if comparison.program:
        return comparison.program + (f" --gtest_filter='{comparison.filter}'" if comparison.filter else "")
    words = ["./polynya run", comparison.scene] + ([f"--level {comparison.level}"] if comparison.level else [])
    command = " ".join(words + [f"--set {each!r}" for each in comparison.settings])
    several = [" ".join(f"--set {each!r}" for each in further) for further in comparison.repeats if further]
    return command + (f", mean of {len(comparison.repeats)} runs: {', '.join(several)}" if several else "")


def outcome(quantity: Quantity, values: tuple[float, ...]) -> dict:
    """The mean of several runs, with what they are apart."""
    reference, ours = quantity.reference, sum(values) / len(values)
    return {"name": quantity.name, "ours": ours, "spread": max(values) - min(values), "reference": reference.value, "range": [reference.low, reference.high],
            "source": quantity.source, "unit": quantity.unit, "scale": quantity.scale, "remark": quantity.remark,
            "agrees": reference.holds(ours)}


def write(found: dict) -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / f"{found['name']}.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


def write_page(comparisons: list[Comparison]) -> None:
    """docs/validation.md of all that has been found so far, the cheapest first."""
    results = [found for found in map(kept, comparisons) if found]
    quantities = [each for found in results for each in found["quantities"]]
    agree = sum(each["agrees"] for each in quantities)
    lines = ["# Validation", "", "Written by `./polynya validate`; each section names the command that repeats it.", "",
             f"{agree} of {len(quantities)} quantities lie within their tolerance.", ""]
    for found in results:
        lines += section(found)
    PAGE.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def section(found: dict) -> list[str]:
    lines = [f"## {found['title']}", "", found["about"], "",
             f"`{found['command']}` ({found['runs']}): {found['wall_time']:.0f} s on {found['machine']}, "
             f"{found['date']}, commit {found['commit']}.", "",
             "| quantity | ours | reference | tolerance | agrees | source |", "| --- | --- | --- | --- | --- | --- |"]
    for each in found["quantities"]:
        low, high = (show(each, bound) for bound in each["range"])
        wanted = show(each, each["reference"]) if each["reference"] is not None else "a range"
        lines.append(f"| {each['name']} | {show(each, each['ours'])} {each['unit']} | {wanted} | {low} to {high} | "
                     f"{'yes' if each['agrees'] else '**no**'} | {each['source']} |")
    lines += [""] + [f"The runs lie {show(each, each['spread'])} {each['unit']} apart in {each['name']}.\n"
                     for each in found["quantities"] if each["spread"] > 0]
    lines += [f"{each['name']}: {each['remark']}\n" for each in found["quantities"] if each["remark"]]
    return lines + [f"![{found['title']}](validation/{picture})\n" for picture in found["pictures"]]


def show(quantity: dict, value: float) -> str:
    return f"{value * quantity['scale']:.4g}"
