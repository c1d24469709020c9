"""From a parsed command line to an exit code."""
from __future__ import annotations

import argparse
import importlib
import sys

from launcher import FAILED, WRONG_INPUT, Failure, WrongInput


def run_command(arguments: argparse.Namespace) -> int:
    """Runs the module of launcher.commands that carries the command's name."""
    command = importlib.import_module(f"launcher.commands.{arguments.command}_command")
    try:
        return command.run(arguments)
    except WrongInput as error:
        print(f"polynya: {error}", file=sys.stderr)
        return WRONG_INPUT
    except Failure as error:
        print(f"polynya: {error}", file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        print("polynya: interrupted", file=sys.stderr)
        return FAILED
    except BrokenPipeError:  # `./polynya list | head`
        sys.stderr.close()
        return FAILED
