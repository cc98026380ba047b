#!/usr/bin/env python3
"""Measures the tables of docs/benchmarks.md and docs/orders.md anew and writes them in their place, and docs/orders.svg.

    docs/measure.py [--tool build/cli/pullfocus] [--table NAME,...] [--out FOLDER]

A table stands between the lines "<!-- bench NAME -->" and "<!-- end -->"; the text around it is left alone. Measure
on a quiet machine: the whole takes about twenty minutes."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parent
BLOCK = re.compile(r"(<!-- bench (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def measure(tool, name, options, plot_data):
    """The machine and the section of one table."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "table.md"
        data = ["--data", str(plot_data)] if name == "orders" else []
        subprocess.run([tool, "bench", "--table", name, "-o", str(out), *options, *data], check=True)
        head, section = out.read_text().split("\n## ", 1)
    machine = head.strip().splitlines()[-1].split(". `")[0]
    return machine, "## " + section.strip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", default=str(DOCS.parent / "build/cli/pullfocus"))
    parser.add_argument("--table", help="only these, with commas between them")
    parser.add_argument("--out", default=str(DOCS), help="folder for the new documents; default: in place")
    parser.add_argument("--quick", action="store_true", help="as of pullfocus bench: needs --out")
    a = parser.parse_args()
    if a.quick and pathlib.Path(a.out).resolve() == DOCS:
        parser.error("--quick measures nothing worth keeping: give --out another folder")
    wanted = set(a.table.split(",")) if a.table else None
    out = pathlib.Path(a.out)
    out.mkdir(parents=True, exist_ok=True)
    sections, machines = {}, set()
    documents = ("benchmarks.md", "orders.md")
    known = {match[2] for name in documents for match in BLOCK.finditer((DOCS / name).read_text())} - {"machine"}
    if wanted and not wanted <= known:
        sys.exit(f"measure.py: no table {', '.join(sorted(wanted - known))} in the documents: use {', '.join(sorted(known))}")
    with tempfile.TemporaryDirectory() as folder:
        plot_data = pathlib.Path(folder) / "orders.data"
        for name in sorted(wanted or known):
            print(f"measuring {name}", file=sys.stderr, flush=True)
            machine, sections[name] = measure(a.tool, name, ["--quick"] if a.quick else [], plot_data)
            machines.add(machine)
        if plot_data.exists():
            subprocess.run(["gnuplot", "-e", f"data='{plot_data}'; out='{out / 'orders.svg'}'", str(DOCS / "orders.gp")],
                           check=True)
    sections["machine"] = "Measured on " + "; ".join(sorted(machines)) + ".\n"
    for name in documents:
        text = (DOCS / name).read_text()  # only now: it may have been edited meanwhile
        (out / name).write_text(BLOCK.sub(lambda m: m[1] + sections[m[2]] + m[3] if m[2] in sections else m[0], text))


if __name__ == "__main__":
    main()
