#!/usr/bin/env python3
"""A picture of a session from its markers: the deformed organ with probe, force and chains, and the contact close up.

    render.py --live SECONDS [--namespace NS] [--pull] --output FILE.png
    render.py --recording DIRECTORY [--namespace NS] [--pull] --output FILE.png

Takes the moment of the deepest press, or with --pull of the farthest pull. The organ's colours are those of the markers;
the legend is measured from them, with the rest surface of `body_mesh`.
"""

import argparse
import sys
from pathlib import Path

import numpy
from PIL import Image, ImageDraw, ImageFont

import capture
import shapes
from raster import Camera, draw, shade, srgb, unit

WIDTH, HEIGHT = 1600, 800
SUPERSAMPLING = 2
ORGAN = (990, 660)
CLOSE_UP = (1000, 40, 560, 450)
CLOSE_UP_M = 0.074
PAPER, INK, FAINT = (250, 250, 248), (40, 42, 46), (120, 124, 130)
SPHERE, ARROW, LINE_LIST, SPHERE_LIST, TRIANGLE_LIST = 2, 0, 5, 7, 11


class Scene:
    """The markers of one moment as geometry in one frame."""

    def __init__(self, recorder):
        self.moment = recorder.best
        self.recorder = recorder
        body = self.moment.markers["body", 0]
        self.deformed = self.points(body)
        self.corner_colours = colours_of(body)
        rest = numpy.array([[v.x, v.y, v.z] for v in recorder.mesh.vertices])
        corners = numpy.array([list(t.vertex_indices) for t in recorder.mesh.triangles]).reshape(-1)
        self.displacement_m = numpy.linalg.norm(self.deformed - self.moved(rest[corners], body.header.frame_id), axis=1)
        self.body = shapes.of_triangles(self.deformed, self.corner_colours)
        self.probe_centre = self.points(self.moment.markers["probe", 0])[0]
        self.probe_radius = self.moment.markers["probe", 0].scale.x / 2
        self.contact = self.points(self.moment.markers["chains", 2])[0]
        proxy = self.points(self.moment.markers["proxy", 0])[0]
        arrow = self.points(self.moment.markers["force", 0])
        self.normal = unit((arrow[1] - arrow[0]) * numpy.sign(self.moment.depth_m))
        self.proxy = proxy

    def moved(self, points, frame_id):
        root_from_frame = self.recorder.root_from(frame_id)
        return points @ root_from_frame[:3, :3].T + root_from_frame[:3, 3]

    def points(self, marker):
        points = numpy.array([[p.x, p.y, p.z] for p in marker.points]).reshape(-1, 3)
        if marker.type == SPHERE:
            position = marker.pose.position
            points = numpy.array([[position.x, position.y, position.z]])
        return self.moved(points, marker.header.frame_id)

    def arrow(self):
        marker = self.moment.markers["force", 0]
        start, end = self.points(marker)
        return shapes.of_arrow(start, end, marker.scale.x, marker.scale.y, marker.scale.z, colour_of(marker))

    def chains(self, thinnest_m):
        """Rods and springs as tubes, mass points as spheres, none thinner than `thinnest_m`."""
        patches = []
        for marker in self.parts_of_chains(0) + self.parts_of_chains(1):
            radius = max(marker.scale.x, thinnest_m) / 2
            ends, colours = self.points(marker).reshape(-1, 2, 3), colours_of(marker)[::2]
            patches += [shapes.of_tube(a, b, (radius, radius), colour, 6) for (a, b), colour in zip(ends, colours)]
        for marker in self.parts_of_chains(2):
            radius = max(marker.scale.x, 1.5 * thinnest_m) / 2
            patches.append(shapes.of_spheres(self.points(marker), radius, colour_of(marker)))
        return patches

    def parts_of_chains(self, part):
        """Markers of the rods (0), springs (1) or mass points (2), one for each size of units."""
        return [marker for (name, i), marker in self.moment.markers.items() if name == "chains" and i % 3 == part]


def colour_of(marker):
    return numpy.array([marker.color.r, marker.color.g, marker.color.b])


def colours_of(marker):
    return numpy.array([[c.r, c.g, c.b] for c in marker.colors])


def view_of_contact(normal, body_points, elevation):
    """Forward and up of a camera that sees the contact obliquely from outside, the body's long side across the picture."""
    centred = body_points - body_points.mean(axis=0)
    long_side = numpy.linalg.svd(centred, full_matrices=False)[2][0]
    across = unit(long_side - normal * (long_side @ normal))
    level = numpy.cross(across, normal)
    forward = -(numpy.sin(elevation) * normal + numpy.cos(elevation) * level)
    return forward, normal


