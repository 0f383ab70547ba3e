"""A program that stays loaded, for many small questions."""

from __future__ import annotations

import json
import subprocess
import threading
from typing import IO


class Server:
    """`rockfold serve`: asked from one thread at a time."""

    def __init__(self, program: str, environment: dict[str, str]) -> None:
        self._process = subprocess.Popen([program, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self._lock = threading.Lock()

    def ask(self, arguments: list[str], text: str | None, folder: str) -> tuple[str, int]:
        """What a command writes, and its exit status. Throws OSError where the program is gone."""
        request = {"arguments": arguments, "folder": folder, "input": text or ""}
        with self._lock:
            try:
                pipes = self._pipes()
                pipes[0].write(json.dumps(request).encode() + b"\n")
                pipes[0].flush()
                header = json.loads(pipes[1].readline())
                said = pipes[1].read(header["bytes"]).decode("utf-8", "replace")
            except BaseException:
                self.end()  # what it would still say is the answer to no later question
                raise
        return said, int(header["status"])

    def end(self) -> None:
        for pipe in self._pipes():
            pipe.close()
        self._process.terminate()
        self._process.wait()

    def _pipes(self) -> tuple[IO[bytes], IO[bytes]]:
        assert self._process.stdin and self._process.stdout
        return self._process.stdin, self._process.stdout
