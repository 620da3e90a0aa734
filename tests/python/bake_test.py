# SPDX-License-Identifier: MIT
import json
import os
import tempfile
import unittest

import conelight
import numpy as np
from support import ErrorCase, run_program


class Probes(ErrorCase):
    def test_are_those_of_the_program(self):
        scene = conelight.Scene.load("builtin:cornell")
        seen = []
        probes = conelight.bake_probes(scene, spacing=0.3, samples=64, seed=3, progress=seen.append)
        with tempfile.TemporaryDirectory() as folder:
            run_program("bake", "builtin:cornell", "--spacing", 0.3, "--samples", 64, "--seed", 3, "--no-check", "-o",
                        folder)
            with open(os.path.join(folder, "probes.json"), encoding="utf-8") as file:
                written = json.load(file)
        x, y, z = written["grid"]["counts"]
        self.assertEqual(probes["position"].shape, (z, y, x, 3))
        self.assertEqual(probes["sh"].shape, (z, y, x, 9, 3))
        self.assertEqual(probes["irradiance"].shape, (z, y, x, 8, 8, 3))
        self.assertEqual(probes["distance"].shape, (z, y, x, 16, 16, 2))
        self.assertEqual(probes["active"].dtype, bool)
        flat = {name: probes[name].reshape(x * y * z, *probes[name].shape[3:]) for name in ("position", "active", "sh")}
        for number, probe in enumerate(written["probes"]):
            self.assertEqual(flat["active"][number], probe["active"])
            np.testing.assert_allclose(flat["position"][number], probe["position"], rtol=1e-6)
            np.testing.assert_allclose(flat["sh"][number], probe["sh"], rtol=1e-5, atol=1e-7)
        np.testing.assert_allclose(probes["spacing"], written["grid"]["spacing"], rtol=1e-6)
        self.assertGreater(len(seen), 0)
        self.assertTrue(all(0 <= done <= 1 for done in seen))
        self.assertGreater(np.median(probes["irradiance"]), 0.01)

    def test_stops_and_refuses(self):
        scene = conelight.Scene.load("builtin:cornell")
        self.assertEqual(conelight.bake_probes(scene, samples=16, progress=lambda done: False), {})
        with self.assertRaises(ZeroDivisionError):
            conelight.bake_probes(scene, samples=16, progress=lambda done: 1 / 0)
        self.assert_error("usage", "spacing", conelight.bake_probes, scene, spacing=-1)
        self.assert_error("usage", "samples", conelight.bake_probes, scene, samples=1)
        self.assert_error("usage", "bounces", conelight.bake_probes, scene, bounces=0)
        with self.assertRaises(TypeError):
            conelight.bake_probes(scene, spacings=1)


if __name__ == "__main__":
    unittest.main()
