#!/usr/bin/python3
"""Tests of the page of a skin (see browser.py)."""
from browser import *


class OnASkin(Page):
    """A press on a fingertip: animated maps, and the plots below them."""

    @classmethod
    def report(cls):
        return respond("skin.html", "--population", "fingertip")

    def setUp(self):
        self.browser.get(self.path.as_uri())
        self.over, self.classes = self.data["over"], self.data["classes"]
        self.frames = frames(self.over["marks"])

    def active(self, frame):
        """For each class, the number of afferents that fired in a frame."""
        return {one["name"]: sum(one["first"] <= unit < one["first"] + one["afferents"] for unit in self.frames[frame]) for one in self.classes}

    def coloured_pixels(self, name):
        """The number of coloured pixels of a map."""
        return self.js("""
            const canvas = document.querySelector(`[data-map="${arguments[0]}"] canvas`);
            const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            let count = 0;
            for (let i = 0; i < pixels.length; i += 4)
                if (Math.max(...pixels.slice(i, i + 3)) - Math.min(...pixels.slice(i, i + 3)) > 90) ++count;
            return count""", name)

    def to_frame(self, frame):
        self.js("corpuscle.view.point(arguments[0])", self.over["t0"] + (frame + 0.5) * self.over["marks"]["width"])
        WebDriverWait(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") == frame)
        self.js("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def test_maps_show_the_afferents_that_fired(self):
        Select(self.browser.find_element(By.ID, "mode")).select_by_index(0)  # one frame
        busiest = max(range(len(self.frames)), key=lambda k: len(self.frames[k]))
        dark_pixels = {}
        for frame in (0, busiest):
            self.to_frame(frame)
            self.assertEqual(self.js("return corpuscle.active()"), self.active(frame))
            dark_pixels[frame] = self.coloured_pixels("sa1")
        self.assertGreater(self.active(busiest)["sa1"], 3)
        self.assertGreater(dark_pixels[busiest], dark_pixels[0] + 50)
        Select(self.browser.find_element(By.ID, "mode")).select_by_value("all")
        ever = {unit for frame in self.frames for unit in frame}
        sa1 = self.classes[0]
        WebDriverWait(self.browser, 20).until(lambda _: self.js("return corpuscle.active().sa1") == sum(unit < sa1["afferents"] for unit in ever))

    def test_the_maps_play_and_the_plots_follow(self):
        self.to_frame(2)
        self.browser.find_element(By.ID, "play").click()
        for frame in (6, 12):
            WebDriverWait(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") > frame)
        line = self.js("return parseFloat(document.querySelector('[data-panel=force] .hairline').style.left)")
        self.assertGreater(line, self.js("return corpuscle.charts.force.toDomXCoord(arguments[0])", 6 * self.over["marks"]["width"]))
        self.browser.find_element(By.TAG_NAME, "body").send_keys(" ")
        self.assertFalse(self.js("return corpuscle.playing"))
        stopped = self.js("return corpuscle.frame")
        self.assertEqual(self.browser.find_element(By.ID, "time").get_attribute("value"), str(stopped))
        self.browser.find_element(By.ID, "time").send_keys(Keys.ARROW_RIGHT)
        WebDriverWait(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") == stopped + 1)

    def test_it_starts_at_the_beginning(self):
        self.assertEqual(self.js("return corpuscle.frame"), 0)
        self.assertEqual(self.browser.find_element(By.ID, "time").get_attribute("value"), "0")

    def test_rates_are_means_of_the_active_afferents_in_hertz(self):
        active = {row["afferent"]: row["active"] for row in self.data["summary"]["rates"] if row["region"] == "all" and row["phase"] == "all"}
        self.assertEqual(self.js("return corpuscle.skin.classes.map((one) => one.active)"), [active[one["name"]] for one in self.classes])
        title = self.browser.find_element(By.CSS_SELECTOR, "[data-panel=population] .panel-title").text
        self.assertRegex(title, r"^mean rate of afferents that fire, in bins of .*Hz")

    def test_rasters_contain_every_spike(self):
        spikes = {one["name"]: sum(n for frame in self.frames for unit, n in frame.items() if one["first"] <= unit < one["first"] + one["afferents"]) for one in self.classes}
        self.assertEqual(sum(spikes.values()), self.over["spikes"]["count"])
        dark_pixels = self.dark_pixels()
        for name, count in spikes.items():
            self.assertEqual(self.readout(f"raster {name}", name), str(count))
            self.assertEqual(dark_pixels[f"raster {name}"] > 0, count > 0)
        end = self.js("return corpuscle.view.end")
        self.js("corpuscle.view.set(0, arguments[0] / 4); corpuscle.view.draw()", end)
        self.assertRegex(self.readout("raster sa1", "sa1"), rf"^\d+ of {spikes['sa1']}$")

    def test_the_afferent_under_the_pointer_is_named(self):
        first = self.data["summary"]["first_spikes"][0]
        index = first["afferent_index"]
        at = next(k for k, one in enumerate(self.classes) if one["first"] <= index < one["first"] + one["afferents"])
        x, y = self.js("return corpuscle.scene.maps[arguments[0]].place(arguments[1])", at, index)
        canvas = self.browser.find_element(By.CSS_SELECTOR, f'[data-map="{self.classes[at]["name"]}"] canvas')
        self.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        ActionChains(self.browser, duration=50).move_to_element_with_offset(canvas, round(x - canvas.size["width"] / 2), round(y - canvas.size["height"] / 2)).perform()
        WebDriverWait(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "unit").text.startswith(first["afferent"] + ","))
        self.assertIn(f"{first['time_s']:.4f}", self.browser.find_element(By.ID, "unit").text)

    def test_without_trials_it_has_no_figure_of_them(self):
        self.assertFalse(self.browser.find_element(By.ID, "trials").is_displayed())

    def test_it_fits_a_narrow_window_and_its_tables_are_complete(self):
        rows = self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")
        self.assertEqual(len(rows), len(self.classes) * (1 + len(self.data["summary"]["input"]["phases"])))
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#firsts tbody tr")), len(self.data["summary"]["first_spikes"]))
        self.browser.save_screenshot(str(OUT / "skin.png"))
        self.browser.set_window_size(700, 900)
        WebDriverWait(self.browser, 20).until(lambda _: self.js("return document.documentElement.scrollWidth <= innerWidth"))
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        try:
            WebDriverWait(self.browser, 20).until(lambda _: self.js("return document.documentElement.scrollWidth <= 390"))
        finally:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        self.browser.set_window_size(1200, 900)


class TrialsOnASkin(Page):
    """The trials of a touch on a hand, aligned to their onsets."""

    @classmethod
    def report(cls):
        path = OUT / "skin-trials.html"
        subprocess.run([CORPUSCLE, "respond", "examples/data/touch.csv", "--deadband", "20mN", "--population", "hand", "--trials", "examples/data/touch_trials.csv",
                        "--align", "onset", "--window", "-0.1..0.3", "--out", str(OUT / "skin-trials"), "--bin", "20ms", "--overwrite", "--report", str(path), "--quiet"],
                       check=True, cwd=ROOT)
        return path

    def setUp(self):
        self.browser.get(self.path.as_uri())

    def panels(self):
        return self.js("return [...document.querySelectorAll('.trial-plots svg')].map((svg) => svg.getAttribute('aria-label'))")

    def test_each_class_has_a_histogram_with_a_curve_for_each_label(self):
        classes = self.data["classes"]
        self.assertEqual(self.panels(), ["force (N)", *(f"{one['name']}: mean rate of {one['afferents']} afferents (Hz)" for one in classes)])
        for k in range(len(classes)):
            self.assertEqual(self.js("return document.querySelectorAll('.trial-plots svg')[arguments[0]].querySelectorAll('path').length", k + 1), 3)
        self.assertEqual([text.split(" (")[0] for text in self.js("return [...document.querySelectorAll('.trial-labels span')].map((one) => one.textContent).filter(Boolean)")],
                         ["tap", "press", "rub"])

    def test_a_class_has_the_spikes_of_all_its_regions(self):
        """psth.csv has a row for each region."""
        spikes = {}
        with open(OUT / "skin-trials" / "psth.csv") as table:
            for row in csv.DictReader(table):
                key = (row["label"], row["afferent"], round(float(row["from_s"]), 6))
                spikes[key] = spikes.get(key, 0) + int(row["spikes"])
        trials, counts = self.data["trials"], {"tap": 2, "press": 1, "rub": 1}
        groups = trials["groups"][:trials["classes"]]
        compared = 0
        for histogram in trials["histograms"]:
            if histogram["group"] >= len(groups):
                continue
            group = groups[histogram["group"]]
            for edge, rate in zip(histogram["edges"], histogram["rate"]):
                expected = spikes[histogram["label"], group["name"], round(edge, 6)] / counts[histogram["label"]] / group["afferents"] / 0.02
                self.assertAlmostEqual(rate, expected, delta=1e-9 * (1 + expected))
                compared += expected > 0
        self.assertGreater(compared, 50)

    def test_a_region_in_which_afferents_fired_can_be_selected(self):
        select = Select(self.browser.find_element(By.CSS_SELECTOR, "#trials select"))
        names = [one.text for one in select.options]
        regions = {one["channel"] for one in self.data["trials"]["groups"][self.data["trials"]["classes"]:]}
        self.assertEqual((names[0], set(names[1:])), ("all", regions))
        with open(OUT / "skin-trials" / "psth.csv") as table:
            self.assertEqual(regions, {row["channel"] for row in csv.DictReader(table) if row["spikes"] != "0"})
        select.select_by_visible_text("index.tip")
        expected = [f"{one['name']}: mean rate of {one['afferents']} afferents (Hz)" for one in self.data["trials"]["groups"] if one["channel"] == "index.tip"]
        self.assertEqual(self.panels(), ["force (N)", *expected])

    def test_it_fits_a_telephone_and_a_dark_theme(self):
        self.js("document.getElementById('trials').scrollIntoView()")
        self.screenshot("skin-trials.png")
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            with self.screen(390, 844, 2):
                self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
                self.assertGreater(self.js("return document.querySelector('.trial-plots svg').clientWidth"), 0.85 * 390)
                self.browser.save_screenshot(str(OUT / f"skin-trials-phone-{theme}.png"))
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


del Page  # a base class, not a test


if __name__ == "__main__":
    run_tests()
