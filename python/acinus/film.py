"""Films of runs: frames drawn with numpy alone, written by Pillow."""
import os

import numpy as np

from acinus.errors import BadInput, NoSuchItem
from acinus.frame import NUCLEUS, SPHERE, VESSEL

#: Directions from the middle of the picture to the camera, and what is up.
CAMERAS = {"iso": ((1.0, -1.35, 0.85), (0, 0, 1)), "top": ((0, 0, 1), (0, 1, 0)), "side": ((0, -1, 0), (0, 0, 1))}
#: Endings of film files; a name without an ending is a folder of pictures.
ENDINGS = (".webp", ".gif", ".png")

_KIND_COLORS = np.array([[214, 154, 92], [104, 150, 190], [190, 70, 70], [96, 72, 140]], float)
_SCALE = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], float)
_BACKGROUND, _INK = (250, 250, 248), (40, 40, 40)
_LIGHT = np.array([0.35, 0.45, 0.82])  # right, up, toward the camera
_FRAGMENTS = 4_000_000  # in memory at a time
_VESSEL_OPACITY = 0.25


def write_film(run, path, frames=None, color="kind", value_range=None, camera="iso", clip=None, size=(800, 600), seconds=8.0):
    """Draws frames of a run into an animated WebP, GIF or PNG, or into a folder of PNG pictures.

    frames: numbers, default all from t = 0 on. color: "kind", "type", "cell" or a field of cell_data, e.g. "pressure".
    value_range: (low, high) of a field, default that of all frames. clip: axis "x", "y" or "z", across which the half nearer to
    the camera is removed. Returns a sentence. Raises BadInput, NoSuchItem.
    """
    try:
        from PIL import Image
    except ImportError:
        raise BadInput("films need Pillow: Debian package python3-pil, or pip install pillow") from None
    path = os.fspath(path)
    ending = os.path.splitext(path)[1].lower()
    if ending and ending not in ENDINGS:
        raise BadInput(f"{path}: a film ends in {', '.join(ENDINGS)}; a name without an ending is a folder of pictures")
    numbers = [int(k) for k in np.flatnonzero(run.times >= 0)] if frames is None else list(frames)
    if not numbers:
        raise NoSuchItem(f"{run.file}: has no frame from t = 0 on")
    view = _View(run, numbers, camera, clip, size)
    if color not in ("kind", "type", "cell") and value_range is None:
        value_range = _range_of(run, numbers, color)
    pictures = []
    for n, k in enumerate(numbers):
        picture = Image.fromarray(draw_frame(run[k], view, color, value_range))
        _label(picture, view, run[k].time, color, value_range)
        if ending:
            pictures.append(picture)
        else:
            os.makedirs(path, exist_ok=True)
            picture.save(os.path.join(path, f"frame_{n:06d}.png"))
    if ending:
        pictures[0].save(path, save_all=True, append_images=pictures[1:], loop=0, duration=round(1000 * seconds / len(pictures)),
                         **({"quality": 75, "method": 4} if ending == ".webp" else {}))
    return f"{path}: {len(numbers)} frames"


