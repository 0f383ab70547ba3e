"""Result files as arrays: docs/result_file.md says what they hold. Nothing is read before it is asked for."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from rockfold.errors import Fault, FileError
from rockfold.models import Model

if TYPE_CHECKING:
    import pyvista
    import trimesh


class Arrays:
    """The arrays of a group as attributes: `group.volume[:]` reads one, `group.volume[3:5]` a part of it."""

    def __init__(self, group: h5py.Group | None, name: str) -> None:
        self._group = group
        self._name = name

    def __getattr__(self, name: str) -> h5py.Dataset:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name.removesuffix("_")]  # class_, since class is a word of Python
        except KeyError as missing:
            raise AttributeError(missing.args[0]) from None

    def __getitem__(self, name: str) -> h5py.Dataset:
        if self._group is None or name not in self._group:
            raise KeyError(f"the result has no {self._name}.{name}; it has {', '.join(self) or 'none of them'}")
        return self._group[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(self._group) if self._group is not None else ())

    def __bool__(self) -> bool:
        return self._group is not None

    def read(self) -> dict[str, np.ndarray]:
        """All of them."""
        return {name: self[name][()] for name in self}


class Blocks(Arrays):
    """Arrays of the blocks: volume [B] m3, centroid [B][3] m, vertex [V][3] m, face_area [F] m2, face_normal [F][3], stage [B], … The
    vertices of block b (from 0) are vertex_begin[b] to vertex_begin[b + 1], its faces face_begin[b] to face_begin[b + 1]."""

    def __len__(self) -> int:
        return len(self.volume)

    def vertices(self, block: int) -> np.ndarray:
        """[n][3] m, of a block counted from 0."""
        block = self._counted(block)
        begin, end = self.vertex_begin[block : block + 2]
        return self.vertex[begin:end]

    def faces(self, block: int) -> list[list[np.ndarray]]:
        """The loops of each face of a block counted from 0: corners [n][3] m, counter-clockwise seen from outside; the first is the outer
        one, the others are holes."""
        block = self._counted(block)
        first, last = self.face_begin[block : block + 2]
        loops = self.loop_begin[first : last + 1]
        corners = self.corner_begin[loops[0] : loops[-1] + 1]
        places = self.vertex[self.vertex_begin[block] : self.vertex_begin[block + 1]]
        of_corner = self.corner_vertex[corners[0] : corners[-1]] - self.vertex_begin[block]
        found = [places[of_corner[a - corners[0] : b - corners[0]]] for a, b in zip(corners[:-1], corners[1:])]
        return [found[a - loops[0] : b - loops[0]] for a, b in zip(loops[:-1], loops[1:])]


    def _counted(self, block: int) -> int:
        count = len(self)
        if not -count <= block < count:
            raise IndexError(f"block {block}: there are {count}, counted from 0")
        return block % count


@dataclass
class Mesh:
    """Convex polygons: polygon c has the points connectivity[offsets[c]] to connectivity[offsets[c + 1] − 1].

    `fields`: values of the polygons, [C] or [C][n], as ParaView shows them: block, origin and material count from 1 (0: unknown), unlike
    the arrays of `Result`; factor_of_safety is NaN where there is none, and where nothing resists (class 3: a key block).
    """

    points: np.ndarray  #: [V][3] m
    connectivity: np.ndarray  #: [·] into points
    offsets: np.ndarray  #: [C + 1]
    fields: dict[str, np.ndarray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def polygons(self) -> Iterator[np.ndarray]:
        """The corners of each, [n][3] m."""
        for begin, end in zip(self.offsets[:-1], self.offsets[1:]):
            yield self.points[self.connectivity[begin:end]]

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """[T][3] into points, and the polygon of each, [T]."""
        corners = np.diff(self.offsets)
        of_polygon = np.repeat(np.arange(len(corners)), np.maximum(corners - 2, 0))
        begin = self.offsets[:-1][of_polygon]
        starts = np.cumsum(np.maximum(corners - 2, 0)) - np.maximum(corners - 2, 0)
        step = np.arange(len(of_polygon)) - starts[of_polygon]
        at = np.stack([begin, begin + step + 1, begin + step + 2], axis=1)
        return self.connectivity[at], of_polygon

    def of_block(self, block: int) -> Mesh:
        """The polygons of one block, counted from 1."""
        chosen = np.flatnonzero(self.fields["block"] == block)
        parts = [self.connectivity[self.offsets[c] : self.offsets[c + 1]] for c in chosen]
        joined = np.concatenate(parts) if parts else np.empty(0, dtype=self.connectivity.dtype)
        used, renumbered = np.unique(joined, return_inverse=True)
        offsets = np.concatenate([[0], np.cumsum([len(part) for part in parts])]).astype(self.offsets.dtype)
        return Mesh(self.points[used], renumbered, offsets, {name: values[chosen] for name, values in self.fields.items()})

    def to_pyvista(self) -> pyvista.PolyData:
        """Throws ImportError without pyvista."""
        import pyvista

        counts = np.diff(self.offsets)
        faces = np.insert(self.connectivity, self.offsets[:-1], counts)
        mesh = pyvista.PolyData(self.points, faces)
        for name, values in self.fields.items():
            mesh.cell_data[name] = values
        return mesh

    def to_trimesh(self) -> trimesh.Trimesh:
        """Its triangles, one body of all polygons. Throws ImportError without trimesh."""
        import trimesh

        triangles, _ = self.triangles()
        return trimesh.Trimesh(self.points, triangles, process=False)


class Result:
    """A result file. Close it, or use it in a `with`."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        try:
            self._file = h5py.File(path, "r", locking=False)
            self._data = self._file["rockfold"]
        except (OSError, KeyError) as wrong:
            raise FileError([Fault(f"is no result of rockfold: {wrong}", os.fspath(path))], 3) from None
        self._keep_alive: object = None
        self.path = Path(path)

    def close(self) -> None:
        self._file.close()

    @property
    def closed(self) -> bool:
        return not self._file

    def __enter__(self) -> Result:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Result {self.path}: {self.title}, {len(self.blocks)} blocks, {len(self.times)} states>"

    @property
    def file(self) -> h5py.File:
        """The open file, for what has no name here."""
        return self._file

    @property
    def title(self) -> str:
        return _text(self._data.attrs["title"])

    @property
    def command(self) -> str:
        return _text(self._data.attrs["command"])

    @property
    def model(self) -> Model:
        """With the overrides of the command line; files that it names lie where they lay."""
        text = self._data["model"][()]
        return Model.parse(text.decode() if isinstance(text, bytes) else str(text))

    @property
    def document(self) -> dict[str, Any]:
        """What the command answered, without its list of blocks."""
        name = "run/document" if "run/document" in self._data else "answer"
        document: dict[str, Any] = json.loads(bytes(self._data[name][()]))
        return document

    @property
    def blocks(self) -> Blocks:
        return Blocks(self._data["blocks"], "blocks")

    @property
    def interfaces(self) -> Arrays:
        """Pairs of faces that touch in a joint: block [I][2] and face [I][2], from 0; area [I] m2."""
        return self._arrays("interfaces")

    @property
    def block_theory(self) -> Arrays:
        """class, batch, mode, factor_of_safety, sliding_force, support_force [B], direction [B][3]; false where it was not asked for."""
        return self._arrays("block_theory")

    @property
    def covers(self) -> Arrays:
        return self._arrays("covers")

    @property
    def contacts(self) -> Arrays:
        """Contact points of all states one after another; states.contact_count of each."""
        return self._arrays("contacts")

    @property
    def states(self) -> Arrays:
        """time, step [S], displacement and velocity [S][U][3] of the unknowns, …; false without."""
        return self._arrays("states")

    @property
    def energy(self) -> Arrays:
        """time and each energy, J, [T] of every step."""
        return self._arrays("energy")

    @property
    def monitors(self) -> dict[str, Arrays]:
        """By their names (numbers where they have none): time [T], displacement, velocity [T][3], stress [T][6], …"""
        group = self._data.get("monitors", {})
        found = sorted(group, key=int)
        return {_text(group[number].attrs.get("name")) or number: Arrays(group[number], "monitor") for number in found}

    @property
    def materials(self) -> list[str]:
        return self._names("materials")

    @property
    def origins(self) -> list[str]:
        """What faces come from: joints, faces of solids and of excavations. blocks.face_origin counts them."""
        return self._names("origins")

    @property
    def times(self) -> np.ndarray:
        """[S] s, of the states."""
        return self._data["states/time"][:] if "states" in self._data else np.empty(0)

    def displacement(self, state: int = -1, of: str = "Blocks") -> np.ndarray:
        """[V][3] m, of the points of a mesh, that of "Blocks" being blocks.vertex."""
        return self._point_values("displacement", state, of)

    def velocity(self, state: int = -1, of: str = "Blocks") -> np.ndarray:
        """[V][3] m/s, likewise."""
        return self._point_values("velocity", state, of)

    def mesh(self, of: str = "Blocks", state: int | None = None) -> Mesh:
        """What ParaView shows as "Blocks", "Joints" or "DeadEnds", with the fields that do not change; moved as in a state, if one is given."""
        group = self._vtk(of)
        points = group["Points"][:]
        if state is not None:
            points = points + self.displacement(state, of)
        polygons = group["Polygons"]
        count = len(polygons["Offsets"]) - 1
        fields = {name: values[:] for name, values in group["CellData"].items() if len(values) == count}
        return Mesh(points, polygons["Connectivity"][:], polygons["Offsets"][:], fields)

    def _vtk(self, name: str) -> h5py.Group:
        group = self._file["VTKHDF"]
        if name not in group:
            there = [one for one in group if one != "Assembly"]
            raise KeyError(f"the result shows no {name}; it shows {', '.join(there)}")
        return group[name]

    def _point_values(self, name: str, state: int, of: str) -> np.ndarray:
        values = self._vtk(of).get(f"PointData/{name}")
        states = len(self.times)
        if values is None or states == 0:
            raise KeyError(f"the result has no {name} of {of}: `{self.command}` stores no states")
        if not -states <= state < states:
            raise IndexError(f"state {state}: there are {states}")
        points = len(values) // states
        begin = (state % states) * points
        return values[begin : begin + points]

    def _arrays(self, name: str) -> Arrays:
        return Arrays(self._data.get(name), name)

    def _names(self, name: str) -> list[str]:
        return [_text(one) for one in self._data[name]["name"][:]] if name in self._data else []


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value or "")


def open_result(path: str | os.PathLike[str]) -> Result:
    """Opens a result file. Throws FileError where it is none."""
    return Result(path)
