"""Pictures, as functions of the pixel; all of them tile."""
import math

from gltf import png


def noise(x, y, period, seed):
    """Smooth value noise 0..1 that repeats after `period` cells."""

    def value(i, j):
        h = ((i % period) * 374761393 + (j % period) * 668265263 + seed * 2246822519) & 0xFFFFFFFF
        h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
        return ((h ^ (h >> 16)) & 0xFFFF) / 65535

    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    top = value(i, j) * (1 - u) + value(i + 1, j) * u
    return top * (1 - v) + (value(i, j + 1) * (1 - u) + value(i + 1, j + 1) * u) * v


def mix(a, b, s):
    return tuple(x + (y - x) * s for x, y in zip(a, b))


def shaded(c, s):
    return tuple(x * s for x in c)


def wood(x, y, n=256):
    grain = noise(x / n * 4, y / n * 32, 32, 1) * 0.6 + noise(x / n * 8, y / n * 128, 128, 2) * 0.4
    board = int(y / n * 4)
    seam = 0.55 if (y % (n // 4)) < 2 else 1.0
    tone = 0.85 + 0.22 * noise(board, 0.5, 4, 9)
    return shaded(mix((0.50, 0.31, 0.17), (0.72, 0.49, 0.29), grain), tone * seam)


def tiles(x, y, n=256):
    cell = n // 4
    light = (x // cell + y // cell) % 2 == 0
    vein = abs(noise(x / 16, y / 16, n // 16, 3) + 0.4 * noise(x / 5.12, y / 5.12, 50, 4) - 0.7)
    base = (
        mix((0.55, 0.52, 0.48), (0.93, 0.90, 0.84), min(vein * 5, 1))
        if light
        else mix((0.45, 0.30, 0.24), (0.20, 0.13, 0.12), min(vein * 5, 1))
    )
    return (0.25, 0.24, 0.22) if x % cell == 0 or y % cell == 0 else base


def weave(x, y, n=128):
    over = (x // 4 + y // 4) % 2 == 0
    across = math.sin(math.pi * ((y if over else x) % 4 + 0.5) / 4)
    warp, weft = (0.74, 0.20, 0.16), (0.93, 0.82, 0.60)
    stripe = (y if not over else x) % n // 16 % 4 == 0
    return shaded(mix(warp if over else weft, (0.12, 0.22, 0.42), 0.8 if stripe else 0), 0.45 + 0.55 * across)


def wallpaper(x, y, n=256):
    u, v = x % 64 - 32, (y + (32 if x // 64 % 2 else 0)) % 64 - 32
    r, a = math.hypot(u, v), math.atan2(v, u)
    petal = r < 14 + 7 * math.cos(6 * a)
    stripe = 0.96 if x // 8 % 2 else 1.0
    base = mix((0.28, 0.47, 0.50), (0.36, 0.55, 0.57), noise(x / 8, y / 8, 16, 5))
    return shaded((0.88, 0.80, 0.58) if r < 6 else (0.70, 0.78, 0.70) if petal else base, stripe)


def screen(x, y, n=128):
    """A terminal: lines of green and amber words, and a plot."""
    glow = (0.02, 0.05, 0.07)
    if x < 6 or y < 6 or x > n - 7 or y > n - 7:
        return (0.01, 0.02, 0.03)
    if y < 14:
        return (0.10, 0.45, 0.75)
    if x > 66 and 22 < y < 76:
        u = (x - 67) / 54
        curve = 74 - 44 * math.exp(-(((u - 0.55) / 0.2) ** 2)) - 6 * u
        if x < 69 or y > 73:
            return (0.6, 0.7, 0.7)
        return (1.0, 0.65, 0.15) if abs(y - curve) < 1.6 else (0.05, 0.14, 0.19) if y > curve else glow
    line, column = (y - 18) // 6, (x - 8) // 3
    length = 8 + int(11 * noise(line * 3.7, 0.5, 97, 7)) + (20 if y > 80 else 0)
    inked = (y - 18) % 6 < 4 and (x - 8) % 3 < 2 and noise(column * 5.3, line * 9.1, 89, 8) > 0.34 and column < length
    return ((0.35, 0.95, 0.55) if line % 4 else (0.95, 0.75, 0.30)) if inked else glow


def print_(x, y, n=256):
    """A page of small print."""
    line, column = y // 8, x // 5
    inked = y % 8 < 5 and x % 5 < 4 and noise(column * 3.1, line * 7.7, 83, 11) > 0.3 and 8 < x < n - 8
    stroke = noise(x * 0.9, y * 0.9, 251, 12) > 0.42
    head = y < 32
    if head:
        return (
            (0.15, 0.13, 0.12)
            if 4 < y < 26 and (x // 14) % 5 != 4 and noise(x / 3, y / 5, 101, 13) > 0.4
            else (0.92, 0.89, 0.80)
        )
    return (0.16, 0.15, 0.15) if inked and stroke else (0.92, 0.89, 0.80)


def bark(x, y, n=128):
    ridge = noise(x / 8, y / 32, 16, 14) * 0.6 + noise(x / 4, y / 8, 32, 15) * 0.4
    return mix((0.16, 0.11, 0.08), (0.45, 0.35, 0.27), ridge)


def asphalt(x, y, n=128):
    grain = noise(x / 2, y / 2, 64, 16) * 0.6 + noise(x / 16, y / 16, 8, 17) * 0.4
    return mix((0.20, 0.21, 0.23), (0.42, 0.42, 0.42), grain)


def evening(x, y, n=256):
    """Sky over hills, of a backdrop: v = 0 is its top."""
    v = y / n
    sky = mix((0.36, 0.55, 0.86), (1.0, 0.80, 0.52), min(1, (v / 0.72) ** 1.5))
    cloud = noise(x / 25.6, y / 10.67, 10, 18) * 0.6 + noise(x / 12.8, y / 5.33, 20, 19) * 0.4
    sky = mix(sky, (1.0, 0.93, 0.85), max(0, cloud - 0.5) * 1.6)
    for depth, height, tone in (
        (0.70, 0.06, (0.62, 0.56, 0.62)),
        (0.79, 0.07, (0.36, 0.38, 0.44)),
        (0.90, 0.06, (0.16, 0.20, 0.20)),
    ):
        if v > depth - height * (noise(x / 51.2, 0.5, 5, int(depth * 100)) + 0.3 * noise(x / 12.8, 0.5, 20, 20)):
            sky = tone
    return sky


def write_all():
    for name, size, pixel in (
        ("wood", 256, wood),
        ("tiles", 256, tiles),
        ("weave", 128, weave),
        ("print", 256, print_),
        ("wallpaper", 128, wallpaper),
        ("screen", 128, screen),
        ("bark", 128, bark),
        ("asphalt", 128, asphalt),
        ("evening", 256, evening),
    ):
        png("textures/%s.png" % name, size, size, pixel)
