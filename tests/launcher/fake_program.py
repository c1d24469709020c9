"""Stands in for a solver, the coupler or resolve_scene in tests. The first argument says what to do."""
import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import time


def resolve(words: list[str]) -> int:
    scene = json.loads(pathlib.Path(words[0]).read_text())
    if "refusal" in scene:
        print(scene["refusal"], file=sys.stderr)
        return 2
    print(json.dumps(scene))
    return 0


def main() -> int:
    deed, words = sys.argv[1], sys.argv[2:]
    if deed == "resolve":
        return resolve(words)
    parser = argparse.ArgumentParser()
    for option in ("--scene", "--out", "--name", "--connect", "--bind", "--run"):
        parser.add_argument(option)
    options = parser.parse_args(words)
    out, name = pathlib.Path(options.out), options.name or "coupler"
    if options.bind:
        pathlib.Path(options.bind.removeprefix("ipc://")).touch()  # the socket
    with open(out / "series" / f"{name}.csv", "w") as series:
        series.write("time [s],vehicle_speed [m/s],contact_force [N]\n0,40,0\n1e-6,40,0\n")
    print(f"[2025-01-01 12:00:00.000] [info] {name} with {os.environ['OMP_NUM_THREADS']} threads, "
          f"{os.environ['OMP_WAIT_POLICY']}, {os.environ['GLIBC_TUNABLES']}", file=sys.stderr, flush=True)
    if deed == "good":
        time.sleep(0.3)
        (out / "logs" / f"{name}.json").write_text(json.dumps({"wall_time": 0.3, "waiting_time": 0.1, "seconds": {}}))
        return 0
    if deed == "wrong_input":
        print(f"{name}: no material 'ice.nowhere'", file=sys.stderr)
        return 2
    if deed == "fails":
        time.sleep(0.3)
        print(f"[error] {name}: element 7 turned inside out", file=sys.stderr)
        return 1
    if deed == "loses_partner":
        time.sleep(0.3)
        print(f"{name}: participant ice lost", file=sys.stderr)
        return 1
    if deed == "dies":
        time.sleep(0.45)
        os.kill(os.getpid(), signal.SIGKILL)
    if deed == "stubborn":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    if deed == "has_child":
        subprocess.Popen([sys.executable, *sys.argv[:1], "waits", *words])
    time.sleep(600)
    return 0


sys.exit(main())
