#!/usr/bin/python3
"""Tests of the page of a skin (see browser.py)."""
from browser import *


SIZES = ((360, 740, 2), (390, 844, 2), (1400, 900, 1), (2560, 1440, 1))
HOSTILE = "<img src=x onerror=alert(1)>"


def spikes_of(record, t0):
    """The spikes of a page of a skin: {afferent: times}."""
    source, out, afferent = iter(base64.b64decode(record["data"]["u8"])), {}, 0

    for _ in range(record["trains"]):
        afferent += packed_number(source)
        count, ticks, times = packed_number(source), 0, []
        for _ in range(count):
            ticks += packed_number(source)
            times.append(t0 + ticks * record["tick"])
        out[afferent] = times
        afferent += 1
    return out


class SkinPage(Page):
    def setUp(self):
        self.open()
        self.over, self.classes = self.data["over"], self.data["classes"]

    def open(self, link=""):
        self.browser.get("about:blank")  # a change of only the link would not load the page again
        self.browser.get(self.path.as_uri() + link)
        self.next_frame()

    def class_of(self, afferent):
        return next(k for k, one in enumerate(self.classes) if one["first"] <= afferent < one["first"] + one["afferents"])

    def select(self, id, value):
        Select(self.browser.find_element(By.ID, id)).select_by_visible_text(value)
        self.next_frame()

    def to_time(self, t):
        self.js("corpuscle.view.point(arguments[0])", t)
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.maps.time") == t)
        self.next_frame()

    def to_frame(self, frame):
        self.to_time(self.over["t0"] + (frame + 0.5) * self.over["marks"]["width"])

    def active(self):
        return self.js("return corpuscle.active")

    def map(self, name):
        canvas = self.browser.find_element(By.CSS_SELECTOR, f'[data-map="{name}"] canvas')
        self.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        return canvas

    def place(self, afferent):
        """The canvas of an afferent's map, and its place in it, in pixels from the middle. Each mark of the page is one afferent."""
        k = self.class_of(afferent)
        canvas = self.map(self.classes[k]["name"])
        x, y = self.js("return corpuscle.scene.maps[arguments[0]].place(arguments[1])", k, afferent)
        return canvas, round(x - canvas.size["width"] / 2), round(y - canvas.size["height"] / 2)


