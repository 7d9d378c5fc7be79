#!/usr/bin/python3
"""Tests of the pages of `corpuscle study` and `corpuscle fit transistor` (see browser.py)."""
from browser import *


class Studies(unittest.TestCase):
    def test_every_claim_has_a_row_and_every_plot_is_drawn(self):
        path = OUT / "studies.html"
        subprocess.run([CORPUSCLE, "study", "fig16", "kim", "--report", str(path), "--quiet"], check=True)
        data = data_of(path)
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            options = webdriver.ChromeOptions()
            options.binary_location = shutil.which("chromium")
            for flag in [*FLAGS, "--user-data-dir=" + profile]:
                options.add_argument(flag)
            browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
            self.addCleanup(browser.quit)
            browser.get(path.as_uri())
            self.assertEqual(browser.get_log("browser"), [])
            claims = [claim for study in data["studies"] for claim in study["claims"]]
            on_top = browser.find_elements(By.CSS_SELECTOR, ".deviations tbody tr")
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, ".claims tbody tr")) - len(on_top), len(claims))
            self.assertEqual(len(on_top), sum(claim["on_top"] for claim in claims))
            browser.find_element(By.CSS_SELECTOR, ".deviations input").click()
            shown = [row for row in on_top if row.is_displayed()]
            self.assertEqual(len(shown), sum(claim["verdict"] in ("differs", "does not hold") for claim in claims))
            self.assertLess(len(shown), len(on_top))
            browser.find_element(By.CSS_SELECTOR, ".deviations input").click()
            self.the_kinds(browser, data, [claim for claim in claims if claim["on_top"]], on_top)
            link = on_top[0].find_element(By.TAG_NAME, "a").get_attribute("href")
            self.assertEqual(len(browser.find_elements(By.ID, link.split("#")[1])), 1)
            points = browser.execute_script("return charts.map((chart) => chart.numRows())")
            self.assertEqual(len(points), sum(len(study["plots"]) for study in data["studies"]))
            self.assertGreater(min(points), 2)
            self.assertEqual(missing_values(browser), [])
            self.the_fitted_transistor(browser)
            browser.get(path.as_uri())
            self.on_a_telephone(browser)

    def the_fitted_transistor(self, browser):
        """The page of 'fit transistor' draws all curves, with one key for the points and the line of a curve."""
        path = OUT / "transistor.html"
        subprocess.run([CORPUSCLE, "fit", "transistor", str(ROOT / "examples/data/nmos.raw"), "-W", "1.5u", "-L", "0.5u", "--report", str(path), "--quiet"],
                       check=True)
        data = data_of(path)
        browser.get(path.as_uri())
        self.assertEqual(browser.get_log("browser"), [])
        self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "tbody tr")), len(data["fit"]["parameters"]))
        self.assertEqual(browser.execute_script("return charts.length"), 6)
        keys = browser.find_elements(By.CSS_SELECTOR, "figure:first-child .key .chip")
        self.assertEqual(len(keys), len(data["plots"][0]["series"]) / 2)
        self.assertEqual(missing_values(browser), [])

    def the_kinds(self, browser, data, claims, rows):
        """The table of kinds has the counts, and the menu leaves the rows of one kind."""
        counts = [[cell.text for cell in row.find_elements(By.CSS_SELECTOR, ".number")] for row in browser.find_elements(By.CSS_SELECTOR, ".kinds tbody tr")]
        self.assertEqual(counts, [[str(kind[group][verdict]) for group in ("printed", "derived", "statements") for verdict in ("agreeing", "deviating")]
                                  for kind in data["kinds"]])
        menu = Select(browser.find_element(By.CSS_SELECTOR, ".deviations select"))
        self.assertGreater(len(menu.options), 2)
        for name in [option.text for option in menu.options[1:]]:
            menu.select_by_visible_text(name)
            shown = [row.is_displayed() for row in rows]
            self.assertEqual(shown, [bool(claim["verdict"]) and claim["kind"] == name for claim in claims], name)
        menu.select_by_visible_text("all")
        self.assertTrue(all(row.is_displayed() for row in rows))

    def on_a_telephone(self, browser):
        """A claim fits the width of the screen and is a few lines high."""
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        browser.refresh()
        self.assertEqual(browser.execute_script("return document.documentElement.scrollWidth"), 390)
        boxes = browser.execute_script("""return [...document.querySelectorAll("tbody tr, tbody tr .reason")].map((one) => {
            const {right, height} = one.getBoundingClientRect(); return [right, height]; })""")
        self.assertLessEqual(max(right for right, _ in boxes), 390)
        self.assertLess(max(height for _, height in boxes), 260)


if __name__ == "__main__":
    run_tests()
