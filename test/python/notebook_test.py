"""Responses in a notebook: executed by nbclient, converted by nbconvert, and looked at in headless Chromium, as wide as a desktop and a phone."""

import os
import tempfile
import unittest

import nbclient
import nbformat
from nbconvert import HTMLExporter
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait
from support import ROOT

CELLS = (f"import corpuscle\nforce = corpuscle.read('{ROOT}/examples/data/touch.csv', deadband='20 mN')\n"
         "corpuscle.respond(force, afferent=['sa1-nerve', 'fa1-nerve'])",
         "corpuscle.respond('press', afferent='sa1', copies=20, spread={'f_B': '10%'})",
         "corpuscle.hand().respond('stroke')")
FLAGS = "--headless=new --no-sandbox --disable-gpu --no-first-run --disable-background-networking --disable-component-update --disable-sync".split()
# The fraction of a canvas's pixels that are drawn.
DRAWN = """
return [...document.querySelectorAll("canvas")].filter((c) => c.width && c.height).map((c) => {
    const pixels = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
    let drawn = 0;
    for (let k = 3; k < pixels.length; k += 4) drawn += pixels[k] > 0;
    return 4 * drawn / pixels.length;
});"""


def executed():
    """The notebook with its outputs."""
    notebook = nbformat.v4.new_notebook(metadata={"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}})
    notebook.cells = [nbformat.v4.new_code_cell(cell) for cell in CELLS]
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    return notebook


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.notebook = executed()
        cls.path = os.path.join(cls.folder.name, "notebook.html")
        with open(cls.path, "w") as file:
            file.write(HTMLExporter().from_notebook_node(cls.notebook)[0])

    def test_each_output_has_text_and_is_limited(self):
        for cell in self.notebook.cells:
            (output,) = cell.outputs
            self.assertLess(len(output.data["text/html"].encode()), 2_000_000)
            self.assertTrue(output.data["text/plain"].startswith("<Response: "))

    def look(self, width, height):
        """Checks each frame at this size of the window."""
        options = webdriver.ChromeOptions()
        for flag in FLAGS + [f"--window-size={width},{height}"]:
            options.add_argument(flag)
        browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        try:
            browser.get("file://" + self.path)
            frames = browser.find_elements(By.TAG_NAME, "iframe")
            self.assertEqual(len(frames), len(CELLS))
            for frame in frames:
                browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", frame)
                browser.switch_to.frame(frame)
                panels = WebDriverWait(browser, 20).until(lambda b: sum(d > 0.002 for d in b.execute_script(DRAWN)) >= 2)
                self.assertTrue(panels)
                page = "document.documentElement"
                self.assertLessEqual(browser.execute_script(f"return {page}.scrollWidth - {page}.clientWidth"), 1)
                self.assertEqual(browser.find_element(By.ID, "command").is_displayed(), False)
                browser.switch_to.default_content()
                if "CORPUSCLE_PICTURES" in os.environ:  # to look at
                    name = f"notebook-{width}-{frames.index(frame)}.png"
                    browser.save_screenshot(os.path.join(os.environ["CORPUSCLE_PICTURES"], name))
        finally:
            browser.quit()

    def test_the_panels_are_seen_on_a_desktop(self):
        self.look(1300, 900)

    def test_the_panels_are_seen_on_a_phone(self):
        self.look(390, 844)


if __name__ == "__main__":
    unittest.main()
