"""Blocky rock from Python: the program Rockfold, its answers as dictionaries and tables, its results as arrays.

    import rockfold

    model = rockfold.Model.read("slope.toml")
    model["joint_material"][0]["friction_angle"] = 30
    answer = rockfold.support(model)
    print(answer["totals"]["keyblocks"], [block["factor_of_safety"] for block in answer["keyblocks"]])
    print(answer.result.blocks.volume[:])       # m3

Units are SI, angles degrees; blocks are numbered from 1 in answers, from 0 in arrays.
"""

from rockfold.commands import check, cut, resume, run, sets, stability, support, theory, verify
from rockfold.answers import Answer
from rockfold.errors import AnalysisError, Fault, FileError, ModelError, RockfoldError, RockfoldWarning, UsageError
from rockfold.examples import example, examples
from rockfold.models import Model
from rockfold.pages import report, view
from rockfold.program import Progress, kept_loaded, program, use_program, version
from rockfold.results import Blocks, Mesh, Result, open_result
from rockfold.sweeps import Sweep, sweep

__all__ = [
    "AnalysisError", "Answer", "Blocks", "Fault", "FileError", "Mesh", "Model", "ModelError", "Progress", "Result",
    "RockfoldError", "RockfoldWarning", "Sweep", "UsageError", "check", "cut", "example", "examples", "kept_loaded", "open_result", "program", "report",
    "resume", "run", "sets", "stability", "support", "sweep", "theory", "use_program", "verify", "version", "view",
]
