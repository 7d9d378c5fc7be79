#!/usr/bin/python3
"""Tests of the page of `corpuscle respond` for afferents on channels (see browser.py)."""
from browser import *


class Press(Page):
    @classmethod
    def report(cls):
        return respond("press.html", "--afferent", "sa1", "--afferent", "fa1")

    def test_the_page_requests_nothing_but_itself(self):
        events = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        requested_urls = {e["params"]["request"]["url"] for e in events
                 if e["method"] == "Network.requestWillBeSent" and e["params"]["documentURL"] == self.path.as_uri()}
        self.assertIn(self.path.as_uri(), requested_urls)
        self.assertEqual([url for url in requested_urls if url != self.path.as_uri() and not url.startswith("data:")], [])

    def test_the_file_refers_to_nothing_outside(self):
        text = re.sub(r"<!--.*?-->|/\*.*?\*/", "", DATA.sub("", self.path.read_text()), flags=re.S)  # licences may name web addresses
        self.assertEqual([url for url in re.findall(r"https?://[^\s\"')]*", text) if not url.startswith("http://www.w3.org/")], [])  # names of SVG
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["']?(?!data:)[\w./]|url\(\s*["']?(?!data:)|@import""", text.split("<script", 1)[0]), [])
        self.assertEqual(re.findall(r"<script[^>]*\bsrc\b|<link[^>]*stylesheet", text), [])
        self.assertNotIn("{{page", text)

    def test_every_panel_is_present_and_drawn(self):
        self.assertEqual(self.panels(), ["force", "raster", "frequency"])
        self.open_sections()
        dark_pixels = self.dark_pixels()
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "sa1 current", "sa1 membrane", "fa1 current", "fa1 membrane"])
        self.assertEqual({name: count for name, count in dark_pixels.items() if count < 80}, {})
        self.screenshot("press.png")

    def test_each_panel_has_a_description_for_screen_readers(self):
        for plot in self.browser.find_elements(By.CSS_SELECTOR, ".plot"):
            self.assertEqual(plot.get_attribute("role"), "img")
            self.assertRegex(plot.get_attribute("aria-label"), r"\w+.* from .*\ss to .*\ss")
        self.assertGreaterEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#rates th[scope=col]")), 4)

    def test_a_drag_in_one_panel_zooms_all(self):
        self.open_sections()
        length = self.end - self.input["t0"]
        begin, end = self.input["t0"] + 0.2 * length, self.input["t0"] + 0.45 * length
        self.drag("sa1 current", begin, end)
        self.settle(lambda a, b: b - a < 0.5 * length)
        windows = self.windows()
        self.assertEqual(windows, [windows[0]] * 7)
        self.assertEqual(windows[0], self.js("return corpuscle.window()"))
        self.assertAlmostEqual(windows[0][0], begin, delta=0.003 * length)
        self.assertAlmostEqual(windows[0][1], end, delta=0.003 * length)
        self.hover("force", begin + 0.1 * length)
        self.screenshot("press-zoomed.png")

    def test_shift_drag_pans_and_double_click_shows_everything(self):
        length = self.end - self.input["t0"]
        middle = self.input["t0"] + 0.5 * length
        self.js("corpuscle.setWindow(arguments[0], arguments[1])", middle, middle + 0.2 * length)
        self.drag("force", middle + 0.15 * length, middle + 0.05 * length, Keys.SHIFT)
        self.settle(lambda a, b: a > middle + 0.05 * length)
        for a, b in self.windows():
            self.assertAlmostEqual(a, middle + 0.1 * length, delta=0.003 * length)
            self.assertAlmostEqual(b - a, 0.2 * length, delta=1e-9)
        ActionChains(self.browser).double_click(self.plot("frequency")).perform()
        self.settle(lambda a, b: b - a > 0.99 * length)

    def button(self, name):
        return self.browser.find_element(By.CSS_SELECTOR, f'button[aria-label="{name}"]')

    def test_buttons_and_keys_zoom_too(self):
        length = self.end - self.input["t0"]
        self.button("Zoom in").click()
        self.settle(lambda a, b: abs(b - a - length / 2) < 1e-9)
        self.browser.find_element(By.TAG_NAME, "body").send_keys("+")
        self.settle(lambda a, b: abs(b - a - length / 4) < 1e-9)
        self.button("Zoom out").click()
        self.settle(lambda a, b: abs(b - a - length / 2) < 1e-9)
        self.browser.find_element(By.XPATH, "//button[text()='Reset']").click()
        self.settle(lambda a, b: abs(b - a - length) < 1e-9)

    def test_the_force_read_on_the_plateau_is_the_force_of_the_data(self):
        t, force = plateau(self.data)
        self.open_sections()
        self.hover("fa1 current", t)  # the cursor is shared: the pointer is in one panel, the values are read in another
        self.assertAlmostEqual(si(self.readout("force", "force")), force, delta=1e-3 * force)
        self.assertAlmostEqual(self.js("return corpuscle.valueAt('force', arguments[0])", t), force, delta=1e-6 * force)
        lines = self.browser.find_elements(By.CSS_SELECTOR, ".hairline")
        self.assertEqual(len({line.location["x"] for line in lines if line.is_displayed()}), 1)
        self.assertEqual(len(lines), 7)

    def test_a_current_between_two_samples_is_that_of_the_nearer_sample(self):
        self.open_sections()
        T, t0 = self.input["T"], self.input["t0"]
        k = round((spike_times(self.data, "sa1")[3] - t0) / T)
        parts = [part["name"] for part in self.data["afferents"][0]["probes"] if part["unit"] == "A"]
        self.assertGreater(len(parts), 1)
        self.js("corpuscle.setWindow(arguments[0], arguments[1])", t0 + (k - 20) * T, t0 + (k + 20) * T)
        for beside in (-0.3, 0.3):
            self.hover("sa1 current", t0 + (k + beside) * T)
            for part in parts:
                low, high, bucket = trace(self.data, part, "sa1")
                shown_values = self.readout("sa1 current", part).split("…")
                for value, text in zip((low[k // bucket], high[k // bucket]), shown_values * (3 - len(shown_values))):
                    self.assertAlmostEqual(si(text), value, delta=6e-4 * abs(value) + 1e-18, msg=part)

    def test_the_raster_has_as_many_spikes_as_the_table(self):
        columns = [cell.text for cell in self.browser.find_elements(By.CSS_SELECTOR, "#rates thead th")]
        rows = [[cell.text for cell in row.find_elements(By.CSS_SELECTOR, "th, td")] for row in self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")]
        at = {name: columns.index(name) for name in ("afferent", "phase", "spikes")}
        for afferent in ("sa1", "fa1"):
            shown_count = self.readout("raster", afferent)
            mine = [row for row in rows if row[at["afferent"]] == afferent]
            complete = [row for row in mine if row[at["phase"]] in ("", "–", "all", "whole")] or mine
            self.assertEqual(int(shown_count), sum(int(row[at["spikes"]]) for row in complete))
            self.assertEqual(int(shown_count), len(spike_times(self.data, afferent)))
            self.assertGreater(int(shown_count), 0)

    def test_each_spike_is_one_tick(self):
        for lane, afferent in enumerate(("sa1", "fa1")):
            times = spike_times(self.data, afferent)
            pad = 0.1 * (times[4] - times[0])
            a, b = self.js("corpuscle.setWindow(arguments[0], arguments[1]); return corpuscle.window()", times[0] - pad, times[4] + pad)
            ticks = self.js("""
                const {x, y, w, h} = corpuscle.panels.raster.area;
                const canvas = document.querySelector('[data-panel="raster"] canvas'), ratio = canvas.width / canvas.clientWidth;
                const line = canvas.getContext("2d").getImageData((x + 2) * ratio, (y + (arguments[0] + 0.5) * h / 2) * ratio, (w - 2) * ratio, 1).data;
                let runs = 0, inside = false;
                for (let i = 0; i < line.length; i += 4) {
                    const dark = line[i + 3] > 60 && Math.min(line[i], line[i + 1], line[i + 2]) < 200;
                    if (dark && !inside) ++runs;
                    inside = dark;
                }
                return runs""", lane)
            self.assertEqual(ticks, sum(a <= t < b for t in times), afferent)

    def test_the_frequency_of_a_spike_is_at_that_spike(self):
        times = spike_times(self.data, "fa1")
        drawn = self.js("""
            const flat = corpuscle.panels.frequency.points(1);
            return Array.from({length: flat.length / 2}, (_, k) => flat.slice(2 * k, 2 * k + 2))""")
        self.assertEqual([t for t, _ in drawn], list(times[:-1]))
        for (t, f), following in zip(drawn, times[1:]):
            self.assertAlmostEqual(f * (following - t), 1, places=9)

    def test_the_vertical_axis_follows_the_window_with_autoscale(self):
        self.open_sections()
        t, _ = plateau(self.data)
        self.browser.find_element(By.ID, "autoscale").click()
        self.js("corpuscle.setWindow(arguments[0], arguments[1])", t - 20 * self.input["T"], t + 20 * self.input["T"])
        low, high = self.js("const {low, high} = corpuscle.panels['sa1 current']; return [low, high]")
        self.browser.find_element(By.ID, "autoscale").click()
        self.js("corpuscle.setWindow(corpuscle.window()[0], corpuscle.window()[1])")
        wide = self.js("const {low, high} = corpuscle.panels['sa1 current']; return [low, high]")
        self.assertLess(high - low, 0.9 * (wide[1] - wide[0]))

    def test_it_fits_a_narrow_window(self):
        self.browser.set_window_size(700, 900)
        waiting(self.browser, 20).until(lambda _: self.js("return corpuscle.panels.force.plot.clientWidth < 700"))
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth - innerWidth"), 0)
        self.browser.set_window_size(1200, 900)

    def test_the_first_screen_shows_force_spikes_and_rate(self):
        with self.screen(1400, 900, 1):
            for panel in ("force", "raster", "frequency"):
                self.assertLess(self.js("return document.querySelector(arguments[0]).getBoundingClientRect().bottom", f'[data-panel="{panel}"]'), 900)

    def test_on_a_telephone_page_and_plots_use_the_width_of_the_screen(self):
        with self.screen(390, 844, 2):
            self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
            self.assertGreater(min(drawn["width"] for drawn in self.js("return corpuscle.pointsDrawn()").values()), 0.7 * 390)

    def test_curves_have_the_resolution_of_the_screen(self):
        """There are two points for each pixel of the screen, not of the layout; otherwise slopes look like stairs."""
        rows = []
        for ratio in (1, 2):
            with self.screen(390, 844, ratio):
                rows.append(self.js("return corpuscle.pointsDrawn()")["force"]["rows"])
                self.assertEqual(self.js("const canvas = document.querySelector('.plot canvas'); return canvas.width / canvas.clientWidth"), ratio)
        self.assertGreater(rows[1], 1.5 * rows[0])


class Versions(Page):
    """SA-I and FA-I, each as a model and as a chip."""
    CHIP = "circuits/sa1.cir"

    @classmethod
    def report(cls):
        return respond("versions.html", "--afferent", "sa1", "--afferent", "fa1,circuits/sa1.cir", "--afferent", "circuits/fa1.cir")

    def setUp(self):
        super().setUp()
        self.open_sections()

    def right_axis(self, panel):
        """For two labels of the right axis: the value in SI, and the value of the left axis at the same height. Labels at the ends are moved inwards."""
        area, low, high = self.js("const {area, low, high} = corpuscle.panels[arguments[0]]; return [area, low, high]", panel)
        labels = [(text, y) for text, _, y in self.texts(panel, "start") if area["y"] + 6 < y < area["y"] + area["h"] - 4]
        self.assertGreaterEqual(len(labels), 2, panel)
        prefix = re.search(r"\((.?)[AV]\)", self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .right-title').text)[1]
        return [(float(text.replace("−", "-")) * PREFIX[prefix], high - (y - area["y"]) / area["h"] * (high - low)) for text, y in (labels[0], labels[-1])]

    def drawn(self, panel, curve):
        """The points of a curve, the first of which is that of the reference."""
        flat = self.js("return corpuscle.panels[arguments[0]].points(arguments[1])", panel, curve)
        return list(zip(flat[::2], flat[1::2]))

    def test_model_and_chip_share_a_panel_for_each_quantity(self):
        self.assertEqual(self.panels(), ["force", "raster", "sa1 frequency", "fa1 frequency", "sa1 I", "sa1 I_A", "sa1 I_B", "sa1 I_C", "sa1 u",
                                         "circuits/sa1.cir nodes", "fa1 I", "fa1 I_A", "fa1 I_B", "fa1 u", "circuits/fa1.cir nodes"])
        self.assertEqual({name: count for name, count in self.dark_pixels().items() if count < 80}, {})
        self.screenshot("versions.png")

    def test_one_instant_is_at_one_position_in_all_panels(self):
        areas = self.js("return Object.values(corpuscle.panels).map(({area}) => [area.x, area.w])")
        self.assertEqual(areas, [areas[0]] * len(areas))

    def test_the_right_axis_has_the_values_of_the_curves(self):
        for panel, part in (("sa1 I", "i(vi)"), ("sa1 I_B", "i(vib)"), ("sa1 u", "v(u)")):
            (low, at_low), (high, at_high) = self.right_axis(panel)
            T = self.input["T"]
            for t in (0.1, 0.33, 0.6, 0.9):
                k = round((t - self.input["t0"]) / T)
                self.js("corpuscle.setWindow(arguments[0], arguments[1])", t - 20 * T, t + 20 * T)
                place = min(self.drawn(panel, 1), key=lambda row: abs(row[0] - t))[1]
                value = trace(self.data, part, self.CHIP)[0][k]
                self.assertAlmostEqual(low + (place - at_low) * (high - low) / (at_high - at_low), value, delta=5e-3 * abs(high - low), msg=(panel, t))
                self.hover(panel, t)
                self.assertAlmostEqual(si(self.readout(panel, self.CHIP)), value, delta=2e-3 * abs(value) + 1e-15, msg=(panel, t))

    def test_thresholds_of_both_membranes_are_at_one_height_and_the_chips_axis_is_inverted(self):
        fires = self.js("return corpuscle.valueAt('v(u)', arguments[0], arguments[1])", spike_times(self.data, self.CHIP)[3] - self.input["T"], self.CHIP)
        (low, at_low), (high, at_high) = self.right_axis("sa1 u")
        self.assertLess((at_high - at_low) / (high - low), 0, "upside down")
        self.assertIn("inverted", self.browser.find_element(By.CSS_SELECTOR, '[data-panel="sa1 u"] .right-title').text)
        self.assertAlmostEqual(at_low + (fires - low) * (at_high - at_low) / (high - low), self.data["afferents"][0]["V_th"], delta=0.02)
        self.assertLess(fires, 0.27)

    def test_the_mean_input_currents_are_at_one_height_and_their_ratio_is_stated(self):
        mean = lambda values: sum(max(v, 0) for v in values) / len(values)
        model, chip = mean(trace(self.data, "I", "sa1")[0]), mean(trace(self.data, "i(vi)", self.CHIP)[0])
        (low, at_low), (high, at_high) = self.right_axis("sa1 I_A")
        self.assertAlmostEqual((high - low) / (at_high - at_low) / (chip / model), 1, delta=0.02)
        note = self.browser.find_element(By.CSS_SELECTOR, "#figures .note").text.replace("\u00a0", " ")
        self.assertIn(f"{1e12 * chip / model * 1e-6:.4g} pA corresponds to 1 µA in sa1", note)

    def test_the_glitches_at_the_chips_spikes_are_visible(self):
        times, T = spike_times(self.data, self.CHIP), self.input["T"]
        for t in times[3:8]:
            rows = [v for s, v in self.drawn("sa1 I", 1) if v is not None and t <= s < t + 4e-3]
            before = [v for s, v in self.drawn("sa1 I", 1) if v is not None and t - 4e-3 < s < t - 5 * T]
            self.assertGreater(max(rows), 1.2 * max(before))

    def test_a_version_has_one_colour_everywhere(self):
        swatches = self.js("""
            const colours = {};
            for (const item of document.querySelectorAll("#figures [data-series]")) {
                const mark = item.firstChild, style = getComputedStyle(mark);
                (colours[item.dataset.series] ||= new Set()).add(mark.className === "mark" ? style.color : style.borderTopColor);
            }
            return Object.fromEntries(Object.entries(colours).map(([name, all]) => [name, [...all]]))""")
        mine = [swatches[name] for name in ("sa1", "fa1", self.CHIP, "circuits/fa1.cir")]
        self.assertEqual([len(one) for one in mine], [1] * 4)
        self.assertEqual(len({one[0] for one in mine}), 4)

    def test_rows_of_one_afferent_type_are_adjacent(self):
        self.assertEqual([text for text, *_ in self.texts("raster", "end")], ["sa1", self.CHIP, "fa1", "circuits/fa1.cir"])

    def test_the_table_of_versions_counts_the_spikes(self):
        section = self.browser.find_element(By.ID, "comparisons")
        columns = [cell.text for cell in section.find_elements(By.CSS_SELECTOR, "thead th")]
        rows = [dict(zip(columns, (cell.text for cell in row.find_elements(By.CSS_SELECTOR, "th, td")))) for row in section.find_elements(By.CSS_SELECTOR, "tbody tr")]
        self.assertEqual([row["afferent"] for row in rows], ["sa1", self.CHIP, "fa1", "circuits/fa1.cir"])
        for row in rows:
            times = spike_times(self.data, row["afferent"])
            self.assertEqual(int(row["spikes"]), len(times))
            for phase in self.input["phases"]:
                self.assertEqual(int(row[phase["name"]]), sum(phase["from"] <= t < phase["to"] for t in times))
        change = 100 * (len(spike_times(self.data, self.CHIP)) / len(spike_times(self.data, "sa1")) - 1)
        self.assertEqual(rows[1]["change (%)"], f"{change:.1f}".replace("-", "−"))
        self.assertEqual((rows[0]["matched"], rows[0]["change (%)"]), ("–", "–"))


class Trials(Page):
    """Eight presses with two labels, one below another in a table, aligned to their onsets."""

    @classmethod
    def report(cls):
        rows = ["trial,texture,time_s,fz_N"]
        for trial in range(1, 9):
            top = 2.0 if trial % 2 else 0.8
            for k in range(500):
                force = min(max((k * 0.002 - 0.2 - 0.02 * trial) * 10, 0), 1) * top
                rows.append(f"{trial},{'rough' if trial % 2 else 'smooth'},{k * 0.002:.3f},{force if k < 400 else 0:.5f}")
        (OUT / "long.csv").write_text("\n".join(rows) + "\n")
        path = OUT / "trials.html"
        subprocess.run([CORPUSCLE, "respond", str(OUT / "long.csv"), "--by", "trial", "--label", "texture", "--align", "onset", "--window", "-0.1..0.6",
                        "-a", "sa1-nerve,fa1-nerve", "--report", str(path), "--quiet"], check=True)
        return path

    def test_each_spike_of_the_selected_afferent_is_in_the_raster(self):
        select = Select(self.browser.find_element(By.CSS_SELECTOR, "#trials select"))
        for group in range(2):
            select.select_by_index(group)
            self.next_frame()
            records = [r for r in self.data["trials"]["spikes"] if r["group"] == group]
            rows = list(csv.DictReader(self.js("return corpuscle.panels['trial raster'].csv()").splitlines()))
            self.assertGreater(len(rows), 20)
            self.assertEqual(sorted(float(row["time_s"]) for row in rows), sorted(t for r in records for t in numbers("d", r["times"])))
            self.assertEqual(self.js("return corpuscle.panels['trial raster'].drawn"), len(rows))
            counts = [int(self.readout("trial raster", label)) for label in self.data["trials"]["labels"]]
            self.assertEqual(sum(counts), len(rows))

    def test_force_and_histogram_have_a_curve_for_each_trial_and_label(self):
        self.assertEqual(self.panels()[:3], ["trial force", "trial raster", "trial rate"])
        for trial in range(8):
            self.assertGreater(len(self.js("return corpuscle.panels['trial force'].points(arguments[0])", trial)), 100)
        svg = ElementTree.fromstring(self.js("return corpuscle.panels['trial rate'].svg()"))
        shapes = lambda tag, name: [one for one in svg.iter("{http://www.w3.org/2000/svg}" + tag) if one.get(name)]
        self.assertGreater(len(shapes("rect", "opacity")), 10, "the band of the standard error")
        colours = {self.js("return getComputedStyle(document.querySelector(arguments[0])).borderTopColor", f'[data-panel="trial rate"] [data-series="{label}"] .swatch')
                   for label in self.data["trials"]["labels"]}
        self.assertEqual(len(colours & {one.get("stroke") for one in shapes("path", "stroke")}), 2)

    def test_each_panel_can_be_saved(self):
        self.open_sections()
        self.assertEqual(unsaved_panels(self.browser), [])

    def test_the_file_of_the_forces_has_each_trial_on_its_own_clock(self):
        rows = list(csv.DictReader(self.js("return corpuscle.panels['trial force'].csv()").splitlines()))
        for k, trial in enumerate(self.data["trials"]["trials"]):
            own = [row for row in rows if row["curve"] == f"force of trial {k + 1}"]
            force, step = numbers("f", trial["force"]["values"]), trial["force"]["step"]
            self.assertEqual([float(row["value (N)"]) for row in own], list(force))
            self.assertAlmostEqual(float(own[0]["time (s)"]), trial["force"]["from"] + step / 2, 9)
            self.assertEqual({row["series"] for row in own}, {trial["label"]})

    def test_the_histogram_is_that_of_the_spikes(self):
        trials = self.data["trials"]
        group = int(self.js("return document.querySelector('#trials select').selectedIndex"))
        histogram = next(h for h in trials["histograms"] if h["label"] == "rough" and h["group"] == group)
        times = [t for r in trials["spikes"] if r["group"] == group and trials["trials"][r["trial"]]["label"] == "rough" for t in numbers("d", r["times"])]
        edges = [*histogram["edges"], histogram["end"]]
        shown = [row for row in csv.DictReader(self.js("return corpuscle.panels['trial rate'].csv()").splitlines()) if row["series"] == "rough"]
        self.assertEqual([float(row["rate_Hz"]) for row in shown], histogram["rate"])
        self.assertEqual([float(row["standard_error_Hz"]) for row in shown], histogram["error"])
        for k, rate in enumerate(histogram["rate"]):
            inside = sum(edges[k] <= t < edges[k + 1] for t in times)
            self.assertAlmostEqual(rate, inside / 4 / (edges[k + 1] - edges[k]), delta=1e-6 * (1 + rate) + 1.01 / 4 / trials["bin"] * any(abs(t - e) < 1e-9 for t in times for e in edges))

    def test_a_label_is_hidden_in_all_figures_of_the_trials(self):
        self.browser.find_element(By.CSS_SELECTOR, '[data-panel="trial rate"] button[data-series="smooth"]').click()
        self.next_frame()
        Select(self.browser.find_element(By.CSS_SELECTOR, "#trials select")).select_by_index(1)
        self.next_frame()
        self.assertEqual(self.js("return ['trial force', 'trial raster', 'trial rate'].map((name) => [...corpuscle.panels[name].hidden])"), [["smooth"]] * 3)
        self.assertEqual({row["afferent"] for row in csv.DictReader(self.js("return corpuscle.panels['trial raster'].csv()").splitlines())}, {"rough"})

    def test_zooming_the_trials_does_not_zoom_the_recording(self):
        before = self.js("return corpuscle.window()")
        plot = self.plot("trial force")
        ActionChains(self.browser).move_to_element(plot).click().send_keys("+").perform()
        waiting(self.browser, 20).until(lambda _: self.js("const {view} = corpuscle.panels['trial raster']; return view.b - view.a") < 0.4)
        self.assertEqual(self.js("return corpuscle.window()"), before)

    def test_a_click_on_a_trial_shows_its_recording(self):
        trials = self.data["trials"]["trials"]
        last = max(range(len(trials)), key=lambda k: (self.data["trials"]["labels"].index(trials[k]["label"]), k))  # in the last row
        plot, area = self.plot("trial raster"), self.js("return corpuscle.panels['trial raster'].area")
        row = area["y"] + area["h"] * 7.5 / 8
        ActionChains(self.browser).move_to_element_with_offset(plot, 0, round(row - plot.size["height"] / 2)).click().perform()
        waiting(self.browser, 20).until(lambda _: Select(self.browser.find_element(By.ID, "input")).first_selected_option.text == trials[last]["input"])
        a, b = self.js("return corpuscle.window()")
        self.assertAlmostEqual(b - a, trials[last]["to"] - trials[last]["from"], places=6)

    def test_it_fits_a_telephone_and_a_dark_theme(self):
        self.screenshot("trials.png")
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            with self.screen(390, 844, 2):
                self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
                self.assertGreater(self.js("return document.querySelector('#trials canvas').clientWidth"), 0.85 * 390)
                save_picture(self.browser, f"trials-phone-{theme}.png")
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


class ManyFiles(Page):
    """Twelve files of two kinds, without options of trials."""

    @classmethod
    def report(cls):
        for k in range(1, 13):
            kind, top = ("press", 2.0) if k <= 6 else ("tap", 1.0)
            rows = "\n".join(f"{n * 0.002:.3f},{top * min(max((n * 0.002 - 0.2 - 0.01 * k) * 10, 0), 1):.5f}" for n in range(400 + 10 * k))
            (OUT / f"{kind}_{k:02}.csv").write_text("time_s,fz_N\n" + rows + "\n")
        path = OUT / "files.html"
        files = sorted(str(one) for kind in ("press", "tap") for one in OUT.glob(f"{kind}_[01][0-9].csv"))
        subprocess.run([CORPUSCLE, "respond", *files, "-a", "sa1-nerve,fa1-nerve", "--report", str(path), "--quiet"], check=True, stderr=subprocess.DEVNULL)
        return path

    def test_each_panel_can_be_saved(self):
        self.open_sections()
        self.assertEqual(unsaved_panels(self.browser), [])

    def test_all_files_are_compared_from_their_start(self):
        trials = self.data["trials"]
        self.assertEqual((len(trials["trials"]), trials["labels"], trials["onset"]), (12, ["press", "tap"], False))
        self.assertEqual(self.panels()[:3], ["trial force", "trial raster", "trial rate"])
        self.assertEqual([text for text, *_ in self.texts("trial raster", "end")], [one["input"] for one in trials["trials"]])
        self.assertIn("12 inputs, aligned to their start", self.browser.find_element(By.ID, "trials").text)
        self.assertGreater(min(self.dark_pixels().values()), 80)
        group = int(self.js("return document.querySelector('#trials select').selectedIndex"))
        of_input = lambda k: next(r for r in self.data["spikes"] if r["channel"] == k and r["afferent"] == trials["groups"][group]["name"])
        for record in trials["spikes"]:
            if record["group"] == group:
                self.assertEqual(list(numbers("d", record["times"])), list(numbers("d", of_input(record["trial"])["times"])), "each file begins at 0")

    def test_more_labels_than_colours_become_one(self):
        names = "one two three four five six seven eight nine".split()
        for name in names:
            (OUT / f"{name}.csv").write_bytes((OUT / "press_01.csv").read_bytes())
        page = OUT / "nine.html"
        subprocess.run([CORPUSCLE, "respond", *(str(OUT / f"{name}.csv") for name in names), "--report", str(page), "--quiet"], check=True, stderr=subprocess.DEVNULL)
        self.assertEqual(data_of(page)["trials"]["labels"], ["all inputs"])

    def test_the_title_is_short_and_the_command_has_no_directories(self):
        self.assertEqual(self.browser.find_element(By.ID, "title").text, "press_01, press_02, press_03 and 9 more")
        command = self.browser.find_element(By.ID, "command").text
        self.assertIn("press_01.csv", command)
        self.assertNotIn(str(OUT), command)

    def test_a_click_on_a_row_selects_its_file(self):
        plot, area = self.plot("trial raster"), self.js("return corpuscle.panels['trial raster'].area")
        ActionChains(self.browser).move_to_element_with_offset(plot, 0, round(area["y"] + area["h"] * 8.5 / 12 - plot.size["height"] / 2)).click().perform()
        waiting(self.browser, 20).until(lambda _: Select(self.browser.find_element(By.ID, "input")).first_selected_option.text == "tap_09")


class NetlistsAlone(Page):
    @classmethod
    def report(cls):
        """A chip, and another with half the current and the same membrane; no model."""
        def change(data):
            chip = next(one for one in data["afferents"] if one["netlist"])
            data["afferents"] = [chip, {**chip, "name": "sa1-macro"}]
            data["traces"] = [r for r in data["traces"] if r["afferent"] != "sa1"]
            for record in [r for r in data["traces"] if r["afferent"]]:
                half = 0.5 if record["unit"] == "A" else 1
                data["traces"].append({**record, "afferent": "sa1-macro", "data": encoded_array("f", [v * half for v in numbers("f", record["data"])])})
            data["spikes"] = [r for r in data["spikes"] if r["afferent"] != "sa1"]
            data["spikes"] += [{**r, "afferent": "sa1-macro"} for r in data["spikes"]]
        return with_changed_data(respond("chip.html", "--afferent", "sa1,circuits/sa1.cir"), "netlists-alone.html", change)

    def test_curves_of_similar_size_share_an_axis(self):
        self.open_sections()
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "sa1 i(vi)", "sa1 i(via)", "sa1 i(vib)", "sa1 i(vic)", "sa1 v(u)", "circuits/sa1.cir nodes",
                                         "sa1-macro nodes"])
        self.assertEqual(self.browser.find_elements(By.CLASS_NAME, "right-title"), [])
        self.hover("sa1 i(via)", 0.5)
        chip, macro = (si(self.readout("sa1 i(via)", name)) for name in ("circuits/sa1.cir", "sa1-macro"))
        self.assertAlmostEqual(macro / chip, 0.5, places=3)


class NetlistByItself(Page):
    @classmethod
    def report(cls):
        return respond("spiker.html", "--afferent", "circuits/spiker.cir")

    def test_its_membrane_has_a_panel_apart_from_its_other_nodes(self):
        self.open_sections()
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "circuits/spiker.cir membrane", "circuits/spiker.cir nodes"])
        self.assertGreater(min(self.dark_pixels().values()), 80)
        self.assertEqual(self.browser.find_elements(By.ID, "comparisons"), [])


class TwoChannels(Page):
    @classmethod
    def report(cls):
        """A second channel: half the force, one spike of sa1, and no curves of the afferents."""
        def add(data):
            first = data["inputs"][0]["channels"][0]
            data["inputs"][0]["channels"].append({"id": 77, "name": "second <b>", "unit": first["unit"]})
            low, _, bucket = trace(data, "force")
            record = next(r for r in data["traces"] if r["quantity"] == "force")
            both = [v / 2 for v in low] if bucket == 1 else [v / 2 for pair in zip(*trace(data, "force")[:2]) for v in pair]
            data["traces"].append({**record, "channel": 77, "data": encoded_array("f", both)})
            data["spikes"].append({"afferent": "sa1", "channel": 77, "count": 1, "times": encoded_array("d", [plateau(data)[0]])})
            at = {name: data["table"]["columns"].index(name) for name in ("afferent", "channel", "spikes")}
            row = list(data["table"]["rows"][0])
            row[at["afferent"]], row[at["channel"]], row[at["spikes"]] = "sa1", "second <b>", 1
            data["table"]["rows"].append(row)
        return with_changed_data(respond("press.html", "--afferent", "sa1", "--afferent", "fa1"), "two-channels.html", add)

    def shown(self):
        return Select(self.browser.find_element(By.ID, "channel")).first_selected_option.text

    def test_the_selector_changes_the_channel_and_keeps_the_window(self):
        t, force = plateau(self.data)
        window = self.js("corpuscle.setWindow(arguments[0], arguments[1]); return corpuscle.window()", t - 0.01, t + 0.01)
        Select(self.browser.find_element(By.ID, "channel")).select_by_visible_text("second <b>")
        self.assertEqual(self.panels(), ["force", "raster", "frequency"])
        self.assertEqual(self.windows(), [window] * 3)
        self.hover("force", t)
        self.assertAlmostEqual(si(self.readout("force", "force")), force / 2, delta=1e-3 * force)
        self.assertEqual((self.readout("raster", "sa1"), self.readout("raster", "fa1")), ("1", "0"))
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")), 1)

    def test_a_click_on_a_raster_row_selects_its_channel(self):
        plot = self.plot("raster")
        x, y, w, h = (self.js("return corpuscle.panels.raster.area")[k] for k in "xywh")
        row = y + 1.5 * h / 4  # sa1 on the second channel
        ActionChains(self.browser).move_to_element_with_offset(plot, 0, round(row - plot.size["height"] / 2)).click().perform()
        waiting(self.browser, 20).until(lambda _: self.shown() == "second <b>")

    def test_keys_reach_a_row_and_enter_selects_its_channel(self):
        first = self.shown()
        self.js("corpuscle.panels.raster.plot.focus()")
        ActionChains(self.browser).send_keys(Keys.ARROW_DOWN, Keys.ENTER).perform()
        waiting(self.browser, 20).until(lambda _: self.shown() != first)
        self.assertTrue(self.js("return document.activeElement === corpuscle.panels.raster.plot"), "the new raster has the focus")
        ActionChains(self.browser).send_keys(Keys.ARROW_UP, Keys.ENTER).perform()
        waiting(self.browser, 20).until(lambda _: self.shown() == first)

    def test_the_table_can_show_all_channels(self):
        self.browser.find_element(By.ID, "all-rows").click()
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")), len(self.data["table"]["rows"]))


class SpikesOnly(Page):
    @classmethod
    def report(cls):
        """No curves, and a million spikes of sa1."""
        def strip(data):
            clock = data["inputs"][0]
            data["traces"] = []
            step = clock["samples"] * clock["T"] / 1_000_000
            record = next(r for r in data["spikes"] if r["afferent"] == "sa1")
            record.update(count=1_000_000, times=encoded_array("d", (clock["t0"] + (k + 0.5) * step for k in range(1_000_000))))
        return with_changed_data(respond("press.html", "--afferent", "sa1", "--afferent", "fa1"), "spikes-only.html", strip)

    def test_raster_and_frequency_are_still_shown(self):
        dark_pixels = self.dark_pixels()
        self.assertEqual(self.panels(), ["raster", "frequency"])
        self.assertGreater(min(dark_pixels.values()), 80)
        self.assertEqual(self.readout("raster", "sa1"), "1000000")
        self.assertLess(self.js("return corpuscle.pointsDrawn().frequency.rows / corpuscle.pointsDrawn().frequency.width"), 3)


class FewCopies(Page):
    @classmethod
    def report(cls):
        return respond("few-copies.html", "--afferent", "sa1,fa1", "--copies", "20", "--spread", "sa1.V_th=10%", "--spread", "fa1.k_A=10%")

    def test_every_copy_has_a_row_and_the_first_one_has_curves(self):
        self.open_sections()
        self.assertEqual(self.panels(), ["force", "raster", "population", "frequency", "sa1 current", "sa1 membrane", "fa1 current", "fa1 membrane"])
        self.assertGreater(min(self.dark_pixels().values()), 80)
        labels = self.js("return corpuscle.panels.raster.rows.map(({label}) => label)")
        self.assertEqual(labels, [f"{name}#{k}" for name in ("sa1", "fa1") for k in range(1, 21)])
        shown = [text for text, *_ in self.texts("raster", "end")]
        self.assertEqual([text for text in labels if text in shown], shown, "as many labels as there is space for")
        self.assertGreater(len(shown), 12)
        self.assertIn("spikes of all 20 copies", self.browser.find_element(By.CSS_SELECTOR, '[data-panel="raster"]').text)
        self.assertIn("instantaneous frequency of copy 1", self.browser.find_element(By.CSS_SELECTOR, '[data-panel="frequency"]').text)
        first = max(spike_times(self.data, "sa1#1"))
        u, V_th = self.js("return corpuscle.valueAt('u', arguments[0], 'sa1')", first - self.input["T"]), self.data["afferents"][0]["V_th"]
        self.assertNotEqual(V_th, 0.5)
        self.assertLess(abs(u - V_th), 0.01, "just before its spike the membrane is at the threshold of that copy")

    def test_the_rate_is_the_mean_over_all_copies(self):
        for rate in self.data["copies"]["rates"]:
            trains = [r for r in self.data["spikes"] if r["afferent"].startswith(rate["afferent"] + "#")]
            self.assertEqual(len(trains), 20)
            self.assertAlmostEqual(sum(rate["values"]) * rate["bin"] * 20, sum(r["count"] for r in trains), places=6)
            times = [t for r in trains for t in numbers("d", r["times"])]
            k = max(range(len(rate["values"])), key=lambda bin: rate["values"][bin])
            within = sum(k * rate["bin"] <= t < (k + 1) * rate["bin"] for t in times)
            self.assertAlmostEqual(rate["values"][k], within / 20 / rate["bin"], places=6)
            self.hover("population", (k + 0.5) * rate["bin"])
            self.assertAlmostEqual(si(self.readout("population", rate["afferent"])), rate["values"][k], delta=6e-4 * rate["values"][k])

    def test_the_tables_have_means_and_deviations(self):
        cells = [cell.text for cell in self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr:nth-child(3) :is(th, td)")]
        self.assertEqual(cells[:3], ["sa1", "press", "plateau"])
        self.assertRegex(cells[3], r"^\d+\.\d ± \d+\.\d$")
        self.assertIn("500 mV ± 50 mV", self.browser.find_element(By.ID, "parameters").text.replace("\u00a0", " "))
        self.assertEqual(self.readout("raster", "sa1"), str(sum(r["count"] for r in self.data["spikes"] if r["afferent"].startswith("sa1#"))))


class ManyCopies(Page):
    @classmethod
    def report(cls):
        return respond("many-copies.html", "--afferent", "sa1,fa1", "--copies", "300", "--spread", "sa1.V_th=10%")

    def test_the_first_fifty_are_shown_with_a_note(self):
        self.assertEqual(self.panels(), ["force", "raster", "population", "frequency"])
        self.assertGreater(min(self.dark_pixels().values()), 80)
        self.assertEqual(len(self.data["spikes"]), 2 * 50)
        text = self.browser.find_element(By.ID, "figures").text
        self.assertIn("spikes of the first 50 of 300 copies; counts of these", text)
        self.assertIn("mean rate of all 300 copies", text)
        self.assertIn("instantaneous frequency of copy 1", text)
        self.assertIn("With more than 50 copies currents and membranes are not recorded", text)
        self.screenshot("many-copies.png")


class Million(Page):
    @classmethod
    def report(cls):
        return respond("million.html", "--rate", "1MHz")

    def test_the_drawn_points_are_bounded_by_the_width_not_by_the_samples(self):
        self.assertGreaterEqual(self.input["samples"], 1_000_000)
        self.open_sections()
        length = self.end - self.input["t0"]
        self.check_point_count()
        for fraction in (0.5, 0.1, 0.02):
            a, b = self.js("return corpuscle.window()")
            self.drag("force", a + 0.3 * (b - a), a + (0.3 + fraction) * (b - a))
            self.settle(lambda c, d: d - c < 0.9 * (b - a))
            self.check_point_count()
        self.assertLess(self.js("return corpuscle.window()[1] - corpuscle.window()[0]"), 0.01 * length)
        middle = self.input["t0"] + length / 2
        for samples in (5000, 1500, 200, 4):
            self.js("corpuscle.setWindow(arguments[0], arguments[1])", middle, middle + samples * self.input["T"])
            self.check_point_count()

    def check_point_count(self):
        for panel, drawn in self.js("return corpuscle.pointsDrawn()").items():
            self.assertGreater(drawn["width"], 500)
            self.assertLess(drawn["rows"], 3 * drawn["width"], panel)
            if panel not in ("raster", "frequency"):  # there may be no spike in the window
                self.assertGreater(drawn["rows"], 0, panel)

    def test_no_extreme_is_lost_in_thinning(self):
        self.open_sections()
        low, high, _ = trace(self.data, "force")
        self.assertEqual(self.drawn_extremes("force"), [min(low), max(high)])
        for afferent in self.data["afferents"][:1]:
            parts = [part["name"] for part in afferent["probes"] if part["unit"] == "V"]
            low, high, _ = trace(self.data, parts[0], afferent["name"])
            self.assertEqual(self.drawn_extremes(afferent["name"] + " membrane"), [min(low), max(high)])

    def drawn_extremes(self, panel):
        values = self.js("return corpuscle.panels[arguments[0]].points(0)", panel)[1::2]
        return [min(values), max(values)]


class Recorded(Page):
    @classmethod
    def report(cls):
        """A recording with hum, and one outlier in every fifty samples."""
        rows = "\n".join(str(9000 if k % 50 == 7 else round(1000 + 500 * math.sin(k / 90) + 100 * math.sin(math.tau * 50 * k / 242.6))) for k in range(3000))
        recording = OUT / "recorded.csv"
        recording.write_text("fz\n" + rows + "\n")
        path = OUT / "recorded.html"
        subprocess.run([CORPUSCLE, "respond", str(recording), "--rate", "242.6Hz", "--scale", "0.002", "--report", str(path), "--quiet"], check=True,
                       stderr=subprocess.DEVNULL)
        return path

    def test_the_page_reports_the_quality_of_the_recording(self):
        section = self.browser.find_element(By.ID, "quality")
        self.assertIn("are isolated outliers, probably transmission errors", section.find_element(By.TAG_NAME, "ul").text)
        cells = dict(zip((one.text for one in section.find_elements(By.CSS_SELECTOR, "thead th")), (one.text for one in section.find_elements(By.CSS_SELECTOR, "tbody :is(th, td)"))))
        self.assertEqual(cells["channel"], "fz")
        self.assertAlmostEqual(float(cells["outliers"]), 0.02, delta=0.001)
        self.assertAlmostEqual(float(cells["force_max (N)"]), 18, delta=0.01)


class Costs(Page):
    @classmethod
    def report(cls):
        return respond("costs.html", "--afferent", f"sa1,{pathlib.Path(__file__).resolve().parents[2] / 'circuits/spiker.cir'}")

    def test_a_netlist_has_a_table_of_costs_and_a_model_has_none(self):
        section = self.browser.find_element(By.ID, "costs")
        self.assertTrue(section.is_displayed())
        table, = section.find_elements(By.TAG_NAME, "table")
        self.assertIn("spiker.cir", section.text)
        cost, = self.data["costs"]
        power = cost["power"]["op"]
        self.assertAlmostEqual(sum(power["blocks_W"].values()) / power["delivered_W"], 1, places=5)
        last = table.find_elements(By.TAG_NAME, "tr")[-1].find_elements(By.CSS_SELECTOR, "th, td")
        self.assertEqual(last[2].text, f'{cost["area"]["total_m2"] * 1e12:.0f}')


if __name__ == "__main__":
    run_tests()
