"""Runs an example model with changed values, and the words in which a case tells what it found."""
import json
import os
import re
import subprocess
import tempfile
from dataclasses import asdict, dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
CASES = ROOT / "tests" / "cases"


class Rockfold:
    """The program, with the number of threads and the time limit of every run."""

    by_substeps = False

    def __init__(self, program=None, threads=2, timeout=1800):
        self.program = program or os.environ.get("ROCKFOLD_BINARY") or ROOT / "build" / "release" / "rockfold"
        self.threads, self.timeout = threads, timeout

    def run(self, case, changes=None, edit=None):
        """The JSON document of `rockfold run` for an example. `changes`: {key path: value}; `edit`: changes the model's text."""
        changes = {"solver.max_iterations": 50000, **(changes or {})}  # orders 1 and 2 on fine lattices take more than the default
        return self.answer("run", case, changes, edit)

    def support(self, case, changes=None, edit=None):
        """Likewise of `rockfold support`."""
        return self.answer("support", case, changes or {}, edit)

    def answer(self, command, case, changes, edit):
        with tempfile.TemporaryDirectory(prefix="rockfold-") as folder:
            text = (CASES / case / "model.toml").read_text(encoding="utf-8")
            model = Path(folder) / f"{case}.toml"
            model.write_text(edit(text) if edit else text, encoding="utf-8")
            sets = [word for key, value in changes.items() for word in ("--set", f"{key}={json.dumps(value)}")]
            done = subprocess.run([self.program, command, model, "--json", "-q", "--threads", str(self.threads), *sets],
                                  cwd=folder, capture_output=True, text=True, timeout=self.timeout, check=False,
                                  env=dict(os.environ, OMP_PROC_BIND="false"))
            if done.returncode:
                raise RuntimeError(f"{case} {' '.join(sets)}: exit status {done.returncode}\n{done.stderr}{done.stdout[:600]}")
            return json.loads(done.stdout)


class Explicit(Rockfold):
    """Takes the dynamic steps of block covers by explicit substeps."""

    by_substeps = True

    def answer(self, command, case, changes, edit):
        def by_substeps(text):
            text = edit(text) if edit else text
            if command != "run" or 'lattice = "block"' not in text or changes.get("analysis.type", "dynamic") != "dynamic":
                return text
            return re.sub(r'^type = "dynamic".*\n', '\\g<0>scheme = "explicit"\n', text, flags=re.M)
        return super().answer(command, case, changes, by_substeps)


def without(*keys):
    """An edit that takes `key = …` lines out of a model."""
    pattern = re.compile(rf"^(?:{'|'.join(map(re.escape, keys))}) *=.*\n", re.M)
    return lambda text: pattern.sub("", text)


def monitor(document, name):
    return next(entry for entry in document["monitors"] if entry["name"] == name)


def last(document, name, what, component):
    """Value at the end of a run. `component`: x, y, z of vectors; xx, yy, zz, xy, yz, zx of stress."""
    index = (["xx", "yy", "zz", "xy", "yz", "zx"] if what == "stress" else ["x", "y", "z"]).index(component)
    return monitor(document, name)[what][-1][index]


@dataclass
class Row:
    """One number beside its reference. `tolerance` is relative, or absolute where the reference is 0; `by_substeps` is that of explicit steps, where
    they may be farther off."""
    quantity: str
    unit: str
    reference: float
    ours: float
    tolerance: float
    origin: str
    by_substeps: float | None = None
    explicit: float | None = None  # ours by explicit steps

    def difference(self):
        return abs(self.ours - self.reference) / (abs(self.reference) or 1.0)

    def good(self):
        return self.difference() <= self.tolerance  # false for NaN


@dataclass
class Line:
    """One line of a figure. `style`: "ours" (marks and a line), "marks", "reference" (dashed) or "curve"."""
    label: str
    x: list
    y: list
    style: str = "ours"


@dataclass
class Panel:
    """One diagram. `slopes`: exponents whose triangles are drawn beside a double logarithmic diagram."""
    title: str
    x: str
    y: str
    lines: list = field(default_factory=list)
    log: str = ""            # "", "y" or "xy"
    slopes: list = field(default_factory=list)
    ticks: list = field(default_factory=list)  # names of the places 0, 1, … along x


@dataclass
class Findings:
    """What a case found: rows for the table, panels of its figure."""
    name: str
    title: str
    rows: list = field(default_factory=list)
    panels: list = field(default_factory=list)

    def row(self, *row, by_substeps=None):
        self.rows.append(Row(*row, by_substeps))

    def bad(self):
        return [row for row in self.rows if not row.good()]

    def for_substeps(self):
        """As what is found by explicit steps is judged."""
        for row in self.rows:
            row.tolerance = row.tolerance if row.by_substeps is None else row.by_substeps
        return self

    def document(self):
        """What is stored: of curves what a figure can show, 1,000 points of six digits."""
        document = asdict(self)
        for panel in document["panels"]:
            for line in panel["lines"]:
                every = -(-len(line["x"]) // 1000)
                for axis in ("x", "y"):
                    line[axis] = [float(f"{value:.6g}") for value in line[axis][::every]]
        return document
