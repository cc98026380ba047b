"""Plots of the report by gnuplot, as SVG."""
import math
import subprocess

COLOURS = {"none": "#cc5200", "layers": "#0067a9", "bitmap": "#00835f"}


TICKS = ", ".join(f"'{digit * 10.0**power:g}' {digit * 10.0**power:g}" for power in range(-4, 4) for digit in (1, 2, 5))


def gnuplot(script):
    done = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError("gnuplot: " + done.stderr.strip())


def block(name, points):
    return f"${name} << EOD\n" + "".join(f"{x} {y}\n" for x, y in points) + "EOD\n"


def front(points):
    """The Pareto front: points that no other one beats in both; of both, less is better."""
    best, kept = math.inf, []
    for x, y in sorted(points):
        if y < best:
            kept.append((x, y))
            best = y
    return kept


def pareto(path, shots, value, title_y):
    """A panel a shot: time a frame against an error. `shots`: {name: {series: (colour, point type, points)}}."""
    columns = 3
    rows = -(-len(shots) // columns)
    text = f"set terminal svg size 1080,{90 + 300 * rows} font 'sans,12' background '#ffffff'\nset output '{path}'\n"
    text += f"set multiplot layout {rows},{columns} margins 0.075,0.985,{0.36 / rows},{1 - 0.09 / rows} spacing 0.065,{0.24 / rows}\n"
    text += f"set logscale x\nunset mxtics\nset xtics ({TICKS})\nset grid lc '#d9dde2'\nset border 3\nset tics nomirror\nunset key\n"
    for i, (name, series) in enumerate(shots.items()):
        text += f"set title '{name}' offset 0,-0.6\nset xlabel 'time / linear' offset 0,0.6\n"
        text += f"set ylabel '{title_y if i % columns == 0 else ''}' offset 1\n"
        everything = [p for _, _, points in series.values() for p in points]
        low, high = min(x for x, _ in everything), max(x for x, _ in everything)
        text += f"set xrange [{low / 1.4}:{high * 1.4}]\nset yrange [*:*]\nset offsets 0,0,graph 0.08,graph 0.08\n"
        text += block("front", front(everything))
        plots = ["$front with lines dt 2 lc '#5c636b' notitle"]
        for k, (label, (colour, kind, points)) in enumerate(series.items()):
            text += block(f"s{k}", points)
            plots.append(f"$s{k} with points pt {kind} ps 0.8 lc '{colour}' title '{label}'")
        if i == 0:
            text += "set key at screen 0.5,0.012 center bottom maxrows 2 samplen 1 width 1\n"
        text += "plot " + ", ".join(plots) + "\nunset key\n"
    gnuplot(text + "unset multiplot\n")


def against_budget(path, lines, title):
    """Time and PSNR by budget. `lines`: {label: [(percent, ms relative to 100 %, PSNR)]}."""
    text = f"set terminal svg size 1000,360 font 'sans,12' background '#ffffff'\nset output '{path}'\n"
    text += "set multiplot layout 1,2 margins 0.07,0.98,0.14,0.88 spacing 0.09,0\n"
    text += "set grid lc '#d9dde2'\nset border 3\nset tics nomirror\nset xlabel 'M, % of changed pixels'\nset xrange [0:102]\n"
    for k, points in enumerate(lines.values()):
        text += f"$d{k} << EOD\n" + "".join(f"{m} {t} {'NaN' if p is None else p}\n" for m, t, p in points) + "EOD\n"
    colours = ["#0067a9", "#cc5200", "#00835f", "#b3488c"]
    for column, name, key in ((2, "time a frame / time at M = 100", "bottom right"), (3, "PSNR against linear, dB", "bottom right")):
        text += f"set title '{title if column == 2 else ''}'\nset ylabel '{name}' offset 1\nset key {key}\n"
        text += "set yrange [0:*]\n" if column == 2 else "set yrange [*:*]\n"
        text += "plot " + ", ".join(
            f"$d{k} using 1:{column} with linespoints pt 7 ps 0.6 lc '{colours[k % 4]}' title '{label}'"
            for k, label in enumerate(lines)) + "\n"
    gnuplot(text + "unset multiplot\n")
