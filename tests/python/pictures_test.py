# SPDX-License-Identifier: MIT
import json
import os
import tempfile
import unittest

import conelight
import numpy as np
from support import ErrorCase, run_program


def gradient(shape=(24, 32, 3), seed=1):
    return np.random.default_rng(seed).random(shape, np.float32)


class Files(ErrorCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_exr_keeps_every_bit(self):
        for shape in [(24, 32), (24, 32, 3), (24, 32, 4)]:
            picture = gradient(shape) - 0.25
            conelight.save(self.path("a.exr"), picture)
            np.testing.assert_array_equal(conelight.read(self.path("a.exr"))["full"], picture)

    def test_layers(self):
        pictures = {"depth": gradient((24, 32)), "full": gradient(), "albedo": gradient(seed=2)}
        conelight.save(self.path("a.exr"), pictures)
        read = conelight.read(self.path("a.exr"))
        self.assertEqual(list(read)[0], "full")
        self.assertEqual(set(read), set(pictures))
        for name, picture in pictures.items():
            np.testing.assert_array_equal(read[name], picture)
        run_program("compare", self.path("a.exr"), self.path("a.exr"), "--layer", "albedo")

    def test_views_of_pictures(self):
        picture = gradient((48, 64, 4))[::2, ::-2, :3]
        conelight.save(self.path("a.exr"), picture)
        np.testing.assert_array_equal(conelight.read(self.path("a.exr"))["full"], picture)

    def test_png_by_the_tone_map(self):
        plain = {"image.tone_map": "none", "image.srgb": True}
        conelight.save(self.path("a.png"), gradient(), plain)
        read = conelight.read(self.path("a.png"))["full"]
        # Half a step of 8 bits is at most 0.0045 of linear radiance, at white.
        self.assertLess(np.abs(read - gradient()).max(), 0.005)
        conelight.save(self.path("b.png"), gradient(), {**plain, "image.exposure": -1})
        self.assertLess(np.abs(conelight.read(self.path("b.png"))["full"] - gradient() / 2).max(), 0.005)

    def test_wrong_ones_write_nothing(self):
        for text, name, pictures in [("unknown picture extension", "a.foo", gradient()),
                                     ("has shape (3,)", "a.exr", np.zeros(3)),
                                     ("has shape (2, 2, 2)", "a.exr", np.zeros((2, 2, 2))),
                                     ("has shape (0, 4, 3)", "a.exr", np.zeros((0, 4, 3))),
                                     ("is empty", "a.exr", {}),
                                     ("b: is of another size", "a.exr", {"a": gradient(), "b": gradient((3, 3))})]:
            self.assert_error("usage", text, conelight.save, self.path(name), pictures)
        self.assert_error("runtime", "a.exr", conelight.save, self.path("no/folder/a.exr"), gradient())
        self.assert_error("bad_input", "none.exr", conelight.read, self.path("none.exr"))
        self.assertEqual(os.listdir(self.folder), [])


class Scores(ErrorCase):
    def test_are_the_program_s(self):
        test, truth = gradient(), gradient(seed=2)
        halves = [truth + 0.01, truth - 0.01]
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, f"{i}.exr") for i in range(4)]
            for file, picture in zip(files, [test, truth, *halves], strict=True):
                conelight.save(file, picture)
            wanted = json.loads(run_program("compare", files[0], files[1], "--halves", f"{files[2]},{files[3]}",
                                            "--json", "-"))["metrics"]
        scores = conelight.compare(test, truth, halves=halves)
        self.assertEqual(set(scores), set(wanted))
        for key, value in wanted.items():
            self.assertEqual(scores[key], value, key)

    def test_equal_pictures(self):
        scores = conelight.compare(gradient(), gradient())
        self.assertEqual((scores["rmse"], scores["flip"], scores["psnr_db"]), (0, 0, np.inf))
        self.assertNotIn("flip", conelight.compare(gradient(), gradient(), flip=False))

    def test_error_maps(self):
        truth = gradient()
        truth[0, 0] = 0.5
        test = truth.copy()
        test[0, 0] += 0.25
        values = conelight.error_map(test, truth)
        self.assertEqual(values.shape, (24, 32))
        self.assertAlmostEqual(values[0, 0], 0.25 / truth.mean(), delta=1e-5)
        self.assertEqual(np.abs(values).sum(), values[0, 0])

    def test_refusals(self):
        self.assert_error("usage", "test: is 32x24 pixels", conelight.compare, gradient(), gradient((3, 3, 3)))
        self.assert_error("usage", "halves: 1 pictures", conelight.compare, gradient(), gradient(), halves=[gradient()])
        self.assert_error("usage", "'square' is no kind", conelight.error_map, gradient(), gradient(), "square")
        self.assert_error("bad_input", "finite", conelight.compare, gradient() * np.nan, gradient())
        with self.assertRaises(TypeError):
            conelight.compare(gradient(), gradient(), fast=True)


if __name__ == "__main__":
    unittest.main()
