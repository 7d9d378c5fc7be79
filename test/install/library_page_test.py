"""The commands and the code of doc/library.md work with the installed library."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["CORPUSCLE_ROOT"])
LIBRARIES = pathlib.Path(os.environ["CORPUSCLE_LIBRARY"]).parent


def blocks(kind):
    return re.findall(rf"^```{kind}\n(.*?)^```$", (ROOT / "doc" / "library.md").read_text(), re.S | re.M)


class LibraryPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.environment = dict(os.environ, LD_LIBRARY_PATH=str(LIBRARIES), PKG_CONFIG_PATH=str(LIBRARIES / "pkgconfig"))

    def run_in_folder(self, *command):
        done = subprocess.run(command, cwd=self.folder.name, env=self.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_the_commands_build_programs_that_run(self):
        for example in ("respond.c", "respond.cpp"):
            shutil.copy(ROOT / "examples" / example, self.folder.name)
        for block in blocks("sh"):
            self.run_in_folder("sh", "-ec", block)
        self.assertIn("sa1-nerve", self.run_in_folder("./respond-c"))
        self.assertIn(" s\n", self.run_in_folder("./respond"))

    def test_the_code_of_ctypes_prints_what_the_page_shows(self):
        (code,), (output,) = blocks("python"), blocks("output")
        self.assertEqual(self.run_in_folder(sys.executable, "-c", code), output)


if __name__ == "__main__":
    unittest.main()
