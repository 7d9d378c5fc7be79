"""The type stubs: they describe the package as it is, and the code of the documents passes mypy with them."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import ROOT

MYPY, STUBTEST = shutil.which("mypy", path="/usr/bin"), shutil.which("stubtest", path="/usr/bin")
CONFIGURATION = "[mypy]\nignore_missing_imports = True\n"
# Objects that stubtest cannot compare: aliases of types, values that are computed when they are first read, and internal modules.
NOT_COMPARED = r"""
corpuscle\.(Settings|Progress|FittedValue)
corpuscle\.\w+\.(times|indices|names|types|channels|positions|start|duration|notes|warnings|summary|models)
corpuscle\.\w+\.__init__
corpuscle\.Epoch\._DT
corpuscle\._.*
"""


@unittest.skipUnless(MYPY and STUBTEST, "mypy is not installed")
class Types(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name, name)
        path.write_text(text)
        return path

    def run_without_error(self, *command):
        package = next(p for p in sys.path if pathlib.Path(p, "corpuscle", "py.typed").is_file())
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=self.folder.name,
                              env={"PATH": "/usr/bin", "MYPYPATH": package, "PYTHONPATH": package})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stubs_have_every_name_and_argument_of_the_package(self):
        self.run_without_error(STUBTEST, "corpuscle", "--concise", "--ignore-unused-allowlist", "--allowlist", self.write("allowed", NOT_COMPARED),
                               "--mypy-config-file", self.write("mypy.ini", CONFIGURATION))

    def test_the_code_of_the_documents_has_the_types_of_the_stubs(self):
        for page in ("README.md", "doc/python.md"):
            code = "\n".join(re.findall(r"^```python\n(.*?)^```$", (pathlib.Path(ROOT) / page).read_text(), re.S | re.M))
            self.run_without_error(MYPY, "--config-file", self.write("mypy.ini", CONFIGURATION), self.write("page.py", code))


if __name__ == "__main__":
    unittest.main()
