"""NIR graphs: read, simulated and written. The oracle of the networks is the simulation in NumPy below."""

import copy
import os
import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy as np

import corpuscle
from support import command_line, press

try:
    import h5py
except ImportError:
    h5py = None

REFERENCE = pathlib.Path(os.environ.get("CORPUSCLE_DATA", "/nonexistent")) / "nir_reference"
NO_REFERENCE = f"ABSENT: {REFERENCE}; set CORPUSCLE_DATA to the folder of recordings"
STEPS = [460, 510, 710, 760]  # of the spikes of the NIR paper's LIF in its exact solution


def write(path, nodes, edges):
    """A NIR file. nodes: {name: (type, {parameter: values})}."""
    with h5py.File(path, "w") as file:
        file["version"] = "1.0"
        file["node/type"] = "NIRGraph"
        file["node/edges"] = np.array(edges, dtype=h5py.string_dtype())
        for name, (kind, parameters) in nodes.items():
            file[f"node/nodes/{name}/type"] = kind
            for parameter, values in parameters.items():
                file[f"node/nodes/{name}/{parameter}"] = values


def simulate(path, signals, dt):
    """A network of Affine, Linear, LIF and CubaLIF by forward Euler: every neuron's spikes of the step before reach the nodes of its loop."""
    with h5py.File(path) as file:
        nodes = {name: {key: value[()] for key, value in group.items()} for name, group in file["node/nodes"].items()}
        edges = [(a.decode(), b.decode()) for a, b in file["node/edges"][()]]
    for node in nodes.values():
        node["type"] = node["type"].decode()
        if "LIF" in node["type"]:
            node["v"], node["i"] = np.array(node["v_leak"], float), np.zeros(len(node["r"]))
            node["z"] = np.zeros(len(node["r"]))
    sources = {name: [a for a, b in edges if b == name] for name in nodes}

    def leads_to(start, goal, seen=()):
        return any(b == goal or (b not in seen and leads_to(b, goal, (*seen, b))) for a, b in edges if a == start)

    looped = {name: leads_to(name, name) for name in nodes}
    rows = []
    for row in signals:
        values = {}

        def output(name):
            node = nodes[name]
            if name in values:
                return values[name]
            x = row if node["type"] == "Input" else 0
            for source in sources[name]:
                delayed = "v" in nodes[source] and looped[source] and leads_to(name, source)
                x = x + (nodes[source]["before"] if delayed else output(source))
            if node["type"] in ("Affine", "Linear"):
                x = node["weight"].astype(float) @ x + node.get("bias", 0)
            elif "LIF" in node["type"]:
                if node["type"] == "CubaLIF":
                    node["i"] += dt / node["tau_syn"] * (node["w_in"] * x - node["i"])
                    x = node["i"]
                node["v"] += dt / node.get("tau_mem", node.get("tau")) * (node["v_leak"] - node["v"] + node["r"] * x)
                fired = node["v"] > node["v_threshold"]
                node["v"][fired] = node.get("v_reset", np.zeros(len(fired)))[fired]
                node["z"] = x = fired.astype(float)
            values[name] = x
            return x

        for node in nodes.values():
            if "z" in node:
                node["before"] = node["z"]
        rows.append(output(next(name for name, node in nodes.items() if node["type"] == "Output")))
        for name in nodes:
            output(name)
    return np.array(rows)


@unittest.skipIf(h5py is None, "h5py is not installed; Debian: python3-h5py")
class NirTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "x.nir")
        warnings.simplefilter("ignore", corpuscle.Warning)

    def write_lif(self, path=None, **changes):
        parameters = dict(tau=[0.01], r=[1.0], v_leak=[0.0], v_threshold=[1.0]) | changes
        write(path or self.path, {"in": ("Input", {"shape": [1]}), "lif": ("LIF", parameters), "out": ("Output", {"shape": [1]})},
              [("in", "lif"), ("lif", "out")])


