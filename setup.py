# SPDX-License-Identifier: MIT
"""Builds the Python module for `pip install .`: CMake's preset `python` compiles, this file copies what comes out."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
BUILD = ROOT / "build" / "python"  # kept: the next build compiles what changed


def version():
    header = (ROOT / "include" / "conelight" / "version.h").read_text(encoding="utf-8")
    return ".".join(re.search(rf"define CONELIGHT_VERSION_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))


class CMakeBuild(build_ext):
    """From the environment: CONELIGHT_CMAKE_ARGUMENTS goes to CMake; CMAKE_BUILD_PARALLEL_LEVEL limits its processes;
    CONELIGHT_BUILD_DIR names a build in which the module was built for this Python, and nothing is compiled."""

    def build_extension(self, ext):
        build = os.environ.get("CONELIGHT_BUILD_DIR") or self.compile()
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(pathlib.Path(build) / "python" / "conelight" / target.name, target)

    @staticmethod
    def compile():
        arguments = [f"-DPython_EXECUTABLE={sys.executable}", *os.environ.get("CONELIGHT_CMAKE_ARGUMENTS", "").split()]
        try:
            import pybind11
            arguments.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass  # CMake finds the system's
        processes = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--preset", "python", *arguments], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "conelight_python", "--parallel", processes], check=True)
        return BUILD


setup(version=version(), packages=["conelight"], package_dir={"": "python"},
      package_data={"conelight": ["__init__.pyi", "py.typed"]},
      ext_modules=[Extension("conelight._conelight", sources=[])], cmdclass={"build_ext": CMakeBuild}, zip_safe=False)
