"""Report pages and notebook displays."""

import html
import json
import os
import pickle
import re
import shutil
import tempfile
import unittest
import warnings
from unittest import mock

import corpuscle
import numpy as np
from corpuscle import _report
from support import ROOT, command_line, press

COMMAND = re.compile(r'"command":"(?:[^"\\]|\\.)*"')
DATA = re.compile(r'<script type="application/json" id="data">(.*?)</script>', re.S)


def framed_page(response):
    """The page in the frame of a display."""
    return html.unescape(re.search("<iframe srcdoc='([^']*)'", response._repr_html_())[1])


def data_of(page):
    return json.loads(DATA.search(page)[1])


class Folders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def report_of(self, response, name="page.html"):
        response.report(self.path(name))
        with open(self.path(name)) as file:
            return file.read()


class Pages(Folders):
    def compare(self, response, *arguments):
        """The same bytes as of the command line, apart from the command."""
        status, _, message = command_line("respond", *arguments, "--report", self.path("theirs.html"), "--overwrite")
        self.assertEqual(status, 0, message)
        with open(self.path("theirs.html")) as file:
            theirs = file.read()
        ours = self.report_of(response)
        self.assertIn('"command":"corpuscle.', ours)
        self.assertEqual(COMMAND.sub("", ours), COMMAND.sub("", theirs))

    def test_of_afferents(self):
        self.compare(corpuscle.respond("press"), "press")
        self.compare(corpuscle.respond("press", afferent="sa1", copies=3, spread={"f_B": "10%"}, seed=2), "press", "--afferent", "sa1", "--copies", "3",
                     "--spread", "sa1.f_B=10%", "--seed", "2")
        self.compare(corpuscle.respond("press", 1000, ["sa1-nerve", "fa2"], single_precision=True), "press", "--rate", "1000", "--afferent", "sa1-nerve,fa2",
                     "--float")

    def test_of_a_recording_and_of_a_stimulus_in_python(self):
        path = f"{ROOT}/examples/data/touch.csv"
        self.compare(corpuscle.respond(corpuscle.read(path, deadband="20 mN")), path, "--deadband", "20 mN")
        self.compare(corpuscle.respond(corpuscle.press(F_max=2, rate=2000)), "press", "--set", "press.F_max=2", "--rate", "2000")

    def test_of_skins(self):
        self.compare(corpuscle.hand().respond("stroke"), "stroke", "--population", "hand")
        self.compare(corpuscle.grid(3, 3).respond("press", contact="sphere"), "press", "--population", "grid 3x3", "--contact", "sphere")

    def test_of_a_pickled_response(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        self.assertEqual(self.report_of(pickle.loads(pickle.dumps(response)), "a.html"), self.report_of(response, "b.html"))

    def test_an_earlier_page_is_replaced_and_another_file_is_not(self):
        first, second = corpuscle.respond("press", afferent="sa1"), corpuscle.respond("press", afferent="fa1")
        self.assertNotEqual(self.report_of(first), self.report_of(second))
        with open(self.path("own.html"), "w") as file:
            file.write("<p>mine</p>")
        with self.assertRaisesRegex(corpuscle.InputError, "/proc/none"):
            first.report("/proc/none/page.html")
        with self.assertRaisesRegex(corpuscle.InputError, "own.html"):
            first.report(self.path("own.html"))
        with open(self.path("own.html")) as file:
            self.assertEqual(file.read(), "<p>mine</p>")

    def test_other_names_are_refused_before_the_run(self):
        response = corpuscle.respond("press", afferent="sa1")
        with mock.patch.object(_report.Run, "page", side_effect=AssertionError):
            for name, text in (("page.pdf", "the name must end in .html, such as "), ("", "must not be empty"), (self.path("a\0b.html"), "NUL"),
                               (None, "is not a path"), ("\ud800.html", "is not a path")):
                with self.subTest(name=name), self.assertRaisesRegex(corpuscle.InputError, text):
                    response.report(name)

    def test_a_page_names_no_directories(self):
        os.mkdir(self.path("secret"))
        shutil.copy(f"{ROOT}/circuits/spiker.cir", self.path("secret/own.cir"))
        shutil.copy(f"{ROOT}/skins/fingertip.toml", self.path("secret/own.toml"))
        page = self.report_of(corpuscle.respond("press", afferent=["sa1", self.path("secret/own.cir")]))
        self.assertIn("afferent=['sa1', 'own.cir']", data_of(page)["command"])
        self.assertNotIn("secret", page)
        page = self.report_of(corpuscle.population(self.path("secret/own.toml")).respond("press"), "skin.html")
        self.assertIn("corpuscle.population('own.toml')", data_of(page)["command"])
        self.assertNotIn("secret", page)

    def test_a_force_that_has_changed_is_refused(self):
        force = press()
        response = corpuscle.respond(force, 1000, "sa1")
        force *= 2
        with self.assertRaisesRegex(corpuscle.InputError, "has changed since the run"):
            response.report(self.path("page.html"))
        self.assertFalse(os.path.exists(self.path("page.html")))


class Displays(Folders):
    def test_the_frame_has_a_page_of_the_response(self):
        response = corpuscle.respond("press")
        data = data_of(framed_page(response))
        self.assertEqual(data["title"], "press")
        self.assertEqual(sum(s["count"] for s in data["spikes"]), len(response))
        self.assertLess(len(response._repr_html_()), _report.MAX_BYTES)
        self.assertIn(html.escape(repr(response), quote=False), response._repr_html_())

    def test_large_runs_stay_below_the_limit_and_name_what_is_left_out(self):
        rng = np.random.default_rng(1)
        many = corpuscle.respond(4 * rng.random((20000, 40)), 1000, ["sa1-nerve", "fa1-nerve"])
        page = framed_page(many)
        shown = len(data_of(page)["inputs"][0]["channels"])
        self.assertTrue(0 < shown < 40)
        self.assertIn(f"This page shows {shown} of 40 channels.", data_of(page)["notes"])
        self.assertEqual({row[1] for row in data_of(page)["table"]["rows"]}, set(many.channels[:2 * shown]))
        self.assertLess(len(many._repr_html_().encode()), _report.MAX_BYTES)
        hand = corpuscle.hand().respond("texture")
        self.assertLess(len(hand._repr_html_().encode()), _report.MAX_BYTES)
        self.assertIn("iframe", hand._repr_html_())

    def test_what_does_not_fit_is_text(self):
        with mock.patch.object(_report, "MAX_BYTES", 1000):
            shown = corpuscle.respond("press")._repr_html_()
        self.assertNotIn("iframe", shown)
        self.assertIn("too large for a notebook", shown)

    def test_a_long_run_is_not_repeated(self):
        response = corpuscle.respond("press")
        response._seconds = 60.0
        with mock.patch.object(_report.Run, "page", side_effect=AssertionError):
            shown = response._repr_html_()
        self.assertIn("The run took 60 s", shown)
        self.assertIn('response.report("page.html")', shown)

    def test_warnings_are_shown_and_names_are_escaped(self):
        force = corpuscle.Force(1e5 * press(), 1000, ["<b>&'\"</script>"], name="<i>'")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", corpuscle.Warning)
            response = corpuscle.respond(force, afferent="sa1")
        shown = response._repr_html_()
        with mock.patch.object(_report, "MAX_BYTES", 1000):
            outside = response._repr_html_()
        self.assertIn("Warning: ", outside)
        self.assertNotIn("<b>", outside)
        self.assertIn("&lt;b&gt;", outside)
        page = html.unescape(re.search("<iframe srcdoc='([^']*)'", shown)[1])
        self.assertEqual(data_of(page)["inputs"][0]["channels"][0]["name"], "<b>&'\"</script>")

    def test_a_changed_force_does_not_stop_the_display(self):
        force = press()
        response = corpuscle.respond(force, 1000, "sa1")
        force *= 2
        self.assertIn("has changed since the run", response._repr_html_())


if __name__ == "__main__":
    unittest.main()
