"""The notebooks of examples/ run, show pictures and print no warnings but those that they explain.

CORPUSCLE_NOTEBOOKS names those to run, separated by commas, or is "all". CORPUSCLE_NOTEBOOKS_OUT is a folder for the executed ones."""

import base64
import os
import pathlib
import re
import struct
import unittest

from support import ROOT

FOLDER = pathlib.Path(ROOT, "examples", "notebooks")
FILES = sorted(FOLDER.glob("*.ipynb"))
QUICK = "own_recording,trials_and_psth"  # the others take longer, or need more memory
MOST_SECONDS = 300  # of a cell
EXPLAINED = {"own_recording": "the noise of the sensor", "model_and_chip": ".expect is ignored"}  # a warning that the text of a notebook is about

os.environ.pop("MPLBACKEND", None)  # a notebook draws its pictures inline
import nbclient
import nbformat
from nbconvert import HTMLExporter


def wanted():
    names = os.environ.get("CORPUSCLE_NOTEBOOKS", QUICK)
    return FILES if names == "all" else [FOLDER / f"{name}.ipynb" for name in names.split(",")]


def execute(path):
    notebook = nbformat.read(path, 4)
    nbclient.NotebookClient(notebook, timeout=MOST_SECONDS, resources={"metadata": {"path": str(path.parent)}}).execute()
    return notebook


def outputs_of(notebook):
    return [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]


def write(notebook, path):
    folder = os.environ.get("CORPUSCLE_NOTEBOOKS_OUT")
    if not folder:
        return
    os.makedirs(folder, exist_ok=True)
    nbformat.write(notebook, os.path.join(folder, path.name))
    page = HTMLExporter().from_notebook_node(notebook)[0]
    pathlib.Path(folder, path.stem + ".html").write_text(page, encoding="utf-8")


class Notebooks(unittest.TestCase):
    def test_they_are_stored_without_outputs_and_explain_themselves(self):
        self.assertGreaterEqual(len(FILES), 7)
        for path in FILES:
            with self.subTest(path.name):
                notebook = nbformat.read(path, 4)
                nbformat.validate(notebook)
                self.assertEqual(outputs_of(notebook), [])
                self.assertRegex(notebook.cells[0].source, r"^# [A-Z]")
                text = [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]
                self.assertGreater(len(text), 2)
                for link in re.findall(r"\]\(([^)#:]+)[)#]", "\n".join(text)):
                    self.assertTrue((FOLDER / link).exists(), link)

    def test_the_list_in_the_readme_is_complete(self):
        listed = re.findall(r"\]\((\w+\.ipynb)\)", (FOLDER / "README.md").read_text())
        self.assertEqual(sorted(listed), [path.name for path in FILES])

    def test_they_run(self):
        for path in wanted():
            with self.subTest(path.name):
                notebook = execute(path)
                outputs = outputs_of(notebook)
                write(notebook, path)
                warnings = [o.text for o in outputs if o.output_type == "stream" and o.name == "stderr"]
                self.assertEqual([EXPLAINED[path.stem] in w for w in warnings] if path.stem in EXPLAINED else warnings, [True] * (path.stem in EXPLAINED))
                pictures = [base64.b64decode(o.data["image/png"]) for o in outputs if "image/png" in o.get("data", {})]
                self.assertGreater(len(pictures), 0)
                for picture in pictures:
                    width, height = struct.unpack(">II", picture[16:24])
                    self.assertGreater(min(width, height), 100)


if __name__ == "__main__":
    unittest.main()