class OnASkin(SkinPage):
    """A press on a fingertip: animated maps, and the plots below them."""

    @classmethod
    def report(cls):
        return respond("skin.html", "--population", "fingertip")

    def setUp(self):
        super().setUp()
        self.frames = frames(self.over["marks"])
        self.downloads = tempfile.TemporaryDirectory()
        self.addCleanup(self.downloads.cleanup)
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": self.downloads.name})

    def expected_active(self, frame):
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

    # Maps

    def test_maps_show_the_afferents_that_fired(self):
        self.select("mode", "Rate, 10\u00a0ms")  # one frame
        busiest = max(range(len(self.frames)), key=lambda k: len(self.frames[k]))
        coloured = {}
        for frame in (0, busiest):
            self.to_frame(frame)
            self.assertEqual(self.active(), self.expected_active(frame))
            coloured[frame] = self.coloured_pixels("sa1")
        self.assertGreater(self.active()["sa1"], 3)
        self.assertGreater(coloured[busiest], coloured[0] + 50)
        self.select("mode", "Mean rate")
        ever = {unit for frame in self.frames for unit in frame}
        self.assertEqual(self.active(), {one["name"]: sum(one["first"] <= unit < one["first"] + one["afferents"] for unit in ever) for one in self.classes})

    def test_recent_spikes_fade_with_their_age(self):
        spikes, t, window = spikes_of(self.over["spikes"], self.over["t0"]), 0.3, 0.05
        self.select("mode", "Spikes, 50\u00a0ms")
        self.to_time(t)
        expected = {}
        for afferent, times in spikes.items():
            ages = [t - one for one in times if t - window < one <= t]
            if ages:
                expected[afferent] = 1 - min(ages) / window
        shown = self.js("const out = []; corpuscle.maps.mode.activity(0.3)((mark, level) => out.push([mark, level])); return out")
        self.assertEqual({mark for mark, _ in shown}, set(expected))
        self.assertGreater(len(shown), 20)
        for mark, level in shown:
            self.assertAlmostEqual(level, expected[mark], delta=1e-5)
        self.assertEqual(sum(self.active().values()), len(expected))

    def test_the_window_of_recent_spikes_suits_each_class(self):
        """FA-II follows a contact with many spikes in phase: a window longer than its intervals would show all of them all the time."""
        texts = self.js("return corpuscle.skin.classes.map((_, k) => corpuscle.maps.modes[0].scale(k)[0])")
        windows = [si(text.replace(" ago", "")) for text in texts]
        intervals = [[] for _ in self.classes]
        for afferent, times in spikes_of(self.over["spikes"], 0).items():
            intervals[self.class_of(afferent)] += [b - a for a, b in zip(times[:50], times[1:50])]
        for window, own in zip(windows, intervals):
            median = sorted(own)[len(own) // 2]
            self.assertTrue(median <= window <= max(0.005, 2.6 * median), (window, median))

    def test_the_outline_is_smooth(self):
        outline = self.js("return corpuscle.skin.geometry.outline.map((one) => [...one])")
        self.assertEqual(len(outline), 1)
        points = list(zip(outline[0][0::2], outline[0][1::2]))
        turns = []
        for k in range(len(points)):
            (x0, y0), (x1, y1), (x2, y2) = points[k - 2], points[k - 1], points[k]
            turns.append(abs(math.remainder(math.atan2(y2 - y1, x2 - x1) - math.atan2(y1 - y0, x1 - x0), 2 * math.pi)))
        self.assertLess(max(turns), 0.9, "the steps of sites turn by 1.57")
        sites = numbers("f", self.data["sites"]["places"])
        area = abs(sum(points[k - 1][0] * points[k][1] - points[k][0] * points[k - 1][1] for k in range(len(points))) / 2)
        self.assertAlmostEqual(area, len(sites) / 2 * self.data["sites"]["side"] ** 2, delta=0.02 * area)

    def test_all_maps_have_one_size_and_use_the_width(self):
        sizes = self.js("return [...document.querySelectorAll('.skin-canvas canvas')].map((one) => [one.clientWidth, one.clientHeight])")
        self.assertEqual(len(sizes), 2 * len(self.classes))
        self.assertEqual(len({tuple(size) for size in sizes}), 1)
        for row in self.js("return [...document.querySelectorAll('.skin-row')].map((one) => [one.clientWidth, [...one.children].reduce((most, map) => Math.max(most, map.getBoundingClientRect().right - one.getBoundingClientRect().left), 0)])"):
            self.assertGreater(row[1], 0.97 * row[0])

    def test_the_scale_of_first_spikes_covers_all_of_them(self):
        first = [t for t in numbers("f", self.data["marks"]["first"]) if not math.isnan(t)]
        texts = [one.text for one in self.browser.find_elements(By.CSS_SELECTOR, "#firsts .bar .ramp-texts span")]
        low, high = si(texts[0]), si(texts[-1])
        resolution = 10 ** -len(texts[0].split()[0].split(".")[1])
        self.assertAlmostEqual(low, min(first), delta=resolution)
        self.assertAlmostEqual(high, max(first), delta=resolution)

    def test_the_force_has_a_scale_with_numbers(self):
        text = self.browser.find_element(By.CSS_SELECTOR, "#maps > .bar .scale-key").text.split("\n")
        self.assertEqual(text[:2], ["force on 0.25 mm²", "0"])
        self.assertAlmostEqual(si(text[-1]), self.over["sites"]["max"], delta=1e-3 * self.over["sites"]["max"])

    def test_the_afferent_under_the_pointer_is_named(self):
        first = self.data["summary"]["first_spikes"][0]
        canvas, x, y = self.place(first["afferent_index"])
        ActionChains(self.browser, duration=50).move_to_element_with_offset(canvas, x, y).perform()
        waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "unit").text.startswith(first["afferent"] + ","))
        self.assertIn(f"{first['time_s']:.4f}", self.browser.find_element(By.ID, "unit").text)
        tip = self.browser.find_element(By.CSS_SELECTOR, f'[data-map="{first["afferent"].split("#")[0]}"] .tip')
        self.assertTrue(tip.is_displayed() and tip.text.startswith(first["afferent"]))

    def test_a_map_zooms_about_the_pointer_and_a_double_click_resets(self):
        canvas, x, y = self.place(self.classes[0]["first"])
        before = self.js("return corpuscle.scene.scale")
        ActionChains(self.browser, duration=50).move_to_element_with_offset(canvas, x, y).perform()
        box = self.js("const {left, top, width, height} = arguments[0].getBoundingClientRect(); return [left + width / 2, top + height / 2]", canvas)
        self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseWheel", "x": box[0] + x, "y": box[1] + y, "deltaX": 0, "deltaY": -300, "modifiers": 2})
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.scene.scale") > 1.4 * before)
        _, after_x, after_y = self.place(self.classes[0]["first"])
        self.assertLess(max(abs(after_x - x), abs(after_y - y)), 4)
        ActionChains(self.browser, duration=50).drag_and_drop_by_offset(canvas, 40, 30).perform()
        _, moved_x, moved_y = self.place(self.classes[0]["first"])
        self.assertLess(max(abs(moved_x - after_x - 40), abs(moved_y - after_y - 30)), 4)
        ActionChains(self.browser, duration=50).double_click(canvas).perform()
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.scene.isComplete && corpuscle.scene.scale") == before)

    def test_two_fingers_zoom_a_map_and_one_taps_an_afferent(self):
        with self.screen(390, 844, 2):
            self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
            try:
                touch = lambda kind, *points: self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]})
                canvas, x, y = self.place(self.classes[0]["first"] + 7)
                left, top = self.js("const {left, top, width, height} = arguments[0].getBoundingClientRect(); return [left + width / 2, top + height / 2]", canvas)
                touch("touchStart", (left + x, top + y))
                touch("touchEnd")
                waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "unit").text.startswith("sa1#8,"))
                before = self.js("return corpuscle.scene.scale")
                touch("touchStart", (left - 30, top), (left + 30, top))
                for step in range(1, 5):
                    touch("touchMove", (left - 30 - 10 * step, top), (left + 30 + 10 * step, top))
                touch("touchEnd")
                waiting(self.browser, 20).until(lambda _: abs(self.js("return corpuscle.scene.scale") / before - 70 / 30) < 0.1)
            finally:
                self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})

    def test_a_map_is_saved_as_png_svg_and_csv(self):
        self.select("mode", "Spikes, 50\u00a0ms")
        self.to_time(0.3)
        active = self.active()["sa1"]
        self.map("sa1")
        menu = self.browser.find_element(By.CSS_SELECTOR, '[data-map="sa1"] .menu')
        files = {}
        for kind in ("PNG", "SVG", "CSV"):
            menu.find_element(By.TAG_NAME, "summary").click()
            menu.find_element(By.XPATH, f".//button[text()='{kind}']").click()
            path = pathlib.Path(self.downloads.name) / f"sa1.{kind.lower()}"
            waiting(self.browser, 20).until(lambda _: path.exists() and path.stat().st_size)
            files[kind] = path.read_bytes()
        self.assertEqual(files["PNG"][:8], b"\x89PNG\r\n\x1a\n")
        size = self.js("const {canvas} = corpuscle.scene.maps[0]; return [canvas.width, canvas.height]")
        self.assertEqual([int.from_bytes(files["PNG"][k:k + 4], "big") for k in (16, 20)], size)
        ElementTree.fromstring(files["SVG"])
        rows = list(csv.DictReader(files["CSV"].decode().splitlines()))
        self.assertEqual(len(rows), active)
        places = numbers("f", self.data["marks"]["places"])
        for row in rows:
            number = int(re.match(r"sa1#(\d+),", row["afferent"])[1]) - 1
            self.assertAlmostEqual(float(row["x_m"]), places[2 * number], delta=1e-7)

    # Player

    def test_the_maps_play_and_the_plots_follow(self):
        self.to_frame(2)
        self.browser.find_element(By.ID, "play").click()
        for frame in (6, 12):
            waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") > frame)
        line = self.js("return new DOMMatrix(document.querySelector('[data-panel=force] .hairline').style.transform).e")
        self.assertGreater(line, self.js("return corpuscle.panels.force.x(arguments[0])", 6 * self.over["marks"]["width"]))
        self.browser.find_element(By.TAG_NAME, "body").send_keys(" ")
        self.assertFalse(self.js("return corpuscle.player.isPlaying"))
        stopped = self.js("return corpuscle.frame")
        self.assertEqual(self.browser.find_element(By.ID, "time").get_attribute("value"), str(stopped))
        self.browser.find_element(By.ID, "time").send_keys(Keys.ARROW_RIGHT)
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") == stopped + 1)
        self.browser.find_element(By.ID, "step-back").click()
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") == stopped)

    def test_it_starts_at_the_beginning_and_plays_from_there(self):
        self.assertEqual(self.js("return [corpuscle.frame, corpuscle.view.cursor]"), [0, self.over["t0"]])
        self.assertEqual(self.browser.find_element(By.ID, "time").get_attribute("value"), "0")
        self.js("window.seen = []; corpuscle.view.onCursor(() => seen.push(corpuscle.view.cursor))")
        self.browser.find_element(By.ID, "play").click()
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.frame") > 3)
        seen = self.js("return seen")
        self.assertLess(seen[0], 0.02 * self.js("return corpuscle.view.end"))
        self.assertEqual(seen, sorted(seen))

    def test_without_loop_it_stops_at_the_end(self):
        self.browser.find_element(By.ID, "loop").click()
        end = self.js("return corpuscle.view.end")
        self.to_time(end - 3 * self.over["marks"]["width"])
        self.browser.find_element(By.ID, "play").click()
        waiting(self.browser, 20).until(lambda _: not self.js("return corpuscle.player.isPlaying"))
        self.assertEqual(self.js("return corpuscle.view.cursor"), end)

    def test_a_link_restores_time_zoom_mode_and_region(self):
        self.to_time(0.3)
        self.select("mode", "Rate, 100\u00a0ms")
        self.select("region", "touched area")
        self.js("corpuscle.view.set(0.2, 0.5)")
        waiting(self.browser, 20).until(lambda _: "from=0.2" in self.js("return location.hash"))
        scale, link = self.js("return [corpuscle.scene.scale, location.hash]")
        self.open(link)
        self.assertEqual(self.js("return [corpuscle.view.a, corpuscle.view.b, corpuscle.view.cursor, corpuscle.maps.mode.label, corpuscle.maps.time]"), [0.2, 0.5, 0.3, "Rate, 100\u00a0ms", 0.3])
        self.assertAlmostEqual(self.js("return corpuscle.scene.scale"), scale, delta=1e-6 * scale)

    def test_a_damaged_link_is_ignored(self):
        for link in ("#t=abc&from=5&to=1&show=none&region=nowhere", "#%%%", "#t=%E0%A4%A", "#t=" + "9" * 5000, "#show=" + HOSTILE):
            self.open(link)
            self.assertEqual(self.js("return [corpuscle.view.a, corpuscle.view.b, corpuscle.view.cursor, corpuscle.maps.mode === corpuscle.maps.modes[0], corpuscle.scene.isComplete]"),
                             [self.over["t0"], self.js("return corpuscle.view.end"), self.over["t0"], True, True])

    # Plots

    def test_rates_are_means_of_the_active_afferents_in_hertz(self):
        active = {row["afferent"]: row["active"] for row in self.data["summary"]["rates"] if row["region"] == "all" and row["phase"] == "all"}
        self.assertEqual(self.js("return corpuscle.skin.classes.map((one) => one.active)"), [active[one["name"]] for one in self.classes])
        title = self.browser.find_element(By.CSS_SELECTOR, "[data-panel=population] .panel-title").text
        self.assertRegex(title, r"^mean rate of the afferents that fire, in bins of .*\(Hz\)$")
        rows = list(csv.DictReader(self.js("return corpuscle.panels.population.csv()").splitlines()))
        for name, afferents in active.items():
            spikes = sum(float(row["rate_Hz"]) * (float(row["to_s"]) - float(row["from_s"])) * afferents for row in rows if row["series"] == name)
            expected = next(row["spikes"] for row in self.data["summary"]["rates"] if (row["afferent"], row["region"], row["phase"]) == (name, "all", "all"))
            self.assertAlmostEqual(spikes, expected, delta=1e-6 * expected)

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

    def test_a_row_of_a_raster_is_chosen_on_the_maps(self):
        plot = self.plot("raster fa1")
        ActionChains(self.browser, duration=50).move_to_element(plot).perform()
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.scene.chosen") is not None)
        self.assertEqual(self.classes[self.class_of(self.js("return corpuscle.scene.chosen"))]["name"], "fa1")

    def test_without_trials_it_has_no_figure_of_them(self):
        self.assertEqual(self.browser.find_elements(By.ID, "trials"), [])

    # Page

    def test_its_tables_are_complete_and_can_be_sorted(self):
        rows = self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")
        self.assertEqual(len(rows), len(self.classes) * (1 + len(self.data["summary"]["input"]["phases"])))
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#firsts tbody tr")), len(self.data["summary"]["first_spikes"]))
        head = next(one for one in self.browser.find_elements(By.CSS_SELECTOR, "#rates thead button") if one.text == "spikes")
        column = self.js("return [...arguments[0].closest('tr').children].indexOf(arguments[0].parentElement)", head)
        self.js("arguments[0].click(); arguments[0].click()", head)
        shown = self.js("return [...document.querySelectorAll('#rates tbody tr')].map((row) => Number(row.children[arguments[0]].textContent))", column)
        self.assertEqual(shown, sorted((row["spikes"] for row in self.data["summary"]["rates"] if row["region"] == "all"), reverse=True))

    def test_maps_come_first_and_the_player_of_a_telephone_is_at_the_bottom(self):
        order = self.js("return [...document.querySelectorAll('section, details.fold')].map((one) => one.id)")
        self.assertEqual(order, ["maps", "plots", "firsts", "rates", "classes", "sources", "parameters", "versions"])
        with self.screen(390, 844, 2):
            box = self.js("const {top, bottom, width} = document.querySelector('.player').getBoundingClientRect(); return [top, bottom, width]")
            self.assertEqual((box[1], box[2]), (844, 390))
            self.assertGreater(box[0], 844 - 120)
            for id in ("play", "step-back", "step-forward"):
                self.assertGreaterEqual(min(self.browser.find_element(By.ID, id).size.values()), 40)

    def test_it_fits_every_screen_in_both_themes(self):
        for width, height, ratio in SIZES:
            with self.screen(width, height, ratio):
                for theme in self.themes():
                    self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width)
                    self.assertEqual(overfull_bars(self.browser), [])
                    save_picture(self.browser, f"skin-{width}-{theme}.png")
                    # on a telephone, one map is swiped to the next, so the first must be complete
                    right = self.js("return document.querySelector('.skin-map').getBoundingClientRect().right")
                    self.assertLessEqual(right, width)

    def test_it_prints_with_all_maps_in_the_light_theme(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.js("dispatchEvent(new Event('beforeprint'))")
        self.next_frame()
        try:
            flesh = self.js("const {canvas} = corpuscle.scene.maps[0]; return [...canvas.getContext('2d').getImageData(canvas.width / 2, canvas.height * 0.9, 1, 1).data]")
            self.assertGreater(min(flesh[:3]), 150)
            widths = self.js("return [...document.querySelectorAll('.skin-map')].map((one) => one.getBoundingClientRect().right - one.parentElement.getBoundingClientRect().left)")
            self.assertLessEqual(max(widths), 701)
        finally:
            self.js("dispatchEvent(new Event('afterprint'))")
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_maps_have_names_for_screen_readers(self):
        self.to_time(0.3)
        for k, one in enumerate(self.classes):
            label = self.js("return corpuscle.scene.maps[arguments[0]].canvas.getAttribute('aria-label')", k)
            self.assertEqual(label, f"{one['name']}: {self.active()[one['name']]} of {one['afferents']} active, at 0.300\u00a0s")
            first = self.js("return corpuscle.scene.maps[arguments[0]].canvas.getAttribute('aria-label')", k + len(self.classes))
            self.assertEqual(first, f"first spike of each {one['name']} afferent")


class HostileNamesOnASkin(SkinPage):
    """Names from files that look like HTML stay text."""

    @classmethod
    def report(cls):
        def change(data):
            data["title"], data["notes"], data["regions"] = HOSTILE, [HOSTILE], [HOSTILE, HOSTILE + "2"]
            about = data["summary"]["skin"]
            about["description"], about["sources"] = HOSTILE, [{"quantity": HOSTILE, "source": HOSTILE}]
            about["regions"] = {name: {"area_cm2": 1} for name in data["regions"]}
            data["summary"]["input"]["description"] = data["summary"]["input"]["phases"][0]["name"] = HOSTILE
            for one, summary in zip(data["classes"], data["summary"]["classes"]):
                old, one["name"] = one["name"], HOSTILE + one["name"]
                summary["name"], one["description"] = one["name"], HOSTILE
                summary["regions"] = {name: {"afferents": 1} for name in data["regions"]}
                for row in data["summary"]["rates"]:
                    if row["afferent"] == old:
                        row["afferent"] = one["name"]
            for row in data["summary"]["first_spikes"]:
                row["afferent"], row["region"] = HOSTILE + row["afferent"], HOSTILE

        return with_changed_data(respond("skin-names.html", "--population", "fingertip"), "skin-hostile.html", change)

    def test_names_stay_text(self):
        self.js("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
        self.next_frame()
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "img"), [])
        self.assertEqual(self.browser.find_element(By.ID, "title").text, HOSTILE)
        for id in ("maps", "plots", "firsts", "rates", "classes"):
            self.assertIn(HOSTILE, self.browser.find_element(By.ID, id).text)
        first = self.data["summary"]["first_spikes"][0]
        canvas, x, y = self.place(first["afferent_index"])
        ActionChains(self.browser, duration=50).move_to_element_with_offset(canvas, x, y).perform()
        waiting(self.browser, 20).until(lambda _: HOSTILE in self.browser.find_element(By.ID, "unit").text)


