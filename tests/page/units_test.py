"""The page's own code: its types, and its parts one by one."""
import subprocess
import sys
from web_packages import BINARY, WEB, node, packages


def main():
    modules = packages()
    tree = BINARY.parent / "web-test"
    # The type checker looks for packages above the files: beside a link to the sources.
    link = tree / "src"
    if link.is_symlink():
        link.unlink()
    link.symlink_to(WEB)
    types = subprocess.run([str(modules / ".bin" / "tsc"), "--project", str(tree / "src" / "tsconfig.json"), "--preserveSymlinks",
                            "--typeRoots", str(modules / "@types"), "--noEmit"], cwd=tree)
    units = node("test/run.mjs", tree / "units")
    return types.returncode or units


if __name__ == "__main__":
    sys.exit(main())
