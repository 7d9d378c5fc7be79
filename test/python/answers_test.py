"""The package gives the numbers of the command line."""

import json
import unittest

import corpuscle
import numpy as np
from support import ROOT, command_line, press


class Answers(unittest.TestCase):
    def compare(self, response, *arguments):
        """Compares the complete document, and every spike."""
        status, output, message = command_line("respond", *arguments, "--json")
        self.assertEqual(status, 0, message)
        document = json.loads(output)
        spikes = document.pop("spikes")
        document.pop("files")
        self.assertEqual(response.summary, document)
        expected = [time for one in spikes for time in one["times_s"]]
        self.assertGreater(len(expected), 3)
        self.assertEqual(response.times.tolist(), sorted(expected))

    def test_of_afferents(self):
        self.compare(corpuscle.respond("press", afferent=["sa1", "fa1-nerve"]), "press", "--afferent", "sa1,fa1-nerve")
        self.compare(corpuscle.respond("press", afferent="sa1", settings={"f_B": "25 Hz", "press.F_max": "2 N"}), "press", "--afferent", "sa1", "--set",
                     "sa1.f_B=25Hz", "--set", "press.F_max=2N")
        self.compare(corpuscle.respond("press", afferent="sa1", method="backward-euler", sampled=True, noise=1e-10, seed=7), "press", "--afferent", "sa1",
                     "--method", "backward-euler", "--sampled", "--noise", "1e-10", "--seed", "7")

    def test_of_skins(self):
        self.compare(corpuscle.hand().respond("stroke"), "stroke", "--population", "hand")
        self.compare(corpuscle.grid(3, 3).respond("press"), "press", "--population", "grid 3x3")

    def test_of_a_recording(self):
        path = f"{ROOT}/examples/data/touch.csv"
        response = corpuscle.respond(corpuscle.read(path, deadband="20 mN"), afferent=["sa1-nerve", "fa1-nerve"])
        document = json.loads(command_line("respond", path, "--deadband", "20 mN", "--afferent", "sa1-nerve,fa1-nerve", "--json")[1])
        self.assertEqual(response.summary["rates"], document["rates"])

    def test_of_a_live_skin(self):
        force = press()
        skin = corpuscle.LiveSkin("grid 2x2")
        live = [spike for f in force for spike in skin.push([f] * 4)] + skin.finish()
        whole = corpuscle.grid(2, 2).respond(np.repeat(force[:, None], 4, axis=1), 1000)
        self.assertGreater(len(live), 10)
        self.assertEqual(live, list(zip(whole.times.tolist(), whole.indices.tolist())))


if __name__ == "__main__":
    unittest.main()
