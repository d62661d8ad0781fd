"""A sheet of pictures with titles, colour bars, legends and scale bars in one style; used by pictures.py.

Places are pixels from the upper left corner. Needs what render.py needs, and Debian's python3-matplotlib and python3-pil.
"""
import pathlib
import tempfile

from film import draw
from labels import KIND_NAME, VESSEL_COLOR, scale_length
from painter import KIND_COLOR, color_table
from run_frame import CBM, DCM, NUCLEUS

INK = "#21262f"
KINDS = {"deformable": (KIND_NAME[DCM], KIND_COLOR[DCM]), "sphere": (KIND_NAME[CBM], KIND_COLOR[CBM]),
         "nucleus": (KIND_NAME[NUCLEUS], KIND_COLOR[NUCLEUS]), "vessel": ("vessel", VESSEL_COLOR), "wall": ("wall", VESSEL_COLOR)}


class Sheet:
    """A white picture of a fixed size in pixels."""

    def __init__(self, width, height):
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        self.width, self.height = width, height
        self.figure = plt.figure(figsize=(width / 100, height / 100), dpi=100, facecolor="white")

    def axes(self, left, top, width, height):
        return self.figure.add_axes([left / self.width, 1 - (top + height) / self.height, width / self.width, height / self.height])

    def text(self, left, top, words, size=15, bold=False, align="left", rotation=0):
        self.figure.text(left / self.width, 1 - top / self.height, words, size=0.72 * size, color=INK, ha=align, va="center",
                         weight="bold" if bold else "normal", rotation=rotation)

    def picture(self, run, frame, options, left, top, width, height, um=None):
        """A frame drawn by render.py; `um` is the width of the picture."""
        import matplotlib.image
        words = ["--no-labels", "--size", f"{width}x{height}", *options] + (["--width", f"{um:g}"] if um else [])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "panel.png"
            draw(run, frame, file, words)
            image = matplotlib.image.imread(file)
        axes = self.axes(left, top, width, height)
        axes.imshow(image, aspect="auto", interpolation="none")
        axes.axis("off")

    def bar(self, name, low, high, left, top, height, width=16):
        """Colours of the values from low to high, as the painter gives them."""
        import numpy as np
        table = color_table(low, high)
        values = np.linspace(low, high, 256)
        axes = self.axes(left, top, width, height)
        axes.imshow(np.array([[table.GetColor(v)] for v in values]), aspect="auto", origin="lower", extent=(0, 1, low, high))
        axes.set_xticks([])
        axes.yaxis.tick_right()
        axes.tick_params(labelsize=10, colors=INK, length=3)
        for edge in axes.spines.values():
            edge.set_linewidth(0.6)
        for k, line in enumerate(reversed(name.split("\n"))):
            self.text(left, top - 18 - 18 * k, line, 14)

    def legend(self, kinds, left, top):
        """A swatch and a name for each category, one below the other."""
        for k, (name, color) in enumerate(KINDS[kind] for kind in kinds):
            axes = self.axes(left, top + 24 * k - 7, 14, 14)
            axes.set_facecolor(color)
            axes.set_xticks([])
            axes.set_yticks([])
            self.text(left + 22, top + 24 * k, name, 14)

    def scale(self, um, width, right, top):
        """The bar for a picture that is `um` wide and takes `width` pixels; ends at `right`."""
        import matplotlib.lines
        length = scale_length(um)
        left = right - length / um * width
        y = 1 - top / self.height
        self.figure.add_artist(matplotlib.lines.Line2D([left / self.width, right / self.width], [y, y], color=INK, linewidth=2.5,
                                                       solid_capstyle="butt"))
        self.text((left + right) / 2, top - 14, f"{length:g} \u00b5m", 14, align="center")

    def save(self, file):
        """24 bits per pixel."""
        import io
        import matplotlib.pyplot as plt
        from PIL import Image
        data = io.BytesIO()
        self.figure.savefig(data, dpi=100)
        plt.close(self.figure)
        file.parent.mkdir(parents=True, exist_ok=True)
        Image.open(data).convert("RGB").save(file, optimize=True)
