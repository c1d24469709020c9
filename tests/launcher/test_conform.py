"""`./polynya conform` names what a participant does wrong: every error sown into a small one is found and called by name."""
import sys
import tempfile
import unittest
import unittest.mock
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from launcher.conform.examine import CONVERSATIONS, Trial, examine

COMMAND = [sys.executable, str(Path(__file__).with_name("seeded_errors.py"))]
SOLID = {"name": "space", "symmetry": "quarter", "run": {"gravity": 0.0}}
FLUID = {"name": "basin", "symmetry": "quarter", "run": {"gravity": 9.81},
         "fluid": {"waterline": 0.0, "water": "water"}, "materials": {"water": {"values": {"density": 1000.0}}}}
WHOLE = ("whole",)

# error: (conversations that show it, section of docs/protocol.md, words of the one sentence)
SOLID_ERRORS = {
    "name": (WHOLE, "3", "'hello' gives the name 'structures', the command line gave 'structure'"),
    "another_run": (WHOLE, "2", "'hello': the header says run 'not-this-run', the command line '"),
    "protocol": (WHOLE, "2", "'hello': the header says protocol 1, this is protocol 2"),
    "no_parts": (WHOLE, "2", "'hello': the header lacks the field 'parts' of type integer"),
    "delimiter": (WHOLE, "2", "a message begins with an empty frame"),
    "ready_first": (WHOLE, "3", "sent 'ready' where 'hello' was due, after its start"),
    "short_frame": (WHOLE, "2", "'surface': array 'positions' came with 88 bytes, its type f8 and shape [4][3] need 96"),
    "lost_frame": (WHOLE, "2", "'surface': the header announces 3 arrays, 2 frames came with it"),
    "body": (WHOLE, "4", "'ready': the field 'body' is 'ice', it must be 'vehicle'"),
    "stable_step": (WHOLE, "4", "'ready': the field 'stable_step' is 0, it must be above 0"),
    "masses_missing": (WHOLE, "4", "'ready': array 'surface.masses' has the shape [3], it must be [4]"),
    "index": (WHOLE, "4", "'ready': 'surface.triangles' refers to vertex 4, the vertices are 0 to 3"),
    "one_turned_triangle": (WHOLE, "4", "in the same direction: neighbours are oriented differently"),
    "inside_out": (WHOLE, "4", "the triangles are clockwise seen from outside, they must be counter-clockwise"),
    "open_surface": (WHOLE, "4", "lies on no plane of symmetry: the surface is not closed"),
    "single_precision": (WHOLE, "4", "'ready': array 'velocities' is of type i4, it must be f8"),
    "not_finite": (WHOLE, "4", "'surface': array 'positions' holds a value that is not a finite number at [2][2]"),
    "account_too_long": (WHOLE, "6", "'surface': array 'account' has the shape [3], it must be [2]"),
    "window_number": (WHOLE, "4", "'surface' has the number 3 in 'window' where 2 is due"),
    "clock": (WHOLE, "4", "'surface' of window 3: the field 'time' is"),
    "jump": (WHOLE, "4", "'surface' of window 2: vertex 0 is 1e-09 m away from where its velocity carries it"),
    "topology": (WHOLE, "4", "'surface' lacks the array 'surface.ids'"),
    "deaf_at_start": (WHOLE, "4", "the loads of 'begin' give the impulse"),
    "wrong_sign": (WHOLE, "4", "the loads of window 1 give the impulse"),
    "whole_step": (WHOLE, "4", "(dt + dt')/2 times the sum of the forces; 'momentum_z' changes by"),
    "does_not_wait": (WHOLE, "4", "sent 'surface' without waiting for 'loads'"),
    "empty_arrays": (WHOLE, "4", "after 'loads' of window 0 with empty arrays: an empty frame"),
    "unknown_field": (WHOLE, "4", "with a field that nobody knows: a field that I do not know"),
    "order_of_arrays": (WHOLE, "4", "with its arrays in another order and one that nobody knows: array 0 is not mine"),
    "leaves_early": (WHOLE, "4",
                     "ended with exit code 3 where 'surface' was due, after 'loads' of window 1: out of licences"),
    "goes_mute": (WHOLE, "4", "'surface' did not come within 2 s after 'loads' of window 1"),
    "impatient": (WHOLE, "4", "ended with exit code 1 while the coupler let it wait 1.5 s for 'loads'"),
    "goes_on": (WHOLE, "3", "sent 'surface' where 'finished' was due, after 'loads' of window 8 with finish = true"),
    "no_goodbye": (WHOLE, "3", "ended with exit code 0 while the coupler let it wait 0.3 s for 'bye'"),
    "exit_code": (WHOLE, "3", "ended with exit code 4 after 'bye', the exit code must be 0"),
    "stop_is_success": (("stop",), "3", "ended with exit code 0 after 'stop', the exit code must be 1"),
    "content_with_closed_connection": (("closed",), "3", "ended with exit code 0 after the coupler closed the connection"),
    "silent_refusal": (("refuse",), "3", "does not print the reason that came with 'refuse'"),
}
FLUID_ERRORS = {
    "role": (WHOLE, "5", "'ready': the field 'role' is 'solid', it must be 'fluid'"),
    "grid_descends": (WHOLE, "5", "'ready': the coordinates of 'grid.z' must ascend"),
    "pressure_shape": (WHOLE, "5", "'pressure': array 'pressure.values' has the shape"),
    "previous_is_present": (WHOLE, "5", "'pressure': array 'pressure.previous_values' has the shape"),
    "span_number": (WHOLE, "5", "'pressure' has the number 1 in 'span' where 0 is due"),
    "absolute_pressure": (WHOLE, "5", "around a body at rest 'pressure.values' is"),
    "gradient_sign": (WHOLE, "5", "around a body at rest 'pressure.gradient_z' is -9810 Pa/m"),
}