@unittest.skipUnless(REFERENCE.exists(), NO_REFERENCE)
class Reference(NirTest):
    def test_the_lif_of_the_nir_paper_fires_in_the_steps_of_its_exact_solution(self):
        recorded = np.loadtxt(REFERENCE / "lif/lif_norse.csv", delimiter=",")
        graph = corpuscle.nir(REFERENCE / "lif/lif_norse.nir")
        for method in ("exact", "euler", "backward-euler"):
            spikes = graph.run(recorded[:, 0], 1e4, method=method)
            np.testing.assert_array_equal(np.flatnonzero(spikes[:, 0]), STEPS)
        np.testing.assert_array_equal(np.flatnonzero(recorded[:, 2]), STEPS)

    def test_the_same_graph_is_an_afferent_of_the_command_line_and_of_respond(self):
        force = np.loadtxt(REFERENCE / "lif/lif_norse.csv", delimiter=",")[:, 0]
        response = corpuscle.respond(force, 1e4, str(REFERENCE / "lif/lif_norse.nir"))
        np.testing.assert_allclose(response.train(0), np.array(STEPS) * 1e-4, atol=1e-12)
        table = self.path + ".csv"
        np.savetxt(table, np.column_stack([np.arange(1000) * 1e-4, force]), delimiter=",", header="time (s),force (N)", comments="")
        status, out, err = command_line("respond", table, "--afferent", str(REFERENCE / "lif/lif_norse.nir"), "--out", self.path + ".out")
        self.assertEqual((status, err), (0, ""))
        written = np.loadtxt(self.path + ".out/spikes.csv", delimiter=",", skiprows=1, usecols=2)
        np.testing.assert_allclose(written, np.array(STEPS) * 1e-4, atol=1e-9)

    def test_inconsistent_shapes_are_refused_with_both(self):
        with self.assertRaisesRegex(corpuscle.InputError, r"the edge from '1_LIFNeuronTorch' to 'output' joins different shapes: .* is \[1\], .* is \[1, 1, 1\]"):
            corpuscle.nir(REFERENCE / "lif/lif_rockpool.nir")

    def test_the_recurrent_networks_agree_with_a_simulation_in_numpy(self):
        signals = (np.random.default_rng(7).random((256, 12)) < 0.1).astype(float)
        for name in ("bias_zero", "noBias_subtract"):
            path = REFERENCE / f"braille_srnn/braille_noDelay_{name}.nir"
            graph = corpuscle.nir(path)
            self.assertEqual((graph.inputs, graph.outputs), (12, 7))
            output = graph.run(signals, 1e4, method="euler")
            np.testing.assert_array_equal(output, simulate(path, signals, 1e-4))
            self.assertGreater(output.sum(), 10)

    def test_every_part_of_a_file_matters(self):
        """Without each dataset, and with each one of another shape, the file is refused; a default and metadata are the exceptions."""
        source = REFERENCE / "braille_srnn/braille_noDelay_bias_zero.nir"
        names = []
        with h5py.File(source) as file:
            file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        may_be_absent = {"version", "node/nodes/lif1.lif/w_in", "node/nodes/lif2/w_in"}
        for name in names:
            for change in ("remove", "reshape"):
                shutil.copyfile(source, self.path)
                os.chmod(self.path, 0o600)
                with h5py.File(self.path, "a") as file:
                    values = file[name][()]
                    del file[name]
                    if change == "reshape":
                        file[name] = np.zeros((3, 5), np.float32) if not isinstance(values, bytes) else "Linea"
                if name == "version" or (name in may_be_absent and change == "remove"):
                    corpuscle.nir(self.path)
                    continue
                with self.assertRaises(corpuscle.InputError, msg=f"{change} {name}") as caught:
                    corpuscle.nir(self.path)
                self.assertIn(self.path, str(caught.exception))


