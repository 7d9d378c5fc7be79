#!/usr/bin/python3
"""An independent implementation of the algorithms of doc/fixed-point.md, written from that page alone, with integers of any size.

The names are those of that page. Checks test vectors against it; each file has the table of its converter:
fixed_reference.py VECTORS.csv ROM.csv ..."""

import sys
from fractions import Fraction


class Words:
    """Arithmetic in words of `word` bits. Counts the results that were saturated."""

    def __init__(self, word):
        self.min, self.max, self.overflows = -(2 ** (word - 1)), 2 ** (word - 1) - 1, 0

    def sat(self, x):
        saturated = min(max(x, self.min), self.max)
        self.overflows += saturated != x
        return saturated

    def times(self, factor, n):
        mantissa, shift = factor
        return self.sat((n * mantissa + (2 ** (shift - 1) if shift else 0)) // 2**shift)

    def abs(self, n):
        return n if n >= 0 else self.sat(-n)


def floor_log2(c):
    """The largest e with 2^e <= c, for a fraction c > 0."""
    e = c.numerator.bit_length() - c.denominator.bit_length()
    return e if Fraction(2) ** e <= c else e - 1


def factor_of(c, word):
    """The factor c >= 0 as (mantissa, shift), which means mantissa / 2^shift."""
    c = Fraction(c)
    if c == 0:
        return 0, 0
    shift = min(word - 2 - floor_log2(c), 62)
    mantissa = (c * Fraction(2) ** shift + Fraction(1, 2)).__floor__()
    return (mantissa // 2, shift - 1) if mantissa == 2 ** (word - 1) else (mantissa, shift)


def level_of(x, frac):
    """The level x as a word with `frac` fraction bits."""
    return (Fraction(x) * 2**frac + Fraction(1, 2)).__floor__()


# Receptors: step() returns the currents for the force F, where F1 is the force of the previous conversion. c: constants; w: Words.
class Sa1a:
    outputs = 1

    def step(self, c, w, F, F1):
        return [w.sat(c["beta"] + w.times(c["k_s"], F) + w.times(c["k_d"], w.abs(w.sat(F - F1))))]


class Fa1a:
    outputs = 2

    def step(self, c, w, F, F1):
        d = w.sat(F - F1)
        x = w.times(c["k"], w.abs(d))
        return [x, 0] if d > 0 else [0, x]


class Sa1b:
    outputs = 1

    def __init__(self):
        self.I_B = self.I_C = 0

    def step(self, c, w, F, F1):
        d = w.sat(F - F1)
        self.I_B = w.sat(w.times(c["k_B1"], d) + w.times(c["k_B2"], self.I_B))
        self.I_C = w.sat(w.times(c["k_C1"], d) + w.times(c["k_C2"], self.I_C))
        return [w.sat(w.times(c["k_A"], F) + max(self.I_B, 0) + max(self.I_C, 0))]


class Fa1b:
    outputs = 1

    def __init__(self):
        self.I_0 = 0

    def step(self, c, w, F, F1):
        self.I_0 = w.times(c["k"], w.sat(w.sat(F - F1) + self.I_0))
        return [w.times(c["k_A"], self.I_0) if self.I_0 > 0 else w.times(c["k_B"], w.abs(self.I_0))]


# Neurons: step() returns 1 if the neuron fires under current I, else 0.
class Neuron:
    def __init__(self, c):
        self.u, self.a, self.wait = c["E_L"], 0, 0

    def spike(self, c, w, theta):
        self.u = c["V_reset"] if c["ref"] > 0 else w.sat(self.u - theta + c["V_reset"])
        self.wait = c["ref"]
        return 1

    def recorded(self):
        return [self.u]

    def step(self, c, w, I):
        if self.wait > 0:
            self.wait -= 1
            return 0
        return self.integrate(c, w, I)


class LifA(Neuron):
    def integrate(self, c, w, I):
        self.u = w.sat(w.times(c["k_a"], I) + w.times(c["k_b"], self.u) + c["k_c"])
        return self.spike(c, w, c["V_th"]) if self.u > c["V_th"] else 0


class LifB(Neuron):
    def integrate(self, c, w, I):
        self.u = w.sat(self.u + w.times(c["k_m"], w.sat(I - c["I_leak0"])))
        if self.u > c["V_th"]:
            return self.spike(c, w, c["V_th"])
        self.u = max(self.u, c["E_L"])
        return 0


class Adaptive(Neuron):
    def recorded(self):
        return [self.u, self.a]

    def step(self, c, w, I):
        self.a = w.times(c["k_th"], self.a)
        return super().step(c, w, I)

    def integrate(self, c, w, I):
        self.u = max(w.sat(self.u + w.times(c["k_m"], I)), c["E_L"])
        theta = w.sat(c["V_th"] + self.a)
        if not (I > 0 and self.u > theta):
            return 0
        s = self.spike(c, w, theta)
        self.a = w.sat(self.a + c["dV_th"])
        return s


RECEPTORS = {"sa1a": Sa1a, "fa1a": Fa1a, "sa1b": Sa1b, "fa1b": Fa1b}
NEURONS = {"lif-a": LifA, "lif-b": LifB, "adaptive": Adaptive}


def read_vectors(path):
    """The header, the levels (value, word), the factors (value, mantissa, shift), and the rows of a file of test vectors."""
    header, levels, factors, rows = {}, {}, {}, []
    for line in open(path, encoding="utf-8", errors="replace"):
        words = line.split()
        if line.startswith("# level"):
            levels[words[2]] = (float(words[3]), int(words[4]))
        elif line.startswith("# factor"):
            factors[words[2]] = (float(words[3]), int(words[4]), int(words[5]))
        elif line.startswith("#"):
            header[words[1]] = words[2] if len(words) > 2 else ""
        elif line[0].isdigit():
            rows.append([int(x) for x in line.split(",")])
    return header, levels, factors, rows


def constants_of(levels, factors, word, frac):
    c = {}
    for name, (value, n) in levels.items():
        expected = level_of(value, 0 if name == "ref" else frac)
        assert n == expected, f"level {name}: {n}, not {expected}"
        c[name] = n
    for name, (value, mantissa, shift) in factors.items():
        expected = factor_of(value, word)
        assert (mantissa, shift) == expected, f"factor {name}: {(mantissa, shift)}, not {expected}"
        c[name] = expected
    return c


def check(path, rom_path):
    """Checks each row: code, force, currents, membranes and spikes of one conversion."""
    header, levels, factors, rows = read_vectors(path)
    rom = [int(line.split(",")[1]) for line in open(rom_path) if line[0].isdigit()]
    assert len(rom) == 2 ** int(header["bits"]), "the table must have a word for every code"
    c = constants_of(levels, factors, int(header["word"]), int(header["frac"]))
    w = Words(int(header["word"]))
    receptor_name, neuron_name = header["parts"].split("+")[-2:]
    receptor = RECEPTORS[receptor_name]()
    neurons = [NEURONS[neuron_name](c) for _ in range(receptor.outputs)]
    F1 = None
    for number, row in enumerate(rows):
        F = rom[row[0]]
        I = receptor.step(c, w, F, F if F1 is None else F1)
        bits = [n.step(c, w, i) for n, i in zip(neurons, I)]
        expected = [row[0], F, *I, *(x for n in neurons for x in n.recorded()), *bits]
        assert row == expected, f"{path}: conversion {number}: {row}, not {expected}"
        F1 = F
    assert rows, f"{path}: no rows"
    print(f"{path}: {len(rows)} conversions, {w.overflows} overflows, every word matches")


if __name__ == "__main__":
    if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:
        sys.exit(__doc__)
    try:
        for vectors, rom in zip(sys.argv[1::2], sys.argv[2::2]):
            check(vectors, rom)
    except AssertionError as error:
        sys.exit(f"fixed_reference: {error}")
