#!/usr/bin/python3
"""Tests of the features that all panels and pages share, on pages of `corpuscle respond` (see browser.py)."""
import urllib.parse
import zlib

from browser import *

SIZES = ((360, 740, 2), (390, 844, 2), (1400, 900, 1), (2560, 1440, 1))
THEMES = ("light", "dark")


class Features(Page):
    @classmethod
    def report(cls):
        return respond("features.html", "--afferent", "sa1", "--afferent", "fa1")

    def setUp(self):
        super().setUp()
        self.downloads = tempfile.TemporaryDirectory()
        self.addCleanup(self.downloads.cleanup)
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": self.downloads.name})

    def save(self, panel, kind):
        """The bytes of the file that the menu of a panel saves."""
        self.plot(panel)
        menu = self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .menu')
        menu.find_element(By.TAG_NAME, "summary").click()
        menu.find_element(By.XPATH, f".//button[text()='{kind}']").click()
        return self.downloaded(f"{panel.replace(' ', '-')}.{kind.lower()}")

    def downloaded(self, name):
        path = pathlib.Path(self.downloads.name) / name
        waiting(self.browser, 20).until(lambda _: path.exists() and path.stat().st_size)
        return path.read_bytes()

    def toggle(self, panel, series):
        self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] button[data-series="{series}"]').click()
        self.next_frame()

    # Legends

    def test_a_click_in_the_legend_hides_a_series_and_a_second_one_shows_it(self):
        drawn = lambda: self.js("return corpuscle.panels.frequency.drawn")
        marks = {name: len(spike_times(self.data, name)) - 1 for name in ("sa1", "fa1")}
        self.assertEqual(drawn(), sum(marks.values()))
        item = self.browser.find_element(By.CSS_SELECTOR, '[data-panel="frequency"] button[data-series="sa1"]')
        self.assertEqual(item.get_attribute("aria-pressed"), "true")
        self.toggle("frequency", "sa1")
        self.assertEqual((drawn(), item.get_attribute("aria-pressed")), (marks["fa1"], "false"))
        rows = csv.DictReader(self.save("frequency", "CSV").decode().splitlines())
        self.assertEqual({row["afferent"] for row in rows}, {"fa1"}, "the file has what is shown")
        self.toggle("frequency", "sa1")
        self.assertEqual((drawn(), item.get_attribute("aria-pressed")), (sum(marks.values()), "true"))
        self.toggle("raster", "fa1")
        self.assertEqual([text for text, *_ in self.texts("raster", "end")], ["sa1"])

    # Zoom

    def wheel(self, panel, t, delta, ctrl):
        plot, x = self.at_time(panel, t)
        box = self.js("const {left, top, width} = arguments[0].getBoundingClientRect(); return [left + width / 2, top + 20]", plot)
        self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseWheel", "x": box[0] + x, "y": box[1], "deltaX": 0, "deltaY": delta, "modifiers": 2 if ctrl else 0})

    def test_ctrl_and_the_wheel_zoom_about_the_pointer(self):
        before = self.js("return corpuscle.window()")
        self.wheel("force", 0.3, -240, ctrl=True)
        self.settle(lambda a, b: b - a < 0.9)
        a, b = self.js("return corpuscle.window()")
        self.assertAlmostEqual((0.3 - a) / (b - a), (0.3 - before[0]) / (before[1] - before[0]), delta=0.01, msg="the time under the pointer stays")

    def test_the_wheel_alone_scrolls_the_page_unless_a_panel_has_the_focus(self):
        self.wheel("force", 0.3, 240, ctrl=False)
        waiting(self.browser, 20).until(lambda _: self.js("return scrollY") > 0)
        self.assertEqual(self.js("return corpuscle.window()"), [0, 1])
        self.js("corpuscle.panels.force.plot.focus({preventScroll: true})")
        self.wheel("force", 0.3, -240, ctrl=False)
        self.settle(lambda a, b: b - a < 0.9)

    def touch(self, kind, *points):
        self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]})

    def test_two_fingers_zoom_and_keep_their_times(self):
        with self.screen(390, 844, 2):
            self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
            try:
                self.plot("force")
                box, area = self.js("const {plot, area} = corpuscle.panels.force, {left, top} = plot.getBoundingClientRect(); return [[left, top], area]")
                x = lambda fraction: box[0] + area["x"] + fraction * area["w"]
                y = box[1] + 40
                self.touch("touchStart", (x(0.4), y), (x(0.6), y))
                for step in range(1, 5):
                    self.touch("touchMove", (x(0.4 - 0.05 * step), y), (x(0.6 + 0.05 * step), y))
                self.touch("touchEnd")
                self.settle(lambda a, b: b - a < 0.5)
                a, b = self.js("return corpuscle.window()")
                self.assertAlmostEqual(a + 0.2 * (b - a), 0.4, delta=0.02)
                self.assertAlmostEqual(a + 0.8 * (b - a), 0.6, delta=0.02)
            finally:
                self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})

    # Values

    def test_a_spike_shows_its_time_and_the_interval_before_it(self):
        times = spike_times(self.data, "sa1")
        plot, x = self.at_time("raster", times[3])
        row = self.js("const {area} = corpuscle.panels.raster; return area.y + area.h / 4")
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, x, round(row - plot.size["height"] / 2)).perform()
        tip = waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.CSS_SELECTOR, '[data-panel="raster"] .tip').text)
        self.assertIn(f"sa1: spike 4 of {len(times)} at {times[3]:.6f}", tip)
        interval = re.search(r", (\S+\s\S+) after the one before", tip)[1]
        self.assertAlmostEqual(si(interval), times[3] - times[2], delta=1e-3 * (times[3] - times[2]))

    def raster_tip(self):
        return waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.CSS_SELECTOR, '[data-panel="raster"] .tip').text)

    def test_a_tapped_spike_shows_its_time(self):
        times = spike_times(self.data, "sa1")
        with self.screen(390, 844, 2):
            self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
            try:
                self.plot("raster")
                x, y = self.js("const {plot, area} = corpuscle.panels.raster, {left, top} = plot.getBoundingClientRect(); return [left + corpuscle.panels.raster.x(arguments[0]), top + area.y + area.h / 4]", times[3])
                self.touch("touchStart", (x, y))
                self.touch("touchEnd")
                self.assertIn(f"at {times[3]:.6f}", self.raster_tip())
                self.next_frame()
                self.assertIn(f"at {times[3]:.6f}", self.raster_tip(), "it stays when the finger has left")
            finally:
                self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})

    def test_n_and_p_go_to_the_next_and_the_previous_spike_of_a_row(self):
        times = spike_times(self.data, "fa1")
        self.js("arguments[0].focus()", self.plot("raster"))
        keys = lambda *names: ActionChains(self.browser).send_keys(*names).perform()
        keys(Keys.ARROW_DOWN, "n", "n")  # the second row
        self.assertIn(f"fa1: spike 2 of {len(times)} at {times[1]:.6f}", self.raster_tip())
        self.assertEqual(self.js("return corpuscle.panels.raster.view.cursor"), times[1])
        keys("p")
        self.assertIn(f"at {times[0]:.6f}", self.raster_tip())
        keys("p")  # there is none before
        self.assertEqual(self.js("return corpuscle.panels.raster.view.cursor"), times[0])
        self.js("corpuscle.setWindow(0, 0.1)")
        keys("n")
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.window()")[1] > times[1])

    def test_a_mark_of_the_frequency_shows_its_value(self):
        times = spike_times(self.data, "fa1")
        plot, x = self.at_time("frequency", times[0])
        y = self.js("return corpuscle.panels.frequency.y(arguments[0])", 1 / (times[1] - times[0]))
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, x, round(y - plot.size["height"] / 2)).perform()
        tip = waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.CSS_SELECTOR, '[data-panel="frequency"] .tip').text)
        self.assertAlmostEqual(si(re.match(r"fa1: (\S+\s\S+) at", tip)[1]) * (times[1] - times[0]), 1, delta=1e-3)

    def test_shift_and_the_arrows_move_the_cursor(self):
        body = self.browser.find_element(By.TAG_NAME, "body")
        body.send_keys(Keys.SHIFT, Keys.ARROW_RIGHT)
        waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "now").text)
        body.send_keys(Keys.ESCAPE)
        waiting(self.browser, 20).until(lambda _: not self.browser.find_element(By.ID, "now").text)

    # Tables

    def test_a_click_on_a_heading_sorts_a_table(self):
        column = lambda k: [row.find_elements(By.CSS_SELECTOR, "th, td")[k].text for row in self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")]
        head = self.browser.find_elements(By.CSS_SELECTOR, "#rates thead th")[3]
        self.assertEqual(head.text, "spikes")
        original = sorted(int(text) for text in column(3))
        head.find_element(By.TAG_NAME, "button").click()
        self.assertEqual(([int(text) for text in column(3)], head.get_attribute("aria-sort")), (original, "ascending"))
        head.find_element(By.TAG_NAME, "button").click()
        self.assertEqual(([int(text) for text in column(3)], head.get_attribute("aria-sort")), (original[::-1], "descending"))
        self.browser.find_element(By.CSS_SELECTOR, "#rates .save").click()
        rows = list(csv.DictReader(self.downloaded("rates.csv").decode().splitlines()))
        self.assertEqual([int(row["spikes"]) for row in rows], original[::-1])

    # Files

    def test_the_csv_of_a_panel_has_the_samples_of_the_visible_times(self):
        self.js("corpuscle.setWindow(0.3, 0.32)")
        rows = list(csv.DictReader(self.save("force", "CSV").decode().splitlines()))
        low, _, bucket = trace(self.data, "force")
        T = self.input["T"]
        self.assertEqual(bucket, 1)
        self.assertAlmostEqual(len(rows), 0.02 / T, delta=2)
        for row in rows:
            self.assertEqual(float(row["force (N)"]), low[round(float(row["time (s)"]) / T)])
        self.assertAlmostEqual(float(rows[0]["time (s)"]), 0.3, delta=T)
        self.js("corpuscle.setWindow(0, 1)")
        rows = list(csv.DictReader(self.save("raster", "CSV").decode().splitlines()))
        self.assertEqual([float(row["time_s"]) for row in rows if row["afferent"] == "sa1"], list(spike_times(self.data, "sa1")))

    def test_the_svg_of_a_panel_is_the_drawing(self):
        root = ElementTree.fromstring(self.save("frequency", "SVG"))
        name = "{http://www.w3.org/2000/svg}"
        paths = [one for one in root.iter(name + "path") if one.get("fill") not in (None, "none")]
        self.assertEqual(len(paths), sum(len(spike_times(self.data, one)) - 1 for one in ("sa1", "fa1")))
        width = self.js("return corpuscle.panels.frequency.plot.clientWidth")
        self.assertEqual(float(root.get("width")), width)
        self.assertIn("0.6 s", [one.text for one in root.iter(name + "text")])

    def test_the_png_of_a_panel_has_the_pixels_of_the_screen(self):
        with self.screen(1400, 900, 2):
            data = self.save("raster", "PNG")
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            width, height = (int.from_bytes(data[k:k + 4], "big") for k in (16, 20))
            self.assertEqual([width, height], self.js("const {width, height} = document.querySelector('[data-panel=raster] canvas'); return [width, height]"))
            self.assertEqual(width, 2 * self.js("return corpuscle.panels.raster.plot.clientWidth"))
            self.assertGreater(len(zlib.decompress(b"".join(png_chunks(data, b"IDAT")))), width * height)

    def test_the_command_can_be_copied(self):
        self.browser.execute_cdp_cmd("Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
        button = self.browser.find_element(By.CSS_SELECTOR, ".command button")
        button.click()
        waiting(self.browser, 20).until(lambda _: button.text == "Copied")
        self.js("document.body.prepend(Object.assign(document.createElement('textarea'), {id: 'paste'}))")
        self.browser.find_element(By.ID, "paste").send_keys(Keys.CONTROL, "v")
        self.assertEqual(self.js("return document.getElementById('paste').value"), self.data["command"])

    # Link

    def restored(self, link):
        """Opens the page with a link, as another reader would."""
        self.browser.get("about:blank")
        self.browser.get(link)
        waiting(self.browser, 30).until(lambda browser: browser.execute_script("return document.readyState === 'complete' && Boolean(window.corpuscle)"))
        self.next_frame()

    def link(self, holds):
        waiting(self.browser, 20).until(lambda _: holds in self.js("return location.hash"))
        return self.js("return location.href")

    def test_a_link_restores_the_view(self):
        self.browser.find_element(By.CSS_SELECTOR, "details.fold summary").click()
        waiting(self.browser, 20).until(lambda _: "sa1 membrane" in self.panels())
        self.browser.find_element(By.ID, "autoscale").click()
        self.toggle("sa1 current", "I_A")
        self.toggle("frequency", "fa1")
        self.js("corpuscle.setWindow(0.25, 0.625)")
        link = self.link("from=0.25")
        self.restored(link)
        self.assertEqual(self.js("return corpuscle.window()"), [0.25, 0.625])
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "sa1 current", "sa1 membrane"])
        self.assertEqual(self.js("return [...corpuscle.panels['sa1 current'].hidden, ...corpuscle.panels.frequency.hidden, ...corpuscle.panels.raster.hidden]"), ["I_A", "fa1"])
        self.assertTrue(self.browser.find_element(By.ID, "autoscale").is_selected())
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#notes li"), [])
        self.assertEqual(self.js("return location.href"), link)

    def test_a_damaged_link_is_ignored_with_a_note(self):
        for damage in ("from=0.5&to=0.2", "from=x&to=1", "what=1", "=", "open=%", "hide=%25E0%25A4%25A", "from=0.5", "open=" + "a" * 5000):
            with self.subTest(damage[:40]):
                self.restored(f"{self.path.as_uri()}#{damage}")
                self.assertEqual(self.js("return corpuscle.window()"), [0, 1])
                self.assertEqual(self.panels(), ["force", "raster", "frequency"])
                self.assertIn("link of this page is damaged", self.browser.find_element(By.ID, "notes").text)

    def test_a_link_to_what_the_page_does_not_have_shows_what_there_is(self):
        self.restored(f"{self.path.as_uri()}#input=7&channel=9&open=other&hide=raster%3Aother&from=0.5&to=4")
        self.assertEqual(self.panels(), ["force", "raster", "frequency"])
        self.assertEqual(self.js("return corpuscle.window()[1]"), 1)

    def test_texts_of_a_link_are_not_html(self):
        attack = urllib.parse.quote(urllib.parse.quote("<img src=x onerror=alert(1)>"))
        self.restored(f"{self.path.as_uri()}#open={attack}&hide={attack}")
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "img"), [])

    # Print

    def test_tables_are_as_wide_as_the_paper_and_their_buttons_cover_nothing(self):
        for width in (360, 1200):
            with self.screen(width, 900, 1):
                self.open_sections()
                self.assertEqual(cropped_tables(self.browser), [], width)

    def test_each_panel_can_be_saved(self):
        self.open_sections()
        self.assertEqual(unsaved_panels(self.browser), [])

    def test_printing_draws_all_sections_in_the_light_theme(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        try:
            self.js("""addEventListener("beforeprint", () => {
                window.printed = [...document.querySelectorAll("[data-panel]")].map((one) => [one.dataset.panel, one.querySelector("canvas").clientWidth]);
                window.ground = getComputedStyle(document.body).backgroundColor;
            })""")
            self.next_frame()
            pdf = base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": True, "paperWidth": 8.27, "paperHeight": 11.69})["data"])
            (OUT / "features.pdf").write_bytes(pdf)
            self.assertEqual(pdf[:5], b"%PDF-")
            self.assertEqual([name for name, _ in self.js("return window.printed")], ["force", "raster", "frequency", "sa1 current", "sa1 membrane", "fa1 current", "fa1 membrane"])
            self.assertEqual({width for _, width in self.js("return window.printed")}, {700})
            self.assertEqual(self.js("return window.ground"), "rgb(255, 255, 255)")
            waiting(self.browser, 20).until(lambda _: self.js("return document.querySelectorAll('details.fold[open]').length") == 0)
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    # Themes and sizes

    def test_texts_and_curves_have_contrast_in_both_themes(self):
        grounds = ("paper", "band", "note", "chosen")
        for theme in THEMES:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            names = ["ink", "faint", "level", "accent", "good", "bad", *(f"series-{k}" for k in range(8)), *grounds]
            colour = self.js("""const probe = document.body.appendChild(document.createElement("i"));
                return Object.fromEntries(arguments[0].map((name) => { probe.style.color = `var(--${name})`; return [name, getComputedStyle(probe).color.match(/\\d+/g).slice(0, 3).map(Number)]; }))""", names)
            for name in names[:-len(grounds)]:
                limit = 3 if name.startswith("series") else 4.5  # WCAG AA: graphical objects, and text
                self.assertGreaterEqual(contrast(colour[name], colour["paper"]), limit, (theme, name))
            for ground in grounds:
                self.assertGreaterEqual(contrast(colour["ink"], colour[ground]), 4.5, (theme, ground))
            for button in self.browser.find_elements(By.CSS_SELECTOR, ".save"):
                self.assertEqual(button.value_of_css_property("opacity"), "1")
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_it_fits_every_screen_in_both_themes(self):
        for width, height, ratio in SIZES:
            with self.screen(width, height, ratio):
                self.open_sections()
                for theme in self.themes():
                    with self.subTest(width=width, theme=theme):
                        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width)
                        for panel in self.panels():
                            self.assertEqual(self.overlapping_labels(panel), [], panel)
                        save_picture(self.browser, f"features-{width}-{theme}.png")

    def overlapping_labels(self, panel):
        """Pairs of tick labels that overlap or leave the drawing."""
        width = self.js("const pen = document.createElement('canvas').getContext('2d'); pen.font = '11px system-ui, sans-serif'; return arguments[0].map((text) => pen.measureText(text).width)",
                        texts := [text for anchor in ("end", "middle", "start") for text, *_ in self.texts(panel, anchor)])
        sizes = dict(zip(texts, width))
        left, bottom = self.texts(panel, "end"), [one for one in self.texts(panel, "middle")]
        bad = [(one, other) for one, other in zip(left, left[1:]) if abs(one[2] - other[2]) < 9]
        bottom = [one for one in bottom if one[0].endswith(" s")]
        bad += [(one, other) for one, other in zip(bottom, bottom[1:]) if other[1] - one[1] < (sizes[one[0]] + sizes[other[0]]) / 2 + 2]
        whole = self.js("return corpuscle.panels[arguments[0]].plot.clientWidth", panel)
        return bad + [one for one in left if one[1] - sizes[one[0]] < 0] + [one for one in bottom if one[1] + sizes[one[0]] / 2 > whole + 1]


