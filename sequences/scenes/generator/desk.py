"""The desk of the five experiments: a cord with a knot, a flying star, a filing cabinet, a computer. Lengths in mm."""
from math import cos, pi, sin

from gltf import File
from shapes import ball, box, join, lathe, moved, plane, star, times, tube, turn

MM = 0.001
frames, fps = 100, 24


def mm(shape):
    return moved(shape, scale=(MM,) * 3)


def cord_path():
    """Down from above, through a trefoil knot, and on downwards; at 21 mm before the camera."""
    path = []
    for k in range(24):
        s = k / 24
        path.append((0.35 * sin(2.5 * s), 3.4 - 2.7 * s, 0.1 * sin(5 * s)))
    for k in range(3, 104):
        a = 2 * pi * (k / 107 - 0.235)
        path.append(
            (0.30 * (sin(a) + 2 * sin(2 * a)) * 0.62, 0.30 * (cos(a) - 2 * cos(2 * a)) * 0.62, -0.30 * sin(3 * a))
        )
    for k in range(1, 25):
        s = k / 24
        path.append((0.15 - 0.55 * sin(2.1 * s), -0.75 - 2.7 * s, 0.1 * sin(4 * s)))
    for _ in range(6):
        path = (
            [path[0]]
            + [
                times(0.25, tuple(a + 2 * b + c for a, b, c in zip(*path[k - 1 : k + 2])))
                for k in range(1, len(path) - 1)
            ]
            + [path[-1]]
        )
    return path


def keyboard(file, key, base, at):
    board = file.node("Keyboard", at=times(MM, at), turn=turn((0, 1, 0), 8))
    file.node("Case", base, parent=board)
    for row in range(4):
        for column in range(12):
            file.node(
                "Key", key, parent=board, at=times(MM, (-7.9 + 1.42 * column + 0.25 * row, 0.75, -1.9 + 1.35 * row))
            )


def computer(file, plastic, dark, lit):
    body = join(
        moved(box((26, 21, 6), 1.6, 6), by=(0, 13.5, 0)),
        moved(lathe([(9.0, -6), (12.5, 6)], 4), by=(0, 13.5, -8), about=(1, 0, 0), degrees=90),
    )
    foot = moved(lathe([(0, 0), (8, 0), (8, 0), (8, 1), (8, 1), (4, 2.6), (4, 4)], 32), by=(0, 0, -4))
    glass = plane((-10.4, 5.6, 3.06), (20.8, 0, 0), (0, 15.8, 0), (8, 6))
    bezel = join(
        *[
            moved(box(size, 0.35, 4), by=at)
            for size, at in (
                ((23, 1.3, 1.2), (0, 22.0, 3.1)),
                ((23, 1.3, 1.2), (0, 5.0, 3.1)),
                ((1.3, 18, 1.2), (-11.1, 13.5, 3.1)),
                ((1.3, 18, 1.2), (11.1, 13.5, 3.1)),
            )
        ]
    )
    lamp = moved(ball(0.35, 10, 6), by=(10, 3.6, 3.2))
    green = file.material((0.1, 0.3, 0.1), emission=(0.3, 3.0, 0.5))
    file.node(
        "Computer",
        file.mesh((mm(join(body, foot)), plastic), (mm(bezel), dark), (mm(glass), lit), (mm(lamp), green)),
        at=times(MM, (-8, 0, -150)),
        turn=turn((0, 1, 0), 10),
    )


def cabinet(file, steel, handle):
    parts, handles = [moved(box((21, 36, 20), 0.5, 8), by=(0, 18, 0))], []
    for k in range(3):
        y = 6.6 + 11.4 * k
        parts.append(moved(box((18.6, 10.4, 1.2), 0.4, 5), by=(0, y, 10.2)))
        handles.append(tube([(-3, y + 1, 10.6), (-3, y + 1, 12), (3, y + 1, 12), (3, y + 1, 10.6)], 0.35, 10))
        handles.append(moved(box((5, 1.8, 0.3), 0.1, 2), by=(0, y + 3.4, 10.9)))
    file.node(
        "Cabinet",
        file.mesh((mm(join(*parts)), steel), (mm(join(*handles)), handle)),
        at=times(MM, (19, 0, -158)),
        turn=turn((0, 1, 0), -14),
    )


