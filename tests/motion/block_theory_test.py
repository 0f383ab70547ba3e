"""First batches of a few random slopes and tunnels move as block theory says."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import ProgramTest  # noqa: E402

from jointed_models import confirm  # noqa: E402


class FirstBatches(ProgramTest):
    def test_move_as_predicted(self):
        for kind, seed in [("slope", seed) for seed in (21, 28, 53, 138)] + [("tunnel", seed) for seed in (30, 66)]:
            with self.subTest(kind=kind, seed=seed):
                confirm(self, kind, seed)


if __name__ == "__main__":
    unittest.main()
