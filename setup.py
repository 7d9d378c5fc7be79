"""Builds the Python package: compiles the extension module and its helper programs with CMake, and puts them beside the Python files.

CORPUSCLE_BUILD_DIR names the CMake build directory (default build/wheel); one that was already built is only updated.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
HELPERS = ["corpuscle-hdf5", "corpuscle-sound"]


def version():
    return re.search(r"project\(corpuscle VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(os.environ.get("CORPUSCLE_BUILD_DIR", ROOT / "build" / "wheel")).resolve()
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release", "-D", "CORPUSCLE_PYTHON=ON",
                        "-D", f"Python_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "corpuscle_python"], check=True)
        module = pathlib.Path(self.get_ext_fullpath(extension.name))
        module.parent.mkdir(parents=True, exist_ok=True)
        for name in [module.name, *HELPERS]:
            shutil.copy2(build / "python" / "corpuscle" / name, module.parent / name)
            subprocess.run(["strip", "--strip-unneeded", module.parent / name], check=True)


(ROOT / "build").mkdir(exist_ok=True)
setup(version=version(), ext_modules=[Extension("corpuscle._corpuscle", sources=[])], cmdclass={"build_ext": BuildWithCMake},
      options={"egg_info": {"egg_base": "build"}})
