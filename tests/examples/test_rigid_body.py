"""The body of examples/rigid_vehicle.py against the laws of a rigid body."""
import unittest

import numpy as np

from examples.rigid_vehicle import RigidBody

MASSES = np.array([1.0, 2.0, 3.0, 1.5])  # kg
POINTS = np.array([[0.1, 0.0, 0.0], [0.0, 0.2, 0.05], [0.0, 0.0, 0.3], [-0.1, -0.05, 0.0]])
DT = 1e-4


def inertia(points):
    return sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(MASSES, points))


def make_body(symmetry, gravity=0.0):
    centre = MASSES @ POINTS / MASSES.sum()
    surface = {"positions": POINTS, "mass": MASSES.sum(), "centre_of_mass": centre, "inertia": inertia(POINTS - centre)}
    return RigidBody(surface, symmetry, 40.0, gravity)


def momentum(state):
    return MASSES @ state["velocities"]


def angular_momentum(state, about):
    return sum(m * np.cross(x - about, v) for m, x, v in zip(MASSES, state["positions"], state["velocities"]))


class RigidBodyMotion(unittest.TestCase):
    def blow(self, body, force, steps=1):
        """Pushes the first vertex for some steps."""
        forces = np.zeros((4, 3))
        forces[0] = force
        for _ in range(steps):
            body.advance(DT)
            body.push(forces, DT, DT)

    def test_keeps_the_distances_of_its_points(self):
        body = make_body("full")
        self.blow(body, [300.0, -2000.0, 5000.0], steps=200)
        positions = body.state()["positions"]
        for i in range(4):
            for j in range(i):
                before, after = (np.linalg.norm(x[i] - x[j]) for x in (POINTS, positions))
                self.assertAlmostEqual(after, before, delta=1e-13)
        self.assertGreater(abs(body.frame - np.eye(3)).max(), 0.1)  # it has turned

    def test_moves_as_the_velocities_say_that_it_sends(self):
        body = make_body("full")
        self.blow(body, [300.0, -2000.0, 5000.0], steps=10)
        before = body.state()["positions"]
        body.advance(DT)
        after = body.state()
        np.testing.assert_allclose(after["positions"], before + DT * after["velocities"], rtol=0, atol=1e-15)

    def test_takes_the_impulse_and_the_moment_of_a_force(self):
        body, force = make_body("full"), np.array([300.0, -2000.0, 5000.0])
        arm = POINTS[0] + [0, 0, 40 * DT] - (body.centre + [0, 0, 40 * DT])
        self.blow(body, force)
        body.advance(DT)
        state = body.state()
        np.testing.assert_allclose(momentum(state), [0, 0, 40 * MASSES.sum()] + DT * force, rtol=1e-12)
        # The velocities that are sent are chords of the turn: second order in the angle of a step.
        np.testing.assert_allclose(angular_momentum(state, body.centre), DT * np.cross(arm, force), rtol=1e-3, atol=1e-4)

    def test_turning_freely_keeps_angular_momentum_and_energy(self):
        """Of a body with three different moments of inertia, whose axis of rotation wanders."""
        body = make_body("full")
        self.blow(body, [300.0, -2000.0, 5000.0], steps=20)
        self.blow(body, [0.0, 0.0, 0.0])
        energy, spin, frame = body.account[0], body.spin_momentum.copy(), body.frame.copy()
        self.blow(body, [0.0, 0.0, 0.0], steps=1000)
        self.assertAlmostEqual(body.account[0], energy, delta=1e-9 * energy)
        np.testing.assert_array_equal(body.spin_momentum, spin)
        self.assertGreater(abs(body.frame - frame).max(), 0.5)

    def test_of_a_half_stays_in_its_plane_and_of_a_quarter_on_its_axis(self):
        half, quarter = make_body("half"), make_body("quarter")
        for body in (half, quarter):
            self.blow(body, [300.0, -2000.0, 5000.0], steps=5)
        np.testing.assert_allclose(half.velocity / [5 * DT * 300 / 7.5, 1, 40 + 5 * DT * 5000 / 7.5], [1, 0, 1])
        np.testing.assert_allclose(half.frame[1], [0, 1, 0])
        self.assertGreater(abs(half.frame[0, 2]), 1e-5)
        np.testing.assert_allclose(quarter.velocity, [0, 0, 40 + 5 * DT * 5000 / 7.5])
        np.testing.assert_array_equal(quarter.frame, np.eye(3))

    def test_falls_with_the_work_and_impulse_of_gravity_in_its_account(self):
        body = make_body("quarter", gravity=9.81)
        body.push(np.zeros((4, 3)), 0, DT)
        self.blow(body, [0.0, 0.0, 0.0], steps=100)
        kinetic, gravity_work, upward, impulse, mass, _ = body.account
        self.assertAlmostEqual(upward, 40 * mass + impulse, delta=1e-9)
        self.assertAlmostEqual(impulse, -mass * 9.81 * 100.5 * DT, delta=1e-9)
        self.assertAlmostEqual(kinetic - gravity_work, 0.5 * mass * 40**2, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