class _View:
    """Camera whose picture holds the cells of all frames, at one scale."""

    def __init__(self, run, numbers, camera, clip, size):
        if camera not in CAMERAS:
            raise BadInput(f'camera "{camera}": known are {", ".join(CAMERAS)}')
        if clip not in (None, "x", "y", "z"):
            raise BadInput(f'clip "{clip}": known are x, y and z')
        self.width, self.height = size
        toward, up = (np.array(v, float) for v in CAMERAS[camera])
        toward /= np.linalg.norm(toward)
        right = np.cross(up, toward)
        right /= np.linalg.norm(right)
        self.axes = np.array([right, np.cross(toward, right), toward])
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        box = np.array([low, high])
        for k in numbers[:: max(1, len(numbers) // 20)] + [numbers[-1]]:
            points, reach = _bodies(run[k])
            if len(points) == 0:
                continue
            at = points @ self.axes.T
            low, high = np.minimum(low, (at - reach).min(0)), np.maximum(high, (at + reach).max(0))
            box = np.array([np.minimum(box[0], (points - reach).min(0)), np.maximum(box[1], (points + reach).max(0))])
        if not np.isfinite(low).all():
            raise NoSuchItem(f"{run.file}: there are no cells in these frames")
        self.middle = (low + high) / 2
        self.scale = 0.88 * min(self.width / (high - low)[0], (self.height - 60) / (high - low)[1])  # pixels per um
        self.clip_axis = None if clip is None else "xyz".index(clip)
        if clip is not None:
            self.clip_at, self.clip_side = box[:, self.clip_axis].mean(), np.sign(self.axes[2][self.clip_axis]) or 1.0

    def place(self, points):
        """Pixels right and down, and um toward the camera."""
        at = (points @ self.axes.T - self.middle) * [self.scale, -self.scale, 1]
        return at + [self.width / 2, self.height / 2 - 10, 0]

    def keeps(self, x):
        """True behind the cut, by the coordinate along its axis."""
        return self.clip_side * (x - self.clip_at) <= 0

    def depth_of_cut(self, column, row):
        """um toward the camera of the cut at the middles of pixels; None if it is seen from its edge."""
        axis = self.axes[:, self.clip_axis]
        if abs(axis[2]) < 1e-6:
            return None
        across = (column + 0.5 - self.width / 2) / self.scale + self.middle[0]
        up = -(row + 0.5 - self.height / 2 + 10) / self.scale + self.middle[1]
        return (self.clip_at - across * axis[0] - up * axis[1]) / axis[2] - self.middle[2]


class _Picture:
    """Colours of the nearest surface of every pixel."""

    def __init__(self, view):
        self.view = view
        self.depth = np.full(view.width * view.height, -np.inf)
        self.rgb = np.tile(np.array(_BACKGROUND, float), (view.width * view.height, 1))

    def put(self, column, row, depth, rgb):
        view = self.view
        kept = (column >= 0) & (column < view.width) & (row >= 0) & (row < view.height)
        pixel = (row * view.width + column)[kept]
        depth, rgb = depth[kept], rgb[kept]
        near = depth > self.depth[pixel]
        pixel, depth, rgb = pixel[near], depth[near], rgb[near]
        order = np.argsort(depth, kind="stable")  # of several in one pixel the last, nearest one stays
        self.depth[pixel[order]] = depth[order]
        self.rgb[pixel[order]] = rgb[order]


def _blocks(extent):
    """Rows of alike extent in pixels, few enough for the memory, with the side of their square."""
    side = 2 ** np.ceil(np.log2(np.maximum(extent, 1) + 2)).astype(int)
    for s in np.unique(side):
        rows = np.flatnonzero(side == s)
        step = max(1, _FRAGMENTS // (s * s))
        for first in range(0, len(rows), step):
            yield rows[first:first + step], int(s)


def _draw_triangles(picture, points, triangles, rgb, body):
    """Draws closed surfaces from outside. Cut ones are closed with the colour of their triangles.

    body: (t,) number of the surface of each triangle.
    """
    view = picture.view
    at = view.place(points)[triangles]  # (t, 3 corners, 3)
    low = np.floor(at[:, :, :2].min(1)).astype(int)
    extent = (at[:, :, :2].max(1) - low).max(1)
    u, v = at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]
    twice = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    corner = points[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]) @ view.axes.T
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-30)[:, None]
    front = normal[:, 2] > 0
    shown = rgb * (0.45 + 0.55 * np.maximum(normal @ _LIGHT, 0))[:, None]
    usable = (np.abs(twice) > 1e-9) & (at[:, :, 0].max(1) >= 0) & (at[:, :, 0].min(1) < view.width)
    cut = np.zeros(len(triangles), bool)
    if view.clip_axis is None:
        usable &= front
    else:
        along = corner[:, :, view.clip_axis]
        kept = view.keeps(along)
        cut = np.isin(body, body[kept.any(1)]) & np.isin(body, body[~kept.all(1)])  # surfaces on both sides
        usable &= kept.any(1) & (front | cut)
    crossings = []
    for rows, side in _blocks(np.where(usable, extent, 0)):
        rows = rows[usable[rows]]
        if len(rows) == 0:
            continue
        grid, pick = np.arange(side), lambda a: a[rows][:, None, None]
        column = pick(low[:, 0]) + grid[None, None, :] + np.zeros((1, side, 1), int)
        row = pick(low[:, 1]) + grid[None, :, None] + np.zeros((1, 1, side), int)
        x, y = column + 0.5 - pick(at[:, 0, 0]), row + 0.5 - pick(at[:, 0, 1])
        b = (x * pick(v[:, 1]) - y * pick(v[:, 0])) / pick(twice)
        c = (y * pick(u[:, 0]) - x * pick(u[:, 1])) / pick(twice)
        inside = (b >= 0) & (c >= 0) & (b + c <= 1)
        if view.clip_axis is not None:
            inside &= view.keeps(pick(along[:, 0]) + b * pick(along[:, 1] - along[:, 0]) + c * pick(along[:, 2] - along[:, 0]))
        triangle = np.repeat(rows, inside.sum((1, 2)))
        column, row, b, c = column[inside], row[inside], b[inside], c[inside]
        seen = front[triangle]
        depth = at[triangle, 0, 2] + b * u[triangle, 2] + c * v[triangle, 2]
        picture.put(column[seen], row[seen], depth[seen], shown[triangle[seen]])
        own = cut[triangle]
        crossings.append((column[own], row[own], triangle[own]))
    if crossings:
        _close_cuts(picture, *(np.concatenate(part) for part in zip(*crossings)), front, rgb, body)


