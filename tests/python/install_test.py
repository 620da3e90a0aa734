# SPDX-License-Identifier: MIT
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import conelight

SOURCES = pathlib.Path(os.environ["CONELIGHT_SOURCE_DIR"])
NEEDED = ("pyproject.toml", "setup.py", "README.md", "include/conelight/version.h", "python/conelight/__init__.py",
          "python/conelight/__init__.pyi", "python/conelight/py.typed")


def run(*command, **named):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **named)
    if done.returncode != 0:
        raise AssertionError(f"{command[0]}: {done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


class Install(unittest.TestCase):
    """pip installs the module of this build into an environment of its own, complete and importable."""

    def setUp(self):
        for module in ("venv", "ensurepip", "setuptools", "wheel"):
            if importlib.util.find_spec(module) is None:
                self.skipTest(f"no {module} (scripts/install_packages --pip)")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_pip(self):
        # A copy of what pip needs: it leaves files beside what it builds.
        for name in NEEDED:
            copy = self.folder / "checkout" / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(SOURCES / name, copy)
        run(sys.executable, "-m", "venv", "--system-site-packages", self.folder / "venv")
        python = self.folder / "venv" / "bin" / "python"
        built = pathlib.Path(conelight.__file__).parents[2]
        clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        run(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", self.folder / "checkout",
            env={**clean, "CONELIGHT_BUILD_DIR": str(built)})
        self.check(python, clean)
        # A wheel is installed without compilers, or anything else of the PATH.
        run(python, "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps", "-w", self.folder / "dist",
            self.folder / "checkout", env={**clean, "CONELIGHT_BUILD_DIR": str(built)})
        wheel, = (self.folder / "dist").iterdir()
        self.assertIn("linux", wheel.name)
        run(python, "-m", "pip", "uninstall", "-y", "conelight", env=clean)
        bare = {**clean, "PATH": ""}
        run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel, env=bare)
        self.check(python, bare)

    def check(self, python, environment):
        said = run(python, "-c", "import conelight, os; print(os.path.dirname(conelight.__file__), "
                   "conelight.__version__, conelight.Scene.load('builtin:cornell').triangle_count)", env=environment,
                   cwd=self.folder).split()
        self.assertTrue(said[0].startswith(str(self.folder)))
        self.assertEqual(said[1:], [conelight.__version__, "42"])
        self.assertEqual({"__init__.pyi", "py.typed"} - set(os.listdir(said[0])), set())


if __name__ == "__main__":
    unittest.main()
