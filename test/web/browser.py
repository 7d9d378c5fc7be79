#!/usr/bin/python3
"""For tests of the pages in a real browser. Each test is a program:   respond_page_test.py CORPUSCLE OUTDIR

It writes pages with the program CORPUSCLE, opens them in headless Chromium, uses them as a reader would, and compares the displayed values with
the data in the page. Pictures of the pages, such as press.png, are saved in the directory CORPUSCLE_PICTURES if this variable is set.
"""
import atexit
import base64
import contextlib
import csv
import functools
import json
import math
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
from array import array
from xml.etree import ElementTree

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

CORPUSCLE, OUT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = os.environ.get("CORPUSCLE_PICTURES")


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


ARRAY_KEYS = {"f": "f32", "d": "f64", "I": "u32", "H": "u16", "B": "u8"}


def numbers(kind, encoded):
    """The numbers of an array of a page: {"f32": base64}."""
    values = array(kind)
    values.frombytes(base64.b64decode(encoded[ARRAY_KEYS[kind]]))
    return values


def encoded_array(kind, values):
    return {ARRAY_KEYS[kind]: base64.b64encode(array(kind, values).tobytes()).decode()}


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


def packed_number(source):
    """The next number of an iterator over bytes, which has seven bits in each byte."""
    n, shift = 0, 0
    for byte in source:
        n, shift = n | (byte & 127) << shift, shift + 7
        if byte < 128:
            return n


def frames(record):
    """The nonzero values of a map: for each frame, {position: value}."""
    source, all_frames = iter(base64.b64decode(record["data"]["u8"])), []
    for _ in range(record["count"]):
        position, frame = 0, {}
        while position < record["places"]:
            byte = next(source)
            if byte == 0:
                position += packed_number(source)
                continue
            frame[position] = byte if byte < 255 else packed_number(source)
            position += 1
        all_frames.append(frame)
    return all_frames


@functools.cache
def the_browser():
    """The browser of this program, which all test cases share."""
    profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in [*FLAGS, "--user-data-dir=" + profile.name]:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    atexit.register(lambda: (browser.quit(), profile.cleanup()))
    return browser


def with_default_settings(browser):
    """The browser, without the screen, theme and open page of earlier tests."""
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    browser.set_window_size(1200, 900)
    browser.get("about:blank")
    browser.get_log("browser")
    return browser


def waiting(browser, seconds):
    """waiting(browser, 20).until(condition): fails after 20 s. It asks ten times a second, because a live page uses the processor while a test waits."""
    return WebDriverWait(browser, seconds, poll_frequency=0.1)


def save_picture(browser, name):
    """Saves a picture of the window in the directory CORPUSCLE_PICTURES, if this is set."""
    if PICTURES:
        pathlib.Path(PICTURES, name).write_bytes(browser.get_screenshot_as_png())


def missing_values(browser):
    """Words of the page that a script writes if a key or a number is missing."""
    text = browser.execute_script("""return [...document.body.querySelectorAll("*")].filter((one) => !["SCRIPT", "STYLE"].includes(one.tagName))
        .flatMap((one) => [...one.childNodes].filter((child) => child.nodeType === Node.TEXT_NODE).map((child) => child.data)).join(" ")""")
    return re.findall(r".{0,40}(?:undefined|NaN|\[object ).{0,40}", text)


def overfull_bars(browser):
    """Bars of controls that are smaller than their contents, which then lie over what follows."""
    return browser.execute_script("""return [...document.querySelectorAll(".bar, .toolbar")].filter((one) => one.getClientRects().length > 0)
        .filter((one) => one.scrollHeight > one.clientHeight + 3 || one.scrollWidth > one.clientWidth + 3).map((one) => one.textContent)""")


def unsaved_panels(browser):
    """Panels whose data or drawing cannot be saved: without rows below the heading, or with an error."""
    return browser.execute_script("""return Object.entries(corpuscle.panels).filter(([, {isShown}]) => isShown).map(([name, panel]) => {
        try { return panel.csv().split("\\n").length < 3 || !panel.svg().startsWith("<svg") ? name : null; }
        catch (error) { return `${name}: ${error}`; }
    }).filter((one) => one !== null)""")


def cropped_tables(browser):
    """Tables that would be cut at the edge of the paper, and buttons over the headings of their table. Draws the page as for printing."""
    browser.execute_script("dispatchEvent(new Event('beforeprint'))")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    cropped = browser.execute_script("""return [...document.querySelectorAll(".scroll")].filter((one) => one.clientWidth > 0 &&
        (one.firstChild.getBoundingClientRect().width > 701 || one.scrollHeight > one.clientHeight + 2)).map((one) => one.getAttribute("aria-label"))""")
    browser.execute_script("dispatchEvent(new Event('afterprint'))")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    return cropped + browser.execute_script("""return [...document.querySelectorAll(".table")].filter((one) => one.clientWidth > 0 &&
        one.querySelector(".save").getBoundingClientRect().bottom > one.querySelector("table").getBoundingClientRect().top).map((one) => one.textContent.slice(0, 40))""")


