"""What the tests of the page share: npm's packages, installed once beside the program, and Chromium."""
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

SOURCE = Path(os.environ["ROCKFOLD_SOURCE_DIR"])
BINARY = Path(os.environ["ROCKFOLD_BINARY"])
WEB = SOURCE / "src" / "web"
SKIPPED = 77  # CTest shows a test that ends with it as skipped


def skip(why):
    print(f"notice: {why}; the page is not tested")
    sys.exit(SKIPPED)


def packages():
    """The folder node_modules with what the page's tests need; skips where npm is missing or cannot fetch."""
    if not shutil.which("npm") or not shutil.which("node"):
        skip("npm was not found")
    tree = BINARY.parent / "web-test"
    tree.mkdir(exist_ok=True)
    lockfile = (WEB / "package-lock.json").read_bytes()
    stamp, wanted = tree / "npm.stamp", hashlib.sha256(lockfile).hexdigest()
    if not (stamp.exists() and stamp.read_text() == wanted):
        for name in ("package.json", "package-lock.json"):
            shutil.copy(WEB / name, tree / name)
        command = ["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts", "--fetch-timeout=10000", "--fetch-retries=0"]
        try:
            done = subprocess.run(command, cwd=tree, capture_output=True, text=True, timeout=180)
        except subprocess.TimeoutExpired:
            skip("npm took too long")
        if done.returncode != 0:
            skip("npm could not fetch its packages")
        stamp.write_text(wanted)
    return tree / "node_modules"


def node(script, *arguments):
    """Runs a script of src/web; its exit status."""
    modules = packages()
    environment = dict(os.environ, NODE_PATH=str(modules))
    return subprocess.run(["node", str(WEB / script), *map(str, arguments)], env=environment).returncode


def node_output(script, *arguments):
    """What a script of src/web prints; ends the test where it fails."""
    environment = dict(os.environ, NODE_PATH=str(packages()))
    done = subprocess.run(["node", str(WEB / script), *map(str, arguments)], env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def chromium():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            return path
    skip("chromium was not found (apt-get install chromium)")
