# SPDX-License-Identifier: MIT
import gc
import json
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import conelight
import numpy as np
from support import SETTINGS, SIZE, ErrorCase, renderer, run_program, scene_from_arrays


def cornell():
    return conelight.Scene.load("builtin:cornell")


def full(scene, **options):
    return renderer().render(scene, None, SIZE, SETTINGS, **options)["full"]


class Pictures(ErrorCase):
    def test_array_scene_has_the_loaded_one_s_bits(self):
        loaded = cornell()
        np.testing.assert_array_equal(full(loaded), full(scene_from_arrays(loaded)))

    def test_program_writes_the_same_file(self):
        parts = ["direct", "indirect", "albedo", "depth"]
        with tempfile.TemporaryDirectory() as folder:
            theirs, ours = os.path.join(folder, "theirs.exr"), os.path.join(folder, "ours.exr")
            run_program("render", "builtin:cornell", "--size", "48x32", "--voxels", 32, "--aa", 0, "--aov",
                        ",".join(parts), "-o", theirs)
            pictures = renderer().render(cornell(), None, SIZE, SETTINGS, components=["full", *parts])
            conelight.save(ours, pictures["full"])
            with_layers = conelight.read(theirs)
            for name in ["full", *parts]:
                wanted = with_layers[name][..., 0] if name == "depth" else with_layers[name]
                np.testing.assert_array_equal(pictures[name], wanted, name)
            run_program("render", "builtin:cornell", "--size", "48x32", "--voxels", 32, "--aa", 0, "-o", theirs)
            np.testing.assert_array_equal(conelight.read(theirs)["full"], conelight.read(ours)["full"])

    def test_modes_and_settings_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "cones.exr")
            run_program("render", "builtin:sunroom", "--size", "48x32", "--voxels", 32, "--mode", "cones", "-o", file)
            scene = conelight.Scene.load("builtin:sunroom")
            settings = scene.settings("cones")
            settings.update(SETTINGS)
            picture = renderer().render(scene, None, SIZE, settings)["full"]
            np.testing.assert_array_equal(picture, conelight.read(file)["full"])

    def test_shapes_and_types(self):
        names = ["full", "indirect", "albedo", "normal", "depth", "occlusion"]
        pictures = renderer().render(cornell(), None, SIZE, SETTINGS, components=names)
        self.assertEqual(list(pictures), names)
        for name, picture in pictures.items():
            self.assertEqual(picture.dtype, np.float32)
            self.assertEqual(picture.shape, (32, 48) if name in ("depth", "occlusion") else (32, 48, 3))
            # The renderer's own pixels, four numbers each, without a copy.
            self.assertEqual(picture.strides[1], 16)
            self.assertIs(picture.flags.owndata, False)
            self.assertIs(picture.flags.writeable, True)
        self.assertEqual(full(cornell(), alpha=True).shape, (32, 48, 4))
        self.assertTrue(full(cornell(), alpha=True).flags.c_contiguous)

    def test_parts_add_up(self):
        pictures = renderer().render(cornell(), None, SIZE, SETTINGS, components=["full", "direct", "indirect"])
        np.testing.assert_allclose(pictures["direct"] + pictures["indirect"], pictures["full"], rtol=1e-5, atol=1e-6)

    def test_geometry_of_the_pixels(self):
        scene = cornell()
        camera = scene.cameras[0]
        pictures = renderer().render(scene, camera, SIZE, SETTINGS, components=["depth", "normal"])
        lengths = np.linalg.norm(pictures["normal"], axis=-1)
        seen = pictures["depth"] > 0
        np.testing.assert_allclose(lengths[seen], 1, atol=1e-3)
        self.assertEqual(lengths[~seen].max(initial=0), 0)
        # Points behind the pixels lie in the box, and those of the floor at its height. Up is up in the picture.
        points = camera.positions(pictures["depth"])[seen]
        self.assertTrue((np.abs(points - [0, 0.5, 0]) < 0.501).all())
        floor = (pictures["normal"][..., 1] > 0.99)[-1]
        self.assertGreater(floor.sum(), 10)
        np.testing.assert_allclose(camera.positions(pictures["depth"])[-1][floor][:, 1], 0, atol=2e-3)

    def test_pictures_outlive_everything(self):
        own = conelight.Renderer()
        picture = own.render(cornell(), None, SIZE, SETTINGS)["full"]
        before = picture.copy()
        del own
        gc.collect()
        full(cornell())
        np.testing.assert_array_equal(picture, before)


