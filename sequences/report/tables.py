"""The report's summaries, as Markdown tables. Numbers come from `pullfocus compare`'s JSON; nothing is typed in but the
paper's own figures."""
from report.runs import EXPERIMENTS

# P. Fearing, "Importance Ordering for Real-Time Depth of Field", 1996, tables 1 and 2, by experiment.
PAPER_TOTAL_S = {1: (2572, 116, "22.1"), 2: (1165, 87, "13.4"), 3: (500, 209, "2.4"), 4: (522, 213, "2.4")}
PAPER_FRAME_S = {1: ("25.7", "0.9", "28.5"), 2: ("11.6", "0.8", "14.5"), 3: ("4.8", "1.9", "2.5"),
                 4: ("5.0", "1.9", "2.6")}
GOOD_DB = 45  # PSNR against linear from which a partial budget counts as good


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def number(value, places, none="-"):
    return none if value is None else f"{value:.{places}f}"


def decibels(value):
    return "inf" if value is None else f"{value:.1f}"


def error(row, against, measure):
    return row["errors"].get(against, {}).get(measure) if row and "errors" in row else None


def full(compared, **wanted):
    return compared.row(method="incremental", budget="100%", **wanted)


def partial_rows(compared):
    return [row for row in compared.shot["filters"] if row["budget"] not in (None, "100%")]


def percent(row):
    return float(row["budget"].rstrip("%"))


def best_visibility(sets):
    """Name of the visibility whose linear picture has the lowest FLIP against the truth; None without a truth."""
    rows = [row for row in sets["visibilities"].shot["filters"] if row["method"] == "linear"]
    known = [row for row in rows if error(row, "truth", "flip") is not None]
    return min(known, key=lambda row: row["errors"]["truth"]["flip"])["visibility"] if known else None


def partial_choice(sets):
    """The fastest partial budget whose PSNR against linear is good, if it is 1.15 times as fast as the full one."""
    whole = full(sets["budgets"])
    good = [row for row in partial_rows(sets["budgets"]) if (error(row, "linear", "psnr") or 1e9) >= GOOD_DB]
    good = [row for row in good if row["speed_up"] >= max(1.1, 1.15 * whole["speed_up"])]
    return max(good, key=lambda row: row["speed_up"]) if good else None


def choice(name, sets):
    whole = full(sets["budgets"])
    text = "`incremental`" if whole["speed_up"] >= 1.1 else "`linear` or `incremental`: no gain"
    partial = partial_choice(sets)
    if partial:
        text += f"; `--budget {partial['budget']} --order {partial['order']}`: {partial['speed_up']:.1f} times, " \
                f"{decibels(error(partial, 'linear', 'psnr'))} dB"
    return text


def budget_speeds(results):
    """How partial budgets compare with 100 % in time, over shots."""
    parts = []
    for budget in sorted({percent(row) for sets in results.shots.values() for row in partial_rows(sets["budgets"])}):
        ratios = []
        for sets in results.shots.values():
            row = next(r for r in partial_rows(sets["budgets"]) if percent(r) == budget and r["order"] == "gain")
            ratios.append(row["median_ms"] / full(sets["budgets"])["median_ms"])
        faster = sum(ratio < 0.95 for ratio in ratios)
        parts.append(f"{budget:g} % in {faster} ({min(ratios):.2f} to {max(ratios):.2f} times)")
    return ("A partial budget is not always faster, as what it leaves over waits for later frames. Shots of "
            f"{len(results.shots)} whose median frame took less than 0.95 of the time at 100 %, order `gain`, and the range "
            "over all shots: " + ", ".join(parts) + ".")


def overview(results):
    rows = []
    for name, sets in results.shots.items():
        linear, whole = sets["budgets"].row(method="linear"), full(sets["budgets"])
        rows.append([f"`{name}`", number(linear["median_ms"], 1), number(whole["median_ms"], 1),
                     number(whole["speed_up"], 2), number(100 * whole["updated_share"], 1),
                     best_visibility(sets) or "-", choice(name, sets)])
    return table(["shot", "linear ms", "incremental ms", "speed-up", "updated %", "nearest to the truth", "choose"], rows)


def visibilities(results):
    rows = []
    for name, sets in results.shots.items():
        compared = sets["visibilities"]
        cells = [f"`{name}`"]
        for visibility in ("none", "layers", "bitmap"):
            linear = compared.row(method="linear", visibility=visibility)
            whole = full(compared, visibility=visibility)
            cells += [number(linear["median_ms"], 1), number(whole["speed_up"], 1),
                      "-" if error(linear, "truth", "flip") is None else decibels(error(linear, "truth", "psnr")),
                      number(error(linear, "truth", "flip"), 4)]
        rows.append(cells)
    head = ["shot"] + [f"{v}: {c}" for v in ("none", "layers", "bitmap") for c in ("linear ms", "speed-up", "dB", "FLIP")]
    return table(head, rows)


