# SPDX-License-Identifier: MIT
"""The notebooks run from top to bottom, small, and print what they promise. Skipped without matplotlib."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

from support import renderer

try:
    import matplotlib
except ImportError:
    matplotlib = None

EXAMPLES = os.path.join(os.environ["CONELIGHT_SOURCE_DIR"], "examples", "python")


@unittest.skipIf(matplotlib is None, "no matplotlib; scripts/install_packages --notebooks installs it")
class Notebooks(unittest.TestCase):
    def setUp(self):
        renderer()  # skips where there is no OpenGL
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_cells(self, name, figures, **environment):
        """Runs the code cells as one program; every plt.show() keeps a figure. Returns what was printed."""
        with open(os.path.join(EXAMPLES, "notebooks", name), encoding="utf-8") as file:
            notebook = json.load(file)
        self.assertEqual(notebook["nbformat"], 4)
        self.assertGreater(sum(cell["cell_type"] == "markdown" for cell in notebook["cells"]), 2)
        program = ["import matplotlib", "matplotlib.use('Agg')", "import matplotlib.pyplot as plt", "_shown = []",
                   "def _show():",
                   "    plt.savefig(f'{len(_shown)}.png'); _shown.append(plt.gcf()); plt.close('all')",
                   "plt.show = _show"]
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                self.assertEqual(cell["outputs"], [], "notebooks are kept without outputs")
                program.append("".join(cell["source"]))
        environment = {**os.environ, "EXAMPLES": EXAMPLES, "MPLCONFIGDIR": self.folder,
                       **{key: str(value) for key, value in environment.items()}}
        done = subprocess.run([sys.executable, "-B", "-c", "\n".join(program)], capture_output=True, text=True,
                              check=False, cwd=self.folder, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        for number in range(figures):
            self.assertGreater(os.path.getsize(os.path.join(self.folder, f"{number}.png")), 4000)
        self.assertFalse(os.path.exists(os.path.join(self.folder, f"{figures}.png")))
        return done.stdout

    def test_error_against_samples(self):
        printed = self.run_cells("error_against_samples.ipynb", 1, SIDE=32, TRUTH=512, MOST=64)
        self.assertLess(abs(float(re.search(r"slope (\S+),", printed)[1]) + 0.5), 0.15)
        self.assertLess(float(re.search(r"high: (\S+) %", printed)[1]), 8)

    def test_data_set(self):
        printed = self.run_cells("data_set.ipynb", 2, ROOMS=3, SIZE="32x24", OUT=os.path.join(self.folder, "rooms"))
        self.assertIn("3 rooms", printed)
        mean, least, most = map(int, re.search(r"light: (\d+) % of all, (\d+) to (\d+) %", printed).groups())
        self.assertLess(least, most)
        self.assertTrue(5 < least <= mean <= most < 95)

    def test_probe_volume(self):
        printed = self.run_cells("probe_volume.ipynb", 1, SPACING=0.25, SAMPLES=256)
        left, right = map(float, re.search(r"green: (\S+) facing left, (\S+) facing right", printed).groups())
        self.assertGreater(left, 1.5 * right)


if __name__ == "__main__":
    unittest.main()