class Graphs(NirTest):
    def test_nodes_have_their_parameters_in_shape(self):
        write(self.path, {"in": ("Input", {"shape": [2]}), "w": ("Affine", {"weight": np.arange(6.0).reshape(3, 2), "bias": np.ones(3)}),
                          "out": ("Output", {"shape": [3]})}, [("in", "w"), ("w", "out")])
        graph = corpuscle.nir(self.path)
        np.testing.assert_array_equal(graph.nodes["w"].parameters["weight"], np.arange(6).reshape(3, 2))
        self.assertEqual(graph.edges, [("in", "w"), ("w", "out")])
        np.testing.assert_array_equal(graph.run([[1, 2], [0, 0]], 1000), [[3, 9, 15], [1, 1, 1]])
        np.testing.assert_array_equal(graph.run(np.array([[True, False]]), 1000), [[1, 3, 5]])
        self.assertEqual((graph.input_nodes, graph.output_nodes), (["in"], ["out"]))
        np.testing.assert_array_equal(copy.copy(graph).run([[1, 2]], 1000), [[3, 9, 15]])
        self.assertIn("w: Affine, [2] to [3]", repr(graph))
        self.assertIn("Affine", graph._repr_html_())

    def test_a_force_and_a_response_are_inputs(self):
        self.write_lif(v_threshold=[1e9])
        graph = corpuscle.nir(self.path)
        self.assertEqual(graph.run(corpuscle.Force(press(), 1000)).shape, (1000, 1))
        write(self.path, {"in": ("Input", {"shape": [2]}), "out": ("Output", {"shape": [2]})}, [("in", "out")])
        response = corpuscle.respond(press(), 1000, ["sa1", "fa1"])
        counts = corpuscle.nir(self.path).run(response, rate=200)
        self.assertEqual(counts.shape, (200, 2))
        for k in (0, 1):
            np.testing.assert_array_equal(counts[:, k], np.histogram(response.train(k), np.arange(201) / 200)[0])
        write(self.path, {"in": ("Input", {"shape": [1]}), "out": ("Output", {"shape": [1]})}, [("in", "out")])
        once = corpuscle.nir(self.path)
        every_step = self.path + ".spikes.nir"
        self.write_lif(every_step, v_threshold=[-1.0], v_leak=[0.0])
        for rate in (3e3, 10e3, 44.1e3):  # spikes on the grid of the samples stay in their steps
            spikes = corpuscle.respond(np.zeros(5000), rate, every_step)
            np.testing.assert_array_equal(once.run(spikes, rate=rate), np.ones((5000, 1)))
        with self.assertRaisesRegex(corpuscle.InputError, "bins are too many"):
            once.run(spikes, rate=1e12)
        write(self.path, {"in": ("Input", {"shape": [2]}), "out": ("Output", {"shape": [2]})}, [("in", "out")])
        with self.assertRaisesRegex(corpuscle.InputError, "the response has 1 afferent; .* has 2 inputs"):
            corpuscle.nir(self.path).run(corpuscle.respond(press(), 1000, "sa1"), rate=200)

    def test_wrong_signals_are_refused(self):
        self.write_lif()
        graph = corpuscle.nir(self.path)
        for signals, options, message in ((np.zeros((4, 2)), {"rate": 1000}, r"the shape \[4, 2\]; .* needs \[step, input\] with 1 input"),
                                          ([0, np.nan], {"rate": 1000}, "input 0 of step 1 is nan"), ([0], {}, "rate is missing"),
                                          ([0], {"rate": -1}, "rate = -1 Hz must be"), ([0], {"rate": np.inf}, "rate = inf Hz must be"),
                                          (["a"], {"rate": 1}, "not an array of real numbers"), (np.zeros((2, 2, 2)), {"rate": 1}, "the shape"),
                                          ([0], {"rate": 1000, "method": "heun"}, "unknown method 'heun' .there are exact, euler, backward-euler"),
                                          ([0], {"rate": 10, "method": "euler"}, "too short for forward Euler"),
                                          (corpuscle.Force([0.0], 10), {"rate": 10}, "a Force has a rate of its own")):
            with self.assertRaisesRegex(corpuscle.InputError, message):
                graph.run(signals, **options)
        self.assertEqual(graph.run(np.zeros(0), 1000).shape, (0, 1))
        strided = np.linspace(0, 3, 2000)[::2]
        np.testing.assert_array_equal(graph.run(strided, 1000), graph.run(strided.copy(), 1000))
        with self.assertRaisesRegex(corpuscle.InputError, "not a NIR graph"):
            with h5py.File(self.path, "w") as file:
                file["x"] = 1
            corpuscle.nir(self.path)

    def test_a_run_stops_when_its_progress_function_says_so(self):
        self.write_lif()
        with self.assertRaises(KeyboardInterrupt):
            corpuscle.nir(self.path).run(np.zeros(50_000_000), 1000, progress=lambda fraction: False)

    def test_files_of_other_writers_are_read(self):
        """Scalars, links, blanks and dots in names, a graph within the graph before the output, metadata of any kind, other element types."""
        lif = dict(tau=0.01, r=np.float32(1), v_leak=0.0, v_threshold=0.05)
        write(self.path, {"in ": ("Input", {"shape": np.zeros(0, np.int64)}), "n.m": ("LIF", lif), "out": ("Output", {"shape": np.zeros(0, np.int64)})},
              [("in ", "n.m"), ("n.m", "out")])
        self.assertEqual(corpuscle.nir(self.path).run(np.full(100, 3.0), 1e3).sum(), 100)
        with h5py.File(self.path, "a") as file:
            group = file["node/nodes"]
            group["n.m/metadata/empty"] = h5py.Empty("f")
            group.create_group("g/nodes")
            group["g/type"], group["g/edges"] = "NIRGraph", np.array([["a", "k"], ["k", "b"]], dtype=h5py.string_dtype())
            for name, kind in (("a", "Input"), ("b", "Output")):
                group[f"g/nodes/{name}/type"], group[f"g/nodes/{name}/shape"] = kind, [1]
            group["g/nodes/k"] = h5py.SoftLink("/node/nodes/n.m")
            del file["node/edges"]
            file["node/edges"] = np.array([["in ", "n.m"], ["n.m", "g"], ["g", "out"]], dtype=h5py.string_dtype())
            group["n.m/v_reset"] = group["n.m/v_leak"]  # a hard link
        self.assertEqual(len(corpuscle.nir(self.path).nodes), 6)
        self.assertEqual(len(corpuscle.respond(np.full(100, 200.0), 1e3, self.path)), 100)  # the inner neuron fires last
        for name, values, message in (("tau", np.array([True]), "'tau' is not a dataset of numbers"), ("tau", np.array([1j]), "'tau' is not a dataset of numbers"),
                                      ("noise", [1.0], "unknown parameter 'noise'")):
            self.write_lif()
            with h5py.File(self.path, "a") as file:
                if name in file["node/nodes/lif"]:
                    del file[f"node/nodes/lif/{name}"]
                file[f"node/nodes/lif/{name}"] = values
            with self.assertRaisesRegex(corpuscle.InputError, message):
                corpuscle.nir(self.path)
        with h5py.File(self.path, "a") as file:
            del file["node/nodes/lif/noise"], file["node/nodes/lif/tau"]
            file["node/nodes/lif"].create_dataset("tau", data=[0.01], chunks=(1,), compression="lzf")
        with self.assertRaisesRegex(corpuscle.InputError, "compressed by filter 32000 .lzf., which is not available here"):
            corpuscle.nir(self.path)

    def test_what_is_no_file_of_this_kind_is_named(self):
        open(self.path, "w").close()
        for path, message in ((self.path, "this file is empty"), (os.path.dirname(self.path), "this is a directory"), ("/dev/null", "not a regular file"),
                              (self.path + "x", "No such file")):
            with self.assertRaisesRegex(corpuscle.InputError, message):
                corpuscle.nir(path)

    def test_a_diverging_network_is_an_error(self):
        write(self.path, {"in": ("Input", {"shape": [1]}), "i": ("I", {"r": [1.0]}), "w": ("Linear", {"weight": [[1e6]]}), "out": ("Output", {"shape": [1]})},
              [("in", "i"), ("i", "w"), ("w", "i"), ("i", "out")])
        with self.assertRaisesRegex(corpuscle.InputError, "output 0 of step .* is inf: the network diverges"):
            corpuscle.nir(self.path).run(np.ones(200), 1.0)

    def test_an_afferent_needs_one_input_and_spikes_and_has_no_parameters(self):
        self.write_lif()
        with self.assertRaisesRegex(corpuscle.InputError, "a NIR graph has no parameters that can be set"):
            corpuscle.respond(press(), 1000, self.path, settings={f"{self.path}.tau": 1})
        self.assertIn("did you mean 'lif.v'?", command_line("respond", "press", "--afferent", self.path, "--probe", "lif.w", "--out", self.path + ".out")[2])
        write(self.path, {"in": ("Input", {"shape": [1]}), "li": ("LI", dict(tau=[0.01], r=[1.0], v_leak=[0.0])), "out": ("Output", {"shape": [1]})},
              [("in", "li"), ("li", "out")])
        with self.assertRaisesRegex(corpuscle.InputError, "'li' .LI., which leads to the output, does not fire"):
            corpuscle.respond(press(), 1000, self.path)
        write(self.path, {"in": ("Input", {"shape": [2]}), "out": ("Output", {"shape": [2]})}, [("in", "out")])
        with self.assertRaisesRegex(corpuscle.InputError, r"this graph has 2 and 2; simulate it in Python with corpuscle.nir\("):
            corpuscle.respond(press(), 1000, self.path)

    def test_blocks_and_probes_do_not_change_the_spikes(self):
        self.write_lif(v_threshold=[0.5], tau=[0.03])
        out = self.path + ".out"
        self.assertEqual(command_line("respond", "press", "--afferent", self.path, "--out", out, "--probe", "lif.v")[0], 0)
        times = np.loadtxt(out + "/spikes.csv", delimiter=",", skiprows=1, usecols=2)
        v = np.loadtxt(out + "/probes.csv", delimiter=",", skiprows=1)
        self.assertGreater(len(times), 20)
        self.assertTrue((v[:, 2] <= 0.5).all())
        steps = np.flatnonzero(corpuscle.nir(self.path).run(v[:, 1], 1e4)[:, 0])  # the force of the file, of nine digits
        self.assertLessEqual(abs(len(steps) - len(times)), 1)


