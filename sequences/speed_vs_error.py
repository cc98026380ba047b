#!/usr/bin/env python3
"""Renders all shots, compares the filters on them, and writes docs/speed-vs-error.md with its plots.

    sequences/speed_vs_error.py            # the document: about 15 minutes at most on two cores
    sequences/speed_vs_error.py --quick    # small and short, to out/speed-vs-error-quick; tests run it

`pullfocus render` and `pullfocus compare` do the work, each on one thread, --jobs of them at a time.
"""
import argparse
import json
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
from report import document, runs  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="all shots, but small, few frames, fewer filters")
    parser.add_argument("--tool", default=ROOT / "build/cli/pullfocus", type=pathlib.Path, help="the program")
    parser.add_argument("--work", type=pathlib.Path, help="folder for frames and results (default: out/...)")
    parser.add_argument("--document", type=pathlib.Path, help="file to write (default: docs/speed-vs-error.md)")
    parser.add_argument("--data", default=ROOT.parent / "shared/data/cycles", type=pathlib.Path,
                        help="shots rendered by Cycles; left out if the folder is not there")
    parser.add_argument("--shots", help="A,B,...: these only")
    parser.add_argument("--jobs", default=2, type=int, help="programs at a time")
    parser.add_argument("--again", action="store_true", help="run nothing: write the document from the last run's results")
    a = parser.parse_args()
    if a.jobs < 1:
        parser.error("--jobs must be at least 1")
    if not a.tool.is_file():
        parser.error(f"--tool {a.tool}: is not there: build the program first")
    a.tool = a.tool.resolve()
    a.work = (a.work or ROOT / ("out/speed-vs-error-quick" if a.quick else "out/speed-vs-error")).resolve()
    a.document = (a.document or (a.work if a.quick else ROOT / "docs") / "speed-vs-error.md").resolve()
    return a


def main():
    a = arguments()
    scale = runs.QUICK if a.quick else runs.FULL
    shots = runs.all_shots(ROOT / "sequences/shots", scale)
    if a.shots:
        known = {shot.name for shot in shots}
        unknown = set(a.shots.split(",")) - known
        if unknown:
            sys.exit(f"--shots: {', '.join(sorted(unknown))} unknown: choose from {', '.join(sorted(known))}")
        shots = [shot for shot in shots if shot.name in a.shots.split(",")]
    start = time.monotonic()
    try:
        results = runs.run_all(runs.Program(a.tool, a.again), a.work, shots, scale, a.data, a.jobs)
        runs.check(results)
    except runs.Failed as problem:
        sys.exit(f"speed_vs_error: {problem}")
    conditions = a.work / "conditions.json"
    if not a.again:
        conditions.write_text(json.dumps(document.conditions(a.tool, a.jobs, time.monotonic() - start)))
    document.write(a.document, results, scale, json.loads(conditions.read_text()))
    print(f"{a.document}: {len(results.shots)} shots in {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
