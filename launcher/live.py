"""The line that tells how far a run is: rewritten on a terminal, a plain line now and then elsewhere."""
from __future__ import annotations

import math
import sys
import time
from pathlib import Path
from types import TracebackType

from rich.console import Console
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from launcher import units
from launcher.series import Tail

PLAIN_INTERVAL = 10.0  # s between plain lines


class LiveLine:
    """Call `update` often; it reads the tail of the series and shows it."""

    def __init__(self, scene: dict, series: Path, plain: bool) -> None:
        self.scene = scene
        self.tail = Tail(series)
        self.plain = plain or not sys.stderr.isatty()
        self.started = time.monotonic()
        self.spoken = self.started
        self.live = None if self.plain else Live(console=Console(stderr=True), auto_refresh=False, transient=True)

    def __enter__(self) -> LiveLine:
        if self.live:
            self.live.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self.live:
            self.live.stop()

    def update(self) -> None:
        now = time.monotonic()
        if self.plain and now - self.spoken < PLAIN_INTERVAL:
            return
        self.spoken = now
        row = self.tail.latest()
        share = finished_share(self.scene, row, self.tail.first)
        words = self.words(row, share)
        if self.plain:
            print("polynya: " + "   ".join(words), file=sys.stderr, flush=True)
        else:
            self.live.update(self.grid(words, share), refresh=True)

    def words(self, row: dict[str, float], share: float | None) -> list[str]:
        """What the line says, in pieces."""
        passed = time.monotonic() - self.started
        if not row:
            return [f"starting, {units.duration(passed)}"]
        words = [f"t {1e3 * row.get('time', 0.0):.3f} ms"]
        if "window" in row:
            words.append(f"window {row['window']:.0f}")
        speed = row.get("vehicle_speed", row.get("speed_z"))
        if speed is not None:
            words.append(f"{speed:.2f} m/s")
        if math.isfinite(row.get("energy_error", math.nan)):
            words.append(f"energy error {100 * row['energy_error']:.2g} %")
        if share and passed > 2:
            words.append(f"about {units.duration(passed * (1 / share - 1))} left")
        return words

    def grid(self, words: list[str], share: float | None) -> Table:
        grid = Table.grid(padding=(0, 2))
        bar = ProgressBar(total=1.0, completed=share or 0.0, width=24, pulse=share is None)
        grid.add_row(bar, *(Text(word, style="bold" if i == 0 else "") for i, word in enumerate(words)))
        return grid


def finished_share(scene: dict, row: dict[str, float], first: dict[str, float]) -> float | None:
    """How much of the simulated time is done: of the latest end, or of the way to the position that ends the run."""
    now, last = row.get("time"), (scene.get("run") or {}).get("end_time")
    if not now or not last:
        return None
    return min(1.0, now / min(last, now + time_to_position(scene, row, first)))


def time_to_position(scene: dict, row: dict[str, float], first: dict[str, float]) -> float:
    """Time until the vehicle, at its present speed, has passed the ice or left it or the water; infinite if that ends nothing."""
    vehicle, ice, water = scene.get("vehicle"), scene.get("ice"), scene.get("fluid")
    end = (scene.get("run") or {}).get("end")
    speed = row.get("vehicle_speed", 0.0)
    if not vehicle or not (ice or water) or end not in ("ice_passed", "exited") or speed <= 0 or "vehicle_position" not in first:
        return math.inf
    behind = vehicle["length"] if end == "exited" else vehicle["head_length"] + vehicle["diameter"]
    surface = ice["lower_face"] + ice["thickness"] if ice else water["waterline"]
    way = surface + behind - vehicle["nose_position"]
    done = row["vehicle_position"] - first["vehicle_position"] + vehicle["speed"] * first["time"]
    return max(0.0, way - done) / speed
