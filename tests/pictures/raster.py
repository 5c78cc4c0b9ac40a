"""A small software rasteriser: orthographic, z-buffered, deferred shading with shadows. Needs numpy and nothing else.

Geometry is a list of patches. A patch is a dict of arrays: `points` (n, 3) in metres, `colours` (n, 3) in linear RGB, and
either `normals` (n, 3) and `triangles` (m, 3), indices of a surface, or `radius`, of a sphere at each point.
"""

import numpy


def unit(vectors):
    lengths = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / numpy.where(lengths > 0, lengths, 1)


class Camera:
    """Looks along `forward` at `centre`; `metres_per_pixel` everywhere, because the projection is orthographic."""

    def __init__(self, centre, forward, up, metres_per_pixel, width, height):
        self.centre = numpy.asarray(centre, float)
        self.forward = unit(numpy.asarray(forward, float))
        self.right = unit(numpy.cross(self.forward, up))
        self.up = numpy.cross(self.right, self.forward)
        self.metres_per_pixel = metres_per_pixel
        self.width, self.height = width, height

    def project(self, points):
        """x and y in pixels and the distance along the view in metres."""
        local = numpy.asarray(points) - self.centre
        x = self.width / 2 + local @ self.right / self.metres_per_pixel
        y = self.height / 2 - local @ self.up / self.metres_per_pixel
        return numpy.stack([x, y, local @ self.forward], axis=-1)


class Buffers:
    """What each pixel shows: distance, normal, colour, position."""

    def __init__(self, camera):
        shape = (camera.height, camera.width)
        self.depth = numpy.full(shape, numpy.inf)
        self.normal = numpy.zeros(shape + (3,))
        self.colour = numpy.zeros(shape + (3,))


def draw(camera, patches):
    """Rasterise patches."""
    buffers = Buffers(camera)
    for patch in patches:
        screen = camera.project(patch["points"])
        if "radius" in patch:
            for centre, colour in zip(screen, patch["colours"]):
                fill_sphere(buffers, camera, centre, patch["radius"], colour)
            continue
        attributes = numpy.concatenate([patch["normals"], patch["colours"]], axis=1)
        for triangle in patch["triangles"]:
            fill(buffers, screen[triangle], attributes[triangle])
    buffers.normal = unit(buffers.normal)
    return buffers


def fill(buffers, corners, attributes):
    """One triangle: the pixels whose centres it covers and that nothing nearer covers."""
    height, width = buffers.depth.shape
    x0, y0 = numpy.floor(corners[:, :2].min(axis=0) - 0.5).astype(int)
    x1, y1 = numpy.ceil(corners[:, :2].max(axis=0) + 0.5).astype(int)
    x0, y0, x1, y1 = max(x0, 0), max(y0, 0), min(x1, width), min(y1, height)
    if x0 >= x1 or y0 >= y1:
        return
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    if abs(area) < 1e-12:
        return
    x = numpy.arange(x0, x1) + 0.5
    y = (numpy.arange(y0, y1) + 0.5)[:, None]
    b = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
    c = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
    a = 1 - b - c
    depth = a * az + b * bz + c * cz
    window = buffers.depth[y0:y1, x0:x1]
    inside = (a >= 0) & (b >= 0) & (c >= 0) & (depth < window)
    if not inside.any():
        return
    window[inside] = depth[inside]
    weights = numpy.stack([a[inside], b[inside], c[inside]], axis=-1)
    values = weights @ attributes
    buffers.normal[y0:y1, x0:x1][inside] = values[:, :3]
    buffers.colour[y0:y1, x0:x1][inside] = values[:, 3:]


def fill_sphere(buffers, camera, centre, radius_m, colour):
    """One sphere, exact to the pixel."""
    height, width = buffers.depth.shape
    reach = radius_m / camera.metres_per_pixel
    x0, y0 = max(int(centre[0] - reach), 0), max(int(centre[1] - reach), 0)
    x1, y1 = min(int(centre[0] + reach) + 2, width), min(int(centre[1] + reach) + 2, height)
    if x0 >= x1 or y0 >= y1:
        return
    right = (numpy.arange(x0, x1) + 0.5 - centre[0]) / reach
    up = (centre[1] - numpy.arange(y0, y1)[:, None] - 0.5) / reach
    inside = right**2 + up**2 < 1
    toward = numpy.sqrt(numpy.clip(1 - right**2 - up**2, 0, None))
    depth = centre[2] - toward * radius_m
    inside &= depth < buffers.depth[y0:y1, x0:x1]
    normal = right[None, :, None] * camera.right + up[..., None] * camera.up - toward[..., None] * camera.forward
    buffers.depth[y0:y1, x0:x1][inside] = depth[inside]
    buffers.normal[y0:y1, x0:x1][inside] = normal[inside]
    buffers.colour[y0:y1, x0:x1][inside] = colour


