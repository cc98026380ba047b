"""A hall with fine patterns: tiled floor, columns, woven hangings, newspapers. Lengths in metres."""
from math import cos, pi, sin

from gltf import File
from shapes import ball, box, join, lathe, moved, plane, sheet, tube, turn, unit


def hanging(width, height, folds):
    def surface(i, j):
        u, v = i / 48, j / 8
        depth = 0.07 * sin(2 * pi * folds * u) * (0.4 + 0.6 * (1 - v))
        slope = 0.07 * 2 * pi * folds / width * cos(2 * pi * folds * u)
        return (width * (u - 0.5), height * v, depth), unit((-slope, 0, 1)), (3.0 * u, 6 * (1 - v))

    return sheet(48, 8, surface)


def column():
    shaft = []
    for k in range(13):
        shaft.append((0.21 - 0.035 * (k / 12) ** 2, 0.30 + 2.5 * k / 12))
    return join(
        moved(box((0.6, 0.16, 0.6), 0.02, 3), by=(0, 0.08, 0)),
        lathe([(0.27, 0.16), (0.28, 0.19), (0.27, 0.23), (0.22, 0.25), (0.21, 0.30)], 36),
        lathe(shaft, 36),
        lathe([(0.175, 2.8), (0.20, 2.83), (0.19, 2.86), (0.27, 2.96)], 36),
        moved(box((0.58, 0.12, 0.58), 0.02, 3), by=(0, 3.02, 0)),
    )


def build():
    file = File()
    floor = file.material(roughness=0.35, picture="textures/tiles.png")
    cloth = file.material(roughness=0.95, picture="textures/weave.png")
    news = file.material(roughness=0.9, picture="textures/print.png")
    paper = file.material(roughness=0.95, picture="textures/wallpaper.png")
    stone, clay = file.material((0.80, 0.76, 0.68), 0.6), file.material((0.62, 0.27, 0.16), 0.35)
    bronze, dark = file.material((0.75, 0.52, 0.30), 0.28, 1), file.material((0.16, 0.12, 0.10), 0.6)

    walk = file.camera("Walk", 0.3941, (-0.55, 1.35, 3.4), turn((1, 0, 0), -7))
    file.camera("Side", 0.3941, (1.1, 0.9, -0.6), turn((0, 1, 0), 17))
    keys = [k / 24 for k in range(0, 49, 4)]
    file.animate(
        "dolly",
        walk,
        "translation",
        keys,
        [(-0.55 + 0.45 * k / 12, 1.35 - 0.1 * k / 12, 3.4 - 1.9 * k / 12) for k in range(13)],
    )
    file.node("Floor", file.mesh((plane((-5, 0, 5), (10, 0, 0), (0, 0, -19), (50, 90), (10, 19)), floor)))
    file.node("Back", file.mesh((plane((-5, 0, -14), (10, 0, 0), (0, 4.5, 0), (20, 9), (10, 4.5)), paper)))
    for side in (-1, 1):
        file.node(
            "Side wall",
            file.mesh(
                (plane((side * 3.2, 0, -7 + side * 12), (0, 0, -side * 24), (0, 4.5, 0), (48, 9), (24, 4.5)), stone)
            ),
        )
    pillar, cloth_mesh = file.mesh((column(), stone)), file.mesh((hanging(1.5, 2.3, 5), cloth))
    for k in range(6):
        for side in (-1, 1):
            file.node("Column", pillar, at=(1.75 * side, 0, 0.6 - 2.4 * k))
            file.node("Hanging", cloth_mesh, at=(3.08 * side, 0.75, -0.6 - 2.4 * k), turn=turn((0, 1, 0), -90 * side))
    vase = lathe(
        [
            (0, 0),
            (0.10, 0),
            (0.10, 0),
            (0.12, 0.02),
            (0.19, 0.18),
            (0.20, 0.28),
            (0.15, 0.40),
            (0.08, 0.48),
            (0.085, 0.54),
            (0.12, 0.57),
            (0.11, 0.56),
            (0.07, 0.5),
        ],
        48,
    )
    plinth = box((0.5, 0.62, 0.5), 0.02, 6)
    for k, (x, z, material) in enumerate(
        ((0.35, -0.9, clay), (-0.75, -2.6, bronze), (0.55, -5.2, clay), (-0.5, -8.2, bronze))
    ):
        file.node("Plinth", file.mesh((plinth, dark if k % 2 else stone)), at=(x, 0.31, z))
        file.node("Vase", file.mesh((vase, material)), at=(x, 0.62, z))
    sheet_ = file.mesh((plane((-0.3, 0, 0.4), (0.6, 0, 0), (0, 0.0, -0.8), (6, 8)), news))
    for k, (x, z, angle) in enumerate(((-0.35, 0.55, 25), (0.9, -0.1, -40), (-0.55, -1.1, 70), (0.25, -2.2, 10))):
        file.node("Newspaper", sheet_, at=(x, 0.004 + 0.001 * k, z), turn=turn((0, 1, 0), angle))
    easel = file.node("Easel", at=(-0.95, 0, -0.5), turn=turn((0, 1, 0), 28))
    file.node(
        "Board",
        file.mesh(
            (moved(plane((-0.36, 0, 0), (0.72, 0, 0), (0, 0.95, 0), (6, 8)), about=(1, 0, 0), degrees=-10), news)
        ),
        parent=easel,
        at=(0, 0.55, 0.02),
    )
    legs = join(
        *[tube([(x, 0, z), (0.05 * x, 1.65, -0.16)], 0.018, 8) for x, z in ((-0.42, 0.12), (0.42, 0.12), (0, -0.6))],
        tube([(-0.4, 0.54, 0.06), (0.4, 0.54, 0.06)], 0.02, 8)
    )
    file.node("Legs", file.mesh((legs, dark)), parent=easel)
    globe = file.mesh((ball(0.11, 28, 16), file.material((0.9, 0.8, 0.6), 0.5, emission=(5, 3.9, 2.4))))
    for k in range(5):
        file.node("Globe", globe, at=(0, 2.75, -0.6 - 2.4 * k))
        file.node("Rod", file.mesh((tube([(0, 2.85, -0.6 - 2.4 * k), (0, 4.5, -0.6 - 2.4 * k)], 0.008, 6), dark)))
    file.write("gallery")
