"""Table 5-1 of the thesis from blocks of a cut model: force, volume, mode and direction of all sixteen rows."""
import math
import unittest

from program import ProgramTest

GENTLE = "single_plane", ["bed"], (0.1 / math.sqrt(1.01), 0, 1 / math.sqrt(1.01))
STEEP = "single_plane", ["ramp"], (math.sqrt(0.5), math.sqrt(0.5), 0)
FALLS = "lifting", [], (1, 0, 0)
# Row, force in newtons as printed, volume in m3 and its rounding, volume as printed, how it moves.
TABLE = [
    (1, 194328, 99.641, 5e-4, 100, GENTLE), (2, 61152, 31.356, 5e-4, 31, GENTLE), (3, 165194, 84.703, 5e-4, 85, GENTLE),
    (4, 107312, 55.024, 5e-4, 55, GENTLE), (5, 32395, 16.610, 5e-4, 17, GENTLE), (6, 191689, 98.288, 5e-4, 98, GENTLE),
    (7, 79093, 40.555, 5e-4, 41, GENTLE), (8, 93909, 48.152, 5e-4, 48, GENTLE), (9, 21140, 10.840, 5e-4, 11, GENTLE),
    (10, 181233, 92.927, 5e-4, 93, GENTLE), (11, 106188, 54.448, 5e-4, 54, GENTLE), (12, 600275, 43.312, 5e-4, 43, STEEP),
    (13, 239486, 12.2187, 5e-5, 12, FALLS), (14, 403603, 206.947, 5e-4, 207, GENTLE), (15, 595424, 30.3788, 5e-5, 30, FALLS),
    (16, 156731, 7.9965, 5e-5, 8, FALLS)]


class Table51(ProgramTest):
    def test_has_all_sixteen_rows(self):
        self.copy_case("table_5_1")
        document = self.json_of("support", "table_5_1.toml")
        keys = document["keyblocks"]
        self.assertEqual(len(keys), 16)
        for row, force, volume, rounding, printed, (mode, planes, direction) in TABLE:
            with self.subTest(row=row):
                key = min(keys, key=lambda k: abs(k["volume"] - volume))
                self.assertAlmostEqual(key["volume"], volume, delta=1e-9)
                self.assertEqual(round(key["volume"]), printed)
                self.assertEqual((key["mode"], key["planes"]), (mode, planes))
                for found, expected in zip(key["direction"], direction):
                    self.assertAlmostEqual(found, expected, delta=1e-12)
                self.assertAlmostEqual(key["sliding_force"], force, delta=19600 * direction[0] * rounding + 0.5)
                self.assertAlmostEqual(key["weight"], 19600 * volume, delta=1e-6)
                # Without friction the least support is against the motion and as large as the force.
                self.assertAlmostEqual(key["support_force"], key["sliding_force"], delta=1e-6)
                for found, expected in zip(key["support_direction"], direction):
                    self.assertAlmostEqual(found, -expected, delta=1e-12)
        self.assertAlmostEqual(document["totals"]["keyblock_volume"], 933.397, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
