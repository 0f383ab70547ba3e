"""What an analysis refuses, with the place in the model, and what it leaves behind when a solve does not converge."""
import re
import resource
import subprocess
import unittest

from program import BINARY, PRESSED, SANITIZED, ProgramTest

DYNAMIC = 'type = "dynamic"\nkinematics = "small"\ntime_step = 0.01\nsteps = 5'

# A soft bar that turns 0.7 times a step of 0.2 s.
SPUN = """
gravity = [0, 0, 0]
[[material]]
density = 2000
young_modulus = 1e7
poisson_ratio = 0.25
[[solid]]
name = "bar"
shape = "box"
min = [0, 0, 0]
max = [2, 1, 1]
[cover]
spacing = 1
[[initial_velocity]]
where = {all = true}
angular_velocity = [1, 2, 20]
[analysis]
time_step = 0.2
steps = 3
"""


class BadInput(ProgramTest):
    """One change of a right model a line: what is replaced, by what, the line and key told, and words of the message."""
    CASES = [
        ("poisson_ratio = 0.25", "poisson_ratio = 0.5", 7, "material[1].poisson_ratio", "found 0.5, must be > -1 and < 0.5"),
        ("density = 2400", "density = -2400", 5, "material[1].density", "found -2400, must be > 0"),
        ("young_modulus = 20e9", "young_modulus = 0", 6, "material[1].young_modulus", "found 0, must be > 0"),
        ('type = "static"', 'type = "dynamic"\ntime_step = 0', 31, "analysis.time_step", "found 0, must be > 0"),
        ('type = "static"', 'type = "dynamic"\ntime_step = -0.1', 31, "analysis.time_step", "found -0.1, must be > 0"),
        ('type = "static"', 'type = "dynamic"\ntime_step = nan', 31, "analysis.time_step", "must be a finite number, > 0"),
        ('{face = "rock.xmin"}', "{box = [[5, 5, 5], [6, 6, 6]]}", 17, "fixed[1].where", "holds nothing: no rock lies there"),
        ('{face = "rock.xmin"}', '{face = "rock.top"}', 18, "fixed[1].where.face", "its faces are: xmin, xmax, ymin, ymax, zmin, zmax"),
        ('{face = "rock.zmax"}', "{box = [[5, 5, 5], [6, 6, 6]]}", 26, "traction[1].where", "no free face"),
        ("[0.4, 0.3, 1.2]", "[0.4, 0.3, 2.0000001]", 31, "monitor[1].point", "(0.4, 0.3, 2.0000001) of monitor"),
        ("[0.4, 0.3, 1.2]", "[0.4, 0.3, 2.2]", 31, "monitor[1].point", "of monitor monitor1 is not in the rock"),
        ("spacing = 0.7", "spacing = 1e-3", 15, "cover.spacing", "elements, must make cover.max_elements = 50000000 or fewer"),
        ("spacing = 0.7", "spacing = -1", 16, "cover.spacing", "found -1, must be > 0"),
        ('type = "static"', 'type = "dynamic"\nnewmark = {beta = 0}', 31, "analysis.newmark.beta", "found 0, must be >= 1e-4 (1e-4 comes to the explicit scheme)"),
        ('type = "static"', 'type = "dynamic"\nkinematics = "small"\nnewmark = {beta = 0.1}\ntime_step = 1e-3', 29, "analysis.time_step",
         "found 0.001 s, longer than the critical step"),
        ("pressure = 10e6", "pressure = inf", 28, "traction[1].pressure", "must be a finite number"),
    ]

    def test_is_refused_with_its_place(self):
        for old, new, line, key, words in self.CASES:
            with self.subTest(key=key, new=new):
                self.assertIn(old, PRESSED)
                self.write("bad.toml", PRESSED.replace(old, new, 1))
                done = self.run_program("run", "bad.toml", status=2)
                self.assertRegex(done.stderr.splitlines()[0], rf"^bad\.toml:{line}:\d+: {re.escape(key)}: .*{re.escape(words)}")
                self.assertNotIn("bad.vtkhdf", self.files())

    def test_of_a_static_analysis_that_nothing_holds_names_the_free_motions(self):
        free = re.sub(r"(?s)\[\[fixed\]\].*(?=\[\[traction)", "", PRESSED)
        self.write("bad.toml", free)
        self.assertIn("nothing holds the rock, it is free to move along x, y and z and to turn about them",
                      self.run_program("run", "bad.toml", status=2).stderr)
        self.write("bad.toml", PRESSED.replace('components = ["x"]', 'components = ["z"]'))
        self.assertIn("block 1 (translation along (1.000, 0.000, 0.000))", self.run_program("run", "bad.toml", status=1).stderr)