class Export(NirTest):
    def spikes(self, afferent, force, rate, settings=None):
        corpuscle.export(afferent, "nir", self.path, settings=settings)
        graph = corpuscle.respond(force, rate, self.path)
        model = corpuscle.respond(force, rate, afferent, settings=settings and {f"{afferent}.{key}": value for key, value in settings.items()})
        return graph.train(0), model.train(0)

    def test_a_receptor_without_rectifiers_and_a_leaky_neuron_are_exact_but_for_the_step(self):
        force = np.repeat([0.0, 12.0, 0.0], 4000)
        errors = []
        for rate, repeats in ((1e4, 1), (1e5, 10)):
            graph, model = self.spikes("sa1a+lif-a", np.repeat(force, repeats), rate, {"k_d": 0, "beta": 0})
            self.assertEqual(len(graph), len(model))
            self.assertGreater(len(model), 5)
            errors.append(np.abs(graph - model).max())
            os.remove(self.path)
        self.assertLess(errors[1], 0.2 * errors[0])  # the error is proportional to the step

    def test_the_thesis_afferents_fire_as_their_models(self):
        force = corpuscle.press(rate=10e3).samples
        for name in ("sa1", "fa1"):
            graph, model = self.spikes(name, force, 10e3)
            self.assertLessEqual(abs(len(graph) - len(model)), 1)
            before_pause = model < 0.5  # after a pause the charge differs, which the export warns of
            self.assertLess(np.abs(graph[:before_pause.sum()] - model[before_pause]).max(), 3e-3)
            os.remove(self.path)

    def test_other_programs_simulate_the_file(self):
        """Thresholds, sums and the neuron of the exported file, with NumPy, by the equations of NIR."""
        corpuscle.export("sa1", "nir", self.path)
        force, dt = corpuscle.press(rate=10e3).samples, 1e-4
        with h5py.File(self.path) as file:
            self.assertEqual(file["node/type"].asstr()[()], "NIRGraph")
            self.assertIn("f_B = 20 Hz", file["node/metadata/description"].asstr()[()])
            node = {name: {key: value[()] for key, value in group.items()} for name, group in file["node/nodes"].items()}
            edges = file["node/edges"].asstr()[()]
        order, waiting = [], set(node)
        while waiting:
            ready = sorted(n for n in waiting if all(a in order for a, b in edges if b == n))
            order += ready
            waiting -= set(ready)
        signal = {}
        for name in order:
            n, kind = node[name], node[name]["type"].decode()
            x = force[:, None] if kind == "Input" else sum(signal[a] for a, b in edges if b == name)
            if kind in ("Linear", "Affine"):
                x = x @ n["weight"].T + n.get("bias", 0)
            elif kind == "Threshold":
                x = (x > n["threshold"]).astype(float)
            elif kind in ("LI", "IF"):
                v, rows = 0.0, np.zeros((len(x), 1))
                for k, value in enumerate(x[:, 0]):
                    v = v + (1 - np.exp(-dt / n["tau"][0])) * (n["r"][0] * value - v) if kind == "LI" else v + dt * n["r"][0] * value
                    rows[k] = v if kind == "LI" else v > n["v_threshold"][0]
                    v = n["v_reset"][0] if kind == "IF" and rows[k] else v
                x = rows
            signal[name] = x
        steps = np.flatnonzero(signal["output"])
        np.testing.assert_array_equal(steps, np.flatnonzero(corpuscle.nir(self.path).run(force, 1e4)))
        self.assertEqual(len(steps), 15)

    def test_what_nir_cannot_say_is_refused_with_a_remedy_that_works(self):
        for name, message in (("fa1-nerve", "no node for the neuron alif; export one with lif-a or lif-b, such as sa1, fa1 or sa1b.lif-a"),
                              ("sa1-nerve", "add --set sa1-nerve.jitter=0"), ("sa1a+lif-b", "the slope of the force"), ("sa1-circuit", "it is a netlist"),
                              ("fast-adapting+lif-a", "the function asinh")):
            with self.assertRaisesRegex(corpuscle.InputError, message):
                corpuscle.export(name, "nir", self.path)
        with self.assertRaisesRegex(corpuscle.InputError, "add --set sa1.t_ref=0"):
            corpuscle.export("sa1", "nir", settings={"t_ref": "1 ms"})
        for name in ("sa1b+lif-a", "fa1b+lif-b"):
            self.assertEqual(corpuscle.export(name, "nir")[:4], b"\x89HDF")

    def test_the_same_command_gives_the_same_bytes_and_replaces_only_its_own_file(self):
        self.assertEqual(command_line("export", "sa1", "--for", "nir", "--out", self.path)[0], 0)
        with open(self.path, "rb") as file:
            self.assertEqual(file.read(), corpuscle.export("sa1", "nir"))
        self.assertEqual(command_line("export", "sa1", "--for", "nir", "--out", self.path)[0], 0)
        self.write_lif()
        status, _, err = command_line("export", "sa1", "--for", "nir", "--out", self.path)
        self.assertEqual(status, 1)
        self.assertIn("was not written by corpuscle", err)
        self.assertIn("--for nir: the file is not text; name it: --out x.nir", command_line("export", "sa1", "--for", "nir")[2])


if __name__ == "__main__":
    unittest.main()