def png_chunks(data, wanted):
    at = 8
    while at < len(data):
        length, name = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        if name == wanted:
            yield data[at + 8:at + 8 + length]
        at += length + 12


def contrast(one, other):
    """The ratio of contrast of two colours, as WCAG 2 defines it."""
    def luminance(colour):
        linear = [c / 255 / 12.92 if c / 255 <= 0.04045 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


class HostileNames(Page):
    """A recording whose name and columns are HTML."""
    NAME = "<img src=x onerror=alert(1)>"

    @classmethod
    def report(cls):
        path = OUT / f"{cls.NAME}.csv"
        rows = "\n".join(f"{k * 0.002:.3f},{1.5 * (100 < k < 300)},{0.5 * (100 < k < 300)}" for k in range(500))
        path.write_text("time_s,\"<b>one</b>\"_N,\"<script>alert(2)</script>\"_N\n" + rows + "\n")
        page = OUT / "hostile.html"
        subprocess.run([CORPUSCLE, "respond", str(path), str(path), "-a", "sa1-nerve,fa1-nerve", "--report", str(page), "--quiet"], check=True, stderr=subprocess.DEVNULL)
        return page

    def test_names_are_text(self):
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "img, main script"), [])
        self.assertEqual({one.text for one in self.browser.find_elements(By.TAG_NAME, "b")}, {"sa1-nerve", "fa1-nerve"})
        self.assertIn(self.NAME, self.browser.find_element(By.ID, "title").text)
        self.assertIn("<b>one</b>", self.browser.find_element(By.CSS_SELECTOR, "#channel").text)
        self.assertNotIn("<img", self.js("return corpuscle.panels['trial raster'].svg()"), "names are escaped in files, too")