class DividedSteps(ProgramTest):
    def run_spun(self, *options):
        self.write("spun.toml", SPUN)
        document = self.json_of("run", "spun.toml", *options)
        return document["totals"], [text for text in document["warnings"] if "divided" in text]

    def test_that_did_not_converge_are_told(self):
        totals, warnings = self.run_spun()
        self.assertGreater(totals["divided_steps"], 0)
        self.assertEqual(warnings, [
            f"{totals['divided_steps']} of 3 steps did not converge at once and were divided, into {totals['largest_substeps']} "
            "parts at most (analysis.time_step = 0.2 s): with a shorter one all steps would be alike"])

    def test_as_the_user_asked_are_no_news(self):
        totals, warnings = self.run_spun("--set", "analysis.time_step=0.05", "--set", "analysis.max_displacement_ratio=1")
        self.assertGreater(totals["largest_substeps"], 1)
        self.assertEqual((totals["divided_steps"], warnings), (0, []))


class NoConvergence(ProgramTest):
    def states(self):
        return self.json_of("info", "slow.vtkhdf")["states"]["step"]

    def test_of_a_static_analysis_says_how_far_it_came(self):
        self.write("slow.toml", PRESSED + "[solver]\npreconditioner = 'node_block_jacobi'\nmax_iterations = 2\n")
        done = self.run_program("run", "slow.toml", status=1)
        self.assertRegex(done.stderr, r"step 1, time \S+ s: the solver did not converge: residual [\d.e-]+ after 2 iterations")
        self.assertIn("slow.vtkhdf holds the state before it did", done.stderr)
        self.assertEqual(self.states(), [0])

    def test_keeps_the_last_good_state(self):
        """Nothing moves until 0.025 s, so that the third step is the first that has to be solved."""
        text = PRESSED.replace('type = "static"', DYNAMIC).replace("pressure = 10e6", "pressure_table = [[0, 0], [0.025, 0], [0.03, 1e7]]")
        self.write("slow.toml", text + "[solver]\npreconditioner = 'node_block_jacobi'\nmax_iterations = 2\n[output]\nevery = 0\n")
        done = self.run_program("run", "slow.toml", status=1)
        self.assertIn("step 3, time 0.03 s: the solver did not converge", done.stderr)
        self.assertIn("slow.vtkhdf holds the 2 states before it did", done.stderr)
        self.assertEqual(self.states(), [0, 2])

    def test_is_not_what_a_full_disk_is_called(self):
        text = PRESSED.replace('type = "static"', 'type = "dynamic"\ntime_step = 1e-3\nsteps = 40') + "[output]\nevery = 1\n"
        self.write("slow.toml", text)
        self.run_program("run", "slow.toml")
        most = (self.folder / "slow.vtkhdf").stat().st_size * 3 // 4
        done = subprocess.run([BINARY, "run", "slow.toml", "-q"], cwd=self.folder, capture_output=True, text=True, check=False,
                              restore_signals=False,  # no SIGXFSZ
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertNotIn("analysis failed", done.stderr)
        self.assertRegex(done.stderr, r"no more results could be written; \S*slow\.vtkhdf holds the (state|\d+ states) before that")

    def test_of_the_first_acceleration_keeps_the_start(self):
        self.write("slow.toml", PRESSED.replace('type = "static"', DYNAMIC + "\nnewmark = {beta = 0.3, gamma = 0.6}") +
                   "[solver]\npreconditioner = 'node_block_jacobi'\nmax_iterations = 1\n")
        self.assertIn("step 0, time 0 s: the solver did not converge", self.run_program("run", "slow.toml", status=1).stderr)
        self.assertEqual(self.states(), [0])


class Warnings(ProgramTest):
    def test_name_keys_that_have_no_use_in_a_static_analysis(self):
        self.write("still.toml", PRESSED.replace('type = "static"', 'type = "static"\ndynamic_ratio = 0.5\nrayleigh = {alpha = 1}'))
        self.assertIn("of no use in a static analysis, which has no time: analysis.dynamic_ratio, analysis.rayleigh\n",
                      self.run_program("run", "still.toml").stderr)
        self.write("still.toml", PRESSED)
        self.assertNotIn("warning", self.run_program("run", "still.toml").stderr)

    def test_name_a_stiffness_of_points_that_are_held_exactly(self):
        held = PRESSED.replace("[[fixed]]\n", "[[fixed]]\nstiffness = 1e9\n")
        self.write("springs.toml", held)
        self.assertNotIn("warning", self.run_program("run", "springs.toml").stderr)
        self.write("held.toml", held.replace("stiffness = 1e9\n", 'stiffness = 1e9\nmethod = "augmented_lagrangian"\n'))
        self.assertRegex(self.run_program("run", "held.toml").stderr,
                         r"held\.toml:\d+:.*fixed\[1\]\.stiffness: is of no use: points are held exactly")

    @unittest.skipIf(SANITIZED, "a large model")
    def test_tell_where_factors_were_asked_for_but_are_out_of_reach(self):
        direct = PRESSED + '[solver]\npreconditioner = "direct"\n'
        self.write("small.toml", direct)
        self.assertNotIn("warning", self.run_program("run", "small.toml").stderr)
        self.write("large.toml", direct.replace("spacing = 0.7", "spacing = 0.03"))
        self.assertRegex(self.run_program("run", "large.toml").stderr, "factors are out of reach .* solved with multigrid")

    def test_name_conditions_that_contradict_each_other(self):
        again = PRESSED.split("[[fixed]]")[1].split("[[")[0]
        self.write("torn.toml", PRESSED + "[[fixed]]" + again + "value = [0.1, 0, 0]\n")
        done = self.run_program("run", "torn.toml", status=2)
        self.assertRegex(done.stderr, r"torn\.toml:\d+:\d*:? ?fixed\[\d\]: contradicts fixed\[1\] \(line \d+\) at t = 0 s, in x at \(")
        # Tables count as they are at t = 1 s in a static analysis.
        self.write("static.toml", PRESSED + "[[fixed]]" + again + "value_table = [[0, 0, 0, 0], [1, 0.1, 0, 0]]\n")
        self.assertRegex(self.run_program("run", "static.toml", status=2).stderr, r"contradicts fixed\[1\] \(line \d+\) after t = 0 s, in x")

    def test_name_supports_of_one_block_that_differ_only_later(self):
        supports = PRESSED.index("[[fixed]]"), PRESSED.index("[[traction]]")
        later = "value_table = [[0, 0, 0, 0], [1, 0, 0, 0], [21, 0, 0, -0.05]]\n"
        text = (PRESSED[:supports[0]] + "[[fixed]]\nwhere = {block_at = [0.5, 0.5, 0.1]}\n[[fixed]]\nwhere = {block_at = [0.5, 0.5, 1.9]}\n" + later
                + '[analysis]\ntype = "quasi_static"\ntime_step = 1\nsteps = 5\n').replace("spacing = 0.7", 'lattice = "block"')
        self.write("later.toml", text)
        for command in ("check", "run"):
            self.assertRegex(self.run_program(command, "later.toml", status=2).stderr,
                             r"later\.toml:\d+.*fixed\[2\]: contradicts fixed\[1\] \(line \d+\) after t = 1 s, in z at \(.*\): at t = 5 s it prescribes -0\.01 m, where fixed\[1\] \(line \d+\) makes 0 m")
        self.write("before.toml", text.replace("steps = 5", "steps = 1"))
        self.run_program("check", "before.toml")


if __name__ == "__main__":
    unittest.main()
