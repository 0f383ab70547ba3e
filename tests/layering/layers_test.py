#!/usr/bin/env python3
"""The include rules, as a test: who may include what (the table is RULES), and that a planted violation is seen.

usage: layers_test.py            check the repository, then the check itself on planted violations
"""
import os
import re
import sys
import tempfile
from pathlib import Path

# Header families by the first characters of the included path; a family may be included only from the files that match.
LIBRARIES = [
    ("Kokkos", r"Kokkos_|Kokkos/|kokkos", r"kernels/.*(\.cpp|_kernel\.hpp)$"),
    ("CGAL", r"CGAL/", r"host/.*(\.cpp|_exact\.hpp)$"),
    ("GMP or MPFR", r"gmp|mpfr", r"host/.*(\.cpp|_exact\.hpp)$"),
    ("Eigen", r"Eigen/", r"(host|kernels)/.*(\.cpp|_exact\.hpp|_kernel\.hpp)$"),
    ("HDF5", r"hdf5|H5", r"src/io/.*\.cpp$"),
    ("zlib", r"zlib", r"src/io/.*\.cpp$"),
    ("toml++", r"toml\+\+/|toml\.hpp|toml\.h$", r"src/model/text/[^/]*\.cpp$"),
    ("CLI11", r"CLI/", r"src/app/[^/]*\.(cpp|hpp)$"),
    ("nlohmann-json", r"nlohmann/", r"src/(app|io|page|printed|report|run|store|sweep)/.*\.(cpp|hpp)$"),
    ("fmt or spdlog", r"fmt/|spdlog/", r"(host/|src/(?!base/|arrays/|space/|system/)).*$"),
    ("MPI", r"mpi\.h$", r"src/sweep/mpi/[^/]*\.cpp$"),
    ("CUDA", r"cuda", r"kernels/device/.*(\.cpp|_kernel\.hpp)$"),
]

# layer: (its folder, the folders whose headers it may include). The first that matches a file counts.
LAYERS = [
    ("src/base", ("src/base/",)),
    ("src/arrays", ("src/base/", "src/arrays/")),
    ("src/space", ("src/base/", "src/arrays/", "src/space/")),
    ("src/system", ("src/base/", "src/arrays/", "src/space/", "src/system/")),
    ("src/model", ("src/base/", "src/arrays/", "src/space/", "src/model/")),
    ("src/io", ("src/base/", "src/arrays/", "src/space/", "src/model/", "src/io/", "generated/")),
    ("src", ("src/", "host/", "kernels/", "generated/")),
    ("host", ("src/base/", "src/arrays/", "src/space/", "src/model/", "host/")),
    ("kernels", ("src/base/", "src/arrays/", "src/space/", "src/system/", "kernels/")),
]
STANDARD_ALONE = ("src/base/", "src/arrays/", "src/space/", "src/system/")
POSIX = r"unistd\.h$|fcntl\.h$|signal\.h$|sys/|dirent\.h$|termios\.h$|omp\.h$|time\.h$|cstdatomic$"

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def is_private(path):
    return path.endswith(("_exact.hpp", "_kernel.hpp"))


def violations(root):
    """One line of text for each include that breaks a rule, sorted."""
    found = []
    for path in sorted(root.glob("*/**/*")):
        name = path.relative_to(root).as_posix()
        if not name.endswith((".cpp", ".hpp")) or not name.startswith(("src/", "host/", "kernels/")):
            continue
        layer, allowed = next((l, a) for l, a in LAYERS if name.startswith(l + "/"))
        for number, quote, header in includes(path):
            place = f"{name}:{number}: "
            if quote == '"':
                if not (root / header).is_file() and not header.startswith("generated/"):
                    found.append(place + f'"{header}" is no file below the repository\'s root')
                elif not header.startswith(allowed):
                    found.append(place + f'{layer}/ must not include "{header}"; it may include {", ".join(allowed)}')
                elif is_private(header) and os.path.dirname(header).split("/")[0] != name.split("/")[0]:
                    found.append(place + f'"{header}" is private to its own layer')
                elif is_private(header) and name.endswith(".hpp") and not is_private(name):
                    found.append(place + f'a public header must not include the private "{header}"')
                continue
            for library, family, where in LIBRARIES:
                if re.match(family, header) and not re.match(where, name):
                    found.append(place + f"{library} must not be included here (<{header}>)")
            if name.startswith(STANDARD_ALONE) and re.search(r"[/.]", header) and not re.match(POSIX, header):
                found.append(place + f"{layer}/ uses the standard library alone, not <{header}>")
    return found


