"""A thin-edged body: a lens of 159 x 99 mm, 35 mm thick in the middle, its rounded edge 5 mm thick.

    python wedge.py               writes meshes/wedge.obj (1 um steps) and prints how well its triangles are shaped

A sharp lens over an ellipse, half axes `AXES`: with r the elliptic radius, 1 at the rim, its upper side is at
22 mm (1 - r^2)^1.5 and its lower at -8 mm (1 - r^2)^1.5. Every point is then moved outwards by `EDGE`, which rounds the rim
by a half circle (three flat strips). Both sides meet the rim flat: 10 mm from the edge the body is 7 to 10 mm thick. The
triangles come from points that push each other apart in the plan, starting from a lattice: no random number."""

from pathlib import Path

import numpy as np
from scipy.spatial import Delaunay

import shared  # noqa: F401

from surface import Surface, read_obj

PATH = Path(__file__).parent / "meshes" / "wedge.obj"
AXES = np.array([0.0775, 0.0475])
UPPER, LOWER, EDGE = 0.022, -0.008, 0.0025
RIM_POINTS, ROWS = 125, 3  # around the rim (odd, see build), and triangles across it
SIZE_MIDDLE = 0.0063
HELD_RADIUS = 0.6


def held(surface: Surface) -> np.ndarray:
    """Vertices of the underside within the elliptic radius `HELD_RADIUS`: what the body lies on. (V,) bool."""
    radius = np.linalg.norm(surface.vertices[:, :2] / AXES, axis=1)
    return (surface.vertices[:, 2] < 0) & (radius <= HELD_RADIUS)


def rim(offset: float) -> np.ndarray:
    """`RIM_POINTS` points of the ellipse evenly along it, the first `offset` steps from the x axis. (n, 2)."""
    angle = np.linspace(0, 2 * np.pi, 100_001)
    points = AXES * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    length = np.r_[0, np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()]
    at = np.interp((np.arange(RIM_POINTS) + offset) / RIM_POINTS * length[-1], length, angle)
    return AXES * np.stack([np.cos(at), np.sin(at)], axis=1)


def plan(border: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (border first) and triangles of the ellipse. Edges shorter than wanted push their ends apart; the wanted length
    goes from that of the border to `SIZE_MIDDLE`."""
    step = np.linalg.norm(border[1] - border[0])

    def wanted(x):
        return step + (SIZE_MIDDLE - step) * np.minimum(1.6 * (1 - np.linalg.norm(x / AXES, axis=1)), 1.0)

    # A lattice as dense as needed at the rim, thinned towards the middle by a fixed sequence.
    pitch = step * np.array([1.0, 0.75**0.5])
    count = (AXES / pitch).astype(int) + 1
    i, j = (k.ravel() for k in np.meshgrid(np.arange(-count[0], count[0] + 1), np.arange(-count[1], count[1] + 1)))
    lattice = np.stack([i + 0.5 * (j % 2), j], axis=1) * pitch
    lattice = lattice[np.linalg.norm(lattice / (AXES - 0.6 * step), axis=1) < 1]
    golden = np.arange(len(lattice)) * 0.6180339887498949 % 1
    lattice = lattice[golden < (step / wanted(lattice)) ** 2]
    points = np.vstack([border, lattice])
    for _ in range(400):
        triangles = Delaunay(points).simplices
        ends = np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
        along = points[ends[:, 0]] - points[ends[:, 1]]
        length = np.linalg.norm(along, axis=1)
        aim = wanted(points[ends].mean(axis=1))
        aim *= 1.2 * np.linalg.norm(length) / np.linalg.norm(aim)
        push = np.maximum(aim / length - 1, 0)[:, None] * along
        force = np.zeros_like(points)
        np.add.at(force, ends[:, 0], push)
        np.add.at(force, ends[:, 1], -push)
        points[len(border) :] += 0.2 * force[len(border) :]
        radius = np.linalg.norm(points[len(border) :] / (AXES - 0.5 * step), axis=1)
        points[len(border) :] /= np.maximum(radius, 1)[:, None]  # none closer to the border than half a triangle
    triangles = Delaunay(points).simplices
    a, b, c = (points[triangles[:, k]] for k in range(3))
    turned = np.cross(np.c_[b - a, 0 * a[:, 0]], np.c_[c - a, 0 * a[:, 0]])[:, 2] < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return points, triangles


def side(points: np.ndarray, height: float) -> np.ndarray:
    """The plan's points on the upper or lower side, moved outwards by `EDGE`. (n, 3)."""
    inside = np.maximum(1 - ((points / AXES) ** 2).sum(1), 0)
    slope = -3 * height * np.sqrt(inside)[:, None] * points / AXES**2
    normal = np.c_[-slope, np.ones(len(points))] * np.sign(height)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return np.c_[points, height * inside**1.5] + EDGE * normal


def build() -> Surface:
    """Upper side, lower side and the half circle between. Each row of the rim is half a step from the next; as the number
    of its points is odd, the last row is the first one mirrored, so one plan serves both sides."""
    points, triangles = plan(rim(0.0))
    count, n = len(points), RIM_POINTS
    mirrored = points * [-1, 1]
    vertices = [side(points, UPPER), side(mirrored, LOWER)]
    faces = [triangles, count + triangles]
    place = np.arange(n)
    # Counter-clockwise seen from above, starting half a step from the x axis: the mirrored rim, numbered on from there.
    last = count + (n // 2 - place) % n
    rows = [place]
    for row in range(1, ROWS):
        border = rim(0.5 * (row % 2))
        outwards = border / AXES**2
        outwards /= np.linalg.norm(outwards, axis=1)[:, None]
        angle = np.pi / 2 - np.pi * row / ROWS
        rows.append(2 * count + (row - 1) * n + place)
        vertices.append(np.c_[border + EDGE * np.cos(angle) * outwards, np.full(n, EDGE * np.sin(angle))])
    rows.append(last)
    for row, (above, below) in enumerate(zip(rows, rows[1:])):
        if row % 2 == 0:  # the row below is half a step ahead
            pairs = [(above, below, np.roll(above, -1)), (below, np.roll(below, -1), np.roll(above, -1))]
        else:
            pairs = [(above, below, np.roll(below, -1)), (above, np.roll(below, -1), np.roll(above, -1))]
        faces += [np.stack(p, axis=1) for p in pairs]
    return Surface(np.round(np.vstack(vertices), 6), np.vstack(faces))


def write(surface: Surface) -> None:
    lines = [f"# thin-edged lens, {len(surface.vertices)} vertices, {len(surface.faces)} triangles, metres"]
    lines.append("# made by: wedge.py")
    lines += ["v {:.6f} {:.6f} {:.6f}".format(*v) for v in surface.vertices]
    lines += ["f {} {} {}".format(*(f + 1)) for f in surface.faces]
    PATH.parent.mkdir(exist_ok=True)
    PATH.write_text("\n".join(lines) + "\n")


def angles(surface: Surface) -> np.ndarray:
    """Angles of all triangles in degrees, (T, 3)."""
    p = surface.vertices[surface.faces]
    a, b = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=2), (a * b).sum(2)))


if __name__ == "__main__":
    write(build())
    body = read_obj(PATH)
    smallest = angles(body).min(axis=1)
    extent = np.ptp(body.vertices, axis=0) * 1e3
    print(
        f"wrote {PATH.name}: {len(body.vertices)} vertices, {len(body.faces)} triangles, {held(body).sum()} vertices held, "
        f"{extent.round(2)} mm, smallest angle {smallest.min():.1f} deg (1 % below {np.percentile(smallest, 1):.1f} deg)"
    )