class Changes(ErrorCase):
    def check(self, change):
        """A change shows. A renderer that followed it is near one that loaded it anew; set_scene makes it the same."""
        scene = cornell()
        own = conelight.Renderer()
        before = own.render(scene, None, SIZE, SETTINGS)["full"]
        change(scene)
        after = own.render(scene, None, SIZE, SETTINGS)["full"]
        self.assertFalse(np.array_equal(before, after))
        anew = full(scene)
        # Measured: 0.4 to 1.3 %, while the changes themselves make 20 % and more.
        self.assertLess(conelight.compare(after, anew, flip=False)["relrmse"], 0.03)
        self.assertGreater(conelight.compare(before, anew, flip=False)["relrmse"], 0.1)
        own.set_scene(scene)
        np.testing.assert_array_equal(own.render(None, scene.cameras[0], SIZE, SETTINGS)["full"], anew)

    def test_material(self):
        def change(scene):
            scene.materials[0].base_color = (0.2, 0.3, 0.9, 1)
        self.check(change)

    def test_light(self):
        self.check(lambda scene: scene.add_light("point", position=(0, 0.5, 0.3), intensity=(1, 1, 1)))

    def test_sky(self):
        def change(scene):
            scene.sky = (1, 1, 2)
        self.check(change)

    def test_environment(self):
        self.check(lambda scene: scene.set_environment(np.ones((4, 8, 3), np.float32)))

    def test_mesh(self):
        def change(scene):
            mesh = scene.meshes[0]
            mesh.replace(mesh.positions * 0.9, mesh.indices, normals=mesh.normals)
        self.check(change)

    def test_transform(self):
        def change(scene):
            moved = scene.instances[-1].transform.copy()
            moved[0, 3] += 0.1
            scene.instances[-1].transform = moved
        self.check(change)

    def test_cameras_leave_nothing_behind(self):
        scene, own = cornell(), conelight.Renderer()
        before = own.render(scene, None, SIZE, SETTINGS)["full"]
        own.render(scene, conelight.Camera((0.1, 0.5, 1.8), (0, 0.5, 0)), SIZE, SETTINGS)
        np.testing.assert_array_equal(own.render(scene, None, SIZE, SETTINGS)["full"], before)

    def test_same_scene_is_the_same_picture(self):
        scene, own = cornell(), conelight.Renderer()
        first = own.render(scene, None, SIZE, SETTINGS)["full"]
        np.testing.assert_array_equal(first, own.render(scene, None, SIZE, SETTINGS)["full"])
        np.testing.assert_array_equal(first, own.render(None, scene.cameras[0], SIZE, SETTINGS)["full"])


