"""Spiking networks in NIR files."""

import numpy as np

from . import _corpuscle
from ._corpuscle import InputError
from ._display import plural, table_html
from ._force import Force
from ._options import bin_count, name_of, number, real_array, text
from ._progress import progress_of
from ._response import Response


class NirNode:
    """A node of a NIR graph.

    - name, type: "lif1", "CubaLIF".
    - input_shape, output_shape: tuples of lengths.
    - parameters: arrays by name, in SI units; a weight has the shape [output, input], every other parameter that of the node.
    """

    def __init__(self, name, type, input_shape, output_shape, parameters):
        self.name, self.type, self.input_shape, self.output_shape = name, type, tuple(input_shape), tuple(output_shape)
        shapes = {"weight": self.output_shape + self.input_shape, "shape": (len(self.input_shape),)}
        self.parameters = {key: values.reshape(shapes.get(key, self.output_shape)) for key, values in parameters.items()}

    def __repr__(self):
        return f"<{self.type} {self.name}: {list(self.input_shape)} to {list(self.output_shape)}>"


class NirGraph:
    """A NIR graph that was read.

    - path: of the file. version: of NIR, as the file states it.
    - nodes: NirNode by name. edges: pairs of names.
    - inputs, outputs: numbers of signals that enter and leave the graph.
    - input_nodes, output_nodes: names of the nodes of the types Input and Output, in the order of their signals.

    A copy and a pickle have the path only, and read the file again.
    """

    def __init__(self, path):
        self.path = path
        self._raw = _corpuscle.NirGraph(path)
        self.nodes = {node[0]: NirNode(*node) for node in self._raw.nodes()}
        self.edges = self._raw.edges()
        self.version = self._raw.version()
        self.input_nodes, self.output_nodes = self._raw.input_nodes(), self._raw.output_nodes()
        self.inputs, self.outputs = self._raw.input_count(), self._raw.output_count()

    def __reduce__(self):
        return nir, (self.path,)

    def run(self, signals, rate=None, *, method="exact", progress=None):
        """Simulates the graph with a fixed step, and returns its output: float64, shape [step, output]. A spike is the value 1 in one step.

        - signals: an array of shape [step, input], or [step] for one input. The channels of a Force are the inputs, and so are the afferents of a
          Response, with the number of spikes in each step as the signal.
        - rate: steps per second; a Force has its own.
        - method: "exact" (the exact solution for inputs that are constant within a step), "euler" (forward Euler, for which many networks were trained) or
          "backward-euler".
        - progress: a function that receives the completed fraction and stops the run by returning False; False: no progress line.

        Raises InputError for signals of another width, numbers that are not finite, a rate that is too low for "euler", and a network that diverges.
        """
        if isinstance(signals, Force):
            if rate is not None:
                raise InputError(f"rate = {rate!r}: a Force has a rate of its own, {signals.rate:g} Hz")
            signals, rate = signals.samples, signals.rate
        if rate is None:
            raise InputError("rate is missing: the number of steps per second")
        rate = number(rate, "rate")
        if isinstance(signals, Response):
            signals = self._spike_counts(signals, rate)
        if isinstance(signals, np.ndarray) and signals.dtype == bool:
            signals = signals.astype(float)
        signals = real_array(signals, "signals")
        if signals.ndim == 1:
            signals = signals[:, np.newaxis]
        if signals.ndim != 2 or signals.shape[1] != self.inputs:
            raise InputError(f"signals: the array has the shape {list(signals.shape)}; {self.path} needs [step, input] with {plural(self.inputs, 'input')}")
        with progress_of(progress) as report:
            output = self._raw.run(np.ascontiguousarray(signals), rate, text(method, "method"), report)
        return output.reshape(len(signals), self.outputs)

    def _spike_counts(self, response, rate):
        if len(response.names) != self.inputs:
            raise InputError(f"signals: the response has {plural(len(response.names), 'afferent')}; {self.path} has {plural(self.inputs, 'input')}")
        if not 0 < rate < np.inf:
            raise InputError(f"rate = {rate:g} Hz must be a finite number above 0")
        counts = np.zeros((max(1, round(bin_count(response.duration, 1 / rate))), self.inputs))
        steps = np.floor((response.times - response.start) * rate + 1e-6).astype(np.int64)  # a spike on the border of two steps is in the later one
        inside = steps < len(counts)
        np.add.at(counts, (steps[inside], response.indices[inside]), 1)
        return counts

    def _rows(self):
        return [[n.name, n.type, list(n.input_shape), list(n.output_shape)] for n in self.nodes.values()]

    def __repr__(self):
        head = f"NIR graph {self.path}: {plural(self.inputs, 'input')}, {plural(self.outputs, 'output')}, {plural(len(self.nodes), 'node')}"
        return "\n  ".join([head] + [f"{name}: {type}, {inputs} to {outputs}" for name, type, inputs, outputs in self._rows()])

    def _repr_html_(self):
        return table_html(["node", "type", "input", "output"], self._rows()[:50])


def nir(path):
    """Reads a NIR file (Neuromorphic Intermediate Representation, an HDF5 file) as a NirGraph. See doc/nir.md.

    Raises InputError, with the node and the reason, if the file is damaged, inconsistent, or has a node that is not simulated.
    """
    return NirGraph(name_of(path, "path"))
