#!/usr/bin/python3
"""Tidies a drawing that xschem exported: schematic_picture.py IN.svg OUT.svg

xschem without a display writes lines of width 0 in the colours of its window, one element a line, on a page of fixed size. This crops the
page, gives each drawing the same scale, joins the lines of a layer and drops the marks of the pins.
"""
import re
import sys

SCALE = 1.0   # pixels for one unit of the schematic; a transistor is 60 units high
MARGIN = 12
# Layer of xschem: 1 wires, 3 text, 4 symbols, 5 pins and ports. The rest is drawn as symbols.
COLOURS = {1: ("#1f4e9c", 1.2), 3: ("#333333", 0.9), 4: ("#111111", 1.3), 5: ("#a03010", 1.2)}


def points(path):
    """The coordinates of a path of straight lines and circular arcs, in order."""
    out = []
    for command, arguments in re.findall(r"([MLAz])([^MLAz]*)", path):
        numbers = [float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", arguments)]
        if command != "z":
            out.append((command, numbers))
    return out


def is_square(shape):
    ends = [n[-2:] for _, n in shape]
    xs, ys = {round(x, 2) for x, _ in ends}, {round(y, 2) for _, y in ends}
    return len(shape) == 5 and len(xs) == 2 and len(ys) == 2


def side(shape):
    ends = [n[-2] for _, n in shape]
    return max(ends) - min(ends)


def read(text):
    """(layer, shape, closed, filled) of every element that is not a mark of a pin, and units per pixel."""
    shapes, marks = [], []
    for layer, rest, path in re.findall(r'<path class="l(\d+)"([^>]*?) d="([^"]*)"', text):
        shape = points(path)
        if is_square(shape) and int(layer) == 5:
            marks.append(side(shape))
        else:
            shapes.append((int(layer), shape, "z" in path))
    for cx, cy, radius, fill in re.findall(r'<circle cx="([^"]*)" cy="([^"]*)" r="([^"]*)"[^>]*? fill="([^"]*)"', text):
        dot = fill != "none"  # a junction of wires, which xschem draws large
        x, y, r = float(cx), float(cy), float(radius) * (0.6 if dot else 1)
        shape = (1 if dot else 4, [("M", [x - r, y]), ("A", [r, r, 0, 1, 0, x + r, y]), ("A", [r, r, 0, 1, 0, x - r, y])], dot)
        if shape not in shapes:
            shapes.append(shape)
    if not marks:
        sys.exit("no pin is drawn, so the scale is unknown: export the drawing with 'xschem -x -q -r --svg FILE.sch'")
    return shapes, SCALE * 5 / max(marks)


def number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


def shifted(shape, closed, scale, left, top):
    out = ""
    for command, n in shape:
        n = list(n)
        if command == "A":
            n[0] *= scale
            n[1] *= scale
        n[-2], n[-1] = (n[-2] - left) * scale + MARGIN, (n[-1] - top) * scale + MARGIN
        out += command + " ".join(number(v) for v in n)
    return out + ("z" if closed else "")


def picture(text):
    shapes, scale = read(text)
    ends = [n[-2:] for _, shape, _ in shapes for _, n in shape]
    left, top = min(x for x, _ in ends), min(y for _, y in ends)
    width, height = ((max(v[k] for v in ends) - (left, top)[k]) * scale + 2 * MARGIN for k in (0, 1))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}">',
           '<rect width="100%" height="100%" fill="#ffffff"/>']
    for layer, (colour, stroke) in COLOURS.items():
        mine = [(shape, closed) for number_, shape, closed in shapes if (number_ if number_ in COLOURS else 4) == layer]
        for fill in (False, True):
            path = "".join(shifted(shape, closed, scale, left, top) for shape, closed in mine if closed == fill)
            if path:
                out.append(f'<path d="{path}" fill="{colour if fill else "none"}" stroke="{colour}" stroke-width="{stroke}" stroke-linecap="round"/>')
    return "\n".join(out + ["</svg>\n"])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    with open(sys.argv[1], encoding="utf-8") as source:
        drawing = picture(source.read())
    with open(sys.argv[2], "w", encoding="utf-8") as target:
        target.write(drawing)
