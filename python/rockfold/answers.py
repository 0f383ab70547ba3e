"""What the program answers."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rockfold.results import Result, open_result

if TYPE_CHECKING:
    import pandas


class Answer(Mapping[str, Any]):
    """The document of a command, read like a dictionary: its keys stand in docs/user_guide.md, JSON documents.

    Of a command that writes a result, `result` has its arrays.
    """

    def __init__(self, document: dict[str, Any], path: Path | None = None, keep_alive: object = None) -> None:
        self.document = document
        self.path = path  #: of the result; None without
        self._keep_alive = keep_alive  # a folder that goes with the answer
        self._result: Result | None = None

    def __getitem__(self, key: str) -> Any:
        return self.document[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self.document)

    def __len__(self) -> int:
        return len(self.document)

    def __repr__(self) -> str:
        return f"<Answer of {self.document.get('command')}: {', '.join(self.document)}>"

    def __reduce__(self) -> tuple[Any, ...]:  # to another process: a result that goes with this answer stays here
        return Answer, (self.document, None if self._keep_alive else self.path)

    def __copy__(self) -> Answer:
        return Answer(self.document, self.path, self._keep_alive)

    def __deepcopy__(self, memo: dict[int, Any]) -> Answer:
        return Answer(copy.deepcopy(self.document, memo), self.path, self._keep_alive)

    @property
    def warnings(self) -> list[str]:
        return list(self.document.get("warnings", []))

    @property
    def result(self) -> Result:
        """Its arrays, opened when they are asked for. Throws AttributeError where none was written."""
        if self.path is None:
            raise AttributeError(f"`{self.document.get('command')}` was asked for its answer alone: it wrote no result")
        if self._result is None or self._result.closed:
            self._result = open_result(self.path)
            self._result._keep_alive = self._keep_alive
        return self._result

    def columns(self, name: str) -> dict[str, np.ndarray]:
        """A list of entries ("keyblocks", "blocks", "support.keyblocks", …) by their keys: arrays with an entry a row, [rows] or, of
        vectors, [rows][n]; NaN where a number is null. Values that are no numbers are arrays of objects."""
        entries = self._entries(name)
        keys = list(dict.fromkeys(key for entry in entries for key in entry))
        columns = _Columns({key: _column([entry.get(key) for entry in entries]) for key in keys})
        columns.empty = not entries
        return columns

    def table(self, name: str) -> pandas.DataFrame:
        """The same as a table of pandas; entries within entries stand as "rotation.axis". Throws ImportError without pandas."""
        import pandas

        return pandas.json_normalize(self._entries(name))

    def write(self, path: str | Path) -> None:
        """The document as a file."""
        Path(path).write_text(json.dumps(self.document, indent=1), encoding="utf-8")

    def _entries(self, name: str) -> list[dict[str, Any]]:
        found: Any = self.document
        for key in name.split("."):
            found = found[key]
        if not isinstance(found, list) or not all(isinstance(entry, dict) for entry in found):
            raise KeyError(f"{name} is no list of entries")
        return found


class _Columns(dict[str, np.ndarray]):
    """Of a list without entries every column is there, and empty."""

    empty = False

    def __missing__(self, key: str) -> np.ndarray:
        if self.empty:
            return np.empty(0)
        raise KeyError(key)


def _column(values: list[Any]) -> np.ndarray:
    numbers = [np.nan if value is None else value for value in values]
    if all(isinstance(value, bool) for value in numbers):
        return np.array(numbers, dtype=bool)
    if all(isinstance(value, (int, float)) for value in numbers):
        return np.array(numbers)
    rows = {len(value) for value in values if isinstance(value, list)}
    flat = all(isinstance(value, list) and all(isinstance(one, (int, float)) for one in value) for value in values)
    if flat and len(rows) == 1:
        return np.array(values, dtype=float)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
