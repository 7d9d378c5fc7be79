#!/usr/bin/python3
"""Messages of the live page, and what it keeps, if a simulation fails, is stopped or is replaced:   live_messages_test.py CORPUSCLE OUTDIR PAGE

Exits with 77 if there is no PAGE, which `make page` builds.
"""
import gzip

from live_page import *

BROKEN_CHIP = "fa1-circuit~r_0=0"  # a circuit that has no operating point
REASON = "no operating point found"


class Messages(LivePage):
    def setUp(self):
        self.start("#rows=sa1&rate=2000&skin=none")

    def readout(self):
        """The text beside the name of the first row."""
        return self.js("return document.querySelector('.row-card[data-row] summary .readout').textContent")

    def open_tools(self):
        """Opens the first row, which is a chip, and the recordings."""
        self.js("document.querySelector('.row-card details').open = true; document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#run-monte-carlo") and self.all("#play-stimulus"))

    def click(self, *buttons):
        """Clicks buttons one after the other, before the engine can answer."""
        self.js("for (const id of arguments) document.getElementById(id).click()", *buttons)

    def monte_carlo(self):
        return self.js("return document.querySelector('.monte-carlo .readout').textContent")

    def errors_in_the_console(self):
        return [one["message"] for one in self.browser.get_log("browser") if one["level"] == "SEVERE"]


class Circuits(Messages):
    def test_a_circuit_that_does_not_converge_says_so_in_its_row_in_a_replay_and_in_a_monte_carlo(self):
        self.follow(f"#rows={BROKEN_CHIP}&skin=none")
        self.until(lambda: REASON in self.readout())
        self.open_tools()
        self.click("play-stimulus")
        self.until(lambda: "spikes" in self.text("recording-status"))
        self.assertRegex(self.text("recording-status"), f"fa1-circuit 0 spikes. fa1-circuit: .*{REASON}")
        self.click("run-monte-carlo")
        self.until(lambda: "50 of 50" in self.monte_carlo())
        self.assertRegex(self.monte_carlo(), f"50 of them stopped: .*{REASON}")

    def test_a_quantity_outside_its_range_is_named_in_the_row_while_it_is_outside(self):
        self.follow("#rows=sa1-circuit&force=20&skin=none")
        self.assertNotIn("outside", self.readout())
        self.js("corpuscle.press.isDown = true")
        self.until(lambda: "outside" in self.readout())
        self.assertRegex(self.readout(), r"Hz, \d+ spikes, .*W\. v\(vf\) is outside 0 to 0.6 V: v_f is above its range")
        self.js("corpuscle.press.isDown = false")
        self.until(lambda: "outside" not in self.readout())


class Replacements(Messages):
    def test_a_replay_that_a_monte_carlo_stops_says_so(self):
        self.follow("#rows=fa1-circuit&skin=none")
        self.open_tools()
        self.click("play-stimulus", "run-monte-carlo")
        self.until(lambda: "stopped" in self.text("recording-status"))
        self.assertRegex(self.text("recording-status"), r"^press: \d+ % simulated, stopped by another simulation$")

    def test_two_quick_changes_of_the_skin_keep_the_beginning_of_the_last_session(self):
        self.js("""const select = document.querySelector('.skin-controls select');
            for (const name of ["fingertip", "none", "hand"]) {
                select.selectedIndex = [...select.options].findIndex(({text}) => text === name);
                select.dispatchEvent(new Event("change"));
            }""")
        self.until(lambda: self.js("return corpuscle.session.skin?.population === 'hand' && corpuscle.session.time > 0.1"))
        unknown = self.js("""const {force} = corpuscle.session;
            return Array.from({length: force.clock.samples}, (_, k) => k).filter((k) => force.range(k, k + 1)[0] === null)""")
        self.assertEqual(unknown, [])


class Links(Messages):
    def test_a_sampling_rate_that_the_page_cannot_run_is_refused(self):
        for rate in ("499", "100001", "2kHz", ""):
            self.follow(f"#rows=sa1&skin=none&rate={rate}")
            self.assertIn("The link of this page is damaged", self.text("message"), rate)
            self.assertEqual(self.rates(), [2000, "2000"], rate)

    def test_any_other_sampling_rate_runs_with_a_message_if_it_is_too_low_for_a_row(self):
        self.follow("#rows=fa2&skin=none&rate=750")
        self.assertEqual(self.text("message"), "fa2: the sample rate is 750 Hz, but this afferent needs 1000 Hz or more: "
                         "vibration above 375 Hz is missing, and the afferent responds to the slower part of the force only")
        self.assertEqual(self.rates(), [750, "750"])
        self.follow("#rows=sa1&skin=none&rate=100000")
        self.assertEqual(self.text("message"), "")
        self.assertEqual(self.rates(), [100000, "100000"])

    def test_a_link_of_the_user_is_followed_although_the_page_has_written_its_own_since(self):
        self.js("location.hash = '#rows=sa1&skin=none&rate=5000'; history.replaceState(null, '', '#rows=sa1&skin=none')")  # before the event of the first
        self.until(lambda: self.rates() == [5000, "5000"])
        self.until(lambda: "rate=5000" in self.js("return location.hash"))

    def rates(self):
        """The sampling rate of the force, and the one that is shown."""
        return self.js("""const chooser = [...document.querySelectorAll('.skin-controls .chooser')].find((one) => one.textContent.startsWith("Samples per second"));
            return [Math.round(1 / corpuscle.session.force.clock.T), chooser.querySelector('select').selectedOptions[0]?.text]""")


class Engine(Messages):
    def test_an_engine_that_stops_says_so_and_how_to_go_on(self):
        self.js("corpuscle.session.engine.worker.postMessage(null)")  # throws in the worker, as a trap of WebAssembly does
        self.until(lambda: self.text("message"))
        self.assertRegex(self.text("message"), r"^The engine has stopped \(.+\)\. Reload the page to start it again; its link keeps the settings\.$")
        self.until(lambda: self.text("pause") == "Go on")
        self.assertEqual(len(self.errors_in_the_console()), 1)
        for button in ("restart", "pause", "save"):  # all say the same
            self.js("document.getElementById('message').textContent = ''")
            self.click(button)
            self.until(lambda: "Reload the page" in self.text("message"))

    def test_an_engine_that_does_not_start_says_so_and_which_browsers_can_start_it(self):
        for name, engine in (("no module", gzip.compress(b"not WebAssembly")), ("not compressed", b"not gzip")):
            path = OUT / "damaged_engine.html"
            path.write_text(re.sub(r'(id="engine">)[^<]*', lambda found: found[1] + base64.b64encode(engine).decode(), PAGE.read_text()))
            self.open(path)
            self.until(lambda: "did not start" in self.js("return document.body.innerText"))
            self.assertRegex(self.js("return document.body.innerText"), r"The engine did not start \(.+\)\. It needs Chrome 112, Firefox 113, Safari 16\.4 or later", name)
            self.errors_in_the_console()


if __name__ == "__main__":
    run_live_tests()