def clutter(file, brass, leaves):
    mug = lathe([(0, 0), (3.6, 0), (3.6, 0), (4.0, 0.6), (4.1, 8.6), (3.9, 9), (3.6, 8.6), (3.5, 1), (0, 1)], 40)
    ear = tube([(4 + 2.2 * sin(pi * k / 12), 4.6 - 2.6 * cos(pi * k / 12), 0) for k in range(13)], 0.5, 10)
    glaze = file.material((0.75, 0.16, 0.10), 0.25)
    file.node("Mug", file.mesh((mm(join(mug, ear)), glaze)), at=times(MM, (-25.5, 0, -128)), turn=turn((0, 1, 0), -35))
    for k, (colour, lean) in enumerate((((0.9, 0.65, 0.1), 9), ((0.12, 0.35, 0.65), -11), ((0.15, 0.5, 0.25), 3))):
        pencil = moved(lathe([(0.55, 0), (0.55, 14)], 6), by=(0, 1, 0))
        tip = lathe([(0.55, 15), (0.1, 16.6), (0, 16.8)], 6)
        file.node(
            "Pencil",
            file.mesh((mm(pencil), file.material(colour, 0.4)), (mm(tip), file.material((0.8, 0.62, 0.42)))),
            at=times(MM, (-25.5 + 0.9 * (k - 1), 0, -128.5 + 0.8 * k)),
            turn=turn((0.4 * k, 0, 1), lean),
        )
    for k, (colour, size, angle) in enumerate(
        (
            ((0.13, 0.25, 0.42), (17, 2.6, 12), 4),
            ((0.55, 0.12, 0.12), (15, 2.0, 11), -9),
            ((0.75, 0.62, 0.35), (13, 3.0, 10), 14),
        )
    ):
        y = (1.3, 3.6, 6.1)[k]
        cover, pages = box(size, 0.25, 5), box((size[0] - 0.5, size[1] - 0.8, size[2] + 0.1), 0.1, 2)
        file.node(
            "Book",
            file.mesh((mm(cover), file.material(colour, 0.6)), (mm(pages), leaves)),
            at=times(MM, (7.5, y, -112)),
            turn=turn((0, 1, 0), angle),
        )
    file.node("Ball", file.mesh((mm(ball(2.4, 40, 24)), brass)), at=times(MM, (-9.5, 2.4, -98)))
    shade = lathe([(5.6, 0), (2.0, 6.5), (2.0, 6.5), (1.9, 6.4), (5.4, 0.05)], 36)
    stand = lathe([(0, 0), (4.2, 0), (4.2, 0), (4.2, 0.8), (4.2, 0.8), (0.5, 1.4), (0.45, 24)], 28)
    bulb = moved(ball(1.7, 20, 12), by=(0, 0.8, 0))
    lamp = file.node("Lamp", file.mesh((mm(stand), brass)), at=times(MM, (-38, 0, -185)))
    file.node(
        "Shade",
        file.mesh(
            (mm(shade), file.material((0.13, 0.32, 0.22), 0.35)), (mm(bulb), file.material(emission=(7, 4.8, 2.5)))
        ),
        parent=lamp,
        at=times(MM, (0, 23, 0)),
    )


