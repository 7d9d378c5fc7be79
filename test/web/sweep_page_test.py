#!/usr/bin/python3
"""Tests of the page of a sweep (see browser.py)."""
from browser import *


class Sweeps(unittest.TestCase):
    """The page of a sweep: 60 chips of the bias generator at two temperatures."""

    def test_yields_plots_and_devices_are_shown_and_follow_the_selectors(self):
        sweep, results, path = OUT / "chips.toml", OUT / "chips.sqlite", OUT / "chips.html"
        sweep.write_text(SWEEP)
        results.unlink(missing_ok=True)
        subprocess.run([CORPUSCLE, "sweep", str(sweep), "--out", str(results), "--quiet"], check=True, cwd=ROOT)
        subprocess.run([CORPUSCLE, "sweep", "show", str(results), "--report", str(path), "--quiet"], check=True)
        data = data_of(path)
        printed_table = subprocess.run([CORPUSCLE, "sweep", "show", str(results), "--by", "temp"], check=True, capture_output=True, text=True).stdout
        self.assertLess(printed_table.index("all limits"), printed_table.index("v(q) (mV)"))
        self.assertIn("temp = 85 degC", printed_table)
        wrong = subprocess.run([CORPUSCLE, "sweep", "show", str(results), "--by", "tmp"], capture_output=True, text=True)
        self.assertEqual((wrong.returncode, wrong.stderr.strip()),
                         (2, "corpuscle: --by tmp: unknown axis; did you mean 'temp'? (known: temp)"))
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            options = webdriver.ChromeOptions()
            options.binary_location = shutil.which("chromium")
            for flag in [*FLAGS, "--user-data-dir=" + profile]:
                options.add_argument(flag)
            browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
            self.addCleanup(browser.quit)
            browser.get(path.as_uri())
            summary = data["summary"]
            first = browser.find_elements(By.CSS_SELECTOR, "#yields tbody tr")[0].text
            self.assertLess(summary["all"]["passed"], 120)
            self.assertIn(f'{summary["all"]["passed"]} of 120', first)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#points tbody tr")), 2)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#measures tbody tr")), len(summary["measures"]))
            found = [one["device"] for one in summary["depends_on"][0]["devices"]]
            self.assertIn(found[0], browser.find_element(By.ID, "influences").text)
            counted = "return charts[0].rawData_.reduce((sum, row) => sum + row[1], 0)"  # the sum of the histogram
            self.assertEqual(browser.execute_script(counted), 120)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#figures figure")), 2 + len(data["factors"][0]))
            Select(browser.find_element(By.ID, "grouping")).select_by_visible_text("temp")
            self.assertAlmostEqual(browser.execute_script(counted), 100, places=6)  # per cent in each group
            self.assertIn("temp = 85", browser.find_element(By.ID, "key").text)
            Select(browser.find_element(By.ID, "measure")).select_by_visible_text("i(vis)")
            self.assertIn("i(vis)", browser.find_element(By.CSS_SELECTOR, "#figures figcaption").text)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#failed tbody tr")), 120 - summary["all"]["passed"])
            self.assertEqual(missing_values(browser), [])
            self.assertEqual(browser.get_log("browser"), [])

    def browse(self, path, width=1400):
        profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(profile.cleanup)
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in [*FLAGS, "--user-data-dir=" + profile.name]:
            options.add_argument(flag)
        browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.addCleanup(browser.quit)
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 2 if width < 600 else 1, "mobile": False})
        browser.get(path.as_uri())
        return browser

    def page_of(self, name, sweep, change=None):
        """The page of a sweep. `change` may change the results file before the page is written."""
        file, results, path = OUT / f"{name}.toml", OUT / f"{name}.sqlite", OUT / f"{name}.html"
        file.write_text(sweep)
        results.unlink(missing_ok=True)
        subprocess.run([CORPUSCLE, "sweep", str(file), "--out", str(results), "--quiet"], check=True, cwd=ROOT)
        if change:
            with contextlib.closing(sqlite3.connect(results)) as database, database:  # the second commits
                change(database)
        subprocess.run([CORPUSCLE, "sweep", "show", str(results), "--report", str(path), "--quiet"], check=True)
        return path

    def test_a_plain_grid_has_lines_over_every_axis_and_a_heat_map_and_no_random_statistics(self):
        path = self.page_of("grid", GRID)
        browser = self.browse(path)
        self.assertEqual(browser.get_log("browser"), [])
        matters = browser.find_element(By.ID, "influences").text
        for axis in ("press.F_max", "sa1.f_B"):
            self.assertEqual(matters.count(axis), 2, matters)
        self.assertIn("interactions", matters)
        self.assertEqual(missing_values(browser), [])
        captions = [one.text for one in browser.find_elements(By.CSS_SELECTOR, "#figures figcaption")]
        self.assertEqual(len(captions), 3, captions)
        self.assertTrue(captions[0].startswith("spikes over press.F_max"), captions)
        self.assertTrue(captions[1].startswith("spikes over sa1.f_B"), captions)
        self.assertEqual(browser.execute_script("return charts.map((chart) => [chart.numRows(), chart.numColumns() - 1])"), [[4, 3], [3, 4]])
        text = browser.find_element(By.TAG_NAME, "body").text
        for statistic in ("95 %", "±", "normal", "chips", "sigma"):
            self.assertNotIn(statistic, text)
        colours = browser.execute_script("""
            const canvas = document.querySelector(".heat canvas"), context = canvas.getContext("2d"), found = new Set();
            for (let i = 0; i < 4; ++i) for (let j = 0; j < 3; ++j) {
                const x = HEAT.left + (i + 0.5) / 4 * (canvas.clientWidth - HEAT.left - HEAT.right), y = HEAT.top + (j + 0.5) / 3 * (260 - HEAT.top - HEAT.bottom);
                found.add(context.getImageData(x * devicePixelRatio, y * devicePixelRatio, 1, 1).data.join());
            }
            return found.size""")
        self.assertGreaterEqual(colours, len({round(v) for row in data_of(path)["grids"][0]["pairs"][0]["means"] for v in row}))

    def test_no_text_of_a_results_file_becomes_a_script(self):
        payload = '"><img src=x onerror="document.title=1"><script>document.title=1</script>'

        def poison(database):
            database.execute("UPDATE columns SET unit = ?", (payload,))
            database.execute("UPDATE columns SET description = ?", (payload,))
            database.execute("UPDATE about SET value = ? WHERE key = 'title'", (payload,))
            database.execute("UPDATE items SET why = ?, ended = 'diverged' WHERE item = 3", (payload,))

        for name, sweep in (("poisoned", GRID), ("poisoned_chips", SWEEP)):
            browser = self.browse(self.page_of(name, sweep, poison))
            self.assertEqual(browser.get_log("browser"), [])
            self.assertNotEqual(browser.title, "1")
            self.assertEqual(browser.find_elements(By.CSS_SELECTOR, "img"), [])
            self.assertEqual(browser.execute_script("return [...document.querySelectorAll('body script')].every((one) => one.id || !one.textContent.includes('document.title=1'))"), True)

    def test_it_fits_a_narrow_window_and_its_subscripts_are_complete(self):
        for name, sweep in (("narrow_grid", GRID), ("narrow_chips", SWEEP)):
            browser = self.browse(self.page_of(name, sweep), 390)
            self.assertLessEqual(browser.execute_script("return document.documentElement.scrollWidth"), 390)
            sideways = browser.execute_script("return [...document.querySelectorAll('.scroll')].filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent.slice(0, 60))")
            self.assertEqual(sideways, [])
        gaps = browser.execute_script("""
            return [...document.querySelectorAll("figcaption sub")].map((sub) => {
                const range = document.createRange();
                range.selectNode(sub.previousSibling);
                const before = [...range.getClientRects()].at(-1), own = sub.getBoundingClientRect();
                return own.top < before.bottom ? own.left - before.right : 1e9;
            })""")
        self.assertGreater(len(gaps), 0)
        self.assertLess(max(map(abs, gaps)), 2)


GRID = """
afferent = "sa1"
force = "press"
measures = ["spikes", "peak_rate"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "3N", "4N"]
[[vary]]
what = "sa1.f_B"
list = ["20Hz", "40Hz", "80Hz"]
"""

SWEEP = """
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
