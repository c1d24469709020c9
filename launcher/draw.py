"""All pictures of a run: decides what there is to draw and when the cuts are taken."""
from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy

from launcher import draw_curves, draw_fields, draw_series, fields, sections, style
from launcher.run_folder import read_json
from launcher.scene import participants
from launcher.series import Series, read_series
from launcher.summary import progress

SHEET = 6  # moments on a sheet


def draw_run(run: Path) -> tuple[list[Path], list[str]]:
    """Draws into RUN/pictures. Returns the pictures and a sentence for each that could not be drawn."""
    style.apply()
    scene, summary = read_json(run / "scene.json"), read_json(run / "summary.json")
    folder = run / "pictures"
    folder.mkdir(exist_ok=True)
    pictures: list[Path] = []
    troubles: list[str] = []
    for name, job in jobs(run, scene, summary, folder):
        try:
            picture = job()
        except Exception as error:  # a picture less is no reason to lose the others, whatever went wrong
            troubles.append(f"picture {name} could not be drawn: {type(error).__name__}: {error}")
        else:
            pictures += picture if isinstance(picture, list) else [picture] if picture else []
    return pictures, troubles


def jobs(run: Path, scene: dict, summary: dict, folder: Path) -> Iterator[tuple[str, Callable]]:
    """Name and drawing function of each picture that may exist for this run."""
    names = participants(scene)
    series = progress(run, names)
    if series and series.has("vehicle_speed"):
        series = series.ordered("vehicle_speed")
        yield "motion", lambda: draw_curves.draw_motion(scene, summary, series, folder / "motion.png")
        yield "energies", lambda: draw_curves.draw_energies(scene, summary, series, folder / "energies.png")
    if series and len(names) == 1:
        yield "series", lambda: draw_series.draw_columns(scene, series.ordered(), folder / "series.png")
    forces = read_series(run / "series" / "bodies.csv")
    if forces:
        yield "forces", lambda: draw_series.draw_columns(scene, forces.ordered(), folder / "forces.png")
    tube = read_series(run / "series" / "tube.csv")
    if tube:
        yield "tube", lambda: draw_series.draw_profiles(scene, tube, folder / "tube.png")
    elif (run / "fields").is_dir():
        yield "cuts", lambda: draw_cuts(run, scene, events(summary, series), folder)


def draw_cuts(run: Path, scene: dict, wishes: list[float], folder: Path) -> list[Path]:
    """The sheet of materials, the sheet of pressure, and the last moment large."""
    times = frame_times(run)
    if not len(times):
        return []
    tolerance = 0.51 * float(numpy.median(numpy.diff(times))) if len(times) > 1 else numpy.inf
    shown = [sections.load_section(run, time, tolerance) for time in choose(times, wishes)]
    view = sections.make_view(scene, shown)
    pictures = [draw_fields.draw_sheet(shown, view, folder / "cuts.png", "materials")]
    if view.pressure:
        pictures.append(draw_fields.draw_sheet(shown, view, folder / "pressure.png", "pressure"))
    if len(shown) > 1:
        whole = sections.whole_view(view, shown[-1])
        pictures.append(draw_fields.draw_sheet(shown[-1:], whole, folder / "last_cut.png", "materials"))
    return pictures


def frame_times(run: Path) -> numpy.ndarray:
    """Of the part with the most frames: two parts may end a frame a step apart."""
    by_part = [[moment.time for moment in fields.moments(run, name)] for name in ("ice", "vehicle", "fluid")]
    return numpy.array(max(by_part, key=len))


def events(summary: dict, series: Series | None) -> list[float]:
    """Times worth seeing: contact, halfway through and shoulder clear; or how a beam breaks."""
    contact, clear = summary.get("first_contact_time"), summary.get("shoulder_clear_time")
    if contact is not None:
        return [contact] + ([contact + clear, contact + clear / 2] if clear is not None else [])
    if series and series.has("most_damage"):
        grown = [numpy.flatnonzero(series["most_damage"] >= share) for share in (0.02, 0.5, 0.98)]
        return [float(series["time"][rows[0]]) for rows in grown if len(rows)]
    return []


def choose(times: numpy.ndarray, wishes: list[float]) -> list[float]:
    """Moments to show: the first and the last frame, those nearest to the wishes, and others evenly between."""
    chosen = {int(numpy.argmin(abs(times - wish))) for wish in (times[0], times[-1], *wishes)}
    while len(chosen) < min(SHEET, len(times)):
        # The frame farthest from all that were chosen.
        gaps = [min(abs(times[i] - times[j]) for j in chosen) for i in range(len(times))]
        chosen.add(int(numpy.argmax(gaps)))
    return [float(times[i]) for i in sorted(chosen)]