class WithoutSpikeTimes(SkinPage):
    """More spikes than the page contains the times of."""

    @classmethod
    def report(cls):
        def change(data):
            cls.spikes, data["over"]["spikes"] = data["over"]["spikes"]["count"], None

        return with_changed_data(respond("skin-times.html", "--population", "fingertip"), "skin-counts.html", change)

    def test_rasters_show_counts_and_maps_show_rates(self):
        self.assertIn("the rasters show counts per frame", self.browser.find_element(By.ID, "plots").text)
        self.assertEqual(self.js("return corpuscle.maps.modes.map(({key}) => key.split('-')[0])[0]"), "rate")
        rows = [row for one in self.classes for row in csv.DictReader(self.js("return corpuscle.panels[arguments[0]].csv()", f"raster {one['name']}").splitlines())]
        self.assertEqual(sum(int(row["spikes"]) for row in rows), self.spikes)
        dark_pixels = self.dark_pixels()
        for one in self.classes:
            self.assertGreater(dark_pixels[f"raster {one['name']}"], 0)


class SensorsOfTwo(SkinPage):
    """Separate sensors with two afferents each."""

    @classmethod
    def report(cls):
        population = OUT / "two.toml"
        population.write_text('title = "two at each sensor"\n[sites]\nrows = 3\ncolumns = 3\npitch = "3 mm"\n[[class]]\nafferent = "sa1-nerve"\nper_site = 2\n[[class]]\nafferent = "fa1-nerve"\nper_site = 3\n')
        return respond("skin-two.html", "--population", str(population))

    def test_afferents_of_one_site_are_fanned_out(self):
        places = numbers("f", self.data["marks"]["places"])
        self.assertLess(len(set(zip(places[0::2], places[1::2]))), len(places) / 2)
        for k, one in enumerate(self.classes):
            shown = self.js("const map = corpuscle.scene.maps[arguments[0]]; return Array.from({length: map.to - map.from}, (_, n) => map.place(map.from + n))", k)
            self.assertEqual(len(shown), one["afferents"])
            nearest = min(math.dist(a, b) for n, a in enumerate(shown) for b in shown[:n])
            self.assertGreater(nearest, 2 * self.js("return corpuscle.scene.dotRadius"))
            for (x, y), afferent in zip(shown, range(one["first"], one["first"] + one["afferents"])):
                site = self.js("return [corpuscle.scene.x(arguments[0]), corpuscle.scene.y(arguments[1])]", places[2 * afferent], places[2 * afferent + 1])
                self.assertLess(math.dist((x, y), site), 0.5 * 3e-3 * self.js("return corpuscle.scene.scale"), "it stays in the square of its sensor")

    def test_separate_sensors_have_no_outline(self):
        self.assertEqual(self.data["sites"]["outline"], {"skin": [], "regions": []})
        self.assertIn("force on 9 mm²", self.browser.find_element(By.ID, "maps").text)


