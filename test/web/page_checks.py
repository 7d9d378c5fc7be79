"""Checks that several pages share: sizes and themes, labels, contrast, files that a page saves."""
from browser import *

SIZES = ((360, 740), (390, 844), (1400, 900), (2560, 1440))
PAYLOAD = '"><img src=x onerror="document.title=1"><script>document.title=1</script>'


def floats(encoded):
    """The numbers of an array of a page: {"f32": base64}."""
    values = array("f")
    values.frombytes(base64.b64decode(encoded["f32"]))
    return list(values)


class Pages(unittest.TestCase):
    """A browser for the tests of a class. No test may cause a message in the console or show a missing value."""

    @classmethod
    def setUpClass(cls):
        cls.browser = with_default_settings(the_browser())
        cls.files = pathlib.Path(tempfile.mkdtemp(dir=OUT))
        cls.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(cls.files)})

    def tearDown(self):
        console_messages = [one["message"] for one in self.browser.get_log("browser") if one["level"] != "INFO"]
        self.assertEqual([text for text in console_messages if "willReadFrequently" not in text], [])
        self.assertEqual(missing_values(self.browser), [])
        self.assertEqual(overfull_bars(self.browser), [])

    def open(self, path, link="", width=1400, height=900, is_dark=False):
        """Shows a page on a screen of this size and waits until its panels are drawn."""
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 2 if width < 600 else 1, "mobile": width < 600})
        self.browser.get("about:blank")
        self.set_theme(is_dark)
        self.browser.get(path.as_uri() + link)
        self.settle()

    def set_theme(self, is_dark):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if is_dark else "light"}]})
        self.settle()

    def settle(self):
        self.js("return new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done))))")

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def texts_of(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])].map((one) => one.textContent)", selector)

    def until(self, condition):
        return waiting(self.browser, 20).until(lambda _: condition())

    def panels(self):
        return self.js("return Object.keys(corpuscle.panels)")

    def view(self, panel):
        return self.js("const {view} = corpuscle.panels[arguments[0]]; return [view.a, view.b]", panel)

    def plot(self, panel):
        found = self.js("const {plot} = corpuscle.panels[arguments[0]]; plot.scrollIntoView({block: 'center'}); return plot", panel)
        self.settle()
        return found

    def drawn_points(self, panel):
        return self.js("return corpuscle.panels[arguments[0]].drawn", panel)

    def saved(self, panel, kind):
        """The file that the menu of a panel saves."""
        name = re.sub(r"(?:[^\w.-]|_)+", "-", panel) + "." + kind.lower()
        menu = self.js("return document.querySelector(`[data-panel=${JSON.stringify(arguments[0])}] .menu`)", panel)
        self.js("arguments[0].open = true; [...arguments[0].querySelectorAll('button')].find((one) => one.textContent === arguments[1]).click()", menu, kind)
        file = self.files / name
        self.until(lambda: file.exists() and file.stat().st_size > 0)
        content = file.read_bytes()
        file.unlink()
        return content

    def assert_it_fits(self, path, link, name):
        """On small and large screens, light and dark, the page does not scroll sideways and no two labels of a plot overlap."""
        for width, height in SIZES:
            self.open(path, link, width, height)
            for is_dark in (False, True):
                self.set_theme(is_dark)
                at = f"{name}, {width} x {height}, {'dark' if is_dark else 'light'}"
                self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width, at)
                self.assertEqual(self.js(OVERLAPS), [], at)
                self.assertEqual(overfull_bars(self.browser), [], at)
                save_picture(self.browser, f"{name}-{width}{'-dark' if is_dark else ''}.png")

    def assert_contrast(self, path):
        """Text and marks have the contrast of WCAG AA in both themes."""
        for is_dark in (False, True):
            self.open(path, is_dark=is_dark)
            ratios = self.js(CONTRASTS)
            self.assertEqual({name: ratio for name, ratio in ratios.items() if ratio < (3 if name.startswith("--series") else 4.5)}, {}, "dark" if is_dark else "light")

    def assert_text_stays_text(self):
        """No text of a file has become an element or a script."""
        self.assertNotEqual(self.browser.title, "1")
        self.assertEqual(self.all("img"), [])
        self.assertTrue(self.js("return [...document.querySelectorAll('body script')].every((one) => one.id === 'data' || !one.textContent.includes('document.title=1'))"))


# Pairs of texts of a panel's drawing whose boxes overlap, from its SVG.
OVERLAPS = """
    const found = [];
    for (const [name, panel] of Object.entries(window.corpuscle?.panels || {})) {
        if (!panel.plot.clientWidth) continue;
        const host = document.createElement("div");
        host.append(new DOMParser().parseFromString(panel.svg(), "image/svg+xml").documentElement);
        document.body.append(host);
        const boxes = [...host.querySelectorAll("text")].map((one) => { const {x, y, height} = one.getBBox(); return [one.textContent.trim(), {x, y, height, width: one.getComputedTextLength()}]; }).filter(([text]) => text);
        const isLabel = ([, box]) => box.width > 0;
        boxes.forEach(([text, a], i) => boxes.slice(i + 1).filter(isLabel).forEach(([other, b]) => {
            const w = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x), h = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
            if (w > 2 && h > 4) found.push(`${name}: ${text} | ${other}`);
        }));
        host.remove();
    }
    return found"""

# The contrast of each colour of text or of a series with the paper.
CONTRASTS = """
    const probe = document.body.appendChild(document.createElement("span"));
    const channels = (css) => { probe.style.color = css; return getComputedStyle(probe).color.match(/[\\d.]+/g).slice(0, 3).map(Number); };
    const luminance = (css) => channels(css).map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)).reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    const ratio = (one, other) => { const [a, b] = [luminance(one), luminance(other)].sort((x, y) => y - x); return (a + 0.05) / (b + 0.05); };
    const names = ["--ink", "--faint", "--accent", "--good", "--bad", ...Array.from({length: 8}, (_, k) => `--series-${k}`)];
    return Object.fromEntries(names.map((name) => [name, ratio(`var(${name})`, "var(--paper)")]))"""
