#!/usr/bin/python3
"""Recordings that are replayed on the live page:   live_replay_test.py CORPUSCLE OUTDIR PAGE

Exits with 77 if there is no PAGE, which `make page` builds.
"""
import random

from live_page import *


def write_recording(name, samples, rate, force, t0=0, channels=("force",)):
    """A CSV recording in N with `force(k)` on each channel."""
    path = OUT / name
    lines = [",".join(["time_s", *(f"{channel}_N" for channel in channels)])]
    lines += [f"{t0 + k / rate:.6f}" + f",{force(k):.6f}" * len(channels) for k in range(samples)]
    path.write_text("\n".join(lines) + "\n")
    return path


def press(k):
    return 2.0 if 200 < k < 700 else 0.0


class Replays(LivePage):
    ROWS = "sa1,sa1-nerve"

    def setUp(self):
        self.start(f"#rows={self.ROWS}&rate=2000&skin=none")
        self.pause()
        self.js("document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#recording-file"))

    def load(self, path):
        self.browser.find_element(By.ID, "recording-file").send_keys(str(path))

    def load_and_wait(self, path):
        self.load(path)
        self.until(lambda: re.match(re.escape(path.name) + r".*: .* spikes", self.text("recording-status")))

    def warnings(self):
        return self.texts_of("#replay .notes li")

    def shown(self):
        """Numbers of the shown choosers, notes and figures."""
        return [len(self.all(selector)) for selector in ("#recording .chooser", "#recording .note, #recording .notes", "#recording figure")]


class Notes(Replays):
    ROWS = "sa1,fa1-nerve"

    def test_a_replay_has_the_warnings_that_the_program_prints(self):
        noise = random.Random(1)
        recordings = [write_recording("rest.csv", 3000, 1000, lambda k: noise.gauss(0, 5e-3)), write_recording("strong.csv", 100, 100, lambda k: 1e5 if k > 10 else 0)]
        for path, parts in zip(recordings, (["noise of the sensor", "--zero 500ms --deadband auto"], ["truncated", "several spikes come within one sample"])):
            printed = subprocess.run([CORPUSCLE, "respond", path, "--afferent", self.ROWS], check=True, capture_output=True, text=True).stderr
            self.load_and_wait(path)
            for part in parts:
                self.assertIn(part, " ".join(self.warnings()), path)
            for warning in self.warnings():
                self.assertIn(warning, printed)

    def test_a_replay_of_a_chip_names_the_range_that_a_quantity_has_left(self):
        self.follow("#rows=sa1-circuit&rate=2000&skin=none")
        self.load_and_wait(write_recording("hard.csv", 300, 1000, lambda k: 15, t0=100))
        self.assertRegex(" ".join(self.warnings()), r"sa1-circuit on force: v\(vf\) was outside 0 V to 600 mV for .* of 300 ms, first at 100")


class Times(Replays):
    def test_figures_and_files_have_the_times_of_the_recording(self):
        path = write_recording("late.csv", 1000, 1000, press, t0=100)
        self.load_and_wait(path)
        self.assertIn("late.csv: 1 s from 100 s; ", self.text("recording-status"))
        begin, end = self.js("return [corpuscle.replay.a, corpuscle.replay.b]")
        self.assertAlmostEqual(begin, 100)
        self.assertAlmostEqual(end, 101)
        subprocess.run([CORPUSCLE, "respond", path, "--afferent", self.ROWS, "--out", OUT / "late", "--quiet", "--overwrite"], check=True)
        expected = (OUT / "late" / "spikes.csv").read_text()
        self.assertEqual(self.download("save-replay", "spikes.csv").read_text(), expected)
        times = [line.split(",")[-1] for line in self.saved("recorded spikes", "CSV").decode().splitlines()[1:]]
        self.assertEqual(sorted(f"{float(t):.9f}" for t in times), sorted(line.split(",")[-1] for line in expected.splitlines()[1:]))
        force = self.saved("recorded force", "CSV").decode().splitlines()
        self.assertEqual(float(force[1].split(",")[0]), 100)

    def test_spikes_of_the_session_and_of_the_replay_are_not_confused(self):
        self.load_and_wait(write_recording("press.csv", 1000, 1000, press))
        self.assertEqual(self.download("save", "spikes.csv").read_text(), "afferent,channel,time_s\n")
        self.assertIn("Nothing has fired since the start of this session, so spikes.csv has no spikes. The replay below has a button of its own", self.text("message"))


