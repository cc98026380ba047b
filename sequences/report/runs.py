"""What is rendered and compared for the report, and what came of it."""
import concurrent.futures
import dataclasses
import json
import pathlib
import subprocess
import tomllib


class Failed(Exception):
    pass


@dataclasses.dataclass(frozen=True)
class Program:
    path: pathlib.Path
    again: bool = False  # run nothing: take what an earlier run left in the folder

    def __str__(self):
        return str(self.path)


@dataclasses.dataclass(frozen=True)
class Scale:
    size: str
    samples: int  # of a sharp picture's pixel
    lens_samples: int  # of a truth's
    truth_every: int  # frames; a multiple of measure_every; of shots longer than `long` twice as many
    measure_every: int
    most_frames: int
    long: int  # frames of longer shots that visibilities and CoC steps are compared on
    budgets: str
    orders: str
    steps: str
    figure_4: str  # budgets of experiment 5
    options: tuple = ()  # of every comparison


FULL = Scale("480x270", 16, 64, 12, 6, 10**6, 48, "5%,15%,30%,60%,100%", "gain,fearing", "0,0.015625,0.03125,0.0625",
             "2%,5%,10%,15%,30%,60%,100%")
QUICK = Scale("64x36", 4, 8, 2, 2, 4, 4, "15%,100%", "gain,fearing", "0,0.03125", "15%,100%",
              ("--max-coc", "60"))  # large tables take longer than such small pictures

# The paper's settings (section 6): gaussian, tables in half-pixel steps, w = 0.5, no occlusion is named for the tables.
PAPER = ["--kernel", "gaussian", "--visibility", "none", "--coc-step", "0", "--orders", "fearing"]
EXPERIMENTS = {f"fearing-{i}": i for i in range(1, 6)}


@dataclasses.dataclass(frozen=True)
class Shot:
    name: str
    first: int
    last: int
    truth: bool = True
    options: tuple = ()

    def count(self):
        return self.last - self.first + 1

    def frames(self, every=1):
        return f"{self.first}-{self.last}" + (f"x{every}" if every > 1 else "")

    def truth_every(self, scale):
        return scale.truth_every * (2 if self.count() > scale.long else 1)


@dataclasses.dataclass
class Compared:
    """One run of `pullfocus compare`: its JSON's shot, its part of a Markdown document, the command."""
    shot: dict
    markdown: str
    command: str

    def row(self, **wanted):
        for row in self.shot["filters"]:
            if all(row.get(key) == value for key, value in wanted.items()):
                return row
        return None


@dataclasses.dataclass
class Results:
    shots: dict  # name -> {set -> Compared}
    cycles: dict  # name -> Compared; empty: no data
    commands: dict  # name -> command that rendered


def all_shots(folder, scale):
    shots = []
    for path in sorted(folder.glob("*.toml")):
        first, last = tomllib.loads(path.read_text())["frames"]
        shots.append(Shot(path.stem, first, min(last, first + scale.most_frames - 1)))
    shots.append(Shot("star-lateral", 1, min(100, scale.most_frames), False, ("--lens", "paper")))
    return shots


def run(words, folder):
    if words[0].again:
        return
    done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(str(word) for word in words)}: {done.stderr.strip().splitlines()[-1:]}")


def shown(words):
    """A command as typed, the program by its name."""
    return " ".join(f"'{word}'" if any(c in str(word) for c in ";*") else str(word) for word in ["pullfocus", *words[1:]])


def compare(tool, folder, name, inputs, options):
    words = [tool, "compare", *inputs, *options, "--threads", "1"]
    run([*words, "--json", f"{name}.json", "--markdown", f"{name}.md"], folder)
    return Compared(json.loads((folder / f"{name}.json").read_text())["shots"][0], (folder / f"{name}.md").read_text(),
                    shown(words))


