#!/usr/bin/env python3
"""Verification: runs the models of tests/cases that have a known answer, and compares.

    tests/verification/verify.py                         all cases, with all their lattices, orders and spacings (minutes)
    tests/verification/verify.py --fast                  a few seconds
    tests/verification/verify.py cook kirsch             these cases
    tests/verification/verify.py --explicit              those of blocks in motion, by explicit steps
    tests/verification/verify.py --store                 writes what was found to docs/verification.json, from which
                                                         docs/draw_verification.py makes the page's table and figures
    tests/verification/verify.py --rockfold PROGRAM …    another program than build/release/rockfold

It needs numpy. The exit status is 1 if a number is farther from its reference than it may be.
"""
import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parent.parent / "reference")]
import bolts  # noqa: E402
import contact  # noqa: E402
import dynamics  # noqa: E402
import impacts  # noqa: E402
import jointed  # noqa: E402
import limits  # noqa: E402
import random_blocks  # noqa: E402
import random_contact  # noqa: E402
import rest  # noqa: E402
import statics  # noqa: E402
import supports  # noqa: E402
import water  # noqa: E402
from runner import ROOT, Explicit, Rockfold  # noqa: E402

CASES = {case.__name__: case for case in (
    statics.patch, statics.bending_patch, statics.column, statics.cantilever, statics.cook, statics.le10, statics.kirsch,
    statics.hollow_cylinder, statics.hollow_sphere, statics.spherical_cavity, statics.plate, statics.plate_large,
    dynamics.plate_peak, dynamics.wave, dynamics.vibration, dynamics.simply_supported, dynamics.oscillator, dynamics.quasi_static,
    contact.sliding_block, contact.cohesive_block, contact.sliding_wedge, contact.shaken_wedge, contact.stacked_blocks, contact.overhang, contact.rocking_block,
    contact.falling_block, contact.colliding_bars, contact.rolling_prism, contact.spinning_box, jointed.jointed_bar, jointed.block_pile,
    random_blocks.random_prisms, random_blocks.random_wedges, random_contact.random_surfaces, random_contact.random_cards,
    random_contact.random_rebounds, random_contact.random_throws, rest.brick_wall, rest.jointed_slope, impacts.crossing_beams, impacts.dropped_cube,
    limits.toppling_slope, limits.voussoir_arch, limits.random_arches, supports.stressed_tunnel, supports.stressed_wedge, supports.anchored_block, water.wet_slope,
    bolts.pull_out, bolts.bolted_wedge, bolts.lined_tunnel)}
# Of blocks in motion, which steps by explicit substeps take too.
BY_SUBSTEPS = ("sliding_block", "cohesive_block", "sliding_wedge", "shaken_wedge", "rocking_block", "falling_block", "rolling_prism", "spinning_box",
               "crossing_beams", "dropped_cube", "random_prisms", "random_wedges")
STORE = ROOT / "docs" / "verification.json"


def find(name, program, full, explicit=False):
    """What a case comes to, by explicit steps or as its model says."""
    if explicit:
        return CASES[name](Explicit(program.program, program.threads), full).for_substeps()
    return CASES[name](program, full)


def report(found):
    for row in found.rows:
        print(f"{'  ' if row.good() else '! '}{found.name:18} {row.quantity:70} {row.reference:12.6g} {row.ours:12.6g} {row.unit:8} "
              f"{row.difference():9.2e} (may be {row.tolerance:g})")


def add_explicit(stored, found):
    """Beside what implicit steps came to, of the same question."""
    for row, its in zip(stored["rows"], found.rows, strict=True):
        row["explicit"] = its.ours if its.quantity == row["quantity"] else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="cases: " + ", ".join(CASES))
    parser.add_argument("--fast", action="store_true")
    parser.add_argument("--explicit", action="store_true", help="dynamic steps of block covers by explicit substeps")
    parser.add_argument("--store", action="store_true")
    parser.add_argument("--rockfold", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    if unknown := set(options.names) - set(CASES):
        parser.error(f"no such case: {', '.join(sorted(unknown))}; there are {', '.join(CASES)}")

    if options.explicit and (others := set(options.names) - set(BY_SUBSTEPS)):
        parser.error(f"no blocks in motion: {', '.join(sorted(others))}")
    program = Rockfold(options.rockfold, options.threads)
    failed = 0
    for name in options.names or (BY_SUBSTEPS if options.explicit else CASES):
        start = time.monotonic()
        try:
            found = find(name, program, not options.fast, options.explicit)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            print(f"! {error}")
            failed += 1
            continue
        report(found)
        print(f"  {name}: {time.monotonic() - start:.1f} s", flush=True)
        failed += len(found.bad())
        if options.store:  # read anew, so that several may run side by side
            stored = json.loads(STORE.read_text(encoding="utf-8")) if STORE.exists() else {}
            if options.explicit and name not in stored:
                print(f"! {name} is not stored by implicit steps yet")
                failed += 1
                continue
            if options.explicit:
                add_explicit(stored[name], found)
            else:
                stored[name] = found.document()
            lines = (f"{json.dumps(key)}: {json.dumps(stored[key])}" for key in CASES if key in stored)  # a case a line
            STORE.write_text("{" + ",\n".join(lines) + "}\n", encoding="utf-8")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
