"""The commands that compute."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rockfold.answers import Answer
from rockfold.models import Model, toml_of, toml_value
from rockfold.program import ProgressCallback, ask

Input = str | os.PathLike[str] | Mapping[str, Any]


class _TemporaryResult:
    """A folder for a result that goes with its answer."""

    def __init__(self) -> None:
        folder = tempfile.mkdtemp(prefix="rockfold-")
        self.path = Path(folder) / "result.vtkhdf"
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)


def _common(changes: Mapping[str, Any] | None, seed: int | None, threads: int | None, max_time: float | None,
            max_memory: str | None, ignore: Sequence[str], yes: bool) -> list[str]:
    arguments: list[str] = []
    for key, value in (changes or {}).items():
        arguments += ["--set", f"{key}=" + ("" if value is None else toml_value(value))]
    for name, option in (("--seed", seed), ("--threads", threads), ("--max-time", max_time), ("--max-memory", max_memory)):
        if option is not None:
            arguments += [name, str(option)]
    for load in ignore:
        arguments += ["--ignore", load]
    return arguments + (["--yes"] if yes else [])


def _ask(command: str, model: Input, arguments: list[str], progress: ProgressCallback | None) -> dict[str, Any]:
    if isinstance(model, Mapping):
        folder = model.folder if isinstance(model, Model) else None
        return ask([command, "-", *arguments], toml_of(model), folder, progress)
    return ask([command, os.fspath(model), *arguments], None, None, progress)


def _with_result(command: str, model: Input, output: str | os.PathLike[str] | bool | None, arguments: list[str],
                 progress: ProgressCallback | None) -> Answer:
    if output is False:
        return Answer(_ask(command, model, [*arguments, "--no-result"], progress))
    temporary = _TemporaryResult() if output is None or output is True else None
    path = temporary.path if temporary else Path(os.path.abspath(os.fspath(output)))  # type: ignore[arg-type]
    document = _ask(command, model, [*arguments, "-o", str(path)], progress)
    return Answer(document, path, temporary)


_ARGUMENTS = """

    model: the path of a model file, or a model as a dictionary, whose files lie in Model.folder or the current folder.
    changes: values by their keys, as {"cover.spacing": 0.5, "joint_set.J1.dip": 40}; None takes a key out.
    output: the result file; None keeps it with the answer, False writes none (faster, and the answer has no arrays).
    seed: of random joint sets. threads: default all. max_time: s. max_memory: "4 GB". ignore: loads that the command does not use.
    yes: more than 100,000 blocks are meant. progress: is called with a Progress as phases go on.
    Throws RockfoldError with all that is wrong.
    """


def check(model: Input, changes: Mapping[str, Any] | None = None, *, seed: int | None = None, threads: int | None = None,
          estimate: bool = False, ignore: Sequence[str] = (), yes: bool = False) -> Answer:
    """Whether a model is right; `estimate`: with what a run will take."""
    arguments = _common(changes, seed, threads, None, None, ignore, yes) + (["--estimate"] if estimate else [])
    return Answer(_ask("check", model, arguments, None))


def theory(model: Input, changes: Mapping[str, Any] | None = None, *, seed: int | None = None, threads: int | None = None,
           ignore: Sequence[str] = ()) -> Answer:
    """Block theory of the joint sets alone."""
    return Answer(_ask("theory", model, _common(changes, seed, threads, None, None, ignore, False), None))


def cut(model: Input, changes: Mapping[str, Any] | None = None, *, output: str | os.PathLike[str] | bool | None = None,
        seed: int | None = None, threads: int | None = None, max_time: float | None = None, max_memory: str | None = None,
        ignore: Sequence[str] = (), yes: bool = False, progress: ProgressCallback | None = None) -> Answer:
    """Cuts the rock into blocks."""
    arguments = _common(changes, seed, threads, max_time, max_memory, ignore, yes)
    return _with_result("cut", model, output, arguments, progress)


def support(model: Input, changes: Mapping[str, Any] | None = None, *, output: str | os.PathLike[str] | bool | None = None,
            seed: int | None = None, threads: int | None = None, max_time: float | None = None, max_memory: str | None = None,
            ignore: Sequence[str] = (), yes: bool = False, progress: ProgressCallback | None = None) -> Answer:
    """Key blocks, and the support that they need."""
    arguments = _common(changes, seed, threads, max_time, max_memory, ignore, yes)
    return _with_result("support", model, output, arguments, progress)


def stability(model: Input, changes: Mapping[str, Any] | None = None, *, output: str | os.PathLike[str] | bool | None = None,
              certificate: str | os.PathLike[str] | None = None, seed: int | None = None, threads: int | None = None,
              max_time: float | None = None, max_memory: str | None = None, ignore: Sequence[str] = (), yes: bool = False,
              progress: ProgressCallback | None = None) -> Answer:
    """The factor of the whole mass; `certificate`: the file of its proof."""
    arguments = _common(changes, seed, threads, max_time, max_memory, ignore, yes)
    if certificate is not None:
        arguments += ["--certificate", os.path.abspath(certificate)]
    return _with_result("stability", model, output, arguments, progress)


def run(model: Input, changes: Mapping[str, Any] | None = None, *, output: str | os.PathLike[str] | bool | None = None,
        seed: int | None = None, threads: int | None = None, max_time: float | None = None, max_memory: str | None = None,
        ignore: Sequence[str] = (), yes: bool = False, progress: ProgressCallback | None = None) -> Answer:
    """The analysis: how the rock deforms, slides and falls."""
    arguments = _common(changes, seed, threads, max_time, max_memory, ignore, yes)
    return _with_result("run", model, output, arguments, progress)


for _command in (check, theory, cut, support, stability, run):
    _command.__doc__ = str(_command.__doc__) + _ARGUMENTS


def resume(result: str | os.PathLike[str], *, threads: int | None = None, progress: ProgressCallback | None = None) -> Answer:
    """Goes on with an interrupted run; its whole answer. Throws RockfoldError."""
    arguments = ["resume", os.fspath(result)] + (["--threads", str(threads)] if threads else [])
    return Answer(ask(arguments, progress=progress), Path(os.path.abspath(result)))


def verify(certificate: str | os.PathLike[str]) -> Answer:
    """Checks a certificate in rational arithmetic. Throws AnalysisError where it proves nothing, FileError where it is none."""
    return Answer(ask(["verify", os.fspath(certificate)]))


def sets(table: str | os.PathLike[str], *, scanline: tuple[float, float] | None = None, blind_zone: float | None = None,
         count: int | str | None = None, left_hand: bool = False, output: str | os.PathLike[str] | None = None,
         picture: str | os.PathLike[str] | None = None) -> Answer:
    """Joint sets of a survey, a table of orientations.

    scanline: trend and plunge of the line that crossed all joints, degrees. blind_zone: degrees (15). count: so many sets are looked for among
    the poles, "auto" as many as they tell of; None: those of the table's column, if it has one. left_hand: of strikes. output: a part of a
    model, .toml. picture: a stereonet, .svg. Throws RockfoldError with all that is wrong.
    """
    arguments = ["sets", os.fspath(table)]
    if scanline is not None:
        arguments += ["--scanline", f"{scanline[0]}/{scanline[1]}"]
    for name, option in (("--blind-zone", blind_zone), ("--sets", count)):
        if option is not None:
            arguments += [name, str(option)]
    for name, path in (("--output", output), ("--picture", picture)):
        if path is not None:
            arguments += [name, os.path.abspath(path)]
    return Answer(ask(arguments + (["--left-hand"] if left_hand else [])))
