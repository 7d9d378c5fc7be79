#!/usr/bin/python3
"""Tests of the live page:   live_page_test.py CORPUSCLE OUTDIR PAGE

The engine in the page must respond as the program CORPUSCLE does: for equations the same spikes within 1 ns, for chips within CHIP_TOLERANCE.
Exits with 77 if there is no PAGE, which `make page` builds.
"""
from live_page import *


class Press(LivePage):
    def test_a_press_by_pointer_gives_the_spikes_of_the_program(self):
        self.press(1.5)
        self.pause()
        spikes, force = trains(self.download("save", "spikes.csv")), OUT / "force.csv"
        shutil.copy(self.download("save-force", "force.csv"), force)
        afferents = self.ROWS.split(",")
        subprocess.run([CORPUSCLE, "respond", force, "--rate", "2kHz", "--afferent", self.ROWS, "--out", OUT / "replayed", "--quiet", "--overwrite"], check=True, cwd=ROOT)
        expected = trains(OUT / "replayed" / "spikes.csv")
        for name in afferents:
            self.assertGreater(len(expected.get(name, [])), 3, name)
            self.check_spikes(spikes.get(name, []), [t for t in expected[name]], name)

    def test_the_skin_fires_where_it_is_pressed(self):
        self.press(0.5)
        counts = self.js("""const {skin} = corpuscle.session, press = corpuscle.press, near = [0, 0], far = [0, 0];
            skin.trains.forEach(({count}, k) => {
                const side = Math.hypot(skin.unitX[k] - press.x, skin.unitY[k] - press.y) < 4e-3 ? near : far;
                side[0] += count, side[1] += 1;
            });
            return [near[0] / near[1], far[0] / far[1]]""")
        self.assertGreater(counts[0], 1)
        self.assertGreater(counts[0], 2 * counts[1])

    def test_the_keyboard_alone_presses_and_moves(self):
        stage = self.browser.find_element(By.ID, "skin-view")
        for _ in range(40):
            if self.js("return document.activeElement === arguments[0]", stage):
                break
            ActionChains(self.browser).send_keys(Keys.TAB).perform()
        self.assertTrue(self.js("return document.activeElement === arguments[0]", stage), "the tab key reaches the skin")
        before = self.js("return corpuscle.press.x")
        ActionChains(self.browser).send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ENTER).perform()
        self.wait(1.2)
        ActionChains(self.browser).send_keys(Keys.ENTER).perform()
        self.wait(0.2)
        self.assertGreater(self.js("return corpuscle.press.x"), before)
        self.assertGreater(self.counts()[0], 3)
        self.assertLess(self.js("return corpuscle.press.force"), 0.01)


