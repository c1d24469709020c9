"""`polynya run`: resolve, build what is needed, start, watch, sum up, draw."""
from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import time
from pathlib import Path

from launcher import build, processes, report, run_folder, summary, swap
from launcher import scene as scenes
from launcher.live import LiveLine
from launcher.supervise import Outcome, Supervisor


def run(arguments: argparse.Namespace) -> int:
    file = scenes.find(arguments.scene)
    build.build(["resolve_scene"])
    scene, mesh = scenes.resolve_with_mesh(file, arguments.level, arguments.settings, explain=True)
    scenes.refuse_what_does_not_fit(scene)
    scene.pop("estimate", None)
    names = scenes.participants(scene)
    folder = run_folder.choose(arguments.out, scene)
    run_folder.check(folder)
    cores = arguments.threads or len(os.sched_getaffinity(0))
    foreign_vehicle = swap.is_replaced(scene, "structure")
    own_mesh = [processes.PROGRAMS["structure"]] if foreign_vehicle else []
    build.build(processes.programs_for(scene, names) + own_mesh)

    started = time.monotonic()
    with run_folder.prepare(folder, scene):
        if mesh:
            from launcher.mesh import importing

            importing.write(mesh, folder / run_folder.ICE_MESH)
        if foreign_vehicle:
            processes.write_surface(scene, folder, build.program_folder())
        outcome = supervise(scene, names, folder, cores, plain=arguments.json)
        result = summary.merge(folder, scene, names, outcome, time.monotonic() - started)
        if outcome.reason:
            print(f"polynya: {outcome.reason} (logs: {folder / 'logs'})", file=sys.stderr)
        pictures = draw(folder) if arguments.pictures else []
    if arguments.json:
        print(json.dumps(result, allow_nan=False))
    else:
        report.print_summary(result, pictures)
    return outcome.exit_code


def supervise(scene: dict, names: list[str], folder: Path, cores: int, plain: bool,
              resume: Path | None = None) -> Outcome:
    """Runs the processes; the socket's private folder is gone afterwards, whatever happened."""
    socket_folder = processes.make_socket_folder() if len(names) > 1 else None
    try:
        socket = socket_folder / "coupler" if socket_folder else None
        plans = processes.plan(scene, names, folder, build.program_folder(), cores, socket, resume)
        series = summary.series_path(folder, names)
        with LiveLine(scene, series, plain) as line:
            return Supervisor(plans, folder / "logs", line.update, has_begun=series.exists).run()
    finally:
        if socket_folder:
            shutil.rmtree(socket_folder, ignore_errors=True)


def draw(folder: Path) -> list[Path]:
    """Pictures are a service: a run whose numbers are there has not failed because one could not be drawn."""
    from launcher import draw as drawing  # matplotlib takes a second to load: only now

    pictures, troubles = drawing.draw_run(folder)
    for trouble in troubles:
        print(f"polynya: {trouble}", file=sys.stderr)
    return pictures
