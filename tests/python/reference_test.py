# SPDX-License-Identifier: MIT
import os
import signal
import tempfile
import threading
import time
import unittest

import conelight
import numpy as np
from support import SETTINGS, SIZE, ErrorCase, renderer, run_program


def cornell():
    return conelight.Scene.load("builtin:cornell")


def trace(scene=None, **options):
    scene = scene or cornell()
    return conelight.reference(scene, scene.cameras[0], SIZE, **{"samples": 8, **options})


class Truth(ErrorCase):
    def test_is_the_program_s(self):
        parts = ["direct", "indirect", "half_a", "bounce1"]
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "truth.exr")
            run_program("render", "builtin:cornell", "--mode", "reference", "--spp", 8, "--seed", 3, "--filter",
                        "center", "--size", "48x32", "--aov", ",".join(parts), "-o", file)
            wanted = conelight.read(file)
        pictures = trace(seed=3, components=["full", *parts])
        self.assertEqual(list(pictures), ["full", *parts])
        for name, picture in pictures.items():
            np.testing.assert_array_equal(picture, wanted[name], name)

    def test_denoise(self):
        truth, noisy, clean = trace(samples=256, seed=9)["full"], trace()["full"], trace(denoise=True)["full"]
        self.assertLess(np.mean((clean - truth) ** 2), 0.5 * np.mean((noisy - truth) ** 2))
        self.assert_error("usage", "denoise", trace, denoise="best")

    def test_seeds_and_threads(self):
        one = trace(threads=1)["full"]
        np.testing.assert_array_equal(one, trace(threads=2)["full"])
        self.assertFalse(np.array_equal(one, trace(seed=2)["full"]))

    def test_halves_and_bounces(self):
        pictures = trace(components=["full", "half_a", "half_b", "direct"])
        np.testing.assert_allclose((pictures["half_a"] + pictures["half_b"]) / 2, pictures["full"], rtol=1e-5, atol=1e-6)
        np.testing.assert_array_equal(trace(bounces=0)["full"], trace(bounces=0, components=["direct"])["direct"])

    def test_renderer_is_near_it(self):
        scene = cornell()
        ours = renderer().render(scene, None, SIZE, SETTINGS)["full"]
        truth = trace(scene, samples=128, components=["full", "half_a", "half_b"])
        scores = conelight.compare(ours, truth["full"], halves=(truth["half_a"], truth["half_b"]), flip=False)
        self.assertLess(scores["relrmse"], 0.1)
        self.assertLess(abs(scores["bias"]), 0.03)

    def test_a_tracer_keeps_the_scene_as_it_was(self):
        scene = cornell()
        tracer = conelight.PathTracer(scene)
        before = tracer.render(scene.cameras[0], SIZE, samples=4)["full"]
        scene.materials[0].base_color = (0, 0, 0, 1)
        scene.add_light("point", intensity=(9, 9, 9), position=(0, 0.5, 0))
        np.testing.assert_array_equal(tracer.render(scene.cameras[0], SIZE, samples=4)["full"], before)
        self.assertFalse(np.array_equal(trace(scene, samples=4)["full"], before))
        self.assertEqual(tracer.stats["samples"], 4)
        self.assertGreater(tracer.stats["rays"], 48 * 32 * 4)

    def test_noise_is_a_goal(self):
        scene = cornell()
        tracer = conelight.PathTracer(scene)
        tracer.render(scene.cameras[0], SIZE, samples=4096, noise=0.2)
        self.assertLess(tracer.stats["noise"], 0.2)
        self.assertLess(tracer.stats["samples"], 4096)