def orders(results):
    """Errors by order and budget, and where `gain` is worse than `fearing`."""
    budgets = sorted({percent(row) for sets in results.shots.values() for row in partial_rows(sets["budgets"])})
    rows, worse = [], {(b, m): [] for b in budgets for m in ("flip", "rmse")}
    shots = dict(results.shots)
    if "mover, budgets" in results.cycles:
        shots["mover (Cycles)"] = {"budgets": results.cycles["mover, budgets"]}
    for name, sets in shots.items():
        cells = [f"`{name}`"]
        for budget in budgets:
            found = {row["order"]: row for row in partial_rows(sets["budgets"]) if percent(row) == budget}
            for measure in ("flip", "rmse"):
                a, b = (error(found[order], "linear", measure) for order in ("gain", "fearing"))
                if a > b:
                    worse[budget, measure].append(f"`{name}` (+{100 * (a / b - 1):.0f} %)" if b else f"`{name}`")
                if measure == "flip":
                    cells += [f"{a:.4f}", f"{b:.4f}"]
        rows.append(cells)
    head = ["shot"] + [f"{b:g} %: {order}" for b in budgets for order in ("gain", "fearing")]
    text = table(head, rows) + "\n"
    for (budget, measure), names in worse.items():
        listed = ": " + ", ".join(names) if names else ""
        text += f"- {budget:g} %: `gain` has the higher {measure.upper()} in {len(names)} of {len(shots)} shots{listed}.\n"
    return text


def steps(results):
    names = [row["coc_step"] for row in next(iter(results.shots.values()))["steps"].shot["filters"]
             if row["method"] == "linear"]
    rows = []
    for name, sets in results.shots.items():
        cells = [f"`{name}`"]
        for step in names:
            linear = sets["steps"].row(method="linear", coc_step=step)
            whole = full(sets["steps"], coc_step=step)
            cells += [number(whole["speed_up"], 2), decibels(error(linear, "quantisation", "psnr")),
                      number(error(linear, "quantisation", "flip"), 4)]
        rows.append(cells)
    title = {0: "0 (half a pixel)", 0.015625: "1/64", 0.03125: "1/32", 0.0625: "1/16"}
    return table(["shot"] + [f"{title.get(s, s)}: {c}" for s in names for c in ("speed-up", "dB", "FLIP")], rows)


def seconds(row, first):
    """Total and mean seconds of filtering: all frames (`first`), or without the first one."""
    ms = [frame["ms"] for frame in row["frames"]][0 if first else 1:]
    return sum(ms) / 1000, sum(ms) / 1000 / len(ms)


def paper_tables(results):
    """Tables 1 and 2 of the paper beside the same quantities here: paper's settings, and the defaults."""
    texts = []
    for first in (True, False):
        rows = []
        for name, experiment in EXPERIMENTS.items():
            if experiment == 5 or name not in results.shots:
                continue
            linear, importance, ratio = (PAPER_TOTAL_S if first else PAPER_FRAME_S)[experiment]
            cells = [str(experiment), f"{linear} s", f"{importance} s", ratio]
            for kind in ("paper", "budgets"):
                compared = results.shots[name][kind]
                a = seconds(compared.row(method="linear"), first)[0 if first else 1]
                b = seconds(full(compared), first)[0 if first else 1]
                unit, scale = ("s", 1) if first else ("ms", 1000)
                cells += [f"{a * scale:.2f} {unit}", f"{b * scale:.2f} {unit}", f"{a / b:.1f}"]
                if not first:
                    cells.append(number(full(compared)["speed_up"], 1))
            rows.append(cells)
        ours = ["incremental", "speed-up"] + ([] if first else ["median"])
        texts.append(table(["experiment", "paper: linear", "importance", "speed-up", "gaussian, none: linear", *ours,
                            "disc, layers: linear", *ours], rows))
    return texts


def figure_4_lines(results):
    """{label: [(M, time relative to M = 100, PSNR against linear)]} of experiment 5."""
    sets, lines = results.shots.get("fearing-5"), {}
    if not sets:
        return lines
    for kind, label, order in (("paper", "gaussian, none, fearing", "fearing"), ("figure 4", "disc, layers, gain", "gain"),
                               ("figure 4", "disc, layers, fearing", "fearing")):
        whole = full(sets[kind])
        points = [(percent(row), seconds(row, False)[1] / seconds(whole, False)[1], error(row, "linear", "psnr"))
                  for row in partial_rows(sets[kind]) if row["order"] == order]
        lines[label] = sorted(points) + [(100, 1.0, None)]
    return lines


def figure_4(results):
    lines = figure_4_lines(results)
    rows = []
    for i, (m, _, _) in enumerate(next(iter(lines.values()))):
        cells = [f"{m:g} %"]
        for points in lines.values():
            cells += [f"{points[i][1]:.2f}", decibels(points[i][2])]
        rows.append(cells)
    return table(["M"] + [f"{label}: {c}" for label in lines for c in ("time", "dB")], rows)
