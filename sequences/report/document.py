"""Writes the report: overview first, then summaries, then every table of `pullfocus compare`."""
import os
import pathlib
import platform
import re
import statistics
import subprocess
import textwrap

from report import plots, tables

PARETO_SHOTS = ["fearing-1", "fearing-4", "focus-pull", "branches", "bokeh", "lighting"]


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def compiler(tool):
    """Name, version and build type, from the build folder."""
    cache = tool.parent.parent / "CMakeCache.txt"
    text = cache.read_text() if cache.is_file() else ""
    found = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", text, re.M)
    build = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", text, re.M)
    if not found:
        return "unknown compiler"
    version = subprocess.run([found[1], "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    return f"{version}, {build[1] if build else 'no build type'}"


def pareto_series(sets):
    """Points of all filters by visibility, over the frames that all runs have: time over that of linear with the defaults
    in the same run, FLIP to the truth."""
    series = {}
    common = {frame["frame"] for frame in sets["visibilities"].shot["filters"][0]["frames"]}

    def median_ms(row):
        return statistics.median(f["ms"] for f in row["frames"][1:] if f["frame"] in common)

    for kind in ("budgets", "visibilities", "steps"):
        rows = sets[kind].shot["filters"]
        is_default = {id(row): row["coc_step"] == 0.03125 and row["visibility"] in ("auto", "layers") for row in rows}
        linear_ms = median_ms(next(row for row in rows if row["method"] == "linear" and is_default[id(row)]))
        for row in rows:
            if kind != "budgets" and is_default[id(row)]:
                continue  # these are shown already
            visibility = "layers" if row["visibility"] == "auto" else row["visibility"]
            what = "linear" if row["method"] == "linear" else "incremental" if row["budget"] == "100%" else "partial"
            kinds = {"linear": 5, "incremental": 7, "partial": 2}
            label = f"{visibility}, {what}" + (f" {row['order']}" if what == "partial" else "")
            colour = plots.COLOURS[visibility] if row["order"] != "fearing" else "#b3488c"
            flips = [f["errors"]["truth"]["flip"] for f in row["frames"]
                     if f["frame"] in common and "truth" in f.get("errors", {})]
            if flips:
                point = (median_ms(row) / linear_ms, statistics.mean(flips))
                series.setdefault(label, (colour, kinds[what], []))[2].append(point)
    return series


def draw(path, results):
    """The plots beside the document; Markdown that shows them."""
    stem = path.with_suffix("")
    shown = {name: pareto_series(results.shots[name]) for name in PARETO_SHOTS if name in results.shots}
    pareto = budgets = ""
    if shown:
        plots.pareto(f"{stem}-pareto.svg", shown, "flip", "FLIP against the truth")
        pareto = f"![Time against error]({stem.name}-pareto.svg)\n"
    lines = tables.figure_4_lines(results)
    if lines:
        plots.against_budget(f"{stem}-figure-4.svg", lines, "Experiment 5")
        budgets = f"![Time and error by budget]({stem.name}-figure-4.svg)\n"
    return pareto, budgets


def conditions(tool, jobs, seconds):
    """What a run was measured on."""
    return {"processor": processor(), "processors": os.cpu_count(), "used": len(os.sched_getaffinity(0)),
            "compiler": compiler(tool), "jobs": jobs, "seconds": seconds,
            "load": pathlib.Path("/proc/loadavg").read_text().split()[0]}


def measured_on(scale, c):
    text = (f"Measured on {c['processor']}, {c['processors']} processors of which {c['used']} were used; {c['compiler']}. "
            f"{c['jobs']} programs ran at a time, one thread each. {scale.size}, sharp pictures of {scale.samples} samples "
            f"a pixel, truth of {scale.lens_samples} lens samples of one frame in {scale.truth_every}, in shots of more than "
            f"{scale.long} frames of one in {2 * scale.truth_every}, from the first; errors of one frame in "
            f"{scale.measure_every}, times and counts of all. Visibilities and CoC steps are compared on the first "
            f"{scale.long} frames at most. Rendering, filtering and measuring took {c['seconds']:.0f} s in all; the load "
            f"average at the end was {c['load']}. Where that is more than the processors used, other programs ran too: then "
            "milliseconds of different tables differ by more than the filters do, and only ratios, of filters that took "
            "turns on every frame, can be compared.")
    return textwrap.fill(text, 120) + "\n"


def indented(text):
    return textwrap.fill(text, 118, initial_indent="  ", subsequent_indent="  ")


def details(title, text):
    return f"<details><summary>{title}</summary>\n\n{text}\n</details>\n\n"


def shot_details(name, sets, commands):
    text = "".join(f"    {command}\n" for command in commands + [c.command for c in sets.values()]) + "\n"
    for kind, compared in sets.items():
        text += re.sub(r"^### .*$", f"**{kind}**", compared.markdown, count=1, flags=re.M) + "\n"
    return details(f"<code>{name}</code>", text)


def cycles_details(results):
    if not results.cycles:
        return "The data was not there when this was written.\n"
    text = ""
    for name, compared in results.cycles.items():
        body = f"    {compared.command}\n\n" + re.sub(r"^### .*\n\n", "", compared.markdown, count=1)
        text += details(name, body)
    return text


def write(path, results, scale, measured):
    pareto, budgets = draw(path, results)
    experiments = any(name in results.shots for name in tables.EXPERIMENTS)
    total, update = tables.paper_tables(results) if experiments else ("", "")
    with_truth = [sets for sets in results.shots.values() if tables.best_visibility(sets)]
    by_visibility = ", ".join(
        f"`{v}` in {sum(tables.best_visibility(sets) == v for sets in with_truth)}" for v in ("layers", "none", "bitmap"))
    gains = [tables.full(sets["budgets"])["speed_up"] for sets in results.shots.values()]
    dear = ", ".join(f"`{name}` {1 / gain:.2f}" for name, gain in zip(results.shots, gains) if gain < 0.95)
    dear = indented(f"It took more than 1.05 times linear's time in: {dear or 'none'}.")
    text = TEXT.format(
        measured=measured_on(scale, measured), overview=tables.overview(results),
        shots=len(results.shots), with_truth=len(with_truth), by_visibility=by_visibility, good=tables.GOOD_DB,
        scale_size_note=scale.size, dear=dear, budget_speeds=indented(tables.budget_speeds(results)),
        gaining=sum(g >= 1.1 for g in gains), least=min(gains), most=max(gains), pareto=pareto,
        visibilities=tables.visibilities(results), orders=tables.orders(results), steps=tables.steps(results),
        table_1=total, table_2=update, figure_4_plot=budgets,
        figure_4=tables.figure_4(results) if budgets else "", cycles=cycles_details(results),
        details="".join(shot_details(name, sets, results.commands[name]) for name, sets in results.shots.items()))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


TEXT = """# Speed against error

Written by `sequences/speed_vs_error.py`; every number comes from `pullfocus render` and `pullfocus compare` ([what they
measure](compare.md)) on the [shots](sequences.md) that come with the program.

{measured}
Errors are of two kinds that are not mixed. *Against linear*: what a budget leaves out; exactly 0 at 100 %, which the
program that writes this checks for every filter and frame that is measured. *Against the truth*: the scene rendered through
the lens, what filtering after rendering can do at all.

## What to choose

{overview}
Layers, disc, CoC steps of 1/32 (the defaults); median ms a frame after the first, speed-up as the median of linear's time over
incremental's, frame by frame, so that it need not be the ratio of the medians. *Nearest to the truth*: the visibility whose linear picture has the lowest FLIP.

- **Method.** `incremental` gives linear's bits. In {gaining} of {shots} shots it was at least 1.1 times as fast; from {least:.2f} to
  {most:.1f} times over all.
{dear}
- **Visibility.** Of {with_truth} shots with a truth, nearest to it: {by_visibility}.
- **Budget.** A partial one is listed if its PSNR against linear is {good} dB or more and it is at least 1.15 times as fast as
  100 %; where several are, the fastest. Elsewhere leave the budget at 100 %.
{budget_speeds}

{pareto}
Every filter of six shots: median time a frame over that of linear with the defaults in the same run (logarithmic) against
FLIP to the truth; less is better in both. Squares: linear, discs: incremental at 100 %, crosses: partial budgets. Dashed: the
Pareto front, filters that no other one beats in both. Of longer shots the frames that visibilities were compared on; blue also
stands for other CoC steps.

## Visibilities

Linear at each visibility: its time, incremental's speed-up over it at 100 %, and linear's PSNR and FLIP against the truth.

{visibilities}
## Budgets and orders

FLIP against linear by budget and order (layers).

{orders}
## CoC steps

Speed-up of incremental at 100 % over linear with the same step; PSNR and FLIP of quantisation: linear with that step against
steps of 1/8 pixel.

{steps}
## The paper's experiments

P. Fearing, *Importance Ordering for Real-Time Depth of Field*, 1996, section 6. Left the paper's figures, on a 100 MHz SGI Indy,
256x256, 100 frames. Then the same experiments here with the paper's settings (gaussian, tables in half-pixel steps, no
occlusion, w = 0.5 for both), and with the defaults. Ours are times of the filter alone, means as in the paper, so that one
disturbed frame shows; *median* is the median of the ratios frame by frame. Each is against its own linear filter. The
paper's linear filter touches every pixel of a kernel; here linear writes only the edges of its runs, which leaves less to save.

The paper does not give the film's size, the places of knot, computer and background, the largest CoC, or how far its gaussian
reaches; sizes and places here are those of [the shots](sequences.md), at {scale_size_note}. Whether its tables were measured
with occlusion bitmaps is not said. Its *No DOF* row (3 s: reading the frames) has no counterpart, as reading is not measured here.

**Table 1**: all frames

{table_1}
**Table 2**: a frame, without the first

{table_2}
**Figure 4**: experiment 5, running time by the share M of changed pixels that a frame may update. The paper's figure is a plot
without numbers in its text, so none are repeated; the text says that at M = 15 the last frame is hardly to be told from
M = 100. Mean time a frame after the first, M = 100 being 1; PSNR against linear.

{figure_4}
{figure_4_plot}
## Shots rendered by Cycles

An independent path tracer's pictures and truth.

{cycles}
## All tables

Commands as run, in a folder for each shot.

{details}"""