class Settings(LivePage):
    ROWS = "sa1,sa1-nerve"  # without a chip, which takes most of the time

    def open_row(self, k):
        self.js("const details = document.querySelectorAll('.row-card details')[arguments[0]]; details.open = true", k)
        self.until(lambda: self.all(f".row-card[data-row] .parameter"))

    def set_number(self, parameter, value):
        field = self.browser.find_element(By.CSS_SELECTOR, f'.parameter[data-parameter="{parameter}"] input:not([type=range])')
        self.js("arguments[0].scrollIntoView({block: 'center'}); arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('change'))", field, value)

    def test_a_changed_parameter_changes_the_spikes_and_is_in_the_link(self):
        self.press(0.8)
        before = self.counts()[0]
        self.open_row(0)
        self.set_number("k_A", "4e-06")
        self.until(lambda: "k_A%3D4e-6A" in urllib.parse.unquote(self.js("return location.hash")).replace("=", "%3D"))
        self.press(0.8)
        self.assertGreater(self.counts()[0] - before, 1.3 * before)
        link = self.js("return location.hash")
        self.start(link)
        self.open_row(0)
        self.assertEqual(self.js("""return document.querySelector('.parameter[data-parameter="k_A"] input[type=number]').value"""), "0.000004")

    def test_a_value_out_of_its_range_is_refused_with_the_engines_sentence(self):
        self.open_row(0)
        self.set_number("f_B", "-5")
        self.until(lambda: "f_B" in self.text("message"))
        self.wait(0.4)  # a change is in the link after 0.2 s
        self.assertNotIn("f_B", self.js("return location.hash"))

    def test_a_chip_has_another_temperature(self):
        self.follow("#rows=sa1-circuit&rate=2000&skin=fingertip")
        self.js("document.querySelector('.row-card details').open = true")
        self.until(lambda: self.all('.parameter[data-parameter="temp"]'))
        warm = self.settled_interval()
        self.set_number("temp", "0")
        self.until(lambda: "temp%3D0" in self.js("return location.hash"))
        self.assertGreater(self.settled_interval(), 1.05 * warm)  # 144 and 133 ms

    def settled_interval(self):
        """The time (s) between two spikes of the first row near the end of a press that is so long that the adaptation has ended."""
        self.press(1.5)
        times = self.js("return corpuscle.session.rows[0].train.times.slice(-3)")
        return times[1] - times[0]  # the last interval may reach into the release

    def test_the_page_follows_a_link_in_the_address_bar(self):
        self.follow("#rows=sa1~k_A=4u&force=2.5&skin=none")
        self.assertEqual(self.js("return corpuscle.session.rows.map(({info}) => info.name)"), ["sa1"])
        self.assertEqual(self.js("return corpuscle.press.target"), 2.5)
        self.follow("#rows=none")
        self.assertEqual(self.js("return corpuscle.session.rows.length"), 0)

    def test_a_refused_link_stays_in_the_address_bar_and_its_damaged_part_is_named(self):
        self.follow("#rows=sa1&force=21&skin=none")
        self.assertIn("damaged: its part force cannot be read", self.text("message"))
        self.wait(0.4)  # a change is in the link after 0.2 s
        self.assertIn("force=21", self.js("return location.hash"))

    def test_a_copied_link_has_the_value_that_is_still_being_typed(self):
        self.js("navigator.clipboard.writeText = (text) => { corpuscle.copied = text; return Promise.resolve(); }")
        self.open_row(0)
        field = self.browser.find_element(By.CSS_SELECTOR, '.parameter[data-parameter="f_B"] input[type=number]')
        self.js("arguments[0].scrollIntoView({block: 'center'}); arguments[0].select()", field)
        field.send_keys("33")
        self.browser.find_element(By.ID, "copy-link").click()
        self.until(lambda: self.js("return corpuscle.copied"))
        self.assertIn("f_B=33Hz", urllib.parse.unquote(self.js("return corpuscle.copied")))

    def test_a_comma_is_a_decimal_point(self):
        self.open_row(0)
        field = self.browser.find_element(By.CSS_SELECTOR, '.parameter[data-parameter="f_B"] input[type=number]')
        self.js("arguments[0].scrollIntoView({block: 'center'}); arguments[0].select()", field)
        field.send_keys("1,5", Keys.ENTER)
        self.until(lambda: "f_B=1.5Hz" in urllib.parse.unquote(self.js("return location.hash")))

    def test_a_link_with_all_sizes_of_a_chip_is_followed(self):
        self.follow("#rows=sa1-circuit&skin=none")
        self.js("document.querySelector('.row-card details').open = true")
        self.until(lambda: self.all('.parameter[data-parameter="mismatch"]'))
        self.assertEqual(self.js("return document.querySelector('.parameter[data-parameter=mismatch] input').value"), "", "without a seed the chip is nominal")
        names = [one["name"] for one in self.js("return corpuscle.session.engine.request({request: 'settable', afferent: 'sa1-circuit'}).then(({head}) => head.settable)") if one["name"].endswith((".w", ".l"))]
        link = "#skin=none&rows=" + urllib.parse.quote("sa1-circuit~" + "~".join(f"{name}=1.01u" for name in names))
        self.assertGreater(len(link), 6000)
        self.follow(link)
        self.assertEqual(self.text("message"), "")
        self.assertEqual(self.js("return corpuscle.session.settings.rows[0].set.size"), len(names))

    def test_a_damaged_or_oversized_link_is_refused(self):
        for link in ("#rows=sa1~f_B", "#skin=..%2Fetc", "#rate=0", "#force=1e9", "#force=50", "#force=0", "#%", "#x=1", "#rows=" + "sa1," * 2000, "#seed=" + "0" * 100_000, "#constructor=1", "#rows=sa1~f_B%3D" + "9" * 200, "#rows=" + urllib.parse.quote(PAYLOAD)):
            self.follow(link)
            self.assertIn("damaged", self.text("message"), link)
            self.assertEqual(self.js("return corpuscle.session.rows.length"), 4, link)
        self.start("#rows=sa1~f_B")
        self.assertIn("damaged", self.text("message"))

    def test_a_link_that_the_engine_refuses_opens_the_defaults(self):
        self.start("#rows=sa1~f_B=abc")
        self.assertIn("is refused", self.text("message"))
        self.assertIn("f_B", self.text("message"))
        self.wait(0.1)
        self.assertEqual(self.js("return corpuscle.session.rows.length"), 4)

    def test_a_refused_change_leaves_everything_as_it_was(self):
        self.js("document.querySelector('.skin-controls details').open = true")
        self.set_number("radius", "2")
        self.until(lambda: "radius" in self.text("message"))
        value = "return document.querySelector('.skin-controls [data-parameter=radius] input[type=number]').value"
        self.assertEqual(self.js(value), "0.005")
        self.wait(0.4)
        self.assertNotIn("radius", self.js("return location.hash"))
        self.set_number("radius", "0.004")
        self.until(lambda: "radius" in self.js("return location.hash"))
        self.assertEqual(self.js(value), "0.004")
        self.assertEqual(self.text("message"), "")
        # A restart that the engine refuses: the rows stay.
        self.js("corpuscle.session.settings.seed = -1; document.querySelector('[data-row=sa1] .remove').click()")
        self.until(lambda: "seed" in self.text("message"))
        self.assertEqual(self.js("return corpuscle.session.settings.rows.length"), 2)
        self.wait(0.1)

    def test_an_afferent_can_be_added_and_removed(self):
        self.js("const select = document.getElementById('add-row'); select.selectedIndex = [...select.options].findIndex(({text}) => text.startsWith('fa1-circuit')); select.dispatchEvent(new Event('change'))")
        self.until(lambda: len(self.counts()) == 3)
        ActionChains(self.browser).double_click(self.browser.find_element(By.CSS_SELECTOR, '[data-row="sa1"] .remove')).perform()
        self.until(lambda: len(self.counts()) == 2)
        self.wait(0.1)
        self.assertEqual(len(self.counts()), 2, "a double click removes one row")
        self.assertIn("fa1-circuit", self.js("return corpuscle.session.rows.map(({info}) => info.name)"))