class Refusals(ErrorCase):
    def test_arguments(self):
        scene, draw = cornell(), renderer().render
        self.assert_error("usage", "size: (0, 3) is no picture size", draw, scene, None, (0, 3))
        self.assert_error("usage", "size: ", draw, scene, None, 5)
        self.assert_error("usage", "'glow'", draw, scene, None, SIZE, components=["full", "glow"])
        self.assert_error("usage", "components: [] names none", draw, scene, None, SIZE, components=[])
        self.assert_error("usage", "voxels.size", draw, scene, None, SIZE, {"voxels.size": 3})
        with self.assertRaises(TypeError):
            draw(scene, None, SIZE, component="full")
        with self.assertRaises(TypeError):
            draw(scene, (0, 0, 1), SIZE)
        with self.assertRaises(TypeError):
            draw(scene, None, SIZE, [1])

    def test_no_scene(self):
        renderer()
        own = conelight.Renderer()
        camera = conelight.Camera((0, 0, 3), (0, 0, 0))
        self.assert_error("usage", "scene: there is none", own.render, None, camera, SIZE)
        self.assert_error("usage", "camera: there is none", own.render, None, None, SIZE)

    def test_refused_scene_leaves_the_renderer_usable(self):
        scene, own = cornell(), conelight.Renderer()
        before = own.render(scene, None, SIZE, SETTINGS)["full"]
        broken = cornell()
        broken.materials[0].roughness = float("nan")
        self.assert_error("bad_input", "roughness is not finite", own.render, broken, None, SIZE, SETTINGS)
        np.testing.assert_array_equal(own.render(scene, None, SIZE, SETTINGS)["full"], before)

    def test_no_such_device(self):
        renderer()
        self.assert_error("usage", "device: there is no EGL device 99", conelight.Renderer, 99)

    def test_no_opengl(self):
        code = "import conelight\ntry: conelight.Renderer()\nexcept conelight.Error as error: print(error.kind)"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                              env={**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"})
        self.assertEqual(done.stdout.strip(), "no_gl")

    def test_empty_scenes_are_black(self):
        empty = conelight.Scene()
        self.assertEqual(full(empty).max(), 0)
        empty.add_instance(empty.add_mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))
        self.assertIsNone(empty.bounds)
        self.assertEqual(full(empty).max(), 0)

    def test_indices_that_lead_nowhere(self):
        scene = cornell()
        scene.instances[0].material = 99
        self.assert_error("bad_input", "material 99; less than 4", full, scene)
        scene = cornell()
        scene.materials[0].base_color_texture = 3
        self.assert_error("bad_input", "names texture 3", full, scene)


class Threads(ErrorCase):
    def test_renderers_of_several_threads(self):
        """Calls from any thread, of one renderer and of two, give the picture that one thread gives."""
        scene, other = cornell(), conelight.Renderer()
        wanted = full(scene)
        results, failures = [], []

        def work(own):
            try:
                for _ in range(3):
                    results.append(own.render(scene, None, SIZE, SETTINGS)["full"])
            except Exception as error:  # pylint: disable=broad-except
                failures.append(error)

        threads = [threading.Thread(target=work, args=(own,)) for own in (renderer(), other, other)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        self.assertEqual(len(results), 9)
        for picture in results:
            np.testing.assert_array_equal(picture, wanted)


class Development(ErrorCase):
    def test_a_debug_context_has_nothing_to_say(self):
        renderer()
        with self.assertNoLogs("conelight", "WARNING"):
            picture = conelight.Renderer(debug=True).render(cornell(), None, SIZE, SETTINGS)["full"]
        np.testing.assert_array_equal(picture, full(cornell()))

    def test_shaders_of_a_folder_win(self):
        renderer()
        name = os.path.join("image", "debug_view.comp.glsl")
        with open(os.path.join(os.environ["CONELIGHT_SOURCE_DIR"], "shaders", name), encoding="utf-8") as file:
            source = file.read()
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "image"))
            for change, broken in (("vec3(7.0 * surface.depth)", False), ("vec3(surface.nothing)", True)):
                self.assertIn("vec3(surface.depth)", source)
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(source.replace("vec3(surface.depth)", change))
                own = conelight.Renderer(shader_directory=folder)
                arguments = (cornell(), None, SIZE, SETTINGS)
                if broken:
                    with self.assertRaisesRegex(conelight.Error, "debug_view.comp.glsl") as caught:
                        own.render(*arguments, components="depth")
                    self.assertEqual(caught.exception.kind, "runtime")
                else:
                    wanted = renderer().render(*arguments, components="depth")["depth"]
                    np.testing.assert_allclose(own.render(*arguments, components="depth")["depth"], 7 * wanted, rtol=1e-6)


class Costs(ErrorCase):
    def test_stats_of_the_last_picture(self):
        full(cornell(), profile=True)
        stats = renderer().stats
        self.assertGreater(stats["memory_bytes"], 1000000)
        self.assertGreater(len(stats["passes"]), 3)
        json.dumps(stats)


if __name__ == "__main__":
    unittest.main()