class Settings(Replays):
    ROWS = "sa1"

    def test_after_a_change_of_the_settings_a_replay_can_be_simulated_again(self):
        path = write_recording("changed.csv", 1000, 1000, press)
        self.load_and_wait(path)
        before, again = self.text("recording-status"), self.browser.find_element(By.ID, "replay-again")
        self.settle()
        self.assertFalse(again.is_displayed())
        self.js("document.querySelector('.row-card details').open = true")
        self.until(lambda: self.all('.parameter[data-parameter="k_A"]'))
        self.js("const field = document.querySelector('.parameter[data-parameter=k_A] input[type=number]'); field.value = '5e-6'; field.dispatchEvent(new Event('change'))")
        self.until(again.is_displayed)
        again.click()
        self.until(lambda: re.search("sa1 .* spikes", self.text("recording-status")) and self.text("recording-status") != before)
        printed = program("respond", path, "--afferent", "sa1", "--set", "sa1.k_A=5u", "--out", OUT / "changed", "--overwrite")
        self.assertTrue(printed)
        self.assertIn(f"sa1 {len(trains(OUT / 'changed' / 'spikes.csv')['sa1'])} spikes", self.text("recording-status"))
        self.assertFalse(again.is_displayed())


class Files(Replays):
    def test_a_refused_file_clears_the_replay_before_it(self):
        self.load_and_wait(write_recording("left_right.csv", 500, 1000, press, channels=("left", "right")))
        self.assertEqual(self.shown()[0], 2)
        self.assertEqual(self.shown()[2], 2)
        self.assertEqual(self.text("recording-name"), "left_right.csv")
        empty = OUT / "empty.csv"
        empty.write_text("")
        self.load(empty)
        self.until(lambda: "empty.csv" in self.text("recording-status") and "reading" not in self.text("recording-status"))
        self.assertEqual(self.shown(), [1, 1, 0])
        self.assertEqual(self.text("recording-name"), "empty.csv")

    def test_another_channel_clears_the_replay_before_it(self):
        self.load_and_wait(write_recording("left_right.csv", 500, 1000, press, channels=("left", "right")))
        remaining = self.js("""const select = [...document.querySelectorAll('#recording .chooser')].find((one) => one.textContent.startsWith('Channel')).querySelector('select');
            select.selectedIndex = 1;
            select.dispatchEvent(new Event("change"));
            return document.querySelectorAll('#replay > *').length;""")  # before the engine has answered
        self.assertEqual(remaining, 0)
        self.until(lambda: self.text("recording-status").startswith("left_right.csv, right: 500 ms"))
        self.assertEqual(self.shown()[2], 2)

    def test_the_newest_file_is_shown_also_if_an_older_one_is_read_later(self):
        old, new = (write_recording(name, 500, 1000, press) for name in ("old.csv", "new.csv"))
        self.js("""const read = File.prototype.arrayBuffer;
            File.prototype.arrayBuffer = async function () {
                const bytes = await read.call(this);
                if (this.name === "old.csv") await new Promise((done) => { corpuscle.release = done; });
                return bytes;
            };""")
        self.load(old)
        self.until(lambda: self.text("recording-status") == "reading old.csv …")
        self.load_and_wait(new)
        self.js("corpuscle.release(); return corpuscle.session.engine.request({request: 'catalogue'}).then(() => true)")  # after all that the older file asks for
        self.assertTrue(self.text("recording-status").startswith("new.csv: "), self.text("recording-status"))
        self.assertEqual(self.text("recording-name"), "new.csv")

    def load_options(self, line):
        field = self.browser.find_element(By.ID, "recording-options")
        field.clear()
        field.send_keys(line, Keys.ENTER)

    def test_a_shells_quotation_marks_and_short_options_are_understood(self):
        path = write_recording("marks.csv", 500, 1000, press, channels=("index", "right thumb"))
        self.load_and_wait(path)
        for line in ("--channel 'right thumb'", '--channel "right thumb"', "--channel right\\ thumb --rate '1kHz'", "-c2", "-c 2", "-c'right thumb'"):
            self.js("document.getElementById('recording-status').textContent = ''")
            self.load_options(line)
            self.until(lambda: self.text("recording-status").startswith("marks.csv: 500 ms; "))
            self.assertEqual(self.download("save-replay", "spikes.csv").read_text().splitlines()[1].split(",")[1], "right thumb", line)
        self.load_options("--channel 'right thumb")
        self.until(lambda: "' is not closed" in self.text("recording-status"))

    def test_a_small_file_of_many_samples_is_simulated(self):
        path = OUT / "bytes.npy"
        header = "{'descr': '|i1', 'fortran_order': False, 'shape': (17000000,), }"
        path.write_bytes(b"\x93NUMPY\x01\x00\x76\x00" + header.encode() + b" " * (117 - len(header)) + b"\n" + bytes(17_000_000))
        self.follow("#rows=sa1&rate=2000&skin=none")
        self.load_options("--rate 100kHz --unit N")
        self.load(path)
        waiting(self.browser, 120).until(lambda _: "simulated" in self.text("recording-status"))
        self.assertIn("bytes.npy: ", self.text("recording-status"))  # 136 MB as numbers of double precision, which did not fit a message
        self.js("document.getElementById('play-stimulus').click()")
        self.until(lambda: self.text("recording-status").startswith("press: 1 s"))

    def test_a_netlist_is_refused_with_the_command_that_reads_it(self):
        path = OUT / "own.cir"
        path.write_text("Axon-Hillock after Mead\nVdd vdd 0 3.3\n.end\n")
        self.load(path)
        command = "type: corpuscle respond press --afferent "
        self.until(lambda: f"own.cir: this is a netlist, not a recording; the page has built-in circuits and equations only; {command}own.cir" == self.text("recording-status"))
        self.follow("#rows=./own.cir")
        self.assertIn(f"{command}./own.cir", self.text("message"))