def picture(camera, solid, hidden=(), glass=()):
    """Linear RGB and coverage. Of `hidden` patches, which must be solid too, what lies below the surface shines
    through; `glass` patches are blended over everything behind them."""
    buffers = draw(camera, solid)
    colour, alpha = shade(camera, buffers, solid)
    light = unit(-0.55 * camera.right + 0.65 * camera.up - 0.75 * camera.forward)
    if hidden:
        below = draw(camera, hidden)
        opacity = numpy.where(numpy.isfinite(below.depth) & (below.depth > buffers.depth + 1e-4), 0.38, 0)[..., None]
        glow = 0.55 + 0.45 * numpy.clip(below.normal @ light, 0, 1)
        colour = colour * (1 - opacity) + below.colour * glow[..., None] * opacity
    for patch in glass:
        pane = draw(camera, [patch])
        facing = numpy.clip(pane.normal @ -camera.forward, 0, 1)
        opacity = numpy.where(pane.depth < buffers.depth, 0.30 + 0.55 * (1 - facing) ** 2, 0)[..., None]
        highlight = numpy.clip(pane.normal @ unit(light - camera.forward), 0, 1) ** 80
        glow = 0.55 + 0.45 * numpy.clip(pane.normal @ light, 0, 1) + 0.8 * highlight
        colour = colour * (1 - opacity) + pane.colour * glow[..., None] * opacity
        alpha = numpy.maximum(alpha, opacity[..., 0])
    # `colour` is premultiplied where glass stands alone; elsewhere alpha is 0 or 1.
    return colour, alpha


def on_paper(colour, alpha):
    """Blend over paper in linear light and reduce the supersampling."""
    paper = ((numpy.array(PAPER) / 255 + 0.055) / 1.055) ** 2.4
    blended = colour + paper * (1 - alpha[..., None])
    height, width = (size // SUPERSAMPLING for size in alpha.shape)
    reduced = blended.reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 3).mean(axis=(1, 3))
    return Image.fromarray((srgb(reduced) * 255 + 0.5).astype(numpy.uint8))


def font(size):
    return ImageFont.load_default(size)


def scale_bar(canvas, camera, left, bottom, length_m):
    """A bar of true length; the projection is orthographic, so it holds everywhere in the panel."""
    pixels = length_m / camera.metres_per_pixel / SUPERSAMPLING
    canvas.rounded_rectangle([left - 14, bottom - 40, left + pixels + 14, bottom + 16], 6, fill=PAPER)
    canvas.line([(left, bottom), (left + pixels, bottom)], fill=INK, width=3)
    for end in (left, left + pixels):
        canvas.line([(end, bottom - 6), (end, bottom + 6)], fill=INK, width=3)
    canvas.text((left + pixels / 2, bottom - 10), f"{length_m * 1e3:g} mm", fill=INK, font=font(20), anchor="mb")


def legend(canvas, scene, left, top, width, height):
    """Colour against displacement, measured from the corners of the drawn triangles."""
    order = numpy.argsort(scene.displacement_m)
    largest = scene.displacement_m[order[-1]]
    shares = (numpy.arange(width) + 0.5) / width * largest
    bar = [numpy.interp(shares, scene.displacement_m[order], scene.corner_colours[order, i]) for i in range(3)]
    for x, colour in enumerate(numpy.stack(bar, axis=1)):
        canvas.line([(left + x, top), (left + x, top + height)], fill=tuple(int(255 * c + 0.5) for c in colour))
    canvas.rectangle([left, top, left + width, top + height], outline=FAINT)
    for mm in range(int(largest * 1e3 + 1e-9) + 1):
        x = left + mm / (largest * 1e3) * width
        canvas.line([(x, top + height), (x, top + height + 6)], fill=INK, width=2)
        canvas.text((x, top + height + 9), str(mm), fill=INK, font=font(18), anchor="mt")
    canvas.text((left, top - 8), "displacement of the surface, mm", fill=INK, font=font(20), anchor="lb")


def key(canvas, scene, left, top):
    """What the parts of the chains are."""
    springs = colours_of(scene.parts_of_chains(1)[0])
    normal, tangential = springs[0], springs[-1]
    chains = list(dict.fromkeys(tuple(colour) for rods in scene.parts_of_chains(0) for colour in colours_of(rods)))
    rows = [(chains, "rods, one colour for each parallel chain"), ([colour_of(scene.parts_of_chains(2)[0])], "mass points")]
    rows += [([normal], "normal springs"), ([tangential], "tangential springs")]
    for row, (colours, text) in enumerate(rows):
        y = top + 30 * row
        part = 36 / len(colours)
        for i, colour in enumerate(colours):
            box = [left + i * part, y - 4, left + (i + 1) * part - 2, y + 4]
            if text == "mass points":
                box = [left + 12, y - 7, left + 26, y + 7]
            draw_shape = canvas.ellipse if text == "mass points" else canvas.rectangle
            draw_shape(box, fill=tuple(int(255 * c) for c in colour), outline=FAINT if text == "mass points" else None)
        canvas.text((left + 50, y), text, fill=INK, font=font(20), anchor="lm")


