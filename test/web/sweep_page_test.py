#!/usr/bin/python3
"""Tests of the page of a sweep (see browser.py)."""
from page_checks import *


def page_of(name, sweep, change=None):
    """The page of a sweep and its results file. `change` may change the results file before the page is written."""
    file, results, path = OUT / f"{name}.toml", OUT / f"{name}.sqlite", OUT / f"{name}.html"
    file.write_text(sweep)
    results.unlink(missing_ok=True)
    subprocess.run([CORPUSCLE, "sweep", str(file), "--out", str(results), "--quiet"], check=True, cwd=ROOT)
    if change:
        with contextlib.closing(sqlite3.connect(results)) as database, database:  # the second commits
            change(database)
    subprocess.run([CORPUSCLE, "sweep", "show", str(results), "--report", str(path), "--quiet"], check=True)
    return path


def items_of(path):
    """The rows of the table of items in the results file of a page, as dictionaries."""
    with contextlib.closing(sqlite3.connect(path.with_suffix(".sqlite"))) as database:
        database.row_factory = sqlite3.Row
        return [dict(row) for row in database.execute("SELECT * FROM items ORDER BY item")]


class SweepPages(Pages):
    def rows(self, section):
        return self.js("return [...document.querySelectorAll(`#${arguments[0]} tbody tr`)].map((row) => [...row.cells].map((one) => one.textContent))", section)

    def select(self, label, option):
        """Selects an option of the selector with this label."""
        menu = next(one for one in self.all("#toolbar label") if one.text.split("\n")[0].startswith(label)).find_element(By.TAG_NAME, "select")
        Select(menu).select_by_visible_text(option)
        self.settle()

    def curve(self, panel, number=0):
        """x and y of a curve of a panel."""
        return self.js("const {x, y} = corpuscle.panels[arguments[0]].curves[arguments[1]]; return [Array.from(x), Array.from(y)]", panel, number)


    def assert_close(self, shown, expected):
        self.assertEqual(shown.keys(), expected.keys())
        self.assertLess(max(abs(shown[key] - expected[key]) for key in shown), 1e-5)


