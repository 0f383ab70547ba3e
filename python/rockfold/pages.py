"""Results to look at and to print."""

from __future__ import annotations

import os
from pathlib import Path

from rockfold.answers import Answer
from rockfold.program import ask


def _path_of(result: str | os.PathLike[str] | Answer) -> str:
    return str(result.result.path) if isinstance(result, Answer) else os.fspath(result)


def view(result: str | os.PathLike[str] | Answer, page: str | os.PathLike[str] | None = None, *, every: int = 1,
         surface_only: bool = False) -> Path:
    """Writes the page of a result (each `every`-th state; without blocks inside the rock); where it is. Throws RockfoldError."""
    arguments = ["view", _path_of(result), "--every", str(every)] + (["--surface-only"] if surface_only else [])
    return Path(ask(arguments + (["-o", os.fspath(page)] if page is not None else []))["page"])


def report(result: str | os.PathLike[str] | Answer, document: str | os.PathLike[str] | None = None) -> Path:
    """Writes the report of a result; where it is. Throws RockfoldError."""
    arguments = ["report", _path_of(result)]
    return Path(ask(arguments + (["-o", os.fspath(document)] if document is not None else []))["report"])
