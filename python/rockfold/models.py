"""Models: what stands in a model file, as a dictionary."""

from __future__ import annotations

import copy
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


class Model(dict[str, Any]):
    """A model as a dictionary with the keys of the model file (docs/user_guide.md); arrays of numpy are lists to it.

    `folder`: where files that it names lie.
    """

    def __init__(self, values: Mapping[str, Any] | None = None, folder: str | os.PathLike[str] | None = None, **keys: Any) -> None:
        super().__init__(copy.deepcopy(dict(values or {})), **keys)
        of_values = values.folder if isinstance(values, Model) else "."
        self.folder = Path(os.path.abspath(of_values if folder is None else folder))

    def __or__(self, other: Mapping[str, Any]) -> Model:  # type: ignore[override]
        return Model({**self, **other}, self.folder)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Model:
        """The model of a TOML file. Throws OSError, or ValueError where it is no TOML."""
        with open(path, "rb") as file:
            return cls(tomllib.load(file), Path(path).parent)

    @classmethod
    def parse(cls, text: str, folder: str | os.PathLike[str] = ".") -> Model:
        """The model of a TOML text. Throws ValueError where it is none."""
        return cls(tomllib.loads(text), folder)

    def copy(self) -> Model:
        """A model of its own: what is changed in it does not change this one."""
        return copy.deepcopy(self)

    def toml(self) -> str:
        """The text of its file. Throws TypeError for a value that TOML does not have."""
        return toml_of(self)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Its file; files that it names are looked for beside it."""
        Path(path).write_text(self.toml(), encoding="utf-8")


def _plain(value: Any) -> Any:
    """Without types of numpy, and without keys whose value is None."""
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items() if one is not None}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return _plain(value.tolist()) if hasattr(value, "tolist") else value


def toml_of(values: Mapping[str, Any]) -> str:
    """The TOML text of a dictionary."""
    return tomli_w.dumps(_plain(values))


def toml_value(value: Any) -> str:
    """A value as it stands in TOML behind its key, for --set."""
    text = tomli_w.dumps({"value": [_plain(value)]})
    return text[text.index("[") + 1 : text.rindex("]")].strip().removesuffix(",")
