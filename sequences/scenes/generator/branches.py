"""Thin branches that cross before an evening sky. Lengths in metres."""
import random
from math import cos, pi, sin

from gltf import File
from shapes import add, ball, cross, join, plane, sheet, times, tube, turn, unit


def limb(rng, start, towards, length, radius, droop):
    """A bent path with radii, and where along it twigs begin."""
    path, radii, direction = [start], [radius], unit(towards)
    steps = 14
    for k in range(steps):
        direction = unit(add(direction, (rng.gauss(0, 0.09), rng.gauss(0, 0.09) - droop, rng.gauss(0, 0.05))))
        path.append(add(path[-1], times(length / steps, direction)))
        radii.append(radius * (1 - 0.8 * (k + 1) / steps))
    return path, radii


def tree(rng, start, towards, length, radius, depth, tubes, leaves):
    path, radii = limb(rng, start, towards, length, radius, 0.012)
    tubes.append(tube(path, radii, 7 if depth else 5, around=2))
    if depth == 0:
        for k in range(4, len(path), 3):
            if rng.random() < 0.5:
                leaves.append((path[k], rng.random() * 360, rng.uniform(0.7, 1.3)))
        return
    for k in range(3, len(path) - 1, 2):
        along = unit(tuple(b - a for a, b in zip(path[k - 1], path[k])))
        side = unit(cross(along, (rng.gauss(0, 0.3), rng.gauss(0, 0.3), 1)))
        out = add(times(0.75, along), times(rng.choice((-1, 1)) * rng.uniform(0.5, 0.9), side))
        tree(rng, path[k], out, length * rng.uniform(0.35, 0.55), radii[k] * 0.62, depth - 1, tubes, leaves)


def leaf():
    def surface(i, j):
        s, t = i / 2 - 1, j / 6
        wide = 0.34 * sin(pi * t**0.8)
        return (s * wide, -t, 0.25 * abs(s) * wide - 0.15 * t * t), unit((-0.25 * s, 0.15, 1)), (i / 4, t)

    return sheet(4, 6, surface)


def build():
    rng = random.Random(11)
    file = File()
    file.camera("Camera", 0.3941, (0, 0, 0))
    sky = file.material((0, 0, 0), 1, emission=(1.9, 1.9, 1.9), glow="textures/evening.png")
    file.node("Backdrop", file.mesh((plane((-24, -13, -55), (48, 0, 0), (0, 30, 0), (1, 1), (2, 1)), sky)))
    file.node(
        "Sun", file.mesh((ball(0.75, 28, 16), file.material((0, 0, 0), 1, emission=(60, 42, 22)))), at=(6.4, -1.9, -50)
    )
    bark = file.material(roughness=0.85, picture="textures/bark.png")
    colours = [file.material(c, 0.55) for c in ((0.72, 0.16, 0.04), (0.85, 0.38, 0.05), (0.62, 0.50, 0.08))]
    blades = [file.mesh((leaf(), colour)) for colour in colours]
    # Name, root, direction, length, radius: near ones in front of focus, the one in focus, and far ones.
    for name, root, towards, length, radius in (
        ("Near", (-0.42, -0.02, -0.62), (1, 0.10, 0.04), 0.80, 0.006),
        ("Focus", (0.62, 0.30, -1.5), (-1, -0.28, 0.02), 1.15, 0.013),
        ("Far", (-1.5, -0.25, -4.2), (0.9, 0.42, 0), 2.6, 0.04),
        ("Farther", (2.6, -1.4, -8), (-0.35, 1, 0), 4.2, 0.10),
    ):
        tubes, leaves = [], []
        tree(rng, (0, 0, 0), towards, length, radius, 1 if name == "Near" else 2, tubes, leaves)
        node = file.node(name, file.mesh((join(*tubes), bark)), at=root)
        size = 0.055 * length
        for place, angle, scale in leaves[:60]:
            file.node(
                "Leaf",
                rng.choice(blades),
                parent=node,
                at=place,
                turn=turn((0.3, 0.2, 1), angle),
                scale=(size * scale,) * 3,
            )
        sway = 1.2 if name == "Near" else 0.5
        keys = [k / 24 for k in range(0, 49, 4)]
        file.animate(
            "wind",
            node,
            "rotation",
            keys,
            [turn((0.2, 0.1, 1), sway * sin(2 * pi * k * 4 / 48 + len(name))) for k in range(len(keys))],
        )
    file.write("branches")
