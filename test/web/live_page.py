"""For tests of the live page, which are programs:   live_page_test.py CORPUSCLE OUTDIR PAGE

A program exits with 77 if there is no PAGE, which `make page` builds.
"""
from page_checks import *

PAGE = pathlib.Path(sys.argv.pop(3)).resolve()
CHIP_TOLERANCE = 1e-6  # s; the pivots of the elimination are others, so the last digits of voltages are


def program(*arguments):
    """The JSON document that the program prints."""
    done = subprocess.run([CORPUSCLE, *map(str, arguments), "--json", "--quiet"], check=True, cwd=ROOT, capture_output=True, text=True)
    return json.loads(done.stdout)


def trains(path, column="afferent"):
    """Spike times by afferent of a file spikes.csv."""
    out = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            out.setdefault(row[column], []).append(float(row["time_s"]))
    return out


class LivePage(Pages):
    ROWS = "sa1,sa1-nerve,sa1-circuit"
    SKIN = "fingertip"

    def setUp(self):
        self.start(f"#rows={self.ROWS}&rate=2000&skin={self.SKIN}")

    def start(self, link="", **screen):
        self.open(PAGE, link, **screen)
        waiting(self.browser, 60).until(lambda _: self.js("return !!window.corpuscle && corpuscle.session.time > 0"))

    def follow(self, link):
        """Changes the link in the address bar. The page follows it without being loaded again."""
        self.js("corpuscle.before = corpuscle.session.force; location.hash = arguments[0]", link)  # a start makes a new curve of the force
        self.until(lambda: self.js("return corpuscle.session.force !== corpuscle.before && corpuscle.session.time > 0"))

    def time(self):
        return self.js("return corpuscle.session.time")

    def wait(self, seconds):
        """Waits until so much more time is simulated."""
        until = self.time() + seconds
        waiting(self.browser, 60).until(lambda _: self.time() >= until)

    def press(self, seconds):
        """Presses the middle of the skin with the pointer."""
        canvas = self.browser.find_element(By.CSS_SELECTOR, "#skin-view canvas")
        ActionChains(self.browser, duration=50).move_to_element(canvas).click_and_hold().perform()
        self.wait(seconds)
        ActionChains(self.browser, duration=50).move_by_offset(20, 10).release().perform()
        self.wait(0.3)

    def download(self, button, name):
        for old in self.files.iterdir():
            old.unlink()
        self.browser.find_element(By.ID, button).click()
        self.until(lambda: (self.files / name).exists() and (self.files / name).stat().st_size > 0)
        return self.files / name

    def pause(self):
        self.browser.find_element(By.ID, "pause").click()
        self.wait_for_idle()

    def wait_for_idle(self):
        self.until(lambda: not self.js("return corpuscle.session.isBusy"))

    def counts(self):
        return self.js("return corpuscle.session.rows.map(({train}) => train.count)")

    def text(self, id):
        return self.browser.find_element(By.ID, id).text

    def check_spikes(self, found, expected, name):
        tolerance = CHIP_TOLERANCE if "circuit" in name else 1e-9
        self.assertEqual(len(found), len(expected), name)
        self.assertLessEqual(max((abs(a - b) for a, b in zip(found, expected)), default=0), tolerance, name)


def run_live_tests():
    if not PAGE.exists():
        print(f"There is no {PAGE}: make page builds it.")
        sys.exit(77)
    run_tests()