def _close_cuts(picture, column, row, triangle, front, rgb, body):
    """Paints the cut where a ray behind it leaves a surface once more than it enters: there it begins inside."""
    view = picture.view
    kept = (column >= 0) & (column < view.width) & (row >= 0) & (row < view.height)
    pixel, triangle = (row * view.width + column)[kept], triangle[kept]
    if len(pixel) == 0:
        return
    numbers, local = np.unique(body, return_inverse=True)
    key, first, which = np.unique(local[triangle] * (view.width * view.height) + pixel, return_index=True, return_inverse=True)
    leaves = np.bincount(which, np.where(front[triangle], -1, 1))
    first = first[leaves > 0]
    depth = view.depth_of_cut(pixel[first] % view.width, pixel[first] // view.width)
    if depth is None:
        return
    # Nuclei have odd numbers; they lie within their cells.
    depth += 1e-3 * (body[triangle[first]] % 2)
    picture.put(pixel[first] % view.width, pixel[first] // view.width, depth, 0.85 * rgb[triangle[first]])


def _draw_spheres(picture, center, radius, rgb):
    view = picture.view
    at = view.place(center)
    pixels = radius * view.scale
    low = np.floor(at[:, :2] - pixels[:, None]).astype(int)
    for rows, side in _blocks(2 * pixels):
        grid, pick = np.arange(side), lambda a: a[rows][:, None, None]
        column = pick(low[:, 0]) + grid[None, None, :] + np.zeros((1, side, 1), int)
        row = pick(low[:, 1]) + grid[None, :, None] + np.zeros((1, 1, side), int)
        x, y = (column + 0.5 - pick(at[:, 0])) / view.scale, -(row + 0.5 - pick(at[:, 1])) / view.scale
        square = pick(radius) ** 2 - x * x - y * y
        inside, z = square > 0, np.sqrt(np.maximum(square, 0))

        def put(where, depth, shade):
            picture.put(column[where], row[where], depth[where], np.repeat(rgb[rows], where.sum((1, 2)), 0) * shade[where][:, None])

        surface = inside
        if view.clip_axis is not None:
            offset = np.stack([x, y, z], -1) @ view.axes[:, view.clip_axis]
            surface = inside & view.keeps(pick(center[:, view.clip_axis]) + offset)
            cut = view.depth_of_cut(column, row)
            if cut is not None:
                put(inside & (np.abs(cut - pick(at[:, 2])) < z), cut, np.full(x.shape, 0.85))
        put(surface, pick(at[:, 2]) + z, 0.45 + 0.55 * np.maximum((x * _LIGHT[0] + y * _LIGHT[1] + z * _LIGHT[2]) / pick(radius), 0))


def _bodies(frame):
    """Points of cells with the reach of each in um."""
    t = len(frame.triangles)
    cell = np.unique(frame.triangles[frame.kind[:t] != VESSEL])
    spheres = frame.spheres
    return (np.concatenate([frame.points[cell], spheres.center]).astype(float),
            np.concatenate([np.zeros(len(cell)), spheres.radius])[:, None])


def _colors(frame, color, value_range):
    """(t + s, 3) of every triangle and sphere."""
    if color == "kind":
        return _KIND_COLORS[frame.kind]
    if color in ("cell", "type"):
        number = frame.cell_id if color == "cell" else frame.cell_data["cell_type"].astype(int)
        hue = (np.asarray(number) * 0.61803398875 + 0.08) % 1
        wave = np.abs(((hue[:, None] * 6 + np.array([0, 4, 2])) % 6) - 3) - 1
        return 255 * (0.35 + 0.55 * np.clip(wave, 0, 1))
    low, high = value_range
    share = np.clip((_field(frame, color) - low) / max(high - low, 1e-30), 0, 1) * (len(_SCALE) - 1)
    first = np.minimum(share.astype(int), len(_SCALE) - 2)
    return _SCALE[first] + (share - first)[:, None] * (_SCALE[first + 1] - _SCALE[first])


def _field(frame, name):
    if name not in frame.cell_data:
        raise NoSuchItem(f'no field "{name}" of cells; there are kind, type, cell, {", ".join(sorted(frame.cell_data))}')
    return frame.cell_data[name]


def _range_of(run, numbers, name):
    values = [_field(frame, name)[frame.kind != VESSEL] for frame in (run[k] for k in numbers)]
    values = np.concatenate(values) if values else np.zeros(0)
    return (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)


def draw_frame(frame, view, color, value_range=None):
    """(height, width, 3) bytes: cells, with vessels and rigid meshes in translucent red."""
    rgb = _colors(frame, color, value_range)
    picture, t = _Picture(view), len(frame.triangles)
    points, kind = frame.points.astype(float), frame.kind[:t]
    body = 2 * frame.cell_id[:t] + (kind == NUCLEUS)
    own = kind != VESSEL if view.clip_axis is not None else (kind != VESSEL) & (kind != NUCLEUS)
    _draw_triangles(picture, points, frame.triangles[own], rgb[:t][own], body[own])
    spheres = frame.spheres
    balls = frame.kind[t:] == SPHERE
    _draw_spheres(picture, spheres.center[balls].astype(float), spheres.radius[balls].astype(float), rgb[t:][balls])
    vessel = kind == VESSEL
    if vessel.any():
        around = _Picture(view)
        around.depth = picture.depth.copy()
        _draw_triangles(around, points, frame.triangles[vessel], rgb[:t][vessel] * 0 + _KIND_COLORS[2], body[vessel])
        front = around.depth > picture.depth
        picture.rgb[front] += _VESSEL_OPACITY * (around.rgb[front] - picture.rgb[front])
    return np.clip(picture.rgb, 0, 255).astype(np.uint8).reshape(view.height, view.width, 3)


def _label(picture, view, time, color, value_range):
    from PIL import ImageDraw
    draw = ImageDraw.Draw(picture)
    unit, name = next(((s, n) for s, n in ((86400, "d"), (3600, "h"), (60, "min")) if abs(time) >= 2 * s), (1, "s"))
    draw.text((12, view.height - 26), f"{time / unit:.3g} {name}", fill=_INK)
    length = next(s * 10.0**e for e in range(6, -4, -1) for s in (5, 2, 1) if s * 10.0**e * view.scale <= view.width / 4)
    right = view.width - 14
    draw.line([(right - length * view.scale, view.height - 12), (right, view.height - 12)], fill=_INK, width=3)
    draw.text((right - length * view.scale, view.height - 30), f"{length:g} um", fill=_INK)
    if value_range is not None:
        draw.text((view.width // 3, view.height - 26), f"{color}: {value_range[0]:.3g} (dark) to {value_range[1]:.3g}", fill=_INK)
