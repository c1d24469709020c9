"""What the reported quantities mean. Every figure that the launcher computes from a time series is defined here.

Speed is that of the vehicle's centre of mass, from its momentum. Deceleration is -d(speed)/dt, low-pass filtered by a
Butterworth filter of second order run forward and backward (no phase shift; amplitude 1/2 at the filter frequency);
the unfiltered one is kept beside it. Peaks count between first contact and `through_time`.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy
from scipy import signal

STAYS_BELOW = 0.02  # of the peak: the passage is over when the filtered deceleration stays below this share
MOST_SAMPLES = 2_000_000


@dataclass(frozen=True)
class Passage:
    """The passage of a vehicle through ice. Times in s after the start unless said otherwise; None: did not happen."""

    initial_speed: float
    residual_speed: float
    residual_speed_at: str  # "through_time" or "end"
    first_contact_time: float | None = None
    through_time: float | None = None
    shoulder_clear_time: float | None = None  # counted from first contact
    shoulder_clear_speed: float | None = None
    peak_deceleration: float | None = None
    mean_deceleration: float | None = None
    mean_deceleration_until: str | None = None  # "through_time", "shoulder_clear_time" or "end"


def raw_deceleration(time: numpy.ndarray, speed: numpy.ndarray) -> numpy.ndarray:
    """-d(speed)/dt by central differences of second order on uneven times, one-sided at the ends."""
    if len(time) < 2:
        return numpy.zeros(len(time))
    return -numpy.gradient(speed, time)


def filtered_deceleration(time: numpy.ndarray, speed: numpy.ndarray, frequency: float) -> numpy.ndarray:
    """-d(speed)/dt low-pass filtered at `frequency` (Hz), at the given times (strictly increasing).

    The speed is sampled evenly first, at the shortest distance of two times, and then differentiated: so the filter
    sees the true change of momentum between samples. Not filtered where the samples cannot resolve the frequency.
    """
    if len(time) < 8 or frequency <= 0:
        return raw_deceleration(time, speed)
    even, rate = even_times(time)
    deceleration = -numpy.gradient(numpy.interp(even, time, speed), even)
    return numpy.interp(time, even, low_pass(deceleration, rate, frequency))


def filtered(time: numpy.ndarray, values: numpy.ndarray, frequency: float) -> numpy.ndarray:
    """Any column through the same filter, at the given times (strictly increasing)."""
    if len(time) < 8 or frequency <= 0:
        return values.copy()
    even, rate = even_times(time)
    return numpy.interp(time, even, low_pass(numpy.interp(even, time, values), rate, frequency))


def even_times(time: numpy.ndarray) -> tuple[numpy.ndarray, float]:
    """Even times at the shortest distance of the given ones, and how many there are per second."""
    duration = time[-1] - time[0]
    samples = min(MOST_SAMPLES, int(numpy.ceil(duration / numpy.diff(time).min())) + 1)
    return numpy.linspace(time[0], time[-1], samples), (samples - 1) / duration


def low_pass(values: numpy.ndarray, rate: float, frequency: float) -> numpy.ndarray:
    """Zero-phase Butterworth low-pass of evenly sampled values (`rate` samples per second)."""
    if frequency >= 0.5 * rate:
        return values.copy()
    sections = signal.butter(2, frequency, fs=rate, output="sos")
    padding = min(len(values) - 1, max(15, int(2 * rate / frequency)))
    # Continued as a mirror image: a point reflection would tie the filtered ends to two single, noisy samples.
    return signal.sosfiltfilt(sections, values, padtype="even", padlen=padding)


def first_contact(time: numpy.ndarray, contact_force: numpy.ndarray) -> float | None:
    """The first time with a contact force other than zero."""
    touching = numpy.flatnonzero(numpy.nan_to_num(contact_force) != 0)
    return float(time[touching[0]]) if len(touching) else None


def through(time: numpy.ndarray, smooth: numpy.ndarray, peak: float) -> float | None:
    """When the filtered deceleration falls below 2 % of its peak for good; None if it never does before the end."""
    threshold = STAYS_BELOW * peak
    above = numpy.flatnonzero(smooth >= threshold)
    if peak <= 0 or not len(above) or above[-1] == len(time) - 1:
        return None
    i = above[-1]
    share = (smooth[i] - threshold) / (smooth[i] - smooth[i + 1])
    return float(time[i] + share * (time[i + 1] - time[i]))


def first_crossing(time: numpy.ndarray, position: numpy.ndarray, level: float) -> float | None:
    """When a position first reaches a level from below."""
    reached = numpy.flatnonzero(position >= level)
    if not len(reached):
        return None
    i = reached[0]
    if i == 0:
        return float(time[0])
    share = (level - position[i - 1]) / (position[i] - position[i - 1])
    return float(time[i - 1] + share * (time[i] - time[i - 1]))


def nose_position(time: numpy.ndarray, position: numpy.ndarray, speed: numpy.ndarray, start: float) -> numpy.ndarray:
    """z of the nose from the travel of whatever point of the vehicle was recorded; `start`: the nose at time zero."""
    return start + position - (position[0] - speed[0] * time[0])


def passage(time: numpy.ndarray, speed: numpy.ndarray, frequency: float, *, contact_force: numpy.ndarray | None = None,
            shoulder: numpy.ndarray | None = None, upper_face: float | None = None,
            initial_speed: float | None = None) -> Passage:
    """All quantities of a passage. `shoulder`: z of the cylinder's first section; without contact most are None."""
    initial = float(speed[0]) if initial_speed is None else initial_speed
    contact = None if contact_force is None else first_contact(time, contact_force)
    if contact is None:
        return Passage(initial, float(speed[-1]), "end")
    smooth = filtered_deceleration(time, speed, frequency)
    peak = float(smooth[time >= contact].max())
    through_time = through(time, smooth, peak)
    clear = None
    if shoulder is not None and upper_face is not None:
        clear = first_crossing(time, shoulder, upper_face)

    until, end = "end", float(time[-1])
    if through_time is not None:
        until, end = "through_time", through_time
    elif clear is not None and clear > contact:
        until, end = "shoulder_clear_time", clear
    speed_at = lambda moment: float(numpy.interp(moment, time, speed))  # noqa: E731
    mean = (speed_at(contact) - speed_at(end)) / (end - contact) if end > contact else None
    return Passage(
        initial_speed=initial,
        residual_speed=float(speed[-1]) if through_time is None else speed_at(through_time),
        residual_speed_at="end" if through_time is None else "through_time",
        first_contact_time=contact,
        through_time=through_time,
        shoulder_clear_time=None if clear is None else clear - contact,
        shoulder_clear_speed=None if clear is None else speed_at(clear),
        peak_deceleration=peak,
        mean_deceleration=mean,
        mean_deceleration_until=None if mean is None else until)
