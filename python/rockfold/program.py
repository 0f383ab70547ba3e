"""Runs the program, and finds it."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rockfold.errors import Fault, FileError, RockfoldError, RockfoldWarning, error_of
from rockfold.server import Server

_chosen: str | None = None
_server: Server | None = None


@dataclass(frozen=True)
class Progress:
    """How far a phase is: `done` of `total` (None: unknown) `unit`s after `seconds`."""

    phase: str
    unit: str
    done: int
    total: int | None
    seconds: float
    ended: bool


ProgressCallback = Callable[[Progress], None]


def use_program(path: str | os.PathLike[str] | None) -> None:
    """Runs this program from now on; None: the one that is found."""
    global _chosen
    _chosen = None if path is None else os.fspath(path)


def program() -> str:
    """The program that is run: of use_program(), of the variable ROCKFOLD, on the PATH, or built in the checkout that this
    package lies in. Throws FileError where there is none."""
    built = Path(__file__).resolve().parents[2] / "build" / "release" / "rockfold"
    for candidate in (_chosen, os.environ.get("ROCKFOLD"), "rockfold", str(built)):
        found = shutil.which(candidate) if candidate else None
        if found:
            return os.path.abspath(found)
        if candidate and candidate in (_chosen, os.environ.get("ROCKFOLD")):
            raise FileError([Fault("is no program that could be run", candidate)], 3)
    raise FileError([Fault("the program was not found: put it on the PATH, name it in the variable ROCKFOLD, or call "
                           "rockfold.use_program(path)", "rockfold")], 3)


def version() -> str:
    """Of the program: "rockfold 0.1.0 (commit)"."""
    return subprocess.run([program(), "--version"], check=True, capture_output=True, text=True).stdout.strip()


@contextmanager
def kept_loaded() -> Iterator[None]:
    """Within it, questions without `progress` go to one program that stays loaded: for many small ones.

        with rockfold.kept_loaded():
            factors = [rockfold.support(model, {"joint_material.1.friction_angle": angle}, output=False) for angle in range(20, 40)]
    """
    global _server
    before, _server = _server, Server(program(), _environment())
    try:
        yield
    finally:
        _server.end()
        _server = before


def _environment() -> dict[str, str]:
    """With what the program would set, and start itself anew for (src/app/process/threads.cpp)."""
    environment = dict(os.environ)
    if "OMP_WAIT_POLICY" not in environment:
        environment.setdefault("GOMP_SPINCOUNT", "1000")
    return environment


def ask(arguments: list[str], text: str | None = None, folder: str | os.PathLike[str] | None = None,
        progress: ProgressCallback | None = None) -> dict[str, Any]:
    """Runs the program with --json and gives its document; `text` is its standard input, `folder` where it runs.

    Throws RockfoldError where it ends with an error. An exception of `progress`, or Ctrl-C, ends the program as Ctrl-C on a terminal
    does: a run leaves a checkpoint.
    """
    if _server and not progress:
        said, status = _server.ask([*arguments, "--json", "--quiet"], text, os.path.abspath(folder or "."))
        return _document(said, "", status)
    command = [program(), *arguments, "--json", "--quiet"]
    listener = _Listener(progress) if progress else None
    if listener:
        command += ["--progress-fd", str(listener.writes)]
    try:
        process = _start(command, folder, listener)
    except OSError as wrong:
        if listener:
            listener.close()
        raise FileError([Fault(str(wrong.strerror), os.fspath(wrong.filename or command[0]))], 3) from None
    try:
        if listener:
            listener.listen(process)
        said, warned = process.communicate(text)
    except BaseException:
        process.send_signal(signal.SIGINT)
        process.communicate()
        raise
    if listener:
        listener.end()
    return _document(said, warned, process.returncode)


def _start(command: list[str], folder: str | os.PathLike[str] | None, listener: _Listener | None) -> subprocess.Popen[str]:
    # In a session of its own, so that Ctrl-C on a terminal reaches it once, by this process: twice would end it at once.
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            encoding="utf-8", errors="replace", cwd=folder, env=_environment(), start_new_session=True,
                            pass_fds=[listener.writes] if listener else [])


def _document(said: str, warned: str, status: int) -> dict[str, Any]:
    try:
        document: dict[str, Any] = json.loads(said)
    except ValueError:
        why = warned.strip() or f"ended with status {status} and without an answer"
        raise RockfoldError([Fault(why)], status) from None
    if "error" in document:
        raise error_of(document["error"], status, document)
    for warning in document.get("warnings", []):
        warnings.warn(warning, RockfoldWarning, stacklevel=4)
    return document


class _Listener:
    """Reads what a process tells of its progress, on a thread of its own."""

    def __init__(self, callback: ProgressCallback) -> None:
        self._callback = callback
        self._reads, self.writes = os.pipe()
        self._failed: BaseException | None = None
        self._thread: threading.Thread | None = None

    def listen(self, process: subprocess.Popen[str]) -> None:
        os.close(self.writes)
        self._thread = threading.Thread(target=self._read, args=(process,), daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Where no process has been started."""
        os.close(self._reads)
        os.close(self.writes)

    def end(self) -> None:
        assert self._thread
        self._thread.join()
        if self._failed:
            raise self._failed

    def _read(self, process: subprocess.Popen[str]) -> None:
        with open(self._reads, encoding="utf-8") as lines:
            for line in lines:
                if self._failed:
                    continue
                try:
                    self._callback(Progress(**json.loads(line)))
                except BaseException as failed:  # raised where the answer is waited for
                    self._failed = failed
                    process.send_signal(signal.SIGINT)