def run_shot(tool, work, shot, scale):
    """Renders a shot and runs all comparisons on it."""
    folder = work / shot.name
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*") if not tool.again else ():
        old.unlink()
    base = [tool, "render", shot.name, "-o", ".", "--size", scale.size, "--threads", "1"]
    pictures = [*base, "--frames", shot.frames()] + (["--samples", scale.samples] if shot.truth else [])
    commands = [shown(pictures)]
    run(pictures, folder)
    inputs = [f"{shot.name}.####.exr"]
    measured = [*shot.options, *scale.options, "--measure-every", scale.measure_every]
    if shot.truth:
        truth = [*base, "--frames", shot.frames(shot.truth_every(scale)), "--truth", scale.lens_samples]
        commands.append(shown(truth))
        run(truth, folder)
        measured += ["--truth", f"{shot.name}.truth.####.exr"]
    part = ["--frames", f"{shot.first}-{shot.first + scale.long - 1}"] if shot.count() > scale.long else []
    sets = {
        "visibilities": [*part, "--visibilities", "none;layers;bitmap", "--budgets", "100%", "--no-quantisation"],
        "budgets": ["--budgets", scale.budgets, "--orders", scale.orders, "--no-quantisation"],
        "steps": [*part, "--coc-steps", scale.steps, "--budgets", "100%"],
    }
    if shot.name in EXPERIMENTS:
        budgets = scale.figure_4 if EXPERIMENTS[shot.name] == 5 else "100%"
        sets["paper"] = [*PAPER, "--budgets", budgets, "--no-quantisation"]
        if EXPERIMENTS[shot.name] == 5:
            sets["figure 4"] = ["--budgets", budgets, "--orders", scale.orders, "--no-quantisation"]
    found = {name: compare(tool, folder, name.replace(" ", "-"), inputs, [*measured, *options])
             for name, options in sets.items()}
    for frame in folder.glob("*.exr"):
        frame.unlink()
    return shot.name, found, commands


def cycles_runs(data, scale):
    """Comparisons on the shots rendered by Cycles: name, folder, inputs and options."""
    lens = ["--focal-length", "50", "--no-quantisation"]
    visibilities = ["--visibilities", "none;layers;bitmap"]
    mover = ["mover/pinhole_####.exr", "--truth", "mover/gt_####.exr", *lens, "--fstop", "2", "--focus", "0.8"]
    yield "mover, visibilities", mover, [*visibilities, "--budgets", "100%"]
    yield "mover, budgets", mover, ["--budgets", scale.budgets, "--orders", scale.orders]
    for focus in ("0.32", "0.80", "2.70"):
        still = ["static_pull/pinhole_0001.exr", "--truth", f"static_pull/gt_f{focus}_0001.exr", *lens]
        yield f"static_pull, focus {focus} m", [*still, "--fstop", "2.4", "--focus", focus], [
            *visibilities, "--methods", "linear"]
    yield "hd1080", ["hd1080/pinhole_0001.exr", *lens, "--fstop", "2", "--focus", "0.8"], [
        "--visibilities", "none;layers", "--methods", "linear"]


def run_cycles(tool, work, data, scale):
    """Results by name; frames are read where they are, results go to `work`."""
    found = {}
    if not data.is_dir():
        return found
    folder = work / "cycles"
    folder.mkdir(parents=True, exist_ok=True)
    for part in ("mover", "static_pull", "hd1080"):
        link = folder / part
        if not link.is_symlink():
            link.symlink_to(data.resolve() / part)
    for i, (name, inputs, options) in enumerate(cycles_runs(data, scale)):
        if not pathlib.Path(folder, inputs[0]).parent.is_dir():
            continue
        found[name] = compare(tool, folder, f"result-{i}", inputs, options)
    return found


def run_all(tool, work, shots, scale, data, jobs):
    work.mkdir(parents=True, exist_ok=True)
    results = Results({}, {}, {})
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        longest_first = sorted(shots, key=lambda s: (s.name not in EXPERIMENTS, s.first - s.last))
        waiting = [pool.submit(run_shot, tool, work, shot, scale) for shot in longest_first]
        cycles = pool.submit(run_cycles, tool, work, data, scale)
        try:
            for future in concurrent.futures.as_completed(waiting):
                name, found, commands = future.result()
                results.shots[name], results.commands[name] = found, commands
                print(f"{name}: done ({len(results.shots)} of {len(shots)})", flush=True)
            results.cycles = cycles.result()
        except Failed:
            pool.shutdown(cancel_futures=True)
            raise
    results.shots = {shot.name: results.shots[shot.name] for shot in shots}
    return results


def check(results):
    """What must hold whatever the machine: with a full budget nothing differs from linear."""
    for name, sets in [*results.shots.items(), ("cycles", results.cycles)]:
        for kind, compared in sets.items():
            for row in compared.shot["filters"]:
                if row["budget"] in (None, "100%") and row["errors"]["linear"]["largest"] != 0:
                    raise Failed(f"{name}, {kind}: {row['label']} differs from linear")
                frames = row["frames"]
                if any(f["changed"] != f["updated"] + f["left_over"] for f in frames[1:]):
                    raise Failed(f"{name}, {kind}: {row['label']} lost count of its pixels")
