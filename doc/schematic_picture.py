#!/usr/bin/python3
"""Draws a schematic as a small SVG: doc/schematic_picture.py SCHEMATIC.sch OUT.svg

xschem exports the drawing. This script crops its page, gives every picture the same scale, and leaves out the marks of the pins. Without a
display xschem 2.8 (Debian 12) does not know the size of its page, so it runs under Xvfb. It draws letters as lines. xschem 3.4 (Debian 13)
needs no display and writes them as text, but places text that ends at a point by a guess of its length.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MARGIN = 12  # pixels; one pixel is one unit of the schematic, and a transistor is 60 units high
PIN = 5      # units: the side of the square that marks a pin
WIRE, TEXT, SYMBOL, PORT = 1, 3, 4, 5  # layers of xschem
STYLE = {WIRE: ("#1f4e9c", 1.2), TEXT: ("#333333", 0.9), SYMBOL: ("#111111", 1.3), PORT: ("#a03010", 1.2)}


class Shape:
    """A part of a drawing: the steps of a path as (command, numbers), the last two of which are its end."""
    def __init__(self, layer, steps, filled):
        self.layer, self.steps, self.filled = layer if layer in STYLE else SYMBOL, steps, filled

    def ends(self):
        return [numbers[-2:] for _, numbers in self.steps]

    def pin(self):
        """The side of the square, if this marks a pin."""
        xs, ys = ({round(end[k], 2) for end in self.ends()} for k in (0, 1))
        return max(xs) - min(xs) if self.layer == PORT and self.filled and len(xs) == len(ys) == 2 else None


def export(schematic):
    """The drawing as xschem exports it."""
    program = shutil.which("xschem") or sys.exit("xschem is not installed: apt-get install xschem")
    version = subprocess.run([program, "-x", "-q", "-v"], capture_output=True, text=True, check=False).stdout
    settings = next((str(folder / "xschemrc") for folder in schematic.parents if (folder / "xschemrc").exists()), "/dev/null")
    command = [program, "-q", "-r", "--svg", "--rcfile", settings, str(schematic)]
    if "V2." in version:
        command = [shutil.which("xvfb-run") or sys.exit("xschem 2 draws on a display: apt-get install xvfb xauth"), "-a", *command]
    else:
        command.insert(1, "-x")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, check=True, timeout=60)
        return pathlib.Path(folder, "plot.svg").read_text(encoding="utf-8")


def steps(path):
    return [(command, [float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", numbers)])
            for command, numbers in re.findall(r"([MLA])([^MLAz]*)", path)]


def circles(text):
    for attributes in re.findall(r"<circle([^>]*)>", text):
        x, y, r = (float(re.search(rf' {name}="([^"]*)"', attributes)[1]) for name in ("cx", "cy", "r"))
        layer = re.search(r'class="l(\d+)"', attributes)
        junction = int(layer[1]) == WIRE if layer else 'fill="none"' not in attributes
        r *= 0.6 if junction else 1
        path = [("M", [x - r, y]), ("A", [r, r, 0, 1, 0, x + r, y]), ("A", [r, r, 0, 1, 0, x - r, y])]
        yield Shape(WIRE if junction else SYMBOL, path, junction)


def shapes_of(text):
    paths = re.findall(r'<path class="l(\d+)"[^>]*? d="([^"]*)"([^>]*)>', text)
    found = [Shape(int(layer), steps(path), ("z" in path or len(steps(path)) > 3) and "A" not in path) for layer, path, _ in paths]
    return found + list(circles(text))


def number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".").replace("-0.", "-.") or "0"


class Page:
    """Maps the coordinates of xschem's page to those of the picture."""
    def __init__(self, scale, points):
        self.scale = scale
        self.corner = [min(p[k] for p in points) for k in (0, 1)]
        self.size = [round((max(p[k] for p in points) - self.corner[k]) * scale + 2 * MARGIN) for k in (0, 1)]

    def at(self, end):
        return tuple(round((end[k] - self.corner[k]) * self.scale + MARGIN, 1) for k in (0, 1))

    def path(self, shapes):
        """One path of all shapes. A shape that begins where the last one ends continues it."""
        out, here = "", None
        for shape in shapes:
            for command, numbers in shape.steps:
                x, y = self.at(numbers[-2:])
                if command == "M" and ((x, y) != here or shape.filled):
                    out += f"M{number(x)} {number(y)}"
                elif command == "L":
                    dx, dy = number(round(x - here[0], 1)), number(round(y - here[1], 1))
                    out += f"v{dy}" if dx == "0" else f"h{dx}" if dy == "0" else f"l{dx} {dy}"
                elif command == "A":
                    out += "A" + " ".join(number(v) for v in (numbers[0] * self.scale, numbers[1] * self.scale, 0, *numbers[3:5], x, y))
                here = x, y
            out += "z" if shape.filled else ""
        return out

    def text(self, colour, size, x, y, turned, content):
        x, y = self.at((x, y))
        turn = f' transform="rotate({turned} {number(x)} {number(y)})"' if turned else ""
        layer = WIRE if colour == "#00ccee" else TEXT
        return f'<text x="{number(x)}" y="{number(y)}" font-size="{number(size * self.scale)}" fill="{STYLE[layer][0]}"{turn}>{content}</text>'


def texts_of(text):
    """(colour, size, x, y, turn in degrees, content) of each text of a drawing by xschem 3.4."""
    row = r'<text fill="([^"]*)"[^>]* font-size="([^"]*)" transform="translate\(([^,]*), ([^)]*)\)(?: rotate\((\d+)\))?"[^>]*>([^<]*)</text>'
    return [(c, float(s), float(x), float(y), r, t) for c, s, x, y, r, t in re.findall(row, text)]


def text_ends(texts):
    for _, size, x, y, turned, content in texts:
        length = 0.6 * size * len(content)
        yield x, y - size
        yield (x, y - length) if turned == "270" else (x, y + length) if turned == "90" else (x + length, y)


def picture(drawing):
    shapes, texts = shapes_of(drawing), texts_of(drawing)
    pins = [side for side in map(Shape.pin, shapes) if side]
    if not pins:
        sys.exit("the drawing has no pin, so its scale is unknown")
    shapes = [shape for shape in shapes if not shape.pin()]
    page = Page(PIN / max(pins), [end for shape in shapes for end in shape.ends()] + list(text_ends(texts)))
    width, height = page.size
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif">',
           '<rect width="100%" height="100%" fill="#ffffff"/>']
    for layer, (colour, stroke) in STYLE.items():
        for filled in (False, True):
            mine = [shape for shape in shapes if shape.layer == layer and shape.filled == filled]
            if mine:
                out.append(f'<path d="{page.path(mine)}" fill="{colour if filled else "none"}" stroke="{colour}" stroke-width="{stroke}" stroke-linecap="round"/>')
    return "\n".join(out + [page.text(*text) for text in texts] + ["</svg>\n"])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    pathlib.Path(sys.argv[2]).write_text(picture(export(pathlib.Path(sys.argv[1]).resolve())), encoding="utf-8")
