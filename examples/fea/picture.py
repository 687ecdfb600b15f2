"""Draws a deformed surface coloured by how far it moved; needs NumPy alone."""
import struct
import zlib

import numpy as np

# From not moved to moved most: dark blue, green, yellow, red.
COLOURS = np.array([(38, 60, 140), (50, 150, 170), (110, 190, 90), (245, 215, 70), (200, 45, 35)], float)


def colour_of(share):
    at = np.clip(share, 0, 1) * (len(COLOURS) - 1)
    low = np.minimum(at.astype(int), len(COLOURS) - 2)
    return COLOURS[low] + (COLOURS[low + 1] - COLOURS[low]) * (at - low)[..., None]


def look_at(points, azimuth, elevation):
    """Coordinates to the right, upwards and towards the eye."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.cos(a) * np.cos(e), np.sin(a) * np.cos(e), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0])
    return points @ np.array([right, np.cross(eye, right), eye]).T


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = np.hstack([np.zeros((height, 1), np.uint8), pixels.astype(np.uint8).reshape(height, width * 3)])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def draw(path, points, faces, moved, width=900, height=760, azimuth=-50, elevation=25):
    """points: already deformed; moved: a length a point. A bar of the colours, 0 at its foot, stands on the right."""
    seen = look_at(points, azimuth, elevation)
    low, high = seen[:, :2].min(0), seen[:, :2].max(0)
    scale = min((width - 110) / (high - low)[0], (height - 40) / (high - low)[1])
    screen = np.column_stack([(seen[:, 0] - low[0]) * scale + 20, height - 20 - (seen[:, 1] - low[1]) * scale, seen[:, 2]])
    pixels = np.full((height, width, 3), 255.0)
    depth = np.full((height, width), -np.inf)
    share = moved / moved.max()
    for face in faces:
        fill(pixels, depth, screen[face], share[face], seen[face])
    bar = colour_of(np.linspace(1, 0, height - 200))
    pixels[100:height - 100, width - 50:width - 30] = bar[:, None]
    write_png(path, pixels)


def fill(pixels, depth, corner, share, seen):
    """One triangle into the pictures of colours and of depth, lit from the eye."""
    (x0, y0, _), (x1, y1, _), (x2, y2, _) = corner
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if abs(area) < 1e-9:
        return
    left, right = int(np.floor(min(x0, x1, x2))), int(np.ceil(max(x0, x1, x2)))
    top, bottom = int(np.floor(min(y0, y1, y2))), int(np.ceil(max(y0, y1, y2)))
    y, x = np.mgrid[top:bottom + 1, left:right + 1]
    b1 = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
    b2 = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
    b0 = 1 - b1 - b2
    z = b0 * corner[0, 2] + b1 * corner[1, 2] + b2 * corner[2, 2]
    window = (slice(top, bottom + 1), slice(left, right + 1))
    shown = (b0 >= 0) & (b1 >= 0) & (b2 >= 0) & (z > depth[window])
    normal = np.cross(seen[1] - seen[0], seen[2] - seen[0])
    light = 0.45 + 0.55 * abs(normal[2]) / max(np.linalg.norm(normal), 1e-300)
    colours = colour_of(b0 * share[0] + b1 * share[1] + b2 * share[2]) * light
    pixels[window][shown] = colours[shown]
    depth[window][shown] = z[shown]
