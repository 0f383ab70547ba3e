"""Joints whose contact does not add up to their area end the cut with an error that names the place."""
import unittest

from program import ProgramTest

# A random fault that folds along straight lines and is flat between them but for the last digit: one block shows both sides of a sliver.
VERTICES = """
412284.6826299494 4823091.47894575 299.6395630161534; 412292.24615616753 4823093.922949627 298.2462125646144;
412299.9271438459 4823095.902063488 297.0774893583304; 412307.7255929845 4823097.416287332 296.1333933973016;
412315.64150358335 4823098.4656211585 295.4139246815278; 412323.67487564246 4823099.050064968 294.91908321100914;
412284.993500617 4823097.3417583 311.610718608431; 412292.5570268351 4823099.785762177 310.21736815689195;
412300.23801451345 4823101.764876038 309.04864495060804; 412308.0364636521 4823103.279099882 308.10454898957914;
412315.9523742509 4823104.328433708 307.3850802738054; 412323.98574631003 4823104.912877518 306.8902388032867;
412285.30437128455 4823103.2045708485 323.58187420070857; 412292.86789750267 4823105.648574727 322.1885237491696;
412300.548885181 4823107.627688588 321.0198005428856; 412308.34733431967 4823109.1419124305 320.07570458185677;
412316.2632449185 4823110.191246258 319.356235866083; 412324.2966169776 4823110.775690068 318.86139439556433;
412285.6152419521 4823109.067383398 335.5530297929862; 412293.17876817024 4823111.511387276 334.15967934144714;
412300.8597558486 4823113.4905011365 332.99095613516323; 412308.65820498724 4823115.00472498 332.04686017413434;
412316.57411558606 4823116.054058807 331.3273914583606; 412324.6074876452 4823116.638502617 330.83254998784196;
"""
TRIANGLES = """
1 2 8; 1 8 7; 2 3 9; 2 9 8; 3 4 10; 3 10 9; 4 5 11; 4 11 10;
5 6 12; 5 12 11; 7 8 14; 7 14 13; 8 9 15; 8 15 14; 9 10 16; 9 16 15;
10 11 17; 10 17 16; 11 12 18; 11 18 17; 13 14 20; 13 20 19; 14 15 21; 14 21 20;
15 16 22; 15 22 21; 16 17 23; 16 23 22; 17 18 24; 17 24 23;
"""
ROCK = """[[material]]
density = 2700
[[joint_material]]
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [412300, 4823100, 310]
max = [412310, 4823110, 320]
continues = ["zmin"]
[[joint_mesh]]
name = "fault"
file = "fault.obj"
"""


def rows(text):
    return [row.strip() for row in text.replace("\n", " ").split(";") if row.strip()]


class LostContact(ProgramTest):
    def write_fault(self, number):
        vertices = ["v " + " ".join(number(float(x)) for x in row.split()) for row in rows(VERTICES)]
        self.write("fault.obj", "\n".join(vertices + ["f " + row for row in rows(TRIANGLES)]) + "\n")
        self.write("m.toml", ROCK)

    def test_is_an_error_with_joint_block_area_and_place(self):
        self.write_fault(repr)
        self.assertRegex(self.run_program("cut", "m.toml", "--no-result", status=1).stderr,
                         r"m\.toml:11:1: joint_mesh\[1\]: the contact of joint fault does not add up to its area: of 122\.674 m2 on block 1, 4\.471 m2 lean on nothing and 0 m2 are counted twice, near \(41230\d\.\d+, 482310\d\.\d+, 31\d[.\d]*\) \(one of 2 places\)")

    def test_is_none_where_corners_are_rounded(self):
        self.write_fault("{:.6f}".format)
        self.assertEqual(self.json_of("cut", "m.toml", "--no-result")["totals"]["blocks"], 2)


if __name__ == "__main__":
    unittest.main()
