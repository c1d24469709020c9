"""The reported quantities against signals whose answers are known in closed form."""
import math
import unittest

import numpy

from launcher import definitions
from tests.launcher import synthetic_run as invented


class LowPass(unittest.TestCase):
    RATE, FREQUENCY = 1e6, 20e3

    def response(self, frequency: float) -> numpy.ndarray:
        """Filtered cosine, without the ends."""
        time = numpy.arange(4000) / self.RATE
        cosine = numpy.cos(2 * math.pi * frequency * time)
        return definitions.low_pass(cosine, self.RATE, self.FREQUENCY)[1000:3000], cosine[1000:3000]

    def test_halves_the_amplitude_at_its_frequency_without_shifting_the_phase(self):
        filtered, cosine = self.response(self.FREQUENCY)
        numpy.testing.assert_allclose(filtered, 0.5 * cosine, atol=2e-3)

    def test_has_the_gain_of_a_butterworth_filter_run_twice(self):
        for ratio in (0.25, 0.5, 2.0, 3.0):
            # The bilinear transform maps frequencies by the tangent.
            warped = math.tan(math.pi * ratio * self.FREQUENCY / self.RATE) / math.tan(
                math.pi * self.FREQUENCY / self.RATE)
            filtered, _ = self.response(ratio * self.FREQUENCY)
            self.assertAlmostEqual(filtered.max(), 1 / (1 + warped ** 4), delta=3e-3)

    def test_leaves_a_constant_and_the_area_of_a_pulse_alone(self):
        numpy.testing.assert_allclose(definitions.low_pass(numpy.full(500, 3.0), self.RATE, self.FREQUENCY), 3.0)
        pulse = numpy.zeros(4000)
        pulse[2000] = 1.0
        self.assertAlmostEqual(definitions.low_pass(pulse, self.RATE, self.FREQUENCY).sum(), 1.0, places=9)

    def test_does_nothing_where_the_samples_do_not_resolve_the_frequency(self):
        values = numpy.array([0.0, 1.0, 0.0, -1.0] * 10)
        numpy.testing.assert_array_equal(definitions.low_pass(values, 1000.0, 600.0), values)


class Deceleration(unittest.TestCase):
    def test_of_uniform_motion_is_zero_and_of_constant_braking_is_constant_on_uneven_times(self):
        random = numpy.random.default_rng(3)
        time = numpy.cumsum(random.uniform(0.5e-6, 2e-6, 2000))
        for value in (0.0, 5000.0):
            speed = 40 - value * time
            numpy.testing.assert_allclose(definitions.raw_deceleration(time, speed), value, rtol=1e-6, atol=1e-6)
            numpy.testing.assert_allclose(definitions.filtered_deceleration(time, speed, 20e3), value, rtol=1e-6,
                                          atol=1e-6)

    def test_filtered_keeps_the_change_of_speed(self):
        time = numpy.linspace(0, 1e-3, 3001)
        noise = numpy.random.default_rng(4).normal(0, 0.01, len(time))
        noise[:200] = noise[-200:] = 0
        speed = invented.speed(time) + noise
        filtered = definitions.filtered_deceleration(time, speed, 20e3)
        self.assertAlmostEqual(numpy.trapz(filtered, time), invented.LOSS, delta=1e-3)

    def test_filtered_is_quiet_where_raw_is_noisy(self):
        """Of white noise in the speed the derivative holds (2 pi f)^2: nearly all of it far above the filter."""
        time = numpy.linspace(0, 1e-3, 3001)
        noise = numpy.random.default_rng(5).normal(0, 0.01, len(time))
        raw = definitions.raw_deceleration(time, noise)
        self.assertLess(definitions.filtered_deceleration(time, noise, 20e3).std(), 0.01 * raw.std())


