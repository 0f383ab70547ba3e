"""Many runs of one model."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rockfold.models import Model, toml_of
from rockfold.program import ProgressCallback, ask

if TYPE_CHECKING:
    import pandas


class Sweep:
    """What a sweep has computed: its `document`, and a table with a row a run in its `folder`."""

    def __init__(self, document: dict[str, Any], folder: Path) -> None:
        self.document = document
        self.folder = Path(os.path.abspath(folder))

    def columns(self) -> dict[str, np.ndarray]:
        """The table by its headings (run, status, seconds, error, parameters, results, events), [runs]: numbers where all are, NaN where one is
        missing; else texts."""
        with open(self.folder / "sweep.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        return {name: _column(name, [row[c] for row in rows[1:]]) for c, name in enumerate(rows[0])}

    def table(self) -> pandas.DataFrame:
        """The same as a table of pandas. Throws ImportError without."""
        import pandas

        return pandas.DataFrame(self.columns())


def _column(name: str, texts: list[str]) -> np.ndarray:
    if name in ("status", "error"):
        return np.array(texts)
    if texts and set(texts) <= {"true", "false"}:
        return np.array([text == "true" for text in texts])
    for numbers in (int, lambda text: float(text) if text else np.nan):
        try:
            return np.array([numbers(text) for text in texts])
        except ValueError:
            pass
    return np.array(texts)


def sweep(plan: str | os.PathLike[str] | Mapping[str, Any], output: str | os.PathLike[str] | None = None, *,
          model: Mapping[str, Any] | None = None, workers: int | None = None,
          progress: ProgressCallback | None = None) -> Sweep:
    """Runs a sweep: `plan` is the path of a SWEEP.toml, or what stands in one as a dictionary, which needs an `output` folder. `model`: a
    model as a dictionary, instead of the plan's; it is kept in the folder. Started again it goes on. Throws RockfoldError."""
    if isinstance(plan, Mapping):
        if output is None:
            raise ValueError("a plan that is no file needs an output folder")
        plan = _written(plan, Path(output), model)
    elif model is not None:
        raise ValueError("the model of a plan in a file stands in that file")
    folder = Path(output) if output is not None else Path(plan).with_suffix("")
    arguments = ["sweep", os.fspath(plan), "-o", str(folder)] + (["--workers", str(workers)] if workers else [])
    return Sweep(ask(arguments, progress=progress), folder)


def _written(plan: Mapping[str, Any], folder: Path, model: Mapping[str, Any] | None) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    values = dict(plan)
    if isinstance(model, (str, os.PathLike)):
        values["model"], model = model, None
    if model is not None:
        values["model"] = "model.toml"
        (folder / "model.toml").write_text(toml_of(_with_absolute_files(model)), encoding="utf-8")
    else:
        if not isinstance(values.get("model"), (str, os.PathLike)):
            raise ValueError("a plan needs a model: its path as plan[\"model\"], or model= a dictionary")
        values["model"] = os.path.abspath(values["model"])
    path = folder / "plan.toml"
    path.write_text(toml_of(values), encoding="utf-8")
    return path


def _with_absolute_files(model: Mapping[str, Any]) -> dict[str, Any]:
    """A model whose files are found from any folder."""
    folder = model.folder if isinstance(model, Model) else Path(".")

    def absolute(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: os.path.abspath(folder / one) if key == "file" and isinstance(one, (str, os.PathLike)) else absolute(one)
                    for key, one in value.items()}
        return [absolute(one) for one in value] if isinstance(value, (list, tuple)) else value

    written: dict[str, Any] = absolute(model)
    return written
