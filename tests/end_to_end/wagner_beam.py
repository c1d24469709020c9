"""Deflection of an elastic wedge that enters water at constant speed: Wagner's theory and Euler's beam, as in Scolan (2004).

The wetted part |x| < c counts as a flat plate. With x = c sin(theta) the potential on it is a sum of b_n cos(n theta), n odd, whose
normal derivative is the wall's velocity v: n b_n = -(4 / pi) c Int v cos(theta) cos(n theta) dtheta. The pressure is
-rho dphi/dt, so the beam's modes q obey d/dt (q' + A(c) q' - V a(c)) = -K q, A and a added masses; c follows from Wagner's
condition V t = (2 / pi) Int (c sin(theta) tan(deadrise) + w) dtheta.

What the theory leaves out enters by two factors of a rigid wedge of the same deadrise: `water`, that of the added mass, and
`reach`, that of c. Exact similarity (Zhao & Faltinsen 1993, 10 degrees: 213.98 rho V^3 t, Wagner 249.3) has water 0.858; linear
acoustics (tests/fluid_solver/acoustic_entry.hpp, 30 m/s in 1480 m/s) has water and reach 0.961."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.optimize import brentq

LENGTH, THICKNESS, DEADRISE, SPEED = 0.6, 0.04, np.radians(10), 30.0  # m, m, rad, m/s
DENSITY, YOUNGS_MODULUS, POISSON_RATIO, WATER = 2700.0, 67.5e9, 0.34, 1000.0
SIMILARITY, ACOUSTICS = 0.858, 0.961

# Time (s) and deflection of the middle (m), read from the figure of Scolan's as later papers repeat it.
PUBLISHED = ((5e-4, 0.20e-3), (7.2e-4, 0.89e-3), (1.03e-3, 3.2e-3), (1.22e-3, 5.0e-3), (1.46e-3, 6.8e-3), (1.73e-3, 8.7e-3),
             (1.98e-3, 10.1e-3), (2.20e-3, 11.1e-3))


class Beam:
    """Hermite elements between clamped ends; the lowest modes, of unit mass."""

    def __init__(self, elements=80, modes=10):
        a = LENGTH / elements
        stiffness, mass = (np.zeros((2 * elements + 2,) * 2) for _ in range(2))
        bending = YOUNGS_MODULUS * THICKNESS**3 / 12 / (1 - POISSON_RATIO**2) / a**3
        k = bending * np.array([[12, 6 * a, -12, 6 * a], [6 * a, 4 * a * a, -6 * a, 2 * a * a],
                                [-12, -6 * a, 12, -6 * a], [6 * a, 2 * a * a, -6 * a, 4 * a * a]])
        m = DENSITY * THICKNESS * a / 420 * np.array([[156, 22 * a, 54, -13 * a], [22 * a, 4 * a * a, 13 * a, -3 * a * a],
                                                      [54, 13 * a, 156, -22 * a], [-13 * a, -3 * a * a, -22 * a, 4 * a * a]])
        for e in range(elements):
            at = slice(2 * e, 2 * e + 4)
            stiffness[at, at] += k
            mass[at, at] += m
        free = np.arange(2, 2 * elements)
        self.squares, shapes = eigh(stiffness[np.ix_(free, free)], mass[np.ix_(free, free)], subset_by_index=[0, modes - 1])
        self.elements = elements
        self.nodes = np.zeros((2 * elements + 2, modes))
        self.nodes[free] = shapes

    def modes(self, s):
        """[places][modes], at distances s from the keel along the beam."""
        a = LENGTH / self.elements
        e = np.clip((s / a).astype(int), 0, self.elements - 1)
        u = s / a - e
        shape = np.array([1 - 3 * u**2 + 2 * u**3, a * (u - 2 * u**2 + u**3), 3 * u**2 - 2 * u**3, a * (u**3 - u**2)])
        return sum(shape[i][:, None] * self.nodes[2 * e + i] for i in range(4))


def deflection(times, water=1.0, reach=1.0, terms=60, points=400):
    """Of the middle, m, at `times` (ascending) after the first contact."""
    beam, weight, odd = Beam(), np.pi / 2 / points, 2 * np.arange(terms) + 1
    theta = (np.arange(points) + 0.5) * weight
    cosines = np.cos(np.outer(odd, theta))
    count, whole = len(beam.squares), LENGTH * np.cos(DEADRISE)

    def wetted(t, q):
        def rest(c):
            w = beam.modes(c * np.sin(theta) / np.cos(DEADRISE)) @ q * np.cos(DEADRISE)
            return SPEED * t - 2 / np.pi * weight * np.sum(c * np.sin(theta) * np.tan(DEADRISE) + w)
        return whole if rest(whole) > 0 else reach * brentq(rest, 0, whole)

    def rates(t, state):
        momentum, q = state[:count], state[count:]
        c = wetted(t, q)
        moved = np.column_stack([beam.modes(c * np.sin(theta) / np.cos(DEADRISE)) * np.cos(DEADRISE), np.ones(points)])
        moment = weight * cosines @ (np.cos(theta)[:, None] * moved)  # [terms][modes, then the wedge as a whole]
        added = water * WATER * 4 / np.pi * c**2 * moment.T @ (moment / odd[:, None])
        speeds = np.linalg.solve(np.eye(count) + added[:count, :count], momentum + SPEED * added[:count, count])
        return np.concatenate([-beam.squares * q, speeds])

    solution = solve_ivp(rates, (1e-7, max(times)), np.zeros(2 * count), t_eval=times, max_step=5e-6, rtol=1e-5, method="RK23")
    return beam.modes(np.array([LENGTH / 2]))[0] @ solution.y[count:]