class Controls(LivePage):
    ROWS = "sa1"

    def test_the_spikes_of_rows_make_sound(self):
        self.js("""corpuscle.clicks = 0;
            const start = AudioBufferSourceNode.prototype.start;
            AudioBufferSourceNode.prototype.start = function (...when) { ++corpuscle.clicks; return start.apply(this, when); };""")
        self.browser.find_element(By.ID, "sound").click()
        self.until(lambda: self.text("sound") == "Sound on")
        self.press(1.5)
        self.assertGreater(self.counts()[0], 3)
        self.assertEqual(self.js("return corpuscle.clicks"), self.counts()[0])

    def test_a_paused_page_draws_only_what_changes(self):
        self.press(0.3)
        self.pause()
        self.settle()
        self.js("""const {charts, skinView: {scene}} = corpuscle, draw = scene.draw;
            corpuscle.drawn = 0;
            charts.view.onDraw(() => ++corpuscle.drawn);
            scene.draw = () => { ++corpuscle.drawn; draw.call(scene); };""")
        for _ in range(20):
            self.settle()
        self.assertEqual(self.js("return corpuscle.drawn"), 0)
        ActionChains(self.browser).move_to_element_with_offset(self.browser.find_element(By.CSS_SELECTOR, "#skin-view canvas"), -20, 10).click().perform()
        self.until(lambda: self.js("return corpuscle.drawn") > 0)

    def test_a_paused_page_is_sharp_on_a_screen_of_another_density_of_pixels(self):
        self.pause()
        for ratio in (1, 3):
            self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 1400, "height": 900, "deviceScaleFactor": ratio, "mobile": False})
            self.set_theme(False)  # an emulated screen tells the page of its density only with its media
            self.until(lambda: self.js("return [...document.querySelectorAll('canvas')].map((one) => one.width / one.clientWidth)") == [ratio] * 4)

    def test_a_restart_ends_a_pause(self):
        self.browser.find_element(By.ID, "pause").click()
        self.until(lambda: self.text("pause") == "Go on")
        self.browser.find_element(By.ID, "restart").click()
        self.until(lambda: self.text("pause") == "Pause")
        self.wait(0.1)

    def test_a_finger_on_the_skin_does_not_scroll_the_page(self):
        self.assertEqual(self.js("return getComputedStyle(document.querySelector('#skin-view canvas')).touchAction"), "none")

    def test_the_menu_of_the_skin_opens_by_key(self):
        self.js("document.querySelector('#skin-view .menu summary').focus()")
        ActionChains(self.browser).send_keys(Keys.ENTER).perform()
        self.assertTrue(self.js("return document.querySelector('#skin-view .menu').open"))
        self.assertFalse(self.js("return corpuscle.press.isDown"))

    def test_more_than_the_last_seconds_can_be_seen(self):
        self.until(lambda: self.time() > 6)
        self.js("corpuscle.charts.view.reset()")
        self.wait(0.2)
        self.assertGreater(self.js("const {view} = corpuscle.charts; return view.b - view.a"), 5.9)


    def test_a_stroke_ends_where_it_began(self):
        before = self.js("return [corpuscle.press.x, corpuscle.press.y]")
        self.browser.find_element(By.ID, "stroke").click()
        self.until(lambda: abs(self.js("return corpuscle.press.x") - before[0]) > 3e-3)
        self.until(lambda: self.js("return corpuscle.press.force") == 0 and self.js("return corpuscle.press.x") == before[0])
        self.assertEqual(self.js("return [corpuscle.press.x, corpuscle.press.y]"), before)

    def test_a_mouse_presses_after_the_keyboard(self):
        self.js("document.getElementById('skin-view').focus()")
        ActionChains(self.browser).send_keys(Keys.ARROW_RIGHT).perform()
        canvas = self.browser.find_element(By.CSS_SELECTOR, "#skin-view canvas")
        ActionChains(self.browser).move_to_element(canvas).click_and_hold().perform()
        self.wait(0.2)
        self.assertTrue(self.js("return corpuscle.press.isDown"))
        ActionChains(self.browser).release().perform()
        ActionChains(self.browser).context_click(canvas).perform()
        self.assertFalse(self.js("return corpuscle.press.isDown"))

    def test_a_frequency_out_of_range_is_limited(self):
        field = self.browser.find_element(By.ID, "vibration")
        for typed, used in (("999", "500"), ("", "1")):
            field.clear()
            field.send_keys(typed)
            self.browser.find_element(By.ID, "vibrate").click()
            self.assertEqual(field.get_attribute("value"), used)

    def test_a_tilt_turns_friction_off_and_takes_its_azimuth_with_it(self):
        def change(name, text):
            self.js("const field = document.querySelector(`[data-parameter=${arguments[0]}] input[type=number]`); field.value = arguments[1]; field.dispatchEvent(new Event('change'))", name, text)
            self.until(lambda: abs(self.js("return corpuscle.session.contactValues.get(arguments[0])", name) - float(text)) < 1e-6)

        self.js("document.querySelector('.skin-controls details').open = true; document.getElementById('shear').click()")
        change("tilt", "10")
        self.until(lambda: self.js("return document.getElementById('shear').disabled"))
        self.press(1)
        self.assertEqual(self.text("message"), "")
        self.assertGreater(self.counts()[0], 1)
        change("azimuth", "30")
        self.until(lambda: "azimuth" in self.browser.current_url)
        change("tilt", "0")
        self.until(lambda: self.js("return corpuscle.session.contactValues.get('azimuth')") == 0)
        self.until(lambda: "azimuth" not in self.browser.current_url)
        self.assertTrue(self.js("return document.querySelector('.skin-controls details').open"))


