# SPDX-License-Identifier: MIT
import copy
import pickle
import unittest

import conelight
from support import ErrorCase, run_program


class Values(ErrorCase):
    def test_types(self):
        settings = conelight.Settings()
        self.assertEqual(settings["voxels.size"], 128)
        self.assertIs(type(settings["voxels.size"]), int)
        self.assertEqual(settings["mode"], "traced")
        self.assertIs(settings["image.srgb"], True)
        self.assertIs(type(settings["voxels.padding"]), float)
        self.assertEqual(settings["traced.bounces"], "all")

    def test_every_setting_takes_what_it_gives(self):
        settings = conelight.Settings()
        self.assertGreater(len(settings), 50)
        for key in settings:
            value = settings[key]
            settings[key] = value
            self.assertEqual(settings.get(key), value)
            self.assertEqual(conelight.Settings.describe(key)["default"], value, key)
        self.assertEqual(settings, conelight.Settings())

    def test_names_are_the_program_s(self):
        listed = run_program("settings")
        for key in conelight.Settings():
            self.assertIn(key, listed)

    def test_bools_words_and_numbers(self):
        settings = conelight.Settings({"phong.shadows": True, "traced.exact_mirrors": True, "traced.bounces": 2,
                                       "image.exposure": "auto"})
        self.assertEqual([settings[key] for key in ("phong.shadows", "traced.exact_mirrors", "traced.bounces",
                                                    "image.exposure")], ["on", True, 2, "auto"])
        self.assertIn("'traced.bounces': 2", repr(settings))

    def test_qualities(self):
        self.assertEqual(conelight.Settings().quality, "interactive")
        high = conelight.Settings(quality="high")
        self.assertEqual(high.quality, "high")
        self.assertNotEqual(high, conelight.Settings())
        self.assertEqual(conelight.Settings({"traced.passes": 3}, quality="high").quality, "custom")
        high.quality = "draft"
        self.assertEqual(high, conelight.Settings(quality="draft"))

    def test_copies(self):
        settings = conelight.Settings({"traced.bounces": 2, "image.exposure": "auto", "phong.shadows": True})
        for copied in (settings.copy(), copy.copy(settings), copy.deepcopy(settings),
                       pickle.loads(pickle.dumps(settings)), conelight.Settings(dict(settings))):
            self.assertEqual(copied, settings)
            copied["voxels.size"] = 64
            self.assertNotEqual(copied, settings)

    def test_wrong_ones_change_nothing(self):
        settings = conelight.Settings()
        self.assert_error("usage", "voxels.size would be the nearest", settings.set, "voxels.siz", 64)
        self.assert_error("usage", "8 to 512", settings.set, "voxels.size", 3)
        self.assert_error("usage", "voxels.size", settings.set, "voxels.size", 64.5)
        self.assert_error("usage", "image.srgb", settings.set, "image.srgb", 2)
        self.assert_error("usage", "nosuch", settings.get, "nosuch")
        self.assert_error("usage", "voxels.size", settings.update, {"voxels.padding": 0.1, "voxels.size": 3})
        self.assert_error("usage", "best", conelight.Settings, quality="best")
        self.assertEqual(settings, conelight.Settings())
        self.assertNotIn("nosuch", settings)

    def test_a_scene_s_own(self):
        scene = conelight.Scene.load("builtin:cornell")
        self.assertEqual(scene.settings("cones")["mode"], "cones")
        self.assertEqual(scene.settings()["mode"], "traced")


if __name__ == "__main__":
    unittest.main()
