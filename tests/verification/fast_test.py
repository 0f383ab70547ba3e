"""Every verification case with the few runs that take a second: all numbers lie within their tolerances.

    fast_test.py [MODULE ...]    the cases of these modules alone
"""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from runner import Rockfold  # noqa: E402
from verify import BY_SUBSTEPS, CASES, find, report  # noqa: E402

FULL = False


class Verification(unittest.TestCase):
    pass


def test_of(name, explicit):
    def test(self):
        found = find(name, Rockfold(), FULL, explicit)
        report(found)
        self.assertTrue(found.rows, "the case compares nothing")
        self.assertEqual([], [f"{row.quantity}: {row.ours!r}, must be {row.reference!r} within {row.tolerance:g}" for row in found.bad()])
    return test


for name, one in CASES.items():
    if not sys.argv[1:] or one.__module__ in sys.argv[1:]:
        setattr(Verification, f"test_{name}", test_of(name, explicit=False))
        if name in BY_SUBSTEPS:
            setattr(Verification, f"test_{name}_by_substeps", test_of(name, explicit=True))

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
