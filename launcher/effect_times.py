"""Where the time of each effect shows in the reports of the processes (RUN/logs/NAME.json, `seconds`)."""
from __future__ import annotations

# Effect -> the (process, heading)s whose times add up to its own; no heading: all that the process computed.
PARTS = {
    "fluid": (("fluid", None), ("coupler", "overlap"), ("coupler", "overlap_check"), ("coupler", "fluid_loads")),
    "deformable_vehicle": (("structure", "internal_forces"),),
    "conversion": (("ice", "conversion"), ("ice", "particles")),
    "debris_displacement": (("coupler", "debris_displacement"),),
    "non_reflecting_boundaries": (("fluid", "boundaries"),),
}
# Why the time of an effect is not separate, or not all of it.
NOTES = {
    "ice_failure": "not separable: stress, strength and damage of an element are one loop (ice: elements)",
    "damage_regularisation": "takes no time of its own: a factor in the law (ice: elements)",
    "interface_reconstruction": "not separable: planes are laid within the sweeps (fluid: remap)",
    "cavitation": "not separable: a bound in the equation of state (fluid: equation_of_state)",
    "gravity": "not separable: a term in the sums of forces (ice and structure: velocities; fluid: lagrange)",
    "friction": "not separable: a term of the contact force (coupler: contact)",
    "symmetry": "takes no time of its own: mirrored parts are left out",
    "non_reflecting_boundaries": "of the fluid's sides; damped nodes of the ice move with the others (ice: velocities)",
}
MESSAGES = "messages"
UNREPORTED = "no process of this run reported it"


def computed(seconds: dict[str, float]) -> float:
    """All that a process computed: every heading but packing, sending and unpacking."""
    return sum(value for heading, value in seconds.items() if heading != MESSAGES)


def time_of(effect: str, active: bool, processes: dict[str, dict]) -> tuple[float | None, str | None]:
    """Seconds of wall time that an effect took, None where they cannot be told; and what is to be said about it."""
    if not active:
        return 0.0, None
    times = []
    for process, heading in PARTS.get(effect, ()):
        seconds = (processes.get(process) or {}).get("seconds") or {}
        if heading is None and seconds:
            times.append(computed(seconds))
        elif heading in seconds:
            times.append(seconds[heading])
    if times:
        return sum(times), NOTES.get(effect)
    return None, NOTES.get(effect, UNREPORTED)
