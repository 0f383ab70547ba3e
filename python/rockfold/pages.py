"""Results to look at and to print."""

from __future__ import annotations

import os
from pathlib import Path

from rockfold.program import ask


def view(result: str | os.PathLike[str], page: str | os.PathLike[str] | None = None, *, every: int = 1,
         surface_only: bool = False) -> Path:
    """Writes the page of a result (each `every`-th state; without blocks inside the rock); where it is. Throws RockfoldError."""
    arguments = ["view", os.fspath(result), "--every", str(every)] + (["--surface-only"] if surface_only else [])
    return Path(ask(arguments + (["-o", os.fspath(page)] if page is not None else []))["page"])


def report(result: str | os.PathLike[str], document: str | os.PathLike[str] | None = None) -> Path:
    """Writes the report of a result; where it is. Throws RockfoldError."""
    arguments = ["report", os.fspath(result)]
    return Path(ask(arguments + (["-o", os.fspath(document)] if document is not None else []))["report"])
