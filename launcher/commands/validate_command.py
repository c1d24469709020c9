"""`polynya validate`: theory, experiments and papers beside what the programs compute."""
from __future__ import annotations

import argparse
import json
import sys

from launcher import DONE, FAILED, ROOT, Failure
from launcher.validation import comparison, draw, measure, results


def run(arguments: argparse.Namespace) -> int:
    every = comparison.read_all()
    chosen = comparison.choose(arguments.names, every)
    if arguments.list:
        print(json.dumps([describe(each) for each in chosen]) if arguments.json else listing(chosen))
        return DONE
    found, failed = [], False
    for each in chosen:
        before = results.kept(each)
        if before and before["commit"] == results.commit() and not arguments.again:
            found.append(before)
        else:
            try:
                found.append(compare(each))
            except Failure as error:
                print(f"polynya: {each.name}: {error}", file=sys.stderr)
                failed = True
                continue
        if not arguments.json:
            print(table(found[-1]), flush=True)
        results.write_page(every)
    if arguments.json:
        print(json.dumps(found))
    return FAILED if failed else DONE


def compare(each: comparison.Comparison) -> dict:
    """Runs a comparison and keeps its result."""
    folder, seconds, values = ROOT / "runs" / "validation" / each.name, 0.0, []
    for further in each.repeats:
        seconds += measure.run_scene(each, further, folder) if each.scene else measure.run_program(each, folder)
        values.append([measure.value_of(quantity, folder) for quantity in each.quantities])
    found = results.result(each, values, seconds, draw.draw(each, folder, results.FOLDER))
    results.write(found)
    return found


def describe(each: comparison.Comparison) -> dict:
    before = results.kept(each)
    return {"name": each.name, "title": each.title, "minutes": each.minutes, "runs": results.what_runs(each),
            "quantities": len(each.quantities), "commit": before and before["commit"],
            "agree": before and sum(quantity["agrees"] for quantity in before["quantities"])}


def listing(chosen: list[comparison.Comparison]) -> str:
    width = max(len(each.name) for each in chosen)
    rows = []
    for known in map(describe, chosen):
        last = f"{known['agree']} of {known['quantities']} agree at {known['commit']}" if known["commit"] else "not run yet"
        rows.append(f"    {known['name']:<{width}}  {known['minutes']:5.1f} min  {known['title']}: {last}")
    return "\n".join(rows)


def table(found: dict) -> str:
    lines = [f"{found['title']} ({found['wall_time']:.0f} s)"]
    for each in found["quantities"]:
        low, high = (results.show(each, bound) for bound in each["range"])
        lines.append(f"    {'agrees ' if each['agrees'] else 'DIFFERS'}  {each['name']}: "
                     f"{results.show(each, each['ours'])} {each['unit']}, wanted {low} to {high} ({each['source']})")
    return "\n".join(lines)
