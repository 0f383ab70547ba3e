"""What the program refuses, as exceptions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong, and where: `line` and `column` count from 1, 0 where there is none."""

    message: str
    file: str = ""
    line: int = 0
    column: int = 0
    key: str = ""

    def __str__(self) -> str:
        place = self.file
        for number in (self.line, self.column):
            place += f":{number}" if number > 0 else ""
        return ": ".join(part for part in (place, self.key, self.message) if part)


class RockfoldError(Exception):
    """The program ended with an error. `faults`: all of them; `status`: its exit status."""

    def __init__(self, faults: list[Fault], status: int, document: dict[str, Any] | None = None) -> None:
        super().__init__("\n".join(map(str, faults)))
        self.faults = faults
        self.status = status
        self.document = document  #: what there was of an answer, where it ended early

    def __reduce__(self) -> tuple[Any, ...]:  # to another process as well
        return type(self), (self.faults, self.status, self.document)

    def __getattr__(self, name: str) -> Any:
        # message, file, line, column and key of the first fault
        if name in Fault.__dataclass_fields__:
            return getattr(self.__dict__["faults"][0], name)
        raise AttributeError(name)


class RockfoldWarning(UserWarning):
    """What the program warns of; an answer's `warnings` has them too."""


class ModelError(RockfoldError):
    """The model is wrong."""


class UsageError(RockfoldError):
    """An argument is wrong."""


class FileError(RockfoldError):
    """A file could not be read or written."""


class AnalysisError(RockfoldError):
    """The analysis failed: it did not converge, or came to a limit."""


_KINDS = {"model": ModelError, "usage": UsageError, "io": FileError, "analysis": AnalysisError}


def error_of(error: dict[str, Any], status: int, document: dict[str, Any] | None = None) -> RockfoldError:
    """The exception for "error" of a document."""
    told = error.get("errors") or [error]
    faults = [Fault(**{key: one[key] for key in Fault.__dataclass_fields__ if key in one}) for one in told]
    return _KINDS.get(error.get("kind", ""), RockfoldError)(faults, status, document)