class Chip(LivePage):
    ROWS = "sa1-circuit"
    SKIN = "none"

    def test_blocks_show_their_voltages(self):
        self.js("document.querySelector('.row-card details').open = true")
        self.until(lambda: self.all("#schematic .block[data-block]"))
        blocks = self.all("#schematic .block[data-block]")
        self.assertGreater(len(blocks), 5)
        self.js("document.querySelector('#schematic .block[data-block=xsummer]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
        self.until(lambda: len(self.all("svg.schematic")) == 2 and self.all(".row-card .columns .schematic .device[data-device]"))
        self.assertGreater(len(self.all(".block-state tbody tr")), 1)
        self.js("document.querySelector('#schematic .block[data-block=xbias]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
        self.until(lambda: {"bp", "bn", "vdd"} <= set(self.texts_of(".block-state tbody th")))  # the nodes at its terminals

    def test_the_schematics_are_legible_and_scroll_in_their_panels(self):
        for width in (1300, 360):
            self.start(f"#rows={self.ROWS}&skin=none", width=width, height=800)
            self.pause()
            self.js("document.querySelector('.row-card details').open = true")
            self.until(lambda: self.all("#schematic .block[data-block]"))
            self.js("document.querySelector('#schematic .block[data-block=xsummer]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
            self.until(lambda: len(self.all("svg.schematic")) == 2)
            scales = self.js("return [...document.querySelectorAll('svg.schematic')].map((svg) => svg.getScreenCTM().a * parseFloat(getComputedStyle(svg).fontSize))")
            self.assertGreaterEqual(min(scales), 8.99, f"{width}: the height of the texts, px")
            small = self.js("return [...document.querySelectorAll('#schematic .block')].map((block) => block.getBoundingClientRect()).filter(({width, height}) => width < 24 || height < 24).length")
            self.assertEqual(small, 0, f"{width}: blocks that a finger misses")
            panel = self.js("const {clientWidth, scrollWidth, clientHeight} = document.getElementById('schematic'); return [clientWidth, scrollWidth, clientHeight]")
            self.assertLessEqual(panel[2], 560)
            if width == 360:
                self.assertGreater(panel[1], panel[0], "the panel scrolls")
            self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width, f"{width}: the page does not scroll sideways")

    def test_a_monte_carlo_has_the_chips_of_the_program(self):
        self.start(f"#rows={self.ROWS}&seed=1&skin=none")
        self.pause()  # the engine has only these chips to simulate
        self.js("document.querySelector('.row-card details').open = true")
        self.until(lambda: self.all("#run-monte-carlo"))
        self.js("document.getElementById('run-monte-carlo').click()")
        waiting(self.browser, 240).until(lambda _: "50 of 50" in self.js("return document.querySelector('.monte-carlo').textContent"))
        found = self.js("return corpuscle.charts && [...document.querySelectorAll('.monte-carlo')].length")
        self.assertEqual(found, 1)
        subprocess.run([CORPUSCLE, "respond", "press", "--rate", "2kHz", "--afferent", "sa1-circuit", "--set", "sa1-circuit.mismatch=1", "--copies", "3", "--out", OUT / "chips", "--quiet", "--overwrite"], check=True, cwd=ROOT)
        expected = trains(OUT / "chips" / "spikes.csv")
        for k in range(3):
            self.check_spikes(self.js("return corpuscle.monteCarlo[arguments[0]].times", k), expected[f"sa1-circuit#{k + 1}"], f"sa1-circuit chip {k + 1}")


    def test_another_simulation_replaces_a_monte_carlo(self):
        self.js("document.querySelector('.row-card details').open = true; document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#run-monte-carlo") and self.all("#play-stimulus"))
        self.js("document.getElementById('run-monte-carlo').click()")
        self.until(lambda: "of 50" in self.js("return document.querySelector('.monte-carlo').textContent"))
        self.js("document.getElementById('play-stimulus').click()")
        waiting(self.browser, 120).until(lambda _: "spikes" in self.text("recording-status"))
        self.assertIn("stopped by another simulation", self.js("return document.querySelector('.monte-carlo').textContent"))
        document = program("respond", "press", "--rate", "2kHz", "--afferent", "sa1-circuit", "--out", OUT / "stimulus", "--overwrite")
        self.assertTrue(document)
        self.assertIn(f"sa1-circuit {len(trains(OUT / 'stimulus' / 'spikes.csv')['sa1-circuit'])}", self.text("recording-status"))


class Recordings(LivePage):
    ROWS = "sa1,sa1-nerve"
    SKIN = "none"

    def load(self, path):
        self.js("document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#recording-file"))
        self.browser.find_element(By.ID, "recording-file").send_keys(str(path))

    def test_a_recording_gives_the_spikes_of_the_program(self):
        rows = self.ROWS + ",sa1-circuit"
        self.follow(f"#rows={rows}&rate=2000&skin=none")
        self.pause()
        self.load(ROOT / "examples" / "data" / "touch.csv")
        waiting(self.browser, 120).until(lambda _: "spikes" in self.text("recording-status"))
        document = program("respond", "examples/data/touch.csv", "--afferent", rows, "--out", OUT / "touch", "--overwrite")
        expected = {name: len(times) for name, times in trains(OUT / "touch" / "spikes.csv").items()}
        self.assertTrue(document)
        for name in rows.split(","):
            self.assertIn(f"{name} {expected.get(name, 0)}", self.text("recording-status"))

    def test_a_recording_without_times_needs_its_rate(self):
        path = OUT / "untimed.csv"
        path.write_text("fz\n" + "".join(f"{100 * min(k / 100, 3)}\n" for k in range(500)))
        self.load(path)
        self.until(lambda: "--rate" in self.text("recording-status"))
        self.set_options("--rate 500Hz --scale 0.01")  # the file is read again
        waiting(self.browser, 60).until(lambda _: "spikes" in self.text("recording-status"))
        self.assertIn("1 s", self.text("recording-status"))
        self.set_options("--rate 250Hz --scale 0.01")
        self.until(lambda: "2 s" in self.text("recording-status"))

    def set_options(self, text):
        field = self.browser.find_element(By.ID, "recording-options")
        field.clear()
        field.send_keys(text, Keys.ENTER)

    def test_options_of_the_command_line_say_how_a_recording_is_read(self):
        path = OUT / "two.csv"
        path.write_text("t,fx,fz,left over\n" + "".join(f"{2 * k},0,{-100 * min(k / 100, 3):g},1\n" for k in range(500)))
        self.load(path)
        self.until(lambda: self.text("recording-status"))
        self.set_options('--abs -c fz --channel="left over" --time-unit ms --scale 0.01 --notch 50Hz --notch 100Hz')
        waiting(self.browser, 60).until(lambda _: "spikes" in self.text("recording-status"))
        self.assertRegex(self.text("recording-status"), r"^two.csv, fz: 1 s")
        self.assertIn("left over", self.text("recording"))
        for line, message in (("fz --abs", "'fz' is not an option"), ("--chanel fz", "unknown option chanel"), ("--rate", "rate"), ("--rate soon", "soon")):
            self.set_options(line)
            self.until(lambda: message in self.text("recording-status"))

    def test_names_in_a_recording_stay_text(self):
        path = OUT / ("<img src=x onerror=document.title=1>.csv".replace("/", ""))
        path.write_text("time_s,\"" + PAYLOAD.replace('"', '""') + " (N)\",second (N)\n" + "".join(f"{k / 100},{k % 7 / 10},0\n" for k in range(100)))
        self.load(path)
        self.until(lambda: self.text("recording-status"))
        self.wait(0.5)
        self.assertNotEqual(self.browser.title, "1")
        self.assertEqual(self.all("#recording img"), [])

    def test_a_file_that_is_no_recording_is_refused(self):
        path = OUT / "noise.csv"
        path.write_bytes(bytes(range(256)) * 10)
        self.load(path)
        self.until(lambda: self.text("recording-status"))
        self.assertNotIn("spikes", self.text("recording-status"))


