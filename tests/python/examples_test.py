# SPDX-License-Identifier: MIT
import os
import subprocess
import sys
import tempfile
import unittest

import conelight
import numpy as np
from support import renderer

EXAMPLES = os.path.join(os.environ["CONELIGHT_SOURCE_DIR"], "examples", "python")


def run_example(name, *arguments):
    done = subprocess.run([sys.executable, "-B", os.path.join(EXAMPLES, name), *map(str, arguments)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{name}: {done.stderr}")
    return done.stdout


class Examples(unittest.TestCase):
    def setUp(self):
        renderer()  # skips where there is no OpenGL
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_quick_start(self):
        printed = run_example("quick_start.py", self.folder, "64x48").split()
        self.assertLess(float(printed[-1]), 0.2)  # noise of 64 samples
        corner = conelight.read(os.path.join(self.folder, "corner.png"))["full"]
        wall = corner[20, 64 * np.array([0, 1]) + 20]  # a pixel of the wall: red, then blue
        self.assertGreater(wall[0, 0], 3 * wall[0, 2])
        self.assertGreater(wall[1, 2], 3 * wall[1, 0])
        points = conelight.read(os.path.join(self.folder, "points.exr"))["full"]
        self.assertLess(np.abs(points[48 // 2, 64 // 2 - 1:64 // 2 + 1, 0]).max(), 0.05)  # the axis is x = 0
        self.assertEqual(conelight.read(os.path.join(self.folder, "cornell.exr"))["depth"].shape, (48, 64))

    def test_random_rooms(self):
        for run in ("a", "b"):
            run_example("random_rooms.py", "--count", 2, "--size", "48x36", "--voxels", 64, "--truth", 32, "--out",
                        os.path.join(self.folder, run))
        rooms = [np.load(os.path.join(self.folder, run, f"room000{i}.npz")) for run in "ab" for i in range(2)]
        self.assertFalse(np.array_equal(rooms[0]["full"], rooms[1]["full"]))
        for first, again in zip(rooms[:2], rooms[2:], strict=True):
            self.assertEqual(set(first.files), {"full", "indirect", "albedo", "normal", "depth", "instance", "truth",
                                                "K", "R", "t"})
            self.assertGreaterEqual(len(np.unique(first["instance"])), 2)
            for name in first.files:
                np.testing.assert_array_equal(first[name], again[name])
            # A closed room: something behind every pixel, some light on nearly all, and the truth is near.
            self.assertGreater(first["depth"].min(), 0)
            self.assertGreater(np.median(first["full"]), 0.05)
            scores = conelight.compare(first["full"], first["truth"], flip=False)
            self.assertLess(abs(scores["bias"]), 0.1)
        self.assertIn("room0001.png", os.listdir(os.path.join(self.folder, "a")))

    def test_error_against_samples(self):
        table = run_example("error_against_samples.py", "--size", "32x32", "--truth", 512, "--most", 64, "--voxels", 64)
        errors = {line[:24].strip(): float(line[24:].split()[0]) for line in table.splitlines()[1:]}
        self.assertEqual(list(errors), ["path tracer, 4 samples", "path tracer, 16 samples", "path tracer, 64 samples",
                                        "renderer, draft", "renderer, interactive", "renderer, high"])
        # Four times the samples halve the error; half again as much is left for chance.
        self.assertLess(errors["path tracer, 16 samples"], 0.75 * errors["path tracer, 4 samples"])
        self.assertLess(errors["path tracer, 64 samples"], 0.75 * errors["path tracer, 16 samples"])
        self.assertLess(errors["renderer, interactive"], 8)


if __name__ == "__main__":
    unittest.main()
