"""The symbols of the shared library: the C functions are those of functions.txt, and C++ shows the public classes and functions only."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import record

LIBRARY = os.environ["CORPUSCLE_LIBRARY"]
ROOT = pathlib.Path(os.environ["CORPUSCLE_ROOT"])
HERE = ROOT / "test" / "abi"


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def exported():
    """The symbols that the library shows, without versions, and the version of each."""
    symbols = {}
    for line in run("nm", "-D", "--defined-only", LIBRARY).splitlines():
        name, _, version = line.split()[-1].partition("@@")
        symbols[name] = version
    return symbols


def abi():
    return re.search(r"#define CORPUSCLE_ABI (\d+)", (ROOT / "include" / "corpuscle.h").read_text())[1]


class Symbols(unittest.TestCase):
    maxDiff = None

    @unittest.skipUnless(shutil.which("gcc"), "only gcc lists the prototypes of a header")
    def test_the_functions_of_the_c_header_are_those_of_the_list(self):
        listed = (HERE / "functions.txt").read_text().splitlines()
        self.assertEqual(listed, record.declared_functions(), "functions may be added (test/abi/record.py); a changed one needs a new CORPUSCLE_ABI")

    def test_the_library_shows_every_function_of_the_list_and_no_other(self):
        listed = {re.search(r"(corpuscle_\w+) \(", line)[1] for line in (HERE / "functions.txt").read_text().splitlines()}
        shown = {name for name, version in exported().items() if version == f"CORPUSCLE_{abi()}" and not name.startswith("CORPUSCLE_")}
        self.assertEqual(listed, shown)

    def test_the_name_of_the_library_has_the_version_of_the_c_interface(self):
        self.assertIn(f"Library soname: [libcorpuscle.so.{abi()}]", run("readelf", "-d", LIBRARY))

    def test_no_internal_name_of_cxx_is_shown(self):
        headers = "".join(p.read_text() for p in sorted((ROOT / "include" / "corpuscle").glob("*.hpp")))
        public = set(re.findall(r"^(?:struct|class)(?: CORPUSCLE_API)? (\w+)", headers, re.M))
        public |= set(re.findall(r"^CORPUSCLE_API [^(;]*?(\w+)\(", headers, re.M))
        names = [name for name, version in exported().items() if version.startswith("CORPUSCLE_CXX") and name.startswith("_Z")]
        self.assertGreater(len(names), 20)
        for name in names:
            text = run("c++filt", name).strip()
            first = re.match(r"(?:typeinfo for |typeinfo name for |vtable for )?corpuscle::(\w+)", text)
            self.assertTrue(first and first[1] in public and "::Impl::" not in text, f"{text} is not in a public header")
        other = [n for n, v in exported().items() if not (v or n).startswith("CORPUSCLE_")]
        self.assertEqual(other, [])

    def test_the_library_is_hardened_and_looks_for_no_library_in_a_path_of_its_own(self):
        dynamic = run("readelf", "-Wd", LIBRARY)
        self.assertIn("NOW", dynamic)
        for tag in ("RPATH", "RUNPATH", "TEXTREL"):
            self.assertNotIn(tag, dynamic)


@unittest.skipUnless(shutil.which("abidw"), "abigail-tools are not installed")
class Abigail(unittest.TestCase):
    """libabigail compares all types that the functions use with those of the record, corpuscle.abi."""

    def test_the_types_of_all_functions_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            library = pathlib.Path(folder, "libcorpuscle.so")
            record.build_interface(library)
            found = subprocess.run(["abidiff", "--no-architecture", HERE / "corpuscle.abi", library], capture_output=True, text=True)
            self.assertEqual(found.returncode, 0, found.stdout + found.stderr + "after an addition run test/abi/record.py")


if __name__ == "__main__":
    unittest.main()