class Served(LivePage):
    """The page of `corpuscle stream --in page`, whose engine is native."""

    def setUp(self):
        self.server = subprocess.Popen([CORPUSCLE, "stream", "--in", "page", "--serve", "0"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.server.communicate)
        self.addCleanup(self.server.terminate)
        self.browser.get(re.search(r"http://\S+", self.server.stderr.readline())[0] + "#rows=sa1,sa1-circuit&rate=2000&skin=fingertip")
        waiting(self.browser, 60).until(lambda _: self.js("return !!window.corpuscle && corpuscle.session.time > 0"))

    def test_spikes_are_saved_as_nwb(self):
        self.press(0.6)
        self.pause()
        csv_file, nwb_file = OUT / "served.csv", OUT / "served.nwb"
        shutil.copy(self.download("save", "spikes.csv"), csv_file)
        shutil.copy(self.download("save-nwb", "spikes.nwb"), nwb_file)
        self.assertGreater(len(trains(csv_file)["sa1-circuit"]), 2)
        document = program("compare", csv_file, nwb_file)
        differences = [(one["a"], one["missing"], one["extra"], one["max_shift_s"]) for one in document["pairs"]]
        self.assertEqual([one for one in differences if one[1] + one[2] > 0 or (one[3] or 0) > 1e-9], [])  # CSV has times in ns

    def test_a_request_above_the_servers_limit_is_refused(self):
        path = OUT / "large.csv"
        path.write_bytes(b"time_s,force_N\n" + b"0.000,0.000000000000000000000000000000000000000000000000\n" * 400_000)
        self.js("document.getElementById('recordings').open = true")
        self.until(lambda: self.all("#recording-file"))
        self.browser.find_element(By.ID, "recording-file").send_keys(str(path))
        self.until(lambda: "accepts 16 MB" in self.text("recording-status"))
        self.wait(0.1)


class Look(LivePage):
    def test_four_sizes_in_two_themes(self):
        for width, height in SIZES:
            self.start("", width=width, height=height)
            self.js("corpuscle.press.isDown = true")
            self.wait(0.7)
            for is_dark in (False, True):
                self.set_theme(is_dark)
                self.wait(0.1)
                overflow = self.js("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
                save_picture(self.browser, f"live-{width}{'-dark' if is_dark else ''}.png")
                self.assertLessEqual(overflow, 0, (width, is_dark))

    def test_it_requests_nothing_but_itself(self):
        text = PAGE.read_text()
        self.assertEqual(re.findall(r"<script[^>]*\bsrc\b|<link[^>]*stylesheet", text), [])


if __name__ == "__main__":
    run_live_tests()
