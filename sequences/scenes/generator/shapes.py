"""Triangle meshes: (points, unit normals, uvs, triangles)."""
import math
from math import cos, pi, sin


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def times(s, a):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return times(1 / length, a) if length > 0 else (0.0, 1.0, 0.0)


def turn(axis, degrees):
    """Quaternion x, y, z, w."""
    half = math.radians(degrees) / 2
    return (*times(sin(half), unit(axis)), cos(half))


def sheet(columns, rows, surface):
    """Grid of columns x rows cells; surface(i, j) gives point, normal, uv."""
    points, normals, uvs, triangles = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            p, n, t = surface(i, j)
            points.append(p), normals.append(n), uvs.append(t)
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    return points, normals, uvs, triangles


def join(*shapes):
    points, normals, uvs, triangles = [], [], [], []
    for p, n, t, f in shapes:
        first = len(points)
        points += p
        normals += n
        uvs += t
        triangles += [tuple(c + first for c in corners) for corners in f]
    return points, normals, uvs, triangles


def moved(shape, by=(0, 0, 0), scale=(1, 1, 1), about=None, degrees=0):
    def rotated(v):
        if about is None:
            return v
        k, a = unit(about), math.radians(degrees)
        return add(add(times(cos(a), v), times(sin(a), cross(k, v))), times(dot(k, v) * (1 - cos(a)), k))

    points, normals, uvs, triangles = shape
    return (
        [add(rotated(tuple(s * c for s, c in zip(scale, p))), by) for p in points],
        [unit(rotated(tuple(c / s for s, c in zip(scale, n)))) for n in normals],
        uvs,
        triangles,
    )


def plane(origin, u, v, cells, repeat=(1, 1)):
    """Parallelogram from origin along u and v, normal u x v; uv runs to `repeat`, v downwards in the picture."""
    normal = unit(cross(u, v))
    return sheet(
        cells[0],
        cells[1],
        lambda i, j: (
            add(origin, add(times(i / cells[0], u), times(j / cells[1], v))),
            normal,
            (repeat[0] * i / cells[0], repeat[1] * (1 - j / cells[1])),
        ),
    )


def box(size, bevel, cuts=3, steps=2):
    """Rounded box around the origin."""
    half = times(0.5, size)
    inner = sub(half, (bevel,) * 3)

    def line(axis):
        side = [-half[axis] + bevel * k / steps for k in range(steps)]
        return side + [inner[axis] * (2 * k / cuts - 1) for k in range(cuts + 1)] + [-s for s in reversed(side)]

    faces = []
    for axis in range(3):
        for sign in (-1, 1):
            a, b = (axis + 1) % 3, (axis + 2) % 3
            la, lb = line(a), line(b)

            def surface(i, j):
                q = [0, 0, 0]
                q[axis], q[a], q[b] = sign * half[axis], la[i], lb[j]
                core = tuple(min(max(c, -h), h) for c, h in zip(q, inner))
                normal = unit(sub(q, core))
                share_a, share_b = la[i] / (2 * half[a]) + 0.5, lb[j] / (2 * half[b]) + 0.5
                # Upright on the faces at front and back, whose a, b are x, y.
                return add(core, times(bevel, normal)), normal, (share_a, 1 - share_b)

            faces.append(sheet(len(la) - 1, len(lb) - 1, surface))
    return join(*faces)


def lathe(profile, segments=40, repeat=(1, 1)):
    """Turned around y; profile is (radius, y) from bottom to top, a point twice in a row makes an edge."""
    pieces, piece = [], [profile[0]]
    for p in profile[1:]:
        if p == piece[-1]:
            pieces.append(piece)
            piece = [p]
        else:
            piece.append(p)
    pieces.append(piece)
    shapes = []
    for piece in pieces:

        def surface(i, j, piece=piece):
            a = 2 * pi * i / segments
            before, after = piece[max(j - 1, 0)], piece[min(j + 1, len(piece) - 1)]
            nr, ny = after[1] - before[1], before[0] - after[0]
            r, y = piece[j]
            return (
                (r * sin(a), y, r * cos(a)),
                unit((nr * sin(a), ny, nr * cos(a))),
                (repeat[0] * i / segments, repeat[1] * (1 - j / max(len(piece) - 1, 1))),
            )

        shapes.append(sheet(segments, len(piece) - 1, surface))
    return join(*shapes)


def ball(radius, segments=24, rings=14):
    return lathe([(radius * sin(pi * j / rings), -radius * cos(pi * j / rings)) for j in range(rings + 1)], segments)


def tube(path, radius, sides=10, twist=0.0, bumps=0, bump=0.0, around=1):
    """Around a path of points; radius a number or a list. `bumps` strands, wound by `twist` turns, `bump` deep."""
    radii = radius if isinstance(radius, list) else [radius] * len(path)
    frames, up = [], None
    for k in range(len(path)):
        along = unit(sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)]))
        if up is None:
            up = unit(cross(along, (0, 0, 1) if abs(along[2]) < 0.9 else (1, 0, 0)))
        up = unit(sub(up, times(dot(up, along), along)))
        frames.append((up, cross(along, up)))

    def point(i, j):
        a = 2 * pi * i / sides
        r = radii[j] * (1 + bump * cos(bumps * (a + 2 * pi * twist * j / len(path))))
        out = add(times(cos(a), frames[j][0]), times(sin(a), frames[j][1]))
        return add(path[j], times(r, out))

    def surface(i, j):
        du = sub(point(i + 0.01, j), point(i - 0.01, j))
        dv = sub(point(i, min(j + 1, len(path) - 1)), point(i, max(j - 1, 0)))
        return point(i, j), unit(cross(du, dv)), (around * i / sides, j / len(path))

    return sheet(sides, len(path) - 1, surface)


def star(radius, notch, height):
    """Five points, ten facets each side, in the xy plane."""
    points, normals, uvs, triangles = [], [], [], []
    rim = [
        (r * sin(pi * k / 5), r * cos(pi * k / 5), 0.0) for k in range(10) for r in [radius if k % 2 == 0 else notch]
    ]
    for top in (height, -height):
        for k in range(10):
            a, b = (rim[k], rim[(k + 1) % 10]) if top < 0 else (rim[(k + 1) % 10], rim[k])
            corners = [(0.0, 0.0, top), a, b]
            normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])))
            triangles.append((len(points), len(points) + 1, len(points) + 2))
            points += corners
            normals += [normal] * 3
            uvs += [(0.0, 0.0)] * 3
    return points, normals, uvs, triangles
