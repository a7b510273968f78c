# SPDX-License-Identifier: Apache-2.0
"""Builds the compiled part with CMake, in the tree of what ships: a minute where the program has been built, ten where not.

Source distributions carry the sources of the whole project, but for tests and benchmarks, in the folder `source`."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE / "source" if (HERE / "source" / "CMakeLists.txt").exists() else HERE.parent.parent
TREE = pathlib.Path(os.environ.get("SUBLIMIT_BUILD_DIR", SOURCE / "build" / "release"))


class CMakeBuild(build_ext):
    """The target sublimit_python of the project's own build."""

    def run(self):
        for extension in self.extensions:
            self.build_extension(extension)

    def build_extension(self, extension):
        def run(*command):
            subprocess.run(command, cwd=SOURCE, check=True)

        cache = TREE / "CMakeCache.txt"
        known = cache.read_text() if cache.exists() else ""
        # Not that of a virtual environment, which may go while the tree stays.
        python = os.path.realpath(getattr(sys, "_base_executable", sys.executable))
        options = ["-DSUBLIMIT_BUILD_PYTHON=ON", f"-DSUBLIMIT_PYTHON={python}"]
        found = re.search("^SUBLIMIT_PYTHON:.*?=(.*)$", known, flags=re.M)
        if not known:
            run("cmake", "--preset", "release", "-B", str(TREE), *options)
        elif "SUBLIMIT_BUILD_PYTHON:BOOL=ON" not in known or not found or os.path.realpath(found[1]) != python:
            run("cmake", "-B", str(TREE), *options)
        run("cmake", "--build", str(TREE), "--target", "sublimit_python")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(TREE / "python" / "sublimit" / ("_sublimit" + sysconfig.get_config_var("EXT_SUFFIX")), target)
        for library in (TREE / "python" / "sublimit").glob("libsublimit_*.so"):  # for OpenVDB and OpenCASCADE, where they are
            shutil.copyfile(library, target.parent / library.name)


class SourceDistribution(sdist):
    """The package, and beside it the sources that its compiled part is built from."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, [file for file in files if not file.startswith("..")])  # not those of OUTPUT
        names = OUTPUT / "sources.txt"
        subprocess.run(["cmake", f"-DSOURCE={SOURCE}", f"-DOUT={names}", "-P",
                        str(SOURCE / "stencils" / "packaging" / "sources.cmake")], check=True)
        for name in names.read_text().splitlines():
            if not name.startswith(("bench/", "tests/")):
                target = pathlib.Path(base_dir, "source", name)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(SOURCE / name, target)


# Nothing is left beside the sources.
OUTPUT = TREE / "wheel"
OUTPUT.mkdir(parents=True, exist_ok=True)
setup(options={"build": {"build_base": str(OUTPUT)}, "egg_info": {"egg_base": str(OUTPUT)}},
      version=re.search(r'SUBLIMIT_VERSION "(.*)"', (SOURCE / "eval/sublimit/base/version.h").read_text())[1],
      ext_modules=[Extension("sublimit._sublimit", [])], cmdclass={"build_ext": CMakeBuild, "sdist": SourceDistribution})