class TrialsOnASkin(SkinPage):
    """The trials of a touch on a hand, aligned to their onsets."""

    @classmethod
    def report(cls):
        path = OUT / "skin-trials.html"
        subprocess.run([CORPUSCLE, "respond", "examples/data/touch.csv", "--deadband", "20mN", "--population", "hand", "--trials", "examples/data/touch_trials.csv",
                        "--align", "onset", "--window", "-0.1..0.3", "--out", str(OUT / "skin-trials"), "--bin", "20ms", "--overwrite", "--report", str(path), "--quiet"],
                       check=True, cwd=ROOT)
        return path

    def panels(self):
        return self.js("return [...document.querySelectorAll('#trials .panel')].map((one) => one.dataset.panel)")

    def test_each_class_has_a_histogram_with_a_curve_for_each_label(self):
        self.assertEqual(self.panels(), ["trial force", *(f"trial rate {one['name']}" for one in self.classes)])
        for one in self.classes:
            panel = f"trial rate {one['name']}"
            title = self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .panel-title').text
            self.assertRegex(title, rf"^{one['name']}: mean rate per afferent ± standard error, bins of 20.ms \(k?Hz\)$")
            self.assertEqual(self.js("return corpuscle.panels[arguments[0]].series.map(({name}) => name)", panel), ["tap", "press", "rub"])
            self.assert_csv_is(panel, next(k for k, group in enumerate(self.data["trials"]["groups"]) if group["name"] == one["name"]))
            # the colours of the classes are those of other figures
            self.assertEqual(set(self.js("return corpuscle.panels[arguments[0]].series.map(({colour}) => colour)", panel)) & {f"var(--series-{k})" for k in range(len(self.classes))}, set())

    def assert_csv_is(self, panel, group):
        rows = list(csv.DictReader(self.js("return corpuscle.panels[arguments[0]].csv()", panel).splitlines()))
        shown = {(row["series"], round(float(row["from_s"]), 6)): float(row["rate_Hz"]) for row in rows if row["rate_Hz"]}
        expected = {(one["label"], round(edge, 6)): rate for one in self.data["trials"]["histograms"] if one["group"] == group for edge, rate in zip(one["edges"], one["rate"]) if rate is not None}
        self.assertEqual(shown, expected)
        self.assertGreater(len(shown), 10)

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
        groups = [k for k, one in enumerate(self.data["trials"]["groups"]) if one["channel"] == "index.tip"]
        self.assertEqual(self.panels(), ["trial force", *(f"trial rate {self.data['trials']['groups'][k]['name']}" for k in groups)])
        self.next_frame()
        for k in groups:
            self.assert_csv_is(f"trial rate {self.data['trials']['groups'][k]['name']}", k)

    def test_it_fits_a_telephone_and_a_dark_theme(self):
        self.js("document.getElementById('trials').scrollIntoView()")
        self.screenshot("skin-trials.png")
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            with self.screen(390, 844, 2):
                self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
                self.assertGreater(self.js("return document.querySelector('#trials .plot').clientWidth"), 0.85 * 390)
                save_picture(self.browser, f"skin-trials-phone-{theme}.png")
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


del Page, SkinPage  # base classes, not tests


if __name__ == "__main__":
    run_tests()