class HalfSinePulse(unittest.TestCase):
    """A pulse of deceleration A sin(pi (t - t0) / T) takes 2 A T / pi from the speed."""

    def setUp(self):
        self.time = numpy.linspace(0, invented.END, 4001)
        self.speed = invented.speed(self.time)
        self.force = invented.MASS * invented.deceleration(self.time)
        nose = definitions.nose_position(self.time, 7.0 + invented.travel(self.time), self.speed, invented.NOSE)
        self.shoulder = nose - invented.HEAD
        self.passage = definitions.passage(self.time, self.speed, 200e3, contact_force=self.force,
                                           shoulder=self.shoulder, upper_face=invented.THICKNESS)

    def test_peak(self):
        self.assertAlmostEqual(self.passage.peak_deceleration, invented.PEAK, delta=2e-3 * invented.PEAK)

    def test_first_contact_is_the_first_sample_with_a_force(self):
        self.assertAlmostEqual(self.passage.first_contact_time, invented.CONTACT, delta=3e-7)

    def test_through_when_two_percent_of_the_peak_are_left(self):
        exact = invented.CONTACT + invented.PULSE * (1 - math.asin(0.02) / math.pi)
        self.assertAlmostEqual(self.passage.through_time, exact, delta=1e-6)

    def test_residual_speed_is_the_speed_then(self):
        self.assertEqual(self.passage.residual_speed_at, "through_time")
        self.assertAlmostEqual(self.passage.residual_speed, invented.SPEED - invented.LOSS, delta=2e-3)

    def test_mean_deceleration_is_the_loss_over_the_passage(self):
        self.assertEqual(self.passage.mean_deceleration_until, "through_time")
        passage_time = self.passage.through_time - self.passage.first_contact_time
        self.assertAlmostEqual(self.passage.mean_deceleration * passage_time,
                               invented.SPEED - self.passage.residual_speed, delta=2e-3)

    def test_shoulder_is_clear_after_the_way_through_the_ice(self):
        way = invented.THICKNESS + invented.HEAD - invented.NOSE
        after = self.passage.first_contact_time + self.passage.shoulder_clear_time
        self.assertAlmostEqual(float(invented.travel(numpy.array(after))), way, delta=1e-8)


class Exceptions(unittest.TestCase):
    TIME = numpy.linspace(0, 1e-3, 1001)

    def test_a_run_that_ends_inside_the_ice_is_not_through(self):
        early = self.TIME < 3e-4
        time = self.TIME[early]
        result = definitions.passage(time, invented.speed(time), 100e3, contact_force=invented.deceleration(time),
                                     shoulder=-0.014 + invented.travel(time), upper_face=0.010)
        self.assertIsNone(result.through_time)
        self.assertIsNone(result.shoulder_clear_time)
        self.assertEqual((result.residual_speed_at, result.mean_deceleration_until), ("end", "end"))
        self.assertEqual(result.residual_speed, invented.speed(time)[-1])

    def test_a_later_second_blow_counts(self):
        speed = invented.speed(self.TIME) + invented.speed(self.TIME - 4.5e-4) - invented.SPEED
        result = definitions.passage(self.TIME, speed, 100e3, contact_force=numpy.ones(len(self.TIME)))
        self.assertGreater(result.through_time, 9e-4)

    def test_a_peak_before_contact_does_not_count(self):
        speed = invented.speed(self.TIME + 1e-4) + (invented.speed(self.TIME - 5e-4) - invented.SPEED) / 10
        late = numpy.where(self.TIME > 5.5e-4, 1.0, 0.0)
        result = definitions.passage(self.TIME, speed, 100e3, contact_force=late)
        self.assertAlmostEqual(result.peak_deceleration, invented.PEAK / 10, delta=0.01 * invented.PEAK)

    def test_without_contact_there_is_only_speed(self):
        for force in (None, numpy.zeros(len(self.TIME)), numpy.full(len(self.TIME), numpy.nan)):
            result = definitions.passage(self.TIME, invented.speed(self.TIME), 100e3, contact_force=force)
            self.assertEqual((result.initial_speed, result.residual_speed_at), (invented.SPEED, "end"))
            self.assertIsNone(result.peak_deceleration)
            self.assertIsNone(result.mean_deceleration)

    def test_two_rows_are_enough_to_say_something(self):
        result = definitions.passage(numpy.array([0.0, 1e-6]), numpy.array([40.0, 39.9]), 20e3,
                                     contact_force=numpy.array([0.0, 1.0]))
        self.assertAlmostEqual(result.peak_deceleration, 1e5, delta=1)


if __name__ == "__main__":
    unittest.main()