class ManyChannels(Page):
    """Forty channels, of which one is pressed."""

    @classmethod
    def report(cls):
        path = OUT / "forty.csv"
        rows = "\n".join(",".join([f"{k * 0.002:.3f}", *(f"{(1.5 if c == 17 else 0.01 * c) * (100 < k < 300):.3f}" for c in range(40))]) for k in range(500))
        path.write_text(",".join(["time_s", *(f"taxel{c:02}_N" for c in range(40))]) + "\n" + rows + "\n")
        page = OUT / "forty.html"
        subprocess.run([CORPUSCLE, "respond", str(path), "-a", "sa1-nerve,fa1-nerve", "--report", str(page), "--quiet"], check=True, stderr=subprocess.DEVNULL)
        return page

    def shown(self):
        return Select(self.browser.find_element(By.ID, "channel")).first_selected_option.text

    def test_the_first_screen_has_force_heat_map_raster_and_frequency(self):
        self.assertEqual(self.panels(), ["force", "all forces", "raster", "frequency"])
        with self.screen(1400, 900, 1):
            for panel in self.panels():
                self.assertLess(self.js("return document.querySelector(arguments[0]).getBoundingClientRect().bottom", f'[data-panel="{panel}"]'), 900, panel)
            save_picture(self.browser, "forty.png")

    def test_the_heat_map_shows_the_pressed_channel_and_its_values(self):
        def pixel(channel, t):
            return self.js("""const {area} = corpuscle.panels["all forces"], canvas = document.querySelector('[data-panel="all forces"] .plot canvas'), ratio = canvas.width / canvas.clientWidth;
                return [...canvas.getContext("2d").getImageData(ratio * corpuscle.panels["all forces"].x(arguments[1]), ratio * (area.y + (arguments[0] + 0.5) / 40 * area.h), 1, 1).data]""", channel, t)
        self.next_frame()
        self.assertGreater(contrast(pixel(17, 0.4)[:3], pixel(17, 0.9)[:3]), 3)
        self.assertLess(contrast(pixel(5, 0.4)[:3], pixel(5, 0.9)[:3]), 1.3)
        rows = list(csv.DictReader(self.js("return corpuscle.panels['all forces'].csv()").splitlines()))
        at = min(rows, key=lambda row: abs(float(row["time (s)"]) - 0.4))
        self.assertAlmostEqual(float(at["taxel17 (N)"]), 1.5, places=5)
        self.assertAlmostEqual(float(at["taxel05 (N)"]), 0.05, places=5)

    def test_a_click_in_the_heat_map_selects_a_channel(self):
        self.assertEqual(self.shown(), "taxel17")
        plot, area = self.plot("all forces"), self.js("return corpuscle.panels['all forces'].area")
        ActionChains(self.browser).move_to_element_with_offset(plot, 0, round(area["y"] + area["h"] * 30.5 / 40 - plot.size["height"] / 2)).click().perform()
        waiting(self.browser, 20).until(lambda _: self.shown() == "taxel30")
        self.assertIn("channel=31", waiting(self.browser, 20).until(lambda _: self.js("return location.hash")))

    def test_a_long_pan_does_not_change_the_link_too_often(self):
        self.js("for (let k = 0; k < 400; ++k) setTimeout(() => corpuscle.setWindow(k / 1000, k / 1000 + 0.1), 2 * k)")
        waiting(self.browser, 30).until(lambda _: "from=0.399" in self.js("return location.hash"))  # a warning in the console would fail

    def test_back_in_the_history_shows_the_view_of_that_link(self):
        self.js("location.hash = '#channel=4&from=0.25&to=0.5'")
        waiting(self.browser, 20).until(lambda _: self.shown() == "taxel03")
        self.assertEqual(self.js("return corpuscle.window()"), [0.25, 0.5])