class Page(unittest.TestCase):
    """A browser with one report open. No test may cause a message in the console or show a missing value."""

    @classmethod
    def setUpClass(cls):
        cls.browser = with_default_settings(the_browser())
        cls.path = cls.report()
        cls.data = data_of(cls.path)

    def setUp(self):
        self.browser.get(self.path.as_uri())
        # On a busy machine get() sometimes returned while the previous, empty page was still shown.
        is_loaded = "return location.href === arguments[0] && document.readyState === 'complete'"
        waiting(self.browser, 30).until(lambda browser: browser.execute_script(is_loaded, self.path.as_uri()))
        self.input = self.data["inputs"][0]
        self.end = self.input["t0"] + self.input["samples"] * self.input["T"]

    def tearDown(self):
        console_messages = [e["message"] for e in self.browser.get_log("browser") if e["level"] != "INFO"]
        # This advice of Chromium concerns only this test, which reads pixels.
        self.assertEqual([text for text in console_messages if "willReadFrequently" not in text], [])
        self.assertEqual(missing_values(self.browser), [])
        self.assertEqual(overfull_bars(self.browser), [])

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def windows(self):
        """The time window of each panel."""
        return self.js("return Object.values(corpuscle.panels).map(({view}) => [view.a, view.b])")

    def settle(self, moved):
        """Waits until all panels are drawn with a window (a, b) for which `moved(a, b)` is true."""
        waiting(self.browser, 20).until(lambda _: all(moved(*window) for window in self.windows()))

    def plot(self, panel):
        found = self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] .plot')
        self.js("arguments[0].scrollIntoView({block: 'center'})", found)
        return found

    def at_time(self, panel, t):
        """The position of time t in a panel, in pixels from the middle of its plot."""
        plot = self.plot(panel)
        x = self.js("return corpuscle.panels[arguments[0]].x(arguments[1])", panel, t)
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
        waiting(self.browser, 20).until(lambda _: self.browser.find_element(By.ID, "now").text)

    def readout(self, panel, series):
        return self.browser.find_element(By.CSS_SELECTOR, f'[data-panel="{panel}"] [data-series="{series}"] .legend-value').text

    def panels(self):
        return self.js("return Object.keys(corpuscle.panels)")

    def open_sections(self):
        """Opens all folded sections and waits until their panels are drawn."""
        self.js("document.querySelectorAll('details.fold').forEach((one) => { one.open = true; })")
        self.next_frame()

    def next_frame(self):
        self.js("return new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done))))")

    def texts(self, panel, anchor):
        """The texts of a panel, as its SVG file has them: [text, x, y]. `anchor`: "end" for the left axis, "middle" for the x axis and names in the
        plot, "start" for the right axis."""
        root = ElementTree.fromstring(self.js("return corpuscle.panels[arguments[0]].svg()", panel))
        return [[one.text, float(one.get("x")), float(one.get("y"))] for one in root.iter("{http://www.w3.org/2000/svg}text") if one.get("text-anchor") == anchor]

    def dark_pixels(self):
        """For each panel, the number of pixels of the plot that are darker than bands and grid."""
        return self.js("""
            return Object.fromEntries(Object.entries(corpuscle.panels).map(([name, {area}]) => {
                const canvas = document.querySelector(`[data-panel="${name}"] .plot canvas`), ratio = canvas.width / canvas.clientWidth;
                const {x, y, w, h} = area;
                const pixels = canvas.getContext("2d").getImageData((x + 3) * ratio, (y + 2) * ratio, (w - 4) * ratio, (h - 4) * ratio).data;
                let count = 0;
                for (let i = 0; i < pixels.length; i += 4)
                    if (pixels[i + 3] > 100 && Math.min(pixels[i], pixels[i + 1], pixels[i + 2]) < 170) ++count;
                return [name, count];
            }))""")

    def themes(self):
        """Shows the page in each theme, one after the other."""
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
            self.next_frame()
            yield theme
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

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
        """Saves a picture of the complete page in the same directory."""
        if not PICTURES:
            return
        self.browser.set_window_size(1200, 900)
        height = self.js("scrollTo(0, 0); return document.documentElement.scrollHeight")
        self.browser.set_window_size(1200, height + 160)  # the height of the browser's own controls, with some margin
        self.js("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        save_picture(self.browser, name)
        self.browser.set_window_size(1200, 900)


def run_tests():
    for folder in filter(None, (OUT, PICTURES)):
        pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    unittest.main(module="__main__", argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
