"""First batches of 30 random slopes and tunnels move as block theory says, but for one."""
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


if __name__ == "__main__":
    unittest.main()