class InAFrame(Page):
    """The page in a sandboxed frame without an origin, as in a notebook."""

    @classmethod
    def report(cls):
        page = respond("framed.html", "--afferent", "sa1", "--afferent", "fa1").read_text()
        path = OUT / "notebook.html"
        path.write_text(f"<!DOCTYPE html><body><iframe sandbox='allow-scripts allow-downloads' style='width: 700px; height: 640px' srcdoc='{page.replace('&', '&amp;').replace(chr(39), '&#39;')}'></iframe>")
        cls.data_page = OUT / "framed.html"
        return path

    @classmethod
    def setUpClass(cls):
        try:
            super().setUpClass()
        except TypeError:  # the outer page has no data of its own
            cls.data = data_of(cls.data_page)

    def setUp(self):
        super().setUp()
        self.browser.switch_to.frame(0)
        waiting(self.browser, 20).until(lambda _: self.js("return Boolean(window.corpuscle) && Object.values(corpuscle.panels).every(({area}) => area.w > 0)"))

    def tearDown(self):
        super().tearDown()
        self.browser.switch_to.default_content()

    def test_it_draws_zooms_and_hides_without_a_link(self):
        self.assertFalse(self.browser.find_element(By.ID, "command").is_displayed())
        self.assertGreater(min(self.dark_pixels().values()), 80)
        self.js("corpuscle.setWindow(0.25, 0.5)")
        self.browser.find_element(By.CSS_SELECTOR, '[data-panel="frequency"] button[data-series="sa1"]').click()
        self.browser.find_element(By.CSS_SELECTOR, "details.fold summary").click()
        waiting(self.browser, 20).until(lambda _: "sa1 membrane" in self.panels())
        self.assertEqual(self.js("return corpuscle.window()"), [0.25, 0.5])
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth - document.documentElement.clientWidth"), 1)


if __name__ == "__main__":
    run_tests()
