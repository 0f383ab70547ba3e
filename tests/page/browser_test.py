"""The page in a real browser without a network: src/web/test/browser.mjs says what is done with it."""
import subprocess
import sys
import tempfile
from pathlib import Path
from web_packages import BINARY, SOURCE, chromium, node, packages, skip

HOSTILE = '</script><script>window.hacked = 1</script><img src=x onerror="window.hacked = 2">'


def rockfold(folder, *arguments):
    return subprocess.run([str(BINARY), *arguments], cwd=folder, capture_output=True, text=True)


def make_page(folder, name, case, command, *more):
    """name.html and name.report.html of an example."""
    model = folder / f"{name}.toml"
    model.write_text((SOURCE / "tests" / "cases" / case / "model.toml").read_text(encoding="utf-8"), encoding="utf-8")
    for step in ([command, f"{name}.toml", "-q", *more], ["view", f"{name}.vtkhdf", "-q"], ["report", f"{name}.vtkhdf", "-q"]):
        done = rockfold(folder, *step)
        if "without npm" in done.stderr:
            skip("the program has no page")
        if done.returncode != 0:
            sys.exit(f"rockfold {' '.join(step)}: {done.stderr}")


def main():
    packages()
    browser = chromium()
    with tempfile.TemporaryDirectory(prefix="rockfold-page-") as name:
        folder = Path(name)
        make_page(folder, "wedge", "wedge", "support")
        make_page(folder, "tunnel", "bolted_tunnel", "support")
        make_page(folder, "fall", "free_fall", "run", "--set", "gravity=[0, 0, -10]")
        make_page(folder, "slide", "sliding_block", "run", "--set", "analysis.end_time=0.4")
        make_page(folder, "hostile", "cube", "cut", "--set", f"title='{HOSTILE}'")
        return node("test/browser.mjs", folder, browser, *sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
