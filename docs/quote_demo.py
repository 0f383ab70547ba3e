"""Writes what `rockfold demo` prints into docs/user_guide.md: python3 docs/quote_demo.py build/release/rockfold"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

GUIDE = Path(__file__).resolve().parent / "user_guide.md"
COMMAND = "rockfold demo --threads 2"


def quoted(guide):
    """The output that the guide's text quotes, and its place there."""
    found = re.search(rf"^\$ {re.escape(COMMAND)}\n(.*?)^```$", guide, re.M | re.S)
    return found.group(1), found.span(1)


def main(binary):
    binary = os.path.abspath(binary)
    with tempfile.TemporaryDirectory() as folder:
        text = subprocess.run([binary, *COMMAND.split()[1:]], cwd=folder, text=True, capture_output=True, check=True).stdout
        text = text.replace(os.path.realpath(folder), "/home/me")
    guide = GUIDE.read_text(encoding="utf-8")
    begin, end = quoted(guide)[1]
    GUIDE.write_text(guide[:begin] + text.rstrip("\n") + "\n" + guide[end:], encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