def blurred(image, radius):
    """Mean over a square window, three times: nearly a Gaussian."""
    for _ in range(3):
        for axis in (0, 1):
            padded = numpy.insert(numpy.cumsum(image, axis=axis), 0, 0, axis=axis)
            size = image.shape[axis]
            low = numpy.clip(numpy.arange(size) - radius, 0, size)
            high = numpy.clip(numpy.arange(size) + radius + 1, 0, size)
            span = (high - low).reshape([-1 if i == axis else 1 for i in range(image.ndim)])
            image = (numpy.take(padded, high, axis=axis) - numpy.take(padded, low, axis=axis)) / span
    return image


def shadows(camera, buffers, patches, light, metres_per_texel):
    """Share of the key light that reaches each pixel, from a picture taken from the light."""
    points = numpy.concatenate([patch["points"] for patch in patches])
    side = numpy.cross(light, [0.3, 0.5, 0.8])
    eye = Camera(points.mean(axis=0), -light, side, metres_per_texel, 1, 1)
    extents = numpy.abs((points - eye.centre) @ numpy.stack([eye.right, eye.up]).T).max(axis=0)
    eye.width, eye.height = (int(2 * extent / metres_per_texel) + 8 for extent in extents)
    depth = draw(eye, patches).depth

    y, x = numpy.mgrid[: camera.height, : camera.width]
    offset_x = (x + 0.5 - camera.width / 2) * camera.metres_per_pixel
    offset_y = (camera.height / 2 - y - 0.5) * camera.metres_per_pixel
    distance = numpy.where(numpy.isfinite(buffers.depth), buffers.depth, 0)
    position = camera.centre + offset_x[..., None] * camera.right + offset_y[..., None] * camera.up
    position = position + distance[..., None] * camera.forward + buffers.normal * 3 * metres_per_texel
    texel = eye.project(position)
    lit = numpy.zeros(distance.shape)
    reach = range(-2, 3)
    for dx in reach:
        for dy in reach:
            column = numpy.clip((texel[..., 0] + 1.5 * dx).astype(int), 0, eye.width - 1)
            row = numpy.clip((texel[..., 1] + 1.5 * dy).astype(int), 0, eye.height - 1)
            lit += texel[..., 2] < depth[row, column] + 4 * metres_per_texel
    return lit / len(reach) ** 2


def shade(camera, buffers, patches, shadow_texel_m=4e-4):
    """Linear RGB and coverage of the picture: key light with shadows, sky light, a soft highlight, dark creases."""
    covered = numpy.isfinite(buffers.depth)
    toward = -camera.forward
    key = unit(-0.55 * camera.right + 0.65 * camera.up + 0.75 * toward)
    normal = buffers.normal * numpy.sign(buffers.normal @ toward + 1e-9)[..., None]

    lit = shadows(camera, buffers, patches, key, shadow_texel_m)
    diffuse = numpy.clip(normal @ key, 0, None) * lit
    fill_light = numpy.clip(normal @ unit(0.8 * camera.right + 0.1 * camera.up + 0.6 * toward), 0, None)
    sky = 0.5 + 0.5 * (normal @ camera.up)
    half = unit(key + toward)
    highlight = numpy.clip(normal @ half, 0, None) ** 160 * lit
    edge = (1 - numpy.clip(normal @ toward, 0, 1)) ** 3

    # Darker where the surroundings are nearer to the eye: the bottom of a dent, the ground below a rod.
    distance = numpy.where(covered, buffers.depth, 0)
    creases = numpy.ones_like(distance)
    for size_m in (0.002, 0.007):
        radius = max(1, int(size_m / camera.metres_per_pixel))
        weight = blurred(covered.astype(float), radius)
        around = blurred(distance, radius) / numpy.where(weight > 0, weight, 1)
        creases *= 1 - 0.55 * numpy.clip((distance - around) / (2 * size_m), 0, 1)

    colour = buffers.colour * (1.15 * diffuse + (0.34 + 0.30 * fill_light + 0.30 * sky) * creases)[..., None]
    colour = colour + (0.07 * highlight + 0.05 * edge)[..., None]
    return numpy.where(covered[..., None], colour, 0), covered.astype(float)


def linear(srgb):
    srgb = numpy.asarray(srgb, float)
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def srgb(linear_rgb):
    clipped = numpy.clip(linear_rgb, 0, 1)
    return numpy.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
