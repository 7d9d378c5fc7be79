"""The catalogues, and the documentation that is made from them."""

import ast
import inspect
import json
import os
import unittest

import corpuscle
import numpy as np
from support import ROOT, command_line


class Catalogues(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.listed = json.loads(command_line("list", "--json")[1])

    def test_every_entry_and_parameter_is_that_of_the_command_line(self):
        for name in corpuscle.catalogues():
            ours = corpuscle.catalogue(name)
            # The command line also lists what is not one entry: grids, own files, the path of a contact.
            listed = [e for e in self.listed[name] if e["name"] not in ("path/own.cir", "path/own.nir", "path/own.toml", "grid 8x8", "path")]
            self.assertGreater(len(ours), 0)
            self.assertEqual(ours.names(), [e["name"] for e in listed])
            for entry, line in zip(ours, listed):
                self.assertEqual(entry.description, line["description"])
                parameters = line.get("parameters", [])
                self.assertEqual([(p.name, p.unit, p.default) for p in entry.parameters], [(p["name"], p["unit"], p["default"]) for p in parameters])
                for p, other in zip(entry.parameters, parameters):
                    if other["low"] is not None and abs(other["low"]) < 1e308:
                        self.assertEqual(p.low, other["low"])
                    self.assertTrue(p.description)

    def test_every_default_is_in_its_range(self):
        for name in corpuscle.catalogues():
            for entry in corpuscle.catalogue(name):
                for p in entry.parameters:
                    self.assertTrue(p.low <= p.default <= p.high, (entry.name, p))

    def test_every_stimulus_is_a_function_whose_documentation_has_each_parameter(self):
        for entry in corpuscle.catalogue("stimuli"):
            name = entry.name.replace("-", "_")
            self.assertIn(name, dir(corpuscle))
            function = getattr(corpuscle, name)
            force = function(rate=2000)
            self.assertEqual(force.rate, 2000)
            self.assertTrue(np.isfinite(force.samples).all())
            for p in entry.parameters:
                self.assertIn(f"{p.name} = {p.default:g}", function.__doc__)
                self.assertIn(p.description, function.__doc__)
            self.assertIn(entry.source, function.__doc__)

    def test_every_afferent_responds_to_its_name(self):
        self.assertIn("sa1-nerve", corpuscle.afferents().names())
        for entry in corpuscle.afferents():
            if "circuit" not in entry.name and "biased" not in entry.name and "macro" not in entry.name:  # seconds each
                self.assertEqual(corpuscle.respond("press", afferent=entry.name).names, [entry.name])

    def test_every_measure_is_documented(self):
        for entry in corpuscle.catalogue("measures"):
            self.assertIn(entry.description, corpuscle.measures.__doc__)
        self.assertEqual(list(corpuscle.measures([0.1, 0.2], 0, 1)), corpuscle.catalogue("measures").names())

    def test_a_catalogue_finds_an_entry_and_shows_itself(self):
        afferents = corpuscle.afferents()
        self.assertEqual(afferents["sa1"], afferents[0])
        with self.assertRaises(KeyError):
            afferents["sa9"]
        self.assertIn("sa1-nerve", repr(afferents))
        self.assertEqual(afferents._repr_html_().count("<tr>"), len(afferents) + 1)
        self.assertIn("f_B = ", str(afferents["sa1"]))


class Documentation(unittest.TestCase):
    def test_everything_public_has_a_docstring(self):
        for name in corpuscle.__all__:
            thing = getattr(corpuscle, name)
            self.assertTrue(thing.__doc__ or issubclass(thing, Exception), name)
            if inspect.isclass(thing):
                for member, value in vars(thing).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_the_stubs_have_the_names_and_arguments_of_the_package(self):
        with open(os.path.join(ROOT, "python/corpuscle/__init__.pyi")) as file:
            tree = ast.parse(file.read())
        stubs = {n.name: n for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
        stubs.pop("FittedValue")  # a type of values only
        stimuli = [e.name.replace("-", "_") for e in corpuscle.catalogue("stimuli")]
        self.assertEqual(set(stubs), {*corpuscle.__all__, *stimuli, "Warning"})
        for name, stub in stubs.items():
            thing = getattr(corpuscle, name)
            if isinstance(stub, ast.FunctionDef):
                self.compare(name, stub, thing)
                continue
            members = {n.name: n for n in stub.body if isinstance(n, ast.FunctionDef)}
            public = {m for m, v in vars(thing).items() if not m.startswith("_") and (callable(v) or hasattr(v, "__get__")) and m not in thing.__dict__.get("__dataclass_fields__", {})}
            self.assertEqual({m for m in members if not m.startswith("_")}, public, name)
            for member, node in members.items():
                value = inspect.getattr_static(thing, member)
                if inspect.isfunction(value):
                    self.compare(f"{name}.{member}", node, value)

    def compare(self, name, stub, function):
        ours = inspect.signature(function).parameters.values()
        args = stub.args
        defaults = [None] * (len(args.args) - len(args.defaults)) + list(args.defaults)
        stated = [(a.arg, d) for a, d in zip(args.args, defaults)] + list(zip((a.arg for a in args.kwonlyargs), args.kw_defaults))
        named = [p for p in ours if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)]
        self.assertEqual([a for a, _ in stated], [p.name for p in named], name)
        self.assertEqual([d and ast.literal_eval(d) for _, d in stated],
                         [None if p.default is p.empty else p.default for p in named], name)
        self.assertEqual(bool(args.vararg), any(p.kind is p.VAR_POSITIONAL for p in ours), name)
        self.assertEqual(bool(args.kwarg), any(p.kind is p.VAR_KEYWORD for p in ours), name)
        self.assertEqual([a.arg for a in args.kwonlyargs], [p.name for p in named if p.kind is p.KEYWORD_ONLY], name)


if __name__ == "__main__":
    unittest.main()