class Links(LivePage):
    def setUp(self):
        self.start("#rows=sa1&rate=2000&skin=none")

    def names(self):
        return self.js("return corpuscle.session.rows.map(({info}) => info.name)")

    def test_every_name_that_the_engine_takes_can_be_in_a_link(self):
        self.follow("#rows=SA1,RA,sa1b%2Bizhikevich&skin=none")
        self.assertEqual(self.text("message"), "")
        self.assertEqual(self.names(), ["sa1", "fa1-nerve", "sa1b+izhikevich"])

    def test_a_repeated_key_is_refused(self):
        self.follow("#rows=sa1&rows=fa1")
        self.assertIn("is damaged", self.text("message"))

    def test_an_unknown_afferent_is_refused_with_the_engines_sentence(self):
        self.follow("#rows=nothing")
        self.assertRegex(self.text("message"), r"^The link of this page is refused \(.*'nothing'.*\), so the page starts with its defaults\.$")


class Server(LivePage):
    def setUp(self):
        self.server = subprocess.Popen([CORPUSCLE, "stream", "--in", "page", "--serve", "0"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.server.communicate)
        self.addCleanup(self.server.terminate)
        self.browser.get(re.search(r"http://\S+", self.server.stderr.readline())[0] + "#rows=sa1&rate=2000&skin=fingertip")
        waiting(self.browser, 60).until(lambda _: self.js("return !!window.corpuscle && corpuscle.session.time > 0"))

    def test_a_paused_page_says_that_the_server_has_ended(self):
        self.pause()
        self.server.terminate()
        self.until(lambda: self.text("message"))
        self.assertRegex(self.text("message"), r"^The server has closed the connection.*Reload the page to connect again\.$")

    def test_the_place_of_the_contact_is_in_millimetres(self):
        self.until(lambda: re.fullmatch(r"0\sN at −?\d+\.\d\d\smm, −?\d+\.\d\d\smm", self.text("skin-readout")))

    def test_a_file_above_the_limit_is_refused_with_the_command_that_reads_it(self):
        path = OUT / "too large.csv"
        path.write_bytes(b"time_s,force_N\n" + b"0.000,0.000000000000000000000000000000000000000000000000\n" * 400_000)
        self.js("document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#recording-file"))
        self.assertIn("at most 16 MB", self.text("recording"))
        self.browser.find_element(By.ID, "recording-file").send_keys(str(path))
        self.until(lambda: self.text("recording-status") == "too large.csv has 22 MB; the engine of this page accepts 16 MB. The command line has no such limit; type: corpuscle respond 'too large.csv'")


class Stream(Pages):
    def test_the_parts_of_the_description_are_apart(self):
        server = subprocess.Popen([CORPUSCLE, "stream", "--in", "press", "--serve", "0", "--population", "grid 1x1"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        self.addCleanup(server.communicate)
        self.addCleanup(server.terminate)
        self.browser.get(re.search(r"http://\S+", server.stderr.readline())[0])
        self.until(lambda: "frames per second" in self.js("return document.getElementById('description').textContent"))
        self.assertRegex(self.js("return document.getElementById('description').textContent"), r"\S, \d+ afferents, \d+ frames per second$")


if __name__ == "__main__":
    run_live_tests()
