"""Models for other simulators: the text is that of the command line."""

import os
import tempfile
import unittest
import warnings

import corpuscle
from support import ROOT, command_line

INVERTER = f"{ROOT}/circuits/inverter.cir"


class Export(unittest.TestCase):
    def test_the_text_is_that_of_the_command_line(self):
        for target in ("brian2", "neuron"):
            expected = command_line("export", "sa1", "--for", target, "--set", "sa1.f_B=25")[1]
            self.assertIn("f_B = 25", expected)
            self.assertEqual(corpuscle.export("sa1", target, settings={"f_B": 25}), expected)

    def test_a_file_is_written_once(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "fa1.py")
            text = corpuscle.export("fa1", "brian2", path)
            with open(path) as file:
                self.assertEqual(file.read(), text)
            with self.assertRaisesRegex(corpuscle.InputError, "this file exists"):
                corpuscle.export("fa1", "brian2", path)

    def test_what_a_simulator_lacks_is_a_warning(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "divider.cir")
            with open(path, "w") as file:
                file.write("divider\nv1 a 0 3\nr1 a b 1k\nr2 b 0 1k\n.op\n.expect v(b) 1.5 1%\n")
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                self.assertTrue(corpuscle.export(path, "ngspice").startswith("divider\n"))
            self.assertIn("left out: .expect", str(caught[0].message))

    def test_a_kit_is_that_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            card, deck = os.path.join(folder, "a kit.lib"), os.path.join(folder, "deck.cir")
            with open(card, "w") as file:
                file.write(".model n1 nmos (level=1)\n.model p1 pmos (level=1)\n")
            options = ("--map", "plain", "--nch", "n1", "--pch", "p1")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                expected = command_line("export", INVERTER, "--for", "ngspice", "--card", card, *options)[1]
                self.assertIn(f".include '{card}'", expected)
                kit = {"card": card, "map": "plain", "nch": "n1", "pch": "p1"}
                self.assertEqual(corpuscle.export(INVERTER, "ngspice", kit=kit), expected)
                relative = corpuscle.export(INVERTER, "ngspice", deck, kit=kit | {"card": os.path.relpath(card)})
            self.assertIn(".include 'a kit.lib'", relative)
            for wrong, message in ((3, "kit = 3 is not a dictionary"), ({"cards": card}, "kit: there is no 'cards' .there are card, map"),
                                   ({"card": 3}, "kit: card = 3 is not a name"), ({"card": card, "nch": "n2"}, "it has no .model n2; it has n1, p1"),
                                   ({"nch": "n1"}, "--nch needs --card")):
                with self.assertRaisesRegex(corpuscle.InputError, message):
                    corpuscle.export(INVERTER, "ngspice", kit=wrong)
            with self.assertRaisesRegex(corpuscle.InputError, "--card is for --for ngspice"):
                corpuscle.export("sa1", "brian2", kit=kit)

    def test_errors_name_the_reason_and_the_remedy(self):
        for arguments, message in ((("sa1", "nest"), "unknown target 'nest' .there are ngspice, brian2"), (("sa1-nerve", "brian2"), "jitter=0"),
                                   (("sa1", "ngspice"), "exports netlists"), (("sa3", "brian2"), "unknown afferent 'sa3'"),
                                   ((3, "brian2"), "subject = 3 is not a name")):
            with self.assertRaisesRegex(corpuscle.InputError, message):
                corpuscle.export(*arguments)


if __name__ == "__main__":
    unittest.main()