class RandomItems(SweepPages):
    """60 chips of the bias generator at two temperatures."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path = page_of("chips", CHIPS)
        cls.data = data_of(cls.path)
        cls.summary = cls.data["summary"]

    def test_the_printed_tables_are_grouped_and_a_wrong_axis_is_corrected(self):
        results = str(self.path.with_suffix(".sqlite"))
        printed = subprocess.run([CORPUSCLE, "sweep", "show", results, "--by", "temp"], check=True, capture_output=True, text=True).stdout
        self.assertLess(printed.index("all limits"), printed.index("v(q) (mV)"))
        self.assertIn("temp = 85 degC", printed)
        wrong = subprocess.run([CORPUSCLE, "sweep", "show", results, "--by", "tmp"], capture_output=True, text=True)
        self.assertEqual((wrong.returncode, wrong.stderr.strip()), (2, "corpuscle: --by tmp: unknown axis; did you mean 'temp'? (known: temp)"))

    def test_yield_measures_influences_and_items_are_in_tables(self):
        self.open(self.path)
        self.assertLess(self.summary["all"]["passed"], 120)
        self.assertEqual(self.rows("yields")[0][2], f'{self.summary["all"]["passed"]} of 120')
        self.assertEqual(len(self.rows("points")), 2)
        self.assertEqual([row[0] for row in self.rows("measures")], [one["name"] for one in self.summary["measures"]])
        self.assertIn(self.summary["depends_on"][0]["devices"][0]["device"], [row[1] for row in self.rows("influences")])
        self.assertEqual(len(self.rows("failed")), 120 - self.summary["all"]["passed"])
        marked = self.texts_of("#failed .bad")
        self.assertTrue(marked and all(text.endswith("✗") for text in marked))
        body = self.browser.find_element(By.TAG_NAME, "body").text
        for unit in ("mV", "nA", "°C"):
            self.assertIn(unit, body)

    def test_only_what_is_drawn_at_random_has_a_confidence_interval(self):
        self.open(self.path)
        self.assertEqual(self.texts_of("#yields .range, #measures .range"), [])
        self.assertEqual(self.all("#measures [title*=…]"), [])
        self.assertEqual(len(self.texts_of("#points .range")), 2, "the chips of a temperature are random")
        self.assertIn("not random", self.texts_of("#measures h2")[0])

    def test_a_grid_with_random_items_has_a_line_of_means(self):
        self.open(self.path)
        x, y = self.js("const {x, y} = [...document.querySelectorAll('#means [data-panel]')].map((one) => corpuscle.panels[one.dataset.panel])[0].curves[0]; return [Array.from(x), Array.from(y)]")
        self.assertEqual(x, [27, 85])
        items = [one for one in items_of(self.path) if one["v(q)"] is not None]
        for temperature, mean in zip(x, y):
            values = [one["v(q)"] for one in items if one["temp"] == temperature]
            self.assertAlmostEqual(mean, sum(values) / len(values), delta=1e-7 * abs(mean))  # the page has single precision

    def test_each_panel_can_be_saved_and_each_table_printed(self):
        self.open(self.path)
        self.assertEqual(unsaved_panels(self.browser), [])
        self.assertEqual(cropped_tables(self.browser), [])

    def test_two_axes_with_random_items_have_a_heat_map_of_means(self):
        self.open(page_of("mixed", CHIPS.replace('samples = 60', 'samples = 3').replace('[limits]', '[[vary]]\nwhat = "supply"\nlist = ["0.65V", "0.7V", "0.75V"]\n[limits]')))
        self.assertEqual(self.drawn_points("v(q): heat map"), 6)

    def test_the_histogram_counts_all_items_and_the_figures_follow_the_selectors(self):
        self.open(self.path)
        self.assertEqual(self.panels()[:2], ["histogram", "normal plot"])
        self.assertEqual(len(self.panels()), 2 + len(self.data["factors"][0]) + 1)  # and the means over the temperature
        self.assertEqual(sum(self.curve("histogram")[1]), 120)
        self.assertEqual(len(self.curve("normal plot")[0]), 120)
        self.select("Colour by", "temp")
        for group in (0, 1):
            self.assertAlmostEqual(sum(self.curve("histogram", group)[1]), 100)  # per cent of each group
        self.assertIn("temp = 85 degC", self.texts_of("[data-panel=histogram] .legend-name"))
        self.select("Measure", "i(vis)")
        self.assertIn("i(vis)", self.texts_of("[data-panel=histogram] figcaption")[0])
        self.until(lambda: "#measure=i(vis)&colour=temp" in self.browser.current_url)

    def test_a_link_restores_the_selection_and_a_damaged_link_is_ignored(self):
        self.open(self.path, "#measure=i(vis)&colour=temp")
        self.assertEqual([Select(self.browser.find_element(By.ID, one)).first_selected_option.text for one in ("measure", "grouping")], ["i(vis)", "temp"])
        for link in ("#measure=nothing&colour=", "#measure=%E0%A4%A", "#<img src=x>", "#" + "a" * 5000):
            self.open(self.path, link)
            self.assertEqual(Select(self.browser.find_element(By.ID, "measure")).first_selected_option.text, "v(q)", link)

    def test_the_file_of_a_scatter_plot_has_the_mismatch_and_the_measure_of_each_item(self):
        self.open(self.path)
        name = self.panels()[2]
        rows = list(csv.reader(self.saved(name, "CSV").decode().splitlines()))
        self.assertEqual(rows[0][2], "v(q) (V)")
        measured = sorted(row["v(q)"] for row in items_of(self.path))
        values = sorted(float(row[2]) for row in rows[1:])
        self.assertEqual(len(values), len(measured))
        self.assertLess(max(abs(a - b) for a, b in zip(values, measured)), 1e-7)

    def test_a_point_shows_its_values(self):
        self.open(self.path)
        name = self.panels()[2]
        plot = self.plot(name)
        x, y = self.js("const p = corpuscle.panels[arguments[0]], [c] = p.placed; return [p.x(c.x[7]) - p.plot.clientWidth / 2, p.y(c.y[7]) - p.plot.clientHeight / 2]", name)
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, round(x), round(y)).perform()
        tip = self.until(lambda: self.js("const tip = corpuscle.panels[arguments[0]].plot.querySelector('.tip'); return tip.style.display === 'block' && tip.textContent", name))
        self.assertRegex(tip, r"V_T .*V, v\(q\) 3\d\d")

    def test_symbols_keep_their_subscripts_on_a_phone(self):
        self.open(self.path, "", 390)
        gaps = self.js("""return [...document.querySelectorAll("figcaption .symbol sub")].map((sub) => {
            const before = sub.previousSibling.getBoundingClientRect(), own = sub.getBoundingClientRect();
            return own.top < before.bottom ? own.left - before.right : 1e9;
        })""")
        self.assertGreater(len(gaps), 0)
        self.assertLess(max(map(abs, gaps)), 2)

    def test_it_fits_every_screen(self):
        self.assert_it_fits(self.path, "", "chips")
        self.assert_contrast(self.path)
        self.open(self.path, "", 390)
        self.assertEqual(self.js("return [...document.querySelectorAll('.scroll')].filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent.slice(0, 60))"), [])

    def test_spikes_and_traces_of_items_are_drawn_with_their_units(self):
        path = page_of("traced", TRACED)
        self.open(path)
        data, rows = data_of(path), items_of(path)
        self.assertEqual(self.drawn_points("sa1 spikes"), sum(row["spikes"] for row in rows))
        self.assertEqual([one["unit"] for one in data["traces"]], ["A", "V"])
        low, high = (floats(data["traces"][1][end]) for end in ("min", "max"))
        bands = self.js("return corpuscle.panels.u.curves[0].bands.map(({low, high}) => [Array.from(low), Array.from(high)])")
        self.assertEqual(bands[0], [low, high])
        self.assertIn("I_A (µA)", re.sub(r"<[^>]*>", "", self.js("return corpuscle.panels.I_A.svg()")).replace("\n", "").replace("IA", "I_A"))
        plot = self.plot("sa1 spikes")
        x = self.js("const p = corpuscle.panels['sa1 spikes'], row = p.rows[0]; return p.x(row.spikes.times[0]) - p.plot.clientWidth / 2")
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, round(x), round(5 - plot.size["height"] / 2)).perform()
        tip = self.until(lambda: self.js("const tip = corpuscle.panels['sa1 spikes'].plot.querySelector('.tip'); return tip.style.display === 'block' && tip.textContent"))
        self.assertRegex(tip, r"^item \d+.*spike 1 of")

        def forget_units(database):
            database.execute("DELETE FROM about WHERE key = 'trace_units'")  # as in files of earlier versions

        earlier = page_of("traced_earlier", TRACED, forget_units)
        self.assertEqual([one["unit"] for one in data_of(earlier)["traces"]], ["", ""])
        self.open(earlier)
        self.assertIn("u", self.panels())


class Grids(SweepPages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path = page_of("grid", GRID)
        cls.large = page_of("grid3", GRID3)

    def test_a_grid_has_a_heat_map_lines_over_both_axes_and_no_random_statistics(self):
        self.open(self.path)
        influences = [row[:2] for row in self.rows("influences")]
        for measure in ("spikes", "peak_rate"):
            for axis in ("press.F_max", "sa1.f_B", "interactions"):
                self.assertEqual(influences.count([measure, axis]), 1)
        self.assertEqual(self.panels()[:3], ["spikes: heat map", "spikes over press.F_max", "spikes over sa1.f_B"])
        self.assertEqual([self.js("return corpuscle.panels[arguments[0]].curves.map(({x}) => x.length)", name) for name in self.panels()[1:3]], [[4, 4, 4], [3, 3, 3, 3]])
        text = self.browser.find_element(By.TAG_NAME, "body").text
        for statistic in ("95 %", "±", "normal", "chips", "sigma", "CI"):
            self.assertNotIn(statistic, text)
        colours = self.js("""const {area, canvas, data} = corpuscle.panels["spikes: heat map"], ratio = canvas.width / canvas.clientWidth, context = canvas.getContext("2d"), found = new Set();
            data.xs.forEach((_, i) => data.ys.forEach((__, j) => found.add(context.getImageData((area.x + (i + 0.1) / 4 * area.w) * ratio, (area.y + (j + 0.1) / 3 * area.h) * ratio, 1, 1).data.join())));
            return found.size""")
        self.assertEqual(colours, len({row["spikes"] for row in items_of(self.path)}))

    def test_each_panel_can_be_saved_and_each_table_printed(self):
        self.open(self.path)
        self.assertEqual(unsaved_panels(self.browser), [])
        self.assertEqual(cropped_tables(self.browser), [])

    def test_units_are_at_every_value(self):
        self.open(self.path)
        head = self.texts_of("#extremes thead th")
        for name in ("press.F_max (N)", "sa1.f_B (Hz)", "peak_rate (Hz)", "first_spike (s)"):
            self.assertIn(name, head)
        self.assertTrue(all(re.fullmatch(r"–|[\d.]+\u00a0m?s", row[-1]) for row in self.rows("extremes")), self.rows("extremes"))

    def test_every_axis_can_be_chosen_and_the_others_have_a_value_or_are_averaged(self):
        self.open(self.large)
        rows, axes = items_of(self.large), ["press.F_max", "sa1.f_B", "sa1.V_th"]
        self.assertEqual([row[0] for row in self.rows("axes")], axes)
        self.assertEqual(sorted(name for name in self.panels() if name.startswith("effect")), sorted(f"effect of {axis}" for axis in axes))
        self.select("Across", "sa1.f_B")
        self.select("Up", "sa1.V_th")

        def expected(force=None):
            cells = {}
            for row in rows:
                if force is None or row["press.F_max"] == force:
                    cells.setdefault((row["sa1.f_B"], row["sa1.V_th"]), []).append(row["spikes"])
            return {cell: sum(values) / len(values) for cell, values in cells.items()}

        def shown():
            table = list(csv.reader(self.saved("spikes: heat map", "CSV").decode().splitlines()))
            self.assertEqual(table[0], ["sa1.f_B (Hz)", "sa1.V_th (V)", "spikes"])
            return {(float(x), float(y)): float(value) for x, y, value in table[1:]}

        self.assert_close(shown(), expected())
        self.select("press.F_max", "4\u00a0N")
        self.until(lambda: self.browser.current_url.endswith("&at=4%2C%2C"))
        self.assert_close(shown(), expected(4))
        self.assertIn("press.F_max 4\u00a0N", self.texts_of("[data-panel='spikes: heat map'] figcaption")[0])
        self.assertEqual([self.curve("spikes over sa1.f_B", k)[1] for k in range(2)], [[expected(4)[(f_B, V_th)] for f_B in (20, 40, 80)] for V_th in (0.4, 0.6)])
        link = self.browser.current_url.split("#")[1]
        self.open(self.large, "#" + link)
        self.assert_close(shown(), expected(4))
        self.open(self.large, "#across=sa1.f_B&up=sa1.f_B&at=77,,")
        self.assertIn("press.F_max", self.texts_of("[data-panel='spikes: heat map'] figcaption")[0])

    def test_a_grid_with_too_many_items_for_the_page_has_the_means_of_each_pair_of_axes(self):
        def drop_items(data):
            data["summary"]["finished"] += 1

        path = with_changed_data(self.large, "grid_of_many_items.html", drop_items)
        self.open(path, "#across=sa1.V_th&up=sa1.f_B")
        self.assertEqual([one.text.split("\n")[0].split(" ")[0] for one in self.all("#toolbar .choosers label")], ["Across", "Up"])
        cells = {}
        for row in items_of(self.large):
            cells.setdefault((row["sa1.V_th"], row["sa1.f_B"]), []).append(row["spikes"])
        table = list(csv.reader(self.saved("spikes: heat map", "CSV").decode().splitlines()))[1:]
        self.assertEqual(len(table), len(cells))
        for V_th, f_B, value in table:
            values = cells[float(V_th), float(f_B)]
            self.assertAlmostEqual(float(value), sum(values) / len(values), places=4)

    def test_a_sweep_without_measures_shows_its_spikes(self):
        path = page_of("no_measures", ONE_AXIS.replace('["spikes"]', "[]"))
        self.open(path)
        self.assertEqual(self.panels(), ["sa1 spikes"])

    def test_an_axis_of_words_shows_its_words(self):
        path = page_of("corners", CORNERS)
        self.open(path)
        texts = re.findall(r">([a-z]{2})</text>", self.js("return corpuscle.panels['v(q) over corner'].svg()"))
        self.assertEqual(texts, ["tt", "ss", "ff"])
        self.assertIn("tt, ss, ff", self.rows("axes")[0][2])

    def test_one_axis_has_a_line_and_no_heat_map(self):
        path = page_of("one_axis", ONE_AXIS)
        self.open(path)
        self.assertEqual(self.panels()[0], "spikes over press.F_max")
        self.assertNotIn("heat", " ".join(self.panels()))
        self.assertEqual(self.curve("spikes over press.F_max"), [[1, 2, 4], [row["spikes"] for row in items_of(path)]])

    def test_a_cell_of_the_heat_map_shows_its_value(self):
        self.open(self.path)
        plot = self.plot("spikes: heat map")
        x, y = self.js("const p = corpuscle.panels['spikes: heat map']; return [p.x(3.5) - p.plot.clientWidth / 2, p.y(0.5) - p.plot.clientHeight / 2]")
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, round(x), round(y)).perform()
        tip = self.until(lambda: self.js("const tip = corpuscle.panels['spikes: heat map'].plot.querySelector('.tip'); return tip.style.display === 'block' && tip.textContent"))
        row = next(one for one in items_of(self.path) if one["press.F_max"] == 4 and one["sa1.f_B"] == 20)
        self.assertEqual(tip.replace("\u00a0", " "), f"press.F_max 4 N, sa1.f_B 20 Hz: {row['spikes']:g}")

    def test_it_fits_every_screen(self):
        self.assert_it_fits(self.large, "", "grid")
        self.open(self.large, "", 390)
        self.assertEqual(self.js("return [...document.querySelectorAll('.scroll')].filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent.slice(0, 60))"), [])


class ForeignFiles(SweepPages):
    def test_no_text_of_a_results_file_becomes_a_script(self):
        def poison(database):
            database.execute("UPDATE columns SET unit = ?", (PAYLOAD,))
            database.execute("UPDATE columns SET description = ?", (PAYLOAD,))
            database.execute("UPDATE about SET value = ? WHERE key = 'title'", (PAYLOAD,))
            database.execute("UPDATE items SET why = ?, ended = 'diverged' WHERE item = 3", (PAYLOAD,))
            database.execute("UPDATE about SET value = ? WHERE key = 'trace_units'", (json.dumps([PAYLOAD] * 2),))

        for name, sweep in (("poisoned", GRID), ("poisoned_chips", CHIPS), ("poisoned_traces", TRACED)):
            self.open(page_of(name, sweep, poison))
            self.assertGreater(len(self.panels()), 2)
            self.assert_text_stays_text()
            for panel in self.panels():
                self.assertNotIn("<img", self.js("return corpuscle.panels[arguments[0]].svg()", panel))

    def test_names_of_axes_measures_trains_and_groups_stay_text(self):
        def poison(data):
            for one in [*data["summary"]["axes"], *data["summary"]["measures"], *data["summary"]["all"]["measures"], *data["rasters"]]:
                one["name"] = PAYLOAD
            for one in data["groupings"]:
                one["name"], one["groups"] = PAYLOAD, [PAYLOAD] * len(one["groups"])

        self.open(with_changed_data(page_of("named", GRID), "named_poison.html", poison))
        self.assertGreater(len(self.all("figure")), 2)
        self.assert_text_stays_text()


GRID = """
afferent = "sa1"
force = "press"
measures = ["spikes", "peak_rate", "first_spike"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "3N", "4N"]
[[vary]]
what = "sa1.f_B"
list = ["20Hz", "40Hz", "80Hz"]
"""

GRID3 = """
afferent = "sa1"
force = "press"
measures = ["spikes", "peak_rate"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "4N"]
[[vary]]
what = "sa1.f_B"
list = ["20Hz", "40Hz", "80Hz"]
[[vary]]
what = "sa1.V_th"
list = ["0.4V", "0.6V"]
"""

ONE_AXIS = """
afferent = "sa1"
force = "press"
measures = ["spikes"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "4N"]
"""

CORNERS = """
netlist = "circuits/bias.cir"
measures = ["v(q)", "i(vis)"]
[[vary]]
what = "corner"
list = ["tt", "ss", "ff"]
[[vary]]
what = "temp"
list = [27, 85]
"""

TRACED = """
afferent = "sa1"
force = "press"
samples = 12
measures = ["spikes", "first_spike"]
keep = ["spikes"]
traces = ["I_A", "u"]
[[vary]]
what = "V_th"
how = "sobol"
sigma = "5%"
"""

CHIPS = """
netlist = "circuits/bias.cir"
samples = 60
measures = ["v(q)", "i(vis)"]
[set]
corner = "mc"
[[vary]]
what = "mismatch"
[[vary]]
what = "temp"
list = [27, 85]
[limits]
"v(q)" = ["349mV", "351mV"]
"""


if __name__ == "__main__":
    run_tests()
