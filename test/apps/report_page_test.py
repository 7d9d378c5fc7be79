#!/usr/bin/python3
"""Tests of the report pages in a real browser:   report_page_test.py CORPUSCLE OUTDIR

Writes reports with the program, opens them in headless Chromium, uses them as a reader would, and compares the displayed
values with the data in the page. Screenshots such as OUTDIR/press.png remain for inspection.
"""
import base64
import contextlib
import csv
import json
import math
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from array import array

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

FLAGS = ("--headless=new --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
         "--disable-component-update --disable-sync --window-size=1200,900").split()
DATA = re.compile(r'(<script type="application/json" id="data">)(.*?)(</script>)', re.S)
PREFIX = {"f": 1e-15, "p": 1e-12, "n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1, "k": 1e3, "M": 1e6}

CORPUSCLE, OUT = None, None
ROOT = pathlib.Path(__file__).resolve().parents[2]


def respond(name, *arguments):
    """Writes a report of the press with the program, and returns its path."""
    path = OUT / name
    subprocess.run([CORPUSCLE, "respond", "press", *arguments, "--report", str(path), "--quiet"], check=True, cwd=ROOT)
    return path


def data_of(path):
    return json.loads(DATA.search(path.read_text())[2])


def with_changed_data(path, name, change):
    """A copy of a page with changed data, e.g. with several channels, which `respond press` does not have."""
    data = data_of(path)
    change(data)
    text = json.dumps(data).replace("<", "\\u003c")
    changed = OUT / name
    changed.write_text(DATA.sub(lambda m: m[1] + text + m[3], path.read_text()))
    return changed


def numbers(kind, text):
    values = array(kind)
    values.frombytes(base64.b64decode(text))
    return values


def base64_of(kind, values):
    return base64.b64encode(array(kind, values).tobytes()).decode()


def trace(data, quantity, afferent=None, channel=None):
    """Minima and maxima of the buckets of a curve, and the samples in a bucket. With 1 sample the two are equal."""
    channel = data["inputs"][0]["channels"][0]["id"] if channel is None else channel
    record = next(r for r in data["traces"] if (r["quantity"], r["afferent"], r["channel"]) == (quantity, afferent, channel))
    values = numbers("f", record["data"])
    return (values, values, 1) if record["bucket"] == 1 else (values[0::2], values[1::2], record["bucket"])


def spike_times(data, afferent):
    return numbers("d", next(r for r in data["spikes"] if r["afferent"] == afferent)["times"])


def plateau(data):
    """The middle (s) of the longest interval of maximum force, and that force (N)."""
    low, _, bucket = trace(data, "force")
    top, best, run = max(low), (0, 0), 0
    for k, value in enumerate(low):
        run = run + 1 if value == top else 0
        best = max(best, (run, k))
    clock = data["inputs"][0]
    return clock["t0"] + (best[1] - best[0] / 2) * bucket * clock["T"], top


def si(text):
    """A readout as a number: "1.250 µA" is 1.25e-6."""
    number, prefix = re.fullmatch(r"(−?[\d.]+)\s?([fpnµmkM]?)(?:N|A|V|Hz|s)", text.strip()).groups()
    return float(number.replace("−", "-")) * PREFIX[prefix]


def frames(record):
    """The nonzero values of a map: for each frame, {position: value}."""
    source, all_frames = iter(base64.b64decode(record["data"])), []

    def number():
        n, shift = 0, 0
        for byte in source:
            n, shift = n | (byte & 127) << shift, shift + 7
            if byte < 128:
                return n

    for _ in range(record["count"]):
        position, frame = 0, {}
        while position < record["places"]:
            byte = next(source)
            if byte == 0:
                position += number()
                continue
            frame[position] = byte if byte < 255 else number()
            position += 1
        all_frames.append(frame)
    return all_frames


def missing_values(browser):
    """Words of the page that a script writes if a key or a number is missing."""
    text = browser.execute_script("""return [...document.body.querySelectorAll("*")].filter((one) => !["SCRIPT", "STYLE"].includes(one.tagName))
        .flatMap((one) => [...one.childNodes].filter((child) => child.nodeType === Node.TEXT_NODE).map((child) => child.data)).join(" ")""")
    return re.findall(r".{0,40}(?:undefined|NaN|\[object ).{0,40}", text)


class Page(unittest.TestCase):
    """A browser with one report open. No test may cause a message in the console or show a missing value."""

    @classmethod
    def setUpClass(cls):
        cls.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(cls.profile.cleanup)
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in [*FLAGS, "--user-data-dir=" + cls.profile.name]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        cls.addClassCleanup(cls.browser.quit)
        cls.path = cls.report()
        cls.data = data_of(cls.path)

    def setUp(self):
        self.browser.get(self.path.as_uri())
        # On a busy machine get() sometimes returned while the previous, empty page was still shown.
        is_loaded = "return location.href === arguments[0] && document.readyState === 'complete'"
        WebDriverWait(self.browser, 30).until(lambda browser: browser.execute_script(is_loaded, self.path.as_uri()))
        self.input = self.data["inputs"][0]
        self.end = self.input["t0"] + self.input["samples"] * self.input["T"]

    def tearDown(self):
        console_messages = [e["message"] for e in self.browser.get_log("browser") if e["level"] != "INFO"]
        # This advice of Chromium concerns only this test, which reads pixels.
        self.assertEqual([text for text in console_messages if "willReadFrequently" not in text], [])
        self.assertEqual(missing_values(self.browser), [])

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def windows(self):
        """The time window of each dygraph."""
        return self.js("return Object.values(corpuscle.charts).map((chart) => chart.xAxisRange())")

    def settle(self, moved):
        """Waits until all panels are drawn with a window (a, b) for which `moved(a, b)` is true."""
        WebDriverWait(self.browser, 20).until(lambda _: all(moved(*window) for window in self.windows()))

    def plot(self, panel):
        found = self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .plot')
        self.js("arguments[0].scrollIntoView({block: 'center'})", found)
        return found

    def at_time(self, panel, t):
        """The position of time t in a panel, in pixels from the middle of its plot."""
        plot = self.plot(panel)
        x = self.js("return corpuscle.charts[arguments[0]].toDomXCoord(arguments[1])", panel, t)
        return plot, round(x - plot.size["width"] / 2)

    def drag(self, panel, begin, end, key=None):
        plot, x = self.at_time(panel, begin)
        _, to = self.at_time(panel, end)
        mouse = ActionChains(self.browser, duration=50)
        mouse = mouse.key_down(key) if key else mouse
        mouse.move_to_element_with_offset(plot, x, 0).click_and_hold().move_by_offset((to - x) // 2, 3).move_by_offset((to - x) - (to - x) // 2, 3).release()
        (mouse.key_up(key) if key else mouse).perform()

    def hover(self, panel, t):
        plot, x = self.at_time(panel, t)
        self.js("document.getElementById('now').textContent = ''")
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, x, 0).perform()
        WebDriverWait(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "now").text)

    def readout(self, panel, series):
        return self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] [data-series="{series}"] .legend-value').text

    def panels(self):
        return self.js("return Object.keys(corpuscle.charts)")

    def dark_pixels(self):
        """For each panel, the number of pixels of the plot that are darker than bands and grid."""
        return self.js("""
            return Object.fromEntries(Object.entries(corpuscle.charts).map(([name, chart]) => {
                const canvas = document.querySelector(`[data-panel="${name}"] canvas`), ratio = canvas.width / canvas.clientWidth;
                const {x, y, w, h} = chart.getArea();
                const pixels = canvas.getContext("2d").getImageData((x + 3) * ratio, (y + 2) * ratio, (w - 4) * ratio, (h - 4) * ratio).data;
                let count = 0;
                for (let i = 0; i < pixels.length; i += 4)
                    if (pixels[i + 3] > 100 && Math.min(pixels[i], pixels[i + 1], pixels[i + 2]) < 170) ++count;
                return [name, count];
            }))""")

    @contextlib.contextmanager
    def screen(self, width, height, pixel_ratio):
        """Loads the page again on a screen of this size."""
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": pixel_ratio, "mobile": width < 600})
        try:
            self.browser.get(self.path.as_uri())
            self.js("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
            yield
        finally:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def screenshot(self, name):
        self.browser.set_window_size(1200, 900)
        height = self.js("scrollTo(0, 0); return document.documentElement.scrollHeight")
        self.browser.set_window_size(1200, height + 160)  # the height of the browser's own controls, with some margin
        self.js("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.browser.save_screenshot(str(OUT / name))
        self.browser.set_window_size(1200, 900)


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
        self.assertEqual(re.findall(r"https?://[^\s\"')]*", text), [])
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["']?(?!data:)[\w./]|url\(\s*["']?(?!data:)|@import""", text.split("<script", 1)[0]), [])
        self.assertEqual(re.findall(r"<script[^>]*\bsrc\b|<link[^>]*stylesheet", text), [])
        self.assertNotIn("{{page", text)

    def test_every_panel_is_present_and_drawn(self):
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

    def test_buttons_and_keys_zoom_too(self):
        length = self.end - self.input["t0"]
        self.browser.find_element(By.ID, "in").click()
        self.settle(lambda a, b: abs(b - a - length / 2) < 1e-9)
        self.browser.find_element(By.TAG_NAME, "body").send_keys("+")
        self.settle(lambda a, b: abs(b - a - length / 4) < 1e-9)
        self.browser.find_element(By.ID, "out").click()
        self.settle(lambda a, b: abs(b - a - length / 2) < 1e-9)
        self.browser.find_element(By.ID, "reset").click()
        self.settle(lambda a, b: abs(b - a - length) < 1e-9)

    def test_the_force_read_on_the_plateau_is_the_force_of_the_data(self):
        t, force = plateau(self.data)
        self.hover("fa1 current", t)  # the cursor is shared: the pointer is in one panel, the values are read in another
        self.assertAlmostEqual(si(self.readout("force", "force")), force, delta=1e-3 * force)
        self.assertAlmostEqual(self.js("return corpuscle.valueAt('force', arguments[0])", t), force, delta=1e-6 * force)
        lines = self.browser.find_elements(By.CSS_SELECTOR, ".hairline")
        self.assertEqual(len({line.location["x"] for line in lines if line.is_displayed()}), 1)
        self.assertEqual(len(lines), 7)

    def test_a_current_between_two_samples_is_that_of_the_nearer_sample(self):
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
        rows = [[cell.text for cell in row.find_elements(By.TAG_NAME, "td")] for row in self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr")]
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
                const chart = corpuscle.charts.raster, {x, y, w, h} = chart.getArea();
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
            const chart = corpuscle.charts.frequency, points = [];
            for (let row = 0; row < chart.numRows(); ++row) if (chart.getValue(row, 2) !== null) points.push([chart.getValue(row, 0), chart.getValue(row, 2)]);
            return points""")
        self.assertEqual([t for t, _ in drawn], list(times[:-1]))
        for (t, f), following in zip(drawn, times[1:]):
            self.assertAlmostEqual(f * (following - t), 1, places=9)

    def test_the_vertical_axis_follows_the_window_with_autoscale(self):
        t, _ = plateau(self.data)
        self.browser.find_element(By.ID, "autoscale").click()
        self.js("corpuscle.setWindow(arguments[0], arguments[1])", t - 20 * self.input["T"], t + 20 * self.input["T"])
        low, high = self.js("return corpuscle.charts['sa1 current'].yAxisRange()")
        self.browser.find_element(By.ID, "autoscale").click()
        self.js("corpuscle.setWindow(corpuscle.window()[0], corpuscle.window()[1])")
        wide = self.js("return corpuscle.charts['sa1 current'].yAxisRange()")
        self.assertLess(high - low, 0.9 * (wide[1] - wide[0]))

    def test_it_fits_a_narrow_window(self):
        self.browser.set_window_size(700, 900)
        WebDriverWait(self.browser, 20).until(lambda _: self.js("return corpuscle.charts.force.width_ < 700"))
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

    def right_axis(self, panel):
        """For two labels of the right axis: the value in SI, and the value of the left axis at the same height."""
        labels = self.js("""
            const chart = corpuscle.charts[arguments[0]], axis = document.querySelector(`[data-panel="${arguments[0]}"] .right-axis`);
            return [...axis.children].map((one) => [one.textContent, chart.toDataYCoord(parseFloat(one.style.top) + chart.getArea().y),
                                                    parseFloat(one.style.top) / chart.getArea().h])""", panel)
        self.assertGreaterEqual(len(labels), 2, panel)
        self.assertTrue(all(-0.01 < height < 1.01 for *_, height in labels), (panel, labels))
        prefix = re.search(r"\((.?)[AV]\)", self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .right-title').text)[1]
        return [(float(text.replace("−", "-")) * PREFIX[prefix], place) for text, place, _ in (labels[0], labels[-1])]

    def drawn(self, panel, column):
        return self.js("""
            const chart = corpuscle.charts[arguments[0]];
            return Array.from({length: chart.numRows()}, (_, row) => [chart.getValue(row, 0), chart.getValue(row, arguments[1])])""", panel, column)

    def test_model_and_chip_share_a_panel_for_each_quantity(self):
        self.assertEqual(self.panels(), ["force", "raster", "sa1 frequency", "fa1 frequency", "sa1 I", "sa1 I_A", "sa1 I_B", "sa1 I_C", "sa1 u",
                                         "circuits/sa1.cir nodes", "fa1 I", "fa1 I_A", "fa1 I_B", "fa1 u", "circuits/fa1.cir nodes"])
        self.assertEqual({name: count for name, count in self.dark_pixels().items() if count < 80}, {})
        self.screenshot("versions.png")

    def test_one_instant_is_at_one_position_in_all_panels(self):
        areas = self.js("return Object.values(corpuscle.charts).map((chart) => [chart.getArea().x, chart.getArea().w])")
        self.assertEqual(areas, [areas[0]] * len(areas))

    def test_the_right_axis_has_the_values_of_the_curves(self):
        for panel, part in (("sa1 I", "i(vi)"), ("sa1 I_B", "i(vib)"), ("sa1 u", "v(u)")):
            (low, at_low), (high, at_high) = self.right_axis(panel)
            T = self.input["T"]
            for t in (0.1, 0.33, 0.6, 0.9):
                k = round((t - self.input["t0"]) / T)
                self.js("corpuscle.setWindow(arguments[0], arguments[1])", t - 20 * T, t + 20 * T)
                place = min(self.drawn(panel, 2), key=lambda row: abs(row[0] - t))[1]
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
            rows = [v for s, v in self.drawn("sa1 I", 2) if v is not None and t <= s < t + 4e-3]
            before = [v for s, v in self.drawn("sa1 I", 2) if v is not None and t - 4e-3 < s < t - 5 * T]
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
        labels = [label.text for label in self.browser.find_elements(By.CSS_SELECTOR, '[data-panel="raster"] .dygraph-axis-label-y')]
        self.assertEqual(labels, ["sa1", self.CHIP, "fa1", "circuits/fa1.cir"])

    def test_the_table_of_versions_counts_the_spikes(self):
        section = self.browser.find_element(By.ID, "comparisons")
        columns = [cell.text for cell in section.find_elements(By.CSS_SELECTOR, "thead th")]
        rows = [dict(zip(columns, (cell.text for cell in row.find_elements(By.TAG_NAME, "td")))) for row in section.find_elements(By.CSS_SELECTOR, "tbody tr")]
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

    def drawn_spikes(self):
        """The number of ticks of the raster."""
        return self.js("return [...document.querySelectorAll('.trial-plots svg:nth-child(2) path')].reduce((n, p) => n + p.getAttribute('d').split('M').length - 1, 0)")

    def test_each_spike_of_the_selected_afferent_is_one_tick(self):
        select = Select(self.browser.find_element(By.CSS_SELECTOR, "#trials select"))
        for group in range(2):
            select.select_by_index(group)
            spikes = sum(len(numbers("d", r["times"])) for r in self.data["trials"]["spikes"] if r["group"] == group)
            self.assertGreater(spikes, 20)
            self.assertEqual(self.drawn_spikes(), spikes)

    def test_force_and_histogram_have_a_curve_for_each_trial_and_label(self):
        count = lambda selector: self.js("return document.querySelectorAll(arguments[0]).length", ".trial-plots " + selector)
        self.assertEqual(count("svg"), 3)
        self.assertEqual(count("svg:nth-child(1) polyline"), 8)
        self.assertEqual(count("svg:nth-child(3) path"), 2)
        self.assertGreater(count("svg:nth-child(3) rect"), 10, "the band of the standard error")

    def test_the_histogram_is_that_of_the_spikes(self):
        trials = self.data["trials"]
        histogram = next(h for h in trials["histograms"] if h["label"] == "rough" and h["group"] == 0)
        times = [t for r in trials["spikes"] if r["group"] == 0 and trials["trials"][r["trial"]]["label"] == "rough" for t in numbers("d", r["times"])]
        edges = [*histogram["edges"], histogram["end"]]
        for k, rate in enumerate(histogram["rate"]):
            inside = sum(edges[k] <= t < edges[k + 1] for t in times)
            self.assertAlmostEqual(rate, inside / 4 / (edges[k + 1] - edges[k]), delta=1e-6 * (1 + rate) + 1.01 / 4 / trials["bin"] * any(abs(t - e) < 1e-9 for t in times for e in edges))

    def test_it_fits_a_telephone_and_a_dark_theme(self):
        self.screenshot("trials.png")
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            with self.screen(390, 844, 2):
                self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
                self.assertGreater(self.js("return document.querySelector('.trial-plots svg').clientWidth"), 0.85 * 390)
                self.browser.save_screenshot(str(OUT / f"trials-phone-{theme}.png"))
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


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
                data["traces"].append({**record, "afferent": "sa1-macro", "data": base64_of("f", [v * half for v in numbers("f", record["data"])])})
            data["spikes"] = [r for r in data["spikes"] if r["afferent"] != "sa1"]
            data["spikes"] += [{**r, "afferent": "sa1-macro"} for r in data["spikes"]]
        return with_changed_data(respond("chip.html", "--afferent", "sa1,circuits/sa1.cir"), "netlists-alone.html", change)

    def test_curves_of_similar_size_share_an_axis(self):
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "sa1 i(vi)", "sa1 i(via)", "sa1 i(vib)", "sa1 i(vic)", "sa1 v(u)", "circuits/sa1.cir nodes",
                                         "sa1-macro nodes"])
        self.assertEqual(self.browser.find_elements(By.CLASS_NAME, "right-axis"), [])
        self.hover("sa1 i(via)", 0.5)
        chip, macro = (si(self.readout("sa1 i(via)", name)) for name in ("circuits/sa1.cir", "sa1-macro"))
        self.assertAlmostEqual(macro / chip, 0.5, places=3)


class NetlistByItself(Page):
    @classmethod
    def report(cls):
        return respond("spiker.html", "--afferent", "circuits/spiker.cir")

    def test_its_membrane_has_a_panel_apart_from_its_other_nodes(self):
        self.assertEqual(self.panels(), ["force", "raster", "frequency", "circuits/spiker.cir membrane", "circuits/spiker.cir nodes"])
        self.assertGreater(min(self.dark_pixels().values()), 80)
        self.assertFalse(self.browser.find_element(By.ID, "comparisons").is_displayed())


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
            data["traces"].append({**record, "channel": 77, "data": base64_of("f", both)})
            data["spikes"].append({"afferent": "sa1", "channel": 77, "count": 1, "times": base64_of("d", [plateau(data)[0]])})
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
        x, y, w, h = (self.js("return corpuscle.charts.raster.getArea()")[k] for k in "xywh")
        row = y + 1.5 * h / 4  # sa1 on the second channel
        ActionChains(self.browser).move_to_element_with_offset(plot, 0, round(row - plot.size["height"] / 2)).click().perform()
        WebDriverWait(self.browser, 20).until(lambda _: self.shown() == "second <b>")

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
            record.update(count=1_000_000, times=base64_of("d", (clock["t0"] + (k + 0.5) * step for k in range(1_000_000))))
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
        self.assertEqual(self.panels(), ["force", "raster", "population", "frequency", "sa1 current", "sa1 membrane", "fa1 current", "fa1 membrane"])
        self.assertGreater(min(self.dark_pixels().values()), 80)
        labels = [label.text for label in self.browser.find_elements(By.CSS_SELECTOR, '[data-panel="raster"] .dygraph-axis-label-y')]
        self.assertEqual(labels, [f"{name}#{k}" for name in ("sa1", "fa1") for k in range(1, 21)])
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
        cells = [cell.text for cell in self.browser.find_elements(By.CSS_SELECTOR, "#rates tbody tr:nth-child(3) td")]
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
        self.assertIn("The first 50 of 300 copies of each afferent, one row per copy. The rate below is the mean over all 300.", text)
        self.assertIn("with more than 50 copies currents and membranes are not recorded", text)
        self.screenshot("many-copies.png")


class Million(Page):
    @classmethod
    def report(cls):
        return respond("million.html", "--rate", "1MHz")

    def test_the_drawn_points_are_bounded_by_the_width_not_by_the_samples(self):
        self.assertGreaterEqual(self.input["samples"], 1_000_000)
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
            self.assertGreater(drawn["rows"], 0, panel)

    def test_no_extreme_is_lost_in_thinning(self):
        low, high, _ = trace(self.data, "force")
        self.assertEqual(self.drawn_extremes("force", 1), [min(low), max(high)])
        for afferent in self.data["afferents"][:1]:
            parts = [part["name"] for part in afferent["probes"] if part["unit"] == "V"]
            low, high, _ = trace(self.data, parts[0], afferent["name"])
            self.assertEqual(self.drawn_extremes(afferent["name"] + " membrane", 1), [min(low), max(high)])

    def drawn_extremes(self, panel, column):
        return self.js("""
            const chart = corpuscle.charts[arguments[0]], values = [];
            for (let row = 0; row < chart.numRows(); ++row) values.push(chart.getValue(row, arguments[1]));
            return [Math.min(...values), Math.max(...values)]""", panel, column)


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
        cells = dict(zip((th.text for th in section.find_elements(By.TAG_NAME, "th")), (td.text for td in section.find_elements(By.TAG_NAME, "td"))))
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
        self.assertIn("spiker.cir", table.text)
        cost, = self.data["costs"]
        power = cost["power"]["op"]
        self.assertAlmostEqual(sum(power["blocks_W"].values()) / power["delivered_W"], 1, places=5)
        last = table.find_elements(By.TAG_NAME, "tr")[-1].find_elements(By.TAG_NAME, "td")
        self.assertEqual(last[1].text, f'{cost["area"]["total_m2"] * 1e12:.0f}')


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
    CORPUSCLE, OUT = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
    OUT.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
