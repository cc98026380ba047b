"""A street at night behind a lantern: small, very bright lights. Lengths in metres."""
import random
from math import cos, pi, sin

from gltf import File
from shapes import ball, box, join, lathe, moved, plane, times, tube, turn


def build():
    rng = random.Random(5)
    file = File()
    file.camera("Camera", 0.3941, (0, 1.25, 0), turn((1, 0, 0), -1.5))
    road = file.material((0.5, 0.5, 0.55), 0.3, picture="textures/asphalt.png")
    wood = file.material((0.6, 0.5, 0.45), 0.3, picture="textures/wood.png")
    iron, wall = file.material((0.05, 0.05, 0.055), 0.35), file.material((0.34, 0.26, 0.22), 0.9)
    glass = file.material((0.05, 0.20, 0.10), 0.12, emission=(0.01, 0.05, 0.02))
    flame = file.material((0, 0, 0), 1, emission=(16, 9, 3))
    file.node("Road", file.mesh((plane((-30, 0, -2), (60, 0, 0), (0, 0, -70), (20, 40), (60, 70)), road)))
    for side in (-1, 1):
        for k in range(9):
            height, z = rng.uniform(5, 11), -9 - 6.5 * k
            window = file.material(
                (0, 0, 0), 1, emission=(rng.uniform(1.5, 5), rng.uniform(1, 2.6), rng.uniform(0.4, 1.2))
            )
            house = file.mesh(
                (moved(box((5, height, 6), 0.05, 2, 1), by=(0, height / 2, 0)), wall),
                (
                    join(
                        *[
                            plane(
                                (-side * 2.52, 1.2 + 1.9 * f, -2.3 + 1.7 * c), (0, 0, side * 0.8), (0, 1.1, 0), (1, 1)
                            )
                            for f in range(int(height / 2))
                            for c in range(3)
                            if rng.random() < 0.45
                        ]
                        or [plane((-side * 2.52, 1, 0), (0, 0, side * 0.8), (0, 1, 0), (1, 1))]
                    ),
                    window,
                ),
            )
            file.node("House", house, at=(side * 7.5, 0, z))
    # Strings of lamps across the street.
    small = ball(1, 14, 8)
    lamps = [
        file.mesh((small, file.material((0, 0, 0), 1, emission=times(46, c))))
        for c in ((1, 0.45, 0.12), (1, 0.12, 0.05), (0.2, 0.8, 0.25), (0.22, 0.42, 1.0), (1, 0.7, 0.35))
    ]
    for k in range(7):
        z, n = -5 - 4.2 * k, 13
        wire = [(-5 + 10 * i / 40, 3.0 + 0.3 * k - 0.9 * sin(pi * i / 40), z + 0.4 * sin(i / 7 + k)) for i in range(41)]
        file.node("Wire", file.mesh((tube(wire, 0.006 + 0.001 * k, 5), iron)))
        for i in range(n):
            at = wire[2 + 3 * i]
            file.node("Bulb", lamps[(i + 2 * k) % 5], at=(at[0], at[1] - 0.05, at[2]), scale=(0.022 + 0.0045 * k,) * 3)
    # Cars that come nearer: two headlights each; and two that drive away.
    white = file.mesh((small, file.material((0, 0, 0), 1, emission=(110, 104, 90))))
    red = file.mesh((small, file.material((0, 0, 0), 1, emission=(70, 4, 2))))
    for k, (x, z, way, mesh) in enumerate(
        ((-1.6, -46, 10, white), (-1.9, -62, 9, white), (1.8, -16, -11, red), (1.5, -31, -9, red))
    ):
        car = file.node("Car", at=(x, 0.65, z))
        for side in (-0.62, 0.62):
            file.node("Light", mesh, parent=car, at=(side, 0, 0), scale=(0.09,) * 3)
        file.animate("traffic", car, "translation", [0, 2], [(x, 0.65, z), (x, 0.65, z + way)])
    # The lantern in focus, on a wooden rail.
    file.node("Rail", file.mesh((moved(box((3, 0.05, 0.30), 0.012, 12, 2), by=(0, 1.02, -1.28)), wood)))
    frame = join(
        lathe([(0, 0), (0.062, 0), (0.062, 0), (0.062, 0.012), (0.062, 0.012), (0.05, 0.02), (0, 0.02)], 32),
        moved(
            lathe([(0.06, 0), (0.06, 0), (0.035, 0.03), (0.012, 0.042), (0.012, 0.05), (0, 0.052)], 32),
            by=(0, 0.145, 0),
        ),
        *[
            tube([(0.05 * cos(a), 0.015, 0.05 * sin(a)), (0.05 * cos(a), 0.15, 0.05 * sin(a))], 0.0035, 8)
            for a in (pi / 4 + k * pi / 2 for k in range(4))
        ],
        tube([(0.035 * cos(pi * k / 16), 0.195 + 0.035 * sin(pi * k / 16), 0) for k in range(17)], 0.003, 8)
    )
    candle = lathe([(0.02, 0.02), (0.02, 0.07), (0.02, 0.07), (0, 0.068)], 24)
    fire = moved(ball(0.007, 14, 10), by=(0, 0.088, 0), scale=(1, 2.1, 1))
    wax = file.material((0.9, 0.75, 0.5), 0.6, emission=(0.55, 0.28, 0.08))
    file.node("Lantern", file.mesh((frame, iron), (candle, wax), (fire, flame)), at=(-0.13, 1.045, -1.25))
    bottle = lathe(
        [
            (0, 0),
            (0.03, 0),
            (0.03, 0),
            (0.034, 0.006),
            (0.034, 0.1),
            (0.028, 0.125),
            (0.012, 0.15),
            (0.012, 0.19),
            (0, 0.19),
        ],
        36,
    )
    file.node("Bottle", file.mesh((bottle, glass)), at=(0.17, 1.045, -1.33))
    file.write("night")
