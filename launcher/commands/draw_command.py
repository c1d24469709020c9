"""`polynya draw`: the pictures of a run again."""
from __future__ import annotations

import argparse
from pathlib import Path

from launcher import DONE, Failure, WrongInput, draw, run_folder


def run(arguments: argparse.Namespace) -> int:
    folder = Path(arguments.run).resolve()
    if not run_folder.is_run(folder):
        raise WrongInput(f"{arguments.run}: is not the folder of a run")
    pictures, troubles = draw.draw_run(folder)
    for picture in pictures:
        print(picture)
    if troubles:
        raise Failure("; ".join(troubles))
    return DONE