def compose(scene, body_name):
    sheet = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
    canvas = ImageDraw.Draw(sheet)
    points = scene.body["points"]
    probe_colour = colour_of(scene.moment.markers["probe", 0])

    # The contact.
    left, top, width, height = CLOSE_UP
    forward, up = view_of_contact(scene.normal, points, 0.50)
    centre = scene.proxy + scene.normal * 0.004
    close = Camera(centre, forward, up, CLOSE_UP_M / (width * SUPERSAMPLING), width * SUPERSAMPLING, height * SUPERSAMPLING)
    chains = scene.chains(1.6 * SUPERSAMPLING * close.metres_per_pixel)
    probe = shapes.of_spheres(scene.probe_centre[None], scene.probe_radius, probe_colour)
    solid = [scene.body, *scene.arrow(), *chains]
    sheet.paste(on_paper(*picture(close, solid, hidden=chains, glass=[probe])), (left, top))
    canvas.rectangle([left, top, left + width, top + height], outline=FAINT, width=2)

    # The whole organ, with a frame around what the close-up shows.
    forward, up = view_of_contact(scene.normal, points, 0.62)
    width, height = ORGAN
    overview = Camera(points.mean(axis=0), forward, up, 1, width * SUPERSAMPLING, height * SUPERSAMPLING)
    aspect = CLOSE_UP[3] / CLOSE_UP[2]
    frame = centre + CLOSE_UP_M / 2 * numpy.array([aspect * overview.up + side * overview.right for side in (1, -1)])
    extents = overview.project(numpy.vstack([points, frame]))[:, :2]
    low, high = extents.min(axis=0), extents.max(axis=0)
    overview.metres_per_pixel = max((high - low) / (numpy.array([width - 60, height - 50]) * SUPERSAMPLING))
    off = (low + high) / 2 - numpy.array([overview.width, overview.height]) / 2
    overview.centre = overview.centre + overview.right * off[0] - overview.up * off[1]
    sheet.paste(on_paper(*picture(overview, [scene.body, probe, *scene.arrow()])), (0, 0))

    spot = overview.project(centre[None])[0, :2] / SUPERSAMPLING
    reach = CLOSE_UP_M / 2 / overview.metres_per_pixel / SUPERSAMPLING
    box = [spot[0] - reach, spot[1] - aspect * reach, spot[0] + reach, spot[1] + aspect * reach]
    canvas.rectangle(box, outline=FAINT, width=2)
    canvas.line([(box[2], box[1]), (left, top)], fill=FAINT, width=1)
    canvas.line([(box[2], box[3]), (left, top + CLOSE_UP[3])], fill=FAINT, width=1)

    depth_mm, force_n = scene.moment.depth_m * 1e3, scene.moment.force_n
    verb = "pressed" if depth_mm > 0 else "pulled"
    title = f"{body_name}, {verb} by {abs(depth_mm):.1f} mm"
    canvas.text((40, HEIGHT - 88), title, fill=INK, font=font(32), anchor="ls")
    vertices = len(scene.recorder.mesh.vertices)
    line = f"{vertices} vertices, {abs(force_n):.2f} N on the hand (arrow)"
    canvas.text((40, HEIGHT - 50), line, fill=FAINT, font=font(22), anchor="ls")
    scale_bar(canvas, overview, 660, HEIGHT - 60, 0.05)
    scale_bar(canvas, close, left + 28, top + CLOSE_UP[3] - 30, 0.01)
    legend(canvas, scene, left, HEIGHT - 62, 420, 18)
    key(canvas, scene, left, top + CLOSE_UP[3] + 40)
    return sheet


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--live", type=float, metavar="SECONDS", help="listen to a running session")
    source.add_argument("--recording", type=Path, metavar="DIRECTORY", help="read a rosbag2 recording")
    parser.add_argument("--namespace", default="")
    parser.add_argument("--body", default="Liver", help="what the title calls the body")
    parser.add_argument("--pull", action="store_true", help="the farthest pull instead of the deepest press")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE.png")
    options = parser.parse_args()
    if options.live:
        recorder = capture.live(options.namespace, options.live, options.pull)
    else:
        recorder = capture.recording(options.recording, options.namespace, options.pull)
    if recorder.best is None or recorder.mesh is None:
        sys.exit("render: no contact with body, force and chains was seen, or no body_mesh")
    compose(Scene(recorder), options.body).save(options.output, optimize=True)
    print(f"{options.output}: {recorder.best.depth_m * 1e3:.2f} mm, {recorder.best.force_n:.3f} N")


if __name__ == "__main__":
    main()
