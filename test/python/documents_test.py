"""The code of doc/python.md, doc/trials.md, doc/nir.md and of the README runs, and prints what the page shows."""

import contextlib
import io
import os
import re
import shutil
import tempfile
import unittest

from support import ROOT

BLOCK = re.compile(r"^```(python|output)\n(.*?)^```$", re.S | re.M)


def blocks_of(page):
    """[(code, expected output or None)] of a page."""
    with open(os.path.join(ROOT, page)) as file:
        found = BLOCK.findall(file.read())
    return [(text, found[k + 1][1] if k + 1 < len(found) and found[k + 1][0] == "output" else None)
            for k, (kind, text) in enumerate(found) if kind == "python"]


class Documents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        shutil.copytree(os.path.join(ROOT, "examples", "data"), "examples/data")

    def run_page(self, page):
        names = {}
        for code, expected in blocks_of(page):
            printed = io.StringIO()
            with self.subTest(code=code), contextlib.redirect_stdout(printed):
                exec(compile(code, page, "exec"), names)
            if expected is not None:
                self.assertEqual(printed.getvalue(), expected, code)

    def test_the_code_of_the_python_page_runs(self):
        self.assertGreater(len(blocks_of("doc/python.md")), 8)
        self.run_page("doc/python.md")
        with open("raster.png", "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_the_code_of_the_page_of_trials_runs(self):
        self.assertEqual(len(blocks_of("doc/trials.md")), 3)
        self.run_page("doc/trials.md")

    def test_the_code_of_the_page_of_nir_runs(self):
        self.assertEqual(len(blocks_of("doc/nir.md")), 1)
        self.run_page("doc/nir.md")

    def test_the_code_of_the_readme_runs(self):
        self.assertEqual(len(blocks_of("README.md")), 1)
        self.run_page("README.md")


if __name__ == "__main__":
    unittest.main()