class SownErrors(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def examine(self, error, name, scene, conversations):
        trial = Trial([*COMMAND, error], name, scene, self.folder / f"{name}-{error}", patience=2.0, slow=1.5)
        if error not in ("impatient", "none"):
            trial = Trial(**{**trial.__dict__, "slow": 0.1})
        return examine(trial, conversations)

    def check(self, name, scene, errors):
        """Each error alone gives its one sentence and no other."""
        with ThreadPoolExecutor(6) as pool:
            verdicts = {error: pool.submit(self.examine, error, name, scene, conversations)
                        for error, (conversations, _, _) in errors.items()}
        for error, (_, section, words) in errors.items():
            with self.subTest(error):
                findings = verdicts[error].result().findings
                self.assertEqual(len(findings), 1, findings)
                self.assertEqual(findings[0][0], section)
                self.assertIn(words, findings[0][1])

    def test_in_a_solid_are_named(self):
        self.check("structure", SOLID, SOLID_ERRORS)

    def test_in_a_fluid_are_named(self):
        self.check("fluid", FLUID, FLUID_ERRORS)

    def test_are_not_found_where_there_are_none(self):
        for name, scene in (("structure", SOLID), ("fluid", FLUID)):
            verdict = self.examine("none", name, scene, CONVERSATIONS)
            self.assertEqual(verdict.findings, [])
            self.assertGreater(max(verdict.counts.values()), 5)

    def test_such_as_living_on_without_a_coupler_are_named(self):
        with unittest.mock.patch("launcher.conform.conversation.UNTIL_ENDED", 1.0):
            verdict = self.examine("ignores_closed_connection", "structure", SOLID, ("closed",))
        self.assertEqual(verdict.findings, [("3", "does not end after the coupler closed the connection: "
                                                  "it still ran 1 s later")])


if __name__ == "__main__":
    unittest.main()