PLANTED = [  # file, include line, a part of the message that must come (None: it is allowed)
    ("host/cut/a.hpp", "#include <CGAL/Nef_3.h>", "CGAL must not"),
    ("host/cut/b_exact.hpp", "#include <CGAL/Nef_3.h>", None),
    ("host/cut/c.cpp", "#include <CGAL/Nef_3.h>", None),
    ("kernels/solve/a.hpp", "#include <Kokkos_Core.hpp>", "Kokkos must not"),
    ("kernels/solve/b_kernel.hpp", "#include <Kokkos_Core.hpp>", None),
    ("kernels/solve/c.cpp", "  #  include <Kokkos_Core.hpp>", None),
    ("host/cut/d.cpp", "#include <Kokkos_Core.hpp>", "Kokkos must not"),
    ("src/app/main.cpp", "#include <Kokkos_Core.hpp>", "Kokkos must not"),
    ("kernels/solve/d.cpp", "#include <CGAL/Nef_3.h>", "CGAL must not"),
    ("kernels/solve/e.cpp", '#include "host/cut/a.hpp"', "kernels/ must not include"),
    ("host/cut/e.cpp", '#include "kernels/solve/a.hpp"', "host/ must not include"),
    ("src/app/pipeline.cpp", '#include "kernels/solve/a.hpp"', None),
    ("src/app/pipeline.hpp", '#include "kernels/solve/b_kernel.hpp"', "private"),
    ("kernels/solve/f.hpp", '#include "kernels/solve/b_kernel.hpp"', "public header must not"),
    ("src/io/a.cpp", "#include <hdf5.h>", None),
    ("src/io/a.hpp", "#include <hdf5.h>", "HDF5 must not"),
    ("src/run/a.cpp", "#include <hdf5.h>", "HDF5 must not"),
    ("src/sweep/a.cpp", "#include <mpi.h>", "MPI must not"),
    ("src/sweep/mpi/a.cpp", "#include <mpi.h>", None),
    ("src/model/text/a.cpp", "#include <toml++/toml.h>", None),
    ("src/model/a.hpp", "#include <toml++/toml.h>", "toml++ must not"),
    ("src/base/a.hpp", "#include <vector>", None),
    ("src/base/b.hpp", "#include <fmt/format.h>", "standard library alone"),
    ("src/arrays/a.hpp", '#include "src/model/a.hpp"', "src/arrays/ must not include"),
    ("src/base/c.hpp", '#include "src/arrays/a.hpp"', "src/base/ must not include"),
    ("src/run/b.cpp", '#include "../model/a.hpp"', "is no file below"),
]


def check_the_check():
    """Plants each violation in an empty tree and fails where the check does not answer as the table says."""
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, line, _ in PLANTED:
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"#pragma once\n{line}\n", encoding="utf-8")
        messages = violations(root)
    for name, line, expected in PLANTED:
        mine = [m for m in messages if m.startswith(f"{name}:2: ")]
        if expected is None and mine:
            wrong.append(f"{name} with '{line}' is allowed, but: {mine}")
        if expected is not None and not any(expected in m for m in mine):
            wrong.append(f"{name} with '{line}' should be refused with '{expected}', but: {mine}")
    return wrong


def main():
    root = Path(os.environ.get("ROCKFOLD_SOURCE_DIR", Path(__file__).resolve().parents[2]))
    broken = violations(root)
    for line in broken:
        print(line)
    wrong = check_the_check()
    for line in wrong:
        print("the check itself:", line)
    print(f"{len(broken)} includes break the rules; {len(PLANTED)} planted cases, {len(wrong)} answered wrongly")
    return 1 if broken or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