def build():
    file = File()
    eye = file.camera("Camera", 0.2277, times(MM, (0, 17, 0)), turn((1, 0, 0), -4))
    wood = file.material(roughness=0.45, picture="textures/wood.png")
    wall = file.material(roughness=0.95, picture="textures/wallpaper.png")
    plastic, dark = file.material((0.70, 0.64, 0.52), 0.5), file.material((0.25, 0.24, 0.22), 0.5)
    steel, chrome = file.material((0.23, 0.33, 0.32), 0.35), file.material((0.9, 0.9, 0.92), 0.45, 1)
    brass, paper = file.material((0.95, 0.72, 0.34), 0.33, 1), file.material((0.92, 0.89, 0.80), 0.9)
    lit = file.material((0.02, 0.02, 0.02), 0.15, emission=(1.3, 1.3, 1.3), glow="textures/screen.png")

    file.node("Desk", file.mesh((mm(plane((-90, 0, -30), (180, 0, 0), (0, 0, -230), (60, 76), (3, 4))), wood)))
    file.node("Wall", file.mesh((mm(plane((-120, -5, -255), (240, 0, 0), (0, 90, 0), (40, 15), (12, 4.5))), wall)))
    page = file.material(roughness=0.9, picture="textures/print.png")
    file.node(
        "Page",
        file.mesh((mm(plane((-6, 0.06, 4), (12, 0, 0), (0, 0, -15), (6, 8))), page)),
        at=times(MM, (12, 0, -86)),
        turn=turn((0, 1, 0), 17),
    )
    file.node(
        "Poster",
        file.mesh((mm(plane((-11, -15, 0), (22, 0, 0), (0, 30, 0), (4, 5))), page)),
        at=times(MM, (34, 34, -254)),
    )
    computer(file, plastic, dark, lit)
    cabinet(file, steel, chrome)
    case = file.mesh((mm(moved(box((19.5, 1.3, 7.2), 0.5, 6), by=(0, 0.3, 0.2))), plastic))
    keyboard(file, file.mesh((mm(box((1.2, 0.9, 1.15), 0.3, 1)), paper)), case, (-9, 0.4, -131))
    clutter(file, brass, paper)

    cord = file.material((0.78, 0.60, 0.36), 0.8)
    rope = tube(cord_path(), 0.17, 36, 13, 3, 0.16)
    file.node("Cord", file.mesh((mm(rope), cord)), parent=eye, at=times(MM, (1.55, 0, -20.8)))
    gold = file.material((1.0, 0.66, 0.18), 0.3, 0.75)
    flying = file.mesh((mm(star(1.2, 0.5, 0.4)), gold))

    times_ = [k / fps for k in range(0, frames, 3)]
    spin = [turn((0.15, 0.1, 1), 20 - 103 * k / (frames - 1)) for k in range(0, frames, 3)]
    star_node = file.node("Star", flying, parent=eye, at=times(MM, (-6.3, -0.3, -40)))
    end = (frames - 1) / fps
    file.animate(
        "lateral", star_node, "translation", [0, end], [times(MM, (-6.3, -0.3, -40)), times(MM, (6.3, -0.3, -40))]
    )
    file.animate("lateral", star_node, "rotation", times_, spin)
    # Away at constant speed in 1/z, from 24 mm to before the wall, as it looks steady.
    depth = [1 / (1 / 24 + (1 / 170 - 1 / 24) * (k / (frames - 1))) for k in range(0, frames, 3)]
    depth[-1] = 170
    file.animate("zoom", star_node, "translation", times_, [times(MM, (-0.018 * z, 0.012 * z, -z)) for z in depth])
    file.animate("zoom", star_node, "rotation", times_, spin)
    file.animate(
        "follow",
        star_node,
        "translation",
        times_,
        [times(MM, ((-0.12 + 0.2 * k / 33) * z, (0.01 + 0.03 * k / 33) * z, -z)) for k, z in enumerate(depth)],
    )
    file.animate("follow", star_node, "rotation", times_, spin)
    still = [turn((0, 0, 1), 12)] * 2
    file.animate("rest", star_node, "rotation", [0, end], still)
    file.write("desk")
