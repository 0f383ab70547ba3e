"""The example models that the program brings along."""

from __future__ import annotations

import os
from pathlib import Path

from rockfold.models import Model
from rockfold.program import ask


def examples() -> dict[str, str]:
    """Their names, and what each shows."""
    return {one["name"]: one["summary"] for one in ask(["examples"])["examples"]}


def example(name: str, folder: str | os.PathLike[str]) -> Model:
    """Writes an example, and the files that it names, into a folder, and reads it. Throws RockfoldError for a name that is not known, and
    where a file is there already."""
    if not name:
        raise ValueError("which example? rockfold.examples() has their names")
    Path(folder).mkdir(parents=True, exist_ok=True)
    return Model.read(Path(folder) / ask(["examples", name], folder=folder)["written"])
