"""First batches of 30 random slopes and tunnels move as block theory says, but for one; openings stay with their support, and come down without."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import ProgramTest  # noqa: E402

from jointed_models import SLOPES, TUNNELS, confirm  # noqa: E402


class FirstBatches(ProgramTest):
    def test_move_as_predicted(self):
        for kind, seed in [("slope", seed) for seed in SLOPES] + [("tunnel", seed) for seed in TUNNELS]:
            with self.subTest(kind=kind, seed=seed):
                confirm(self, kind, seed)


class Openings(ProgramTest):
    """Two to six minutes a run."""

    def moved(self, name, *arguments):
        """Which key blocks have moved how far, m, and whether their support is to hold them."""
        document = self.json_of("run", f"{name}.toml", "--no-result", "-q", *arguments, timeout=3600)
        return [(key["seen"]["moved"], key["predicted"].get("held", False))
                for key in document["confirmed"] if key["predicted"]]

    def test_tunnel_stays_with_its_support(self):
        self.copy_case("held_tunnel")
        held = self.moved("held_tunnel")
        self.assertEqual(len(held), 19)
        self.assertTrue(all(is_held and way < 0.005 for way, is_held in held), held)
        falls = self.moved("held_tunnel", "--set", "bolt_pattern=", "--set", "shotcrete=")
        self.assertGreaterEqual(sum(way > 0.04 for way, _ in falls), 17)

    def test_arch_of_a_cavern_bears_on_its_cables(self):
        self.copy_case("held_cavern")
        held = self.moved("held_cavern")
        self.assertEqual(sum(is_held for _, is_held in held), 12)
        self.assertLess(max(way for way, is_held in held if is_held), 0.05)
        self.assertGreater(max(way for way, is_held in held if not is_held), 1)  # in the floor
        falls = self.moved("held_cavern", "--set", "bolt_pattern=", "--set", "shotcrete=")
        arch = [way for (way, _), (_, is_held) in zip(falls, held, strict=True) if is_held]
        self.assertGreaterEqual(sum(way > 0.5 for way in arch), 11)


if __name__ == "__main__":
    unittest.main()