class Surfaces(ErrorCase):
    def test_are_what_the_renderer_sees(self):
        for name in ("builtin:cornell", "builtin:study"):
            scene = conelight.Scene.load(name)
            camera, size = scene.cameras[0], (96, 64)
            seen = conelight.PathTracer(scene).surfaces(camera, size)
            drawn = renderer().render(scene, camera, size, SETTINGS, components=["depth", "normal"])
            # Edges may fall to either side of a pixel's centre, by rounding.
            near = np.abs(seen["depth"] - drawn["depth"]) <= 1e-3 * drawn["depth"]
            self.assertGreater(near.mean(), 0.99)
            alike = (seen["geometric_normal"] * drawn["normal"]).sum(axis=-1)[near & (drawn["depth"] > 0)]
            self.assertGreater((alike > 0.7).mean(), 0.98)
            hit = seen["instance"] >= 0
            np.testing.assert_array_equal(hit, seen["depth"] > 0)
            np.testing.assert_allclose(camera.positions(seen["depth"])[hit], seen["position"][hit], atol=1e-4)

    def test_numbers_are_the_scene_s(self):
        scene = cornell()
        seen = conelight.PathTracer(scene).surfaces(scene.cameras[0], (96, 64))
        self.assertGreater(len(np.unique(seen["instance"])), 5)
        for number in np.unique(seen["instance"]):
            here = seen["instance"] == number
            if number < 0:
                self.assertEqual(set(seen["material"][here]) | set(seen["triangle"][here]), {-1})
                self.assertEqual(np.abs(seen["position"][here]).max(), 0)
                continue
            instance = scene.instances[number]
            material = scene.materials[instance.material]
            self.assertEqual(set(seen["material"][here]), {instance.material})
            np.testing.assert_allclose(seen["base_color"][here], [material.base_color[:3]] * here.sum(), rtol=1e-6)
            self.assertEqual(set(seen["roughness"][here]), {np.float32(material.roughness)})
            # The point lies in the plane of the triangle that is named.
            mesh = scene.meshes[instance.mesh]
            corners = mesh.positions[mesh.indices[seen["triangle"][here]]] @ instance.transform[:3, :3].T
            corners = corners + instance.transform[:3, 3]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            away = ((seen["position"][here] - corners[:, 0]) * normal).sum(axis=1)
            self.assertLess(np.abs(away).max(), 1e-4)

    def test_uv_runs_over_a_square(self):
        scene = conelight.Scene()
        square = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]],
                                uvs=[[0, 1], [1, 1], [1, 0], [0, 0]])
        scene.add_instance(square)
        camera = conelight.Camera((0, 0, 1), (0, 0, 0), vfov=np.pi / 2)  # the square fills the picture
        seen = conelight.PathTracer(scene).surfaces(camera, (8, 8))
        centres = (np.arange(8) + 0.5) / 8
        np.testing.assert_allclose(seen["uv"], np.stack(np.meshgrid(centres, centres), axis=-1), atol=1e-5)
        self.assertEqual(set(seen["material"].ravel()), {-1})


class Progress(ErrorCase):
    def test_is_called_and_stops(self):
        seen = []

        def stop(now):
            seen.append((now.samples_done, now.samples_planned))
            return False

        picture = trace(samples=1 << 16, progress=stop)["full"]
        self.assertEqual(len(seen), 1)
        self.assertEqual(seen[0][1], 1 << 16)
        self.assertGreater(picture.mean(), 0)

    def test_errors_of_the_callback_arrive(self):
        with self.assertRaises(TypeError):
            trace(samples=1 << 16, progress=5)
        with self.assertRaises(ZeroDivisionError):
            trace(samples=1 << 16, progress=lambda now: 1 / 0)

    def test_other_threads_go_on_meanwhile(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(1)
                done.wait(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        trace(samples=256)
        done.set()
        thread.join()
        self.assertGreater(len(counted), 5)

    def test_interrupts_end_it(self):
        started = []

        def interrupt(now):
            if not started:
                started.append(now)
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            trace(samples=1 << 16, progress=interrupt)

    def test_interrupts_end_it_without_a_callback(self):
        scene = cornell()
        tracer = conelight.PathTracer(scene)
        start = time.process_time()

        def interrupt():
            while time.process_time() < start + 0.3:  # until it traces: nothing else here takes so much work
                time.sleep(0.01)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        with self.assertRaises(KeyboardInterrupt):
            thread.start()
            tracer.render(scene.cameras[0], SIZE, samples=1 << 18)
        thread.join()
        self.assertEqual(tracer.stats, {})  # it did not go on to its end


class Refusals(ErrorCase):
    def test_arguments(self):
        for text, named in [("samples: 0", {"samples": 0}),
                            ("has no 'depth'", {"components": ["depth"]}), ("has no 'bounce65'", {"components": "bounce65"}),
                            ("bounces: -2", {"bounces": -2}), ("bounces: 'some'", {"bounces": "some"}),
                            ("filter: there is no 'gauss'", {"filter": "gauss"}), ("noise", {"noise": -1.0}),
                            ("threads", {"threads": -1})]:
            self.assert_error("usage", text, trace, **named)
        for named in ({"spp": 4}, {"samples": "many"}):
            with self.assertRaises(TypeError):
                trace(**named)


if __name__ == "__main__":
    unittest.main()
