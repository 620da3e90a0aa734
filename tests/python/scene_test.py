# SPDX-License-Identifier: MIT
import base64
import json
import os
import pathlib
import pickle
import tempfile
import unittest

import conelight
import numpy as np
from support import ErrorCase, fields_of, run_program, scene_from_arrays

TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)


def triangle_scene():
    scene = conelight.Scene()
    scene.add_instance(scene.add_mesh(TRIANGLE, [[0, 1, 2]]), scene.add_material(base_color=(0.5, 0.5, 0.5, 1)))
    return scene


class Loading(ErrorCase):
    def test_builtin_has_its_tables(self):
        scene = conelight.Scene.load("builtin:cornell")
        self.assertEqual(scene.triangle_count, 42)
        np.testing.assert_allclose(scene.bounds, [[-0.5, 0, -0.5], [0.5, 1, 0.5]], atol=1e-6)
        self.assertEqual([m.name for m in scene.materials][:2], ["white", "red"])
        self.assertIn("42", scene.info())

    def test_file_is_the_scene_that_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            for file in ("box.glb", "box.gltf"):
                path = pathlib.Path(folder) / file
                conelight.Scene.load("builtin:cornell").save(path)
                self.assertEqual(conelight.Scene.load(path).triangle_count, 42)
            self.assertIn("42", run_program("info", os.path.join(folder, "box.glb")))

    def test_completion_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "triangle.glb")
            triangle_scene().save(path)
            self.assertEqual(len(conelight.Scene.load(path, complete=False).cameras), 0)
            completed = conelight.Scene.load(path)
            self.assertEqual(len(completed.cameras), 1)
            self.assertTrue(completed.notes)

    def test_errors_name_the_file(self):
        self.assert_error("bad_input", "/nowhere/box.glb: no such file", conelight.Scene.load, "/nowhere/box.glb")
        self.assert_error("usage", "builtin:cornel", conelight.Scene.load, "builtin:cornel")
        with self.assertRaises(conelight.Error) as caught:
            conelight.Scene.load("/nowhere/box.glb")
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((type(again), str(again), again.kind),
                         (conelight.Error, str(caught.exception), "bad_input"))

    def test_all_builtins_have_names(self):
        self.assertIn("builtin:cornell", conelight.builtin_scenes())


class Building(ErrorCase):
    def test_every_number_comes_back(self):
        for name in ("builtin:cornell", "builtin:glossy", "builtin:sunroom", "builtin:coats"):
            loaded = conelight.Scene.load(name)
            built = scene_from_arrays(loaded)
            for kind in ("materials", "instances", "lights"):
                pairs = list(zip(getattr(loaded, kind), getattr(built, kind), strict=True))
                for one, other in pairs:
                    for field, value in fields_of(one).items():
                        np.testing.assert_array_equal(getattr(other, field), value, f"{name} {kind} {field}")
            for one, other in zip(loaded.meshes, built.meshes, strict=True):
                for rows in ("positions", "indices", "normals", "uvs", "tangents", "colors"):
                    np.testing.assert_array_equal(getattr(one, rows), getattr(other, rows))
            self.assertEqual(loaded.bounds, built.bounds)

    def test_arrays_of_any_kind_and_order(self):
        scene = conelight.Scene()
        for positions in (TRIANGLE.astype(np.float64), np.asfortranarray(TRIANGLE), TRIANGLE.tolist(),
                          np.repeat(TRIANGLE, 2, axis=0)[::2]):
            for indices in ([[0, 1, 2]], np.array([0, 1, 2], np.int64), np.array([[0, 1, 2]], np.uint8)):
                mesh = scene.add_mesh(positions, indices)
                np.testing.assert_array_equal(mesh.positions, TRIANGLE)
                np.testing.assert_array_equal(mesh.indices, [[0, 1, 2]])
                self.assertEqual(mesh.indices.dtype, np.uint32)
                self.assertIsNone(mesh.normals)

    def test_normals_become_unit_vectors(self):
        mesh = conelight.Scene().add_mesh(TRIANGLE, [[0, 1, 2]], normals=[[0, 0, 2]] * 3)
        np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 3)

    def test_wrong_arrays_are_refused_whole(self):
        scene = conelight.Scene()
        wrong = [
            ("positions: has shape (3, 2); (N, 3)", (TRIANGLE[:, :2], [[0, 1, 2]]), {}),
            ("positions: is no array of numbers", ("text", [[0, 1, 2]]), {}),
            ("positions: is no array of numbers", (None, [[0, 1, 2]]), {}),
            ("indices: have shape (1, 2)", (TRIANGLE, [[0, 1]]), {}),
            ("indices: are no integers", (TRIANGLE, [[0.0, 1.0, 2.0]]), {}),
            ("indices: hold -1", (TRIANGLE, [[0, 1, -1]]), {}),
            ("indices: 3; less than 3", (TRIANGLE, [[0, 1, 3]]), {}),
            ("normals: 2 rows; 3", (TRIANGLE, [[0, 1, 2]]), {"normals": [[0, 0, 1]] * 2}),
            ("normals: row 0 has no length", (TRIANGLE, [[0, 1, 2]]), {"normals": [[0, 0, 0]] * 3}),
            ("uvs: has shape (3, 3)", (TRIANGLE, [[0, 1, 2]]), {"uvs": TRIANGLE}),
        ]
        for text, arguments, named in wrong:
            self.assert_error("usage", text, scene.add_mesh, *arguments, **named)
        with self.assertRaises(TypeError):
            scene.add_mesh(TRIANGLE, [[0, 1, 2]], normal=TRIANGLE)
        self.assertEqual(len(scene.meshes), 0)

    def test_wrong_parts_are_refused_whole(self):
        scene = triangle_scene()
        self.assert_error("usage", "base_color: has shape (2,)", scene.add_material, base_color=(1, 1))
        self.assert_error("usage", "metallic: 'x' is of the wrong type", scene.add_material, metallic="x")
        self.assert_error("usage", "alpha_mode: there is no 'glass'", scene.add_material, alpha_mode="glass")
        self.assert_error("usage", "mesh: 1; 0 or more and less than 1", scene.add_instance, 1)
        self.assert_error("usage", "material: 7", scene.add_instance, 0, 7)
        self.assert_error("usage", "material: 'x' is of the wrong type", scene.add_instance, 0, "x")
        self.assert_error("usage", "transform: has shape (2, 2)", scene.add_instance, 0, 0, np.eye(2))
        self.assert_error("usage", "type: there is no 'lamp'", scene.add_light, "lamp")
        self.assert_error("usage", "direction: has no length", scene.add_light, "spot", direction=(0, 0, 0))
        self.assert_error("usage", "pixels: are no uint8", scene.add_texture, np.zeros((2, 2, 3), np.float32))
        with self.assertRaises(TypeError):
            scene.add_material(colour=(1, 1, 1))
        self.assertEqual((len(scene.materials), len(scene.instances), len(scene.lights)), (1, 1, 0))

    def test_validate_says_what_is_not_finite(self):
        scene = triangle_scene()
        scene.validate()
        scene.materials[0].emission = (float("nan"), 0, 0)
        self.assert_error("bad_input", "emission is not finite", scene.validate)


def moving_file(folder, last_time=2):
    """A glTF file: a triangle, a lamp and a camera on one node, which goes 4 m along x in 2 s; another lamp at rest."""
    data = np.concatenate([TRIANGLE.ravel(), np.float32([0, last_time]), np.float32([0, 0, 0, 4, 0, 0])]).astype("<f4").tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    views = [{"buffer": 0, "byteOffset": start, "byteLength": length} for start, length in ((0, 36), (36, 8), (44, 24))]
    accessors = [{"bufferView": i, "componentType": 5126, "count": count, "type": kind, **bounds}
                 for i, (count, kind, bounds) in enumerate([(3, "VEC3", {"min": [0, 0, 0], "max": [1, 1, 0]}),
                                                            (2, "SCALAR", {"min": [0], "max": [last_time]}), (2, "VEC3", {})])]
    lamp = {"type": "point", "intensity": 100}
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [1, 0]}],
            "buffers": [{"uri": uri, "byteLength": len(data)}], "bufferViews": views, "accessors": accessors,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [{**lamp, "name": "moves"}, {**lamp, "name": "rests"}]}},
            "nodes": [{"mesh": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
                      {"extensions": {"KHR_lights_punctual": {"light": 1}}}],
            "animations": [{"name": "go", "samplers": [{"input": 1, "output": 2}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}
    path = pathlib.Path(folder) / "moving.gltf"
    path.write_text(json.dumps(file), encoding="utf-8")
    return path


class Clips(ErrorCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.scene = conelight.Scene.load(moving_file(folder.name))

    def places(self, scene):
        lamps = {light.name: light.position[0] for light in scene.lights}
        return scene.instances[0].transform[0, 3], scene.cameras[0].eye[0], lamps

    def test_poses(self):
        clip, = self.scene.clips
        self.assertEqual((clip.name, clip.duration), ("go", 2))
        for named in (clip, "go", 0):
            for time, x in ((0.5, 1), (2, 4), (9, 4), (0, 0)):
                self.scene.pose(named, time)
                self.assertEqual(self.places(self.scene), (x, x, {"moves": x, "rests": 0}))

    def test_broken_clips_leave_the_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = conelight.Scene.load(moving_file(folder, last_time=-1))  # times that go back
        self.assertEqual((scene.clips, scene.triangle_count), ((), 1))
        self.assertTrue(any("clips are left out" in note for note in scene.notes), scene.notes)

    def test_lights_that_were_removed(self):
        for gone, left in (("rests", {"moves": 2}), ("moves", {"rests": 0})):
            copy = self.scene.copy()
            copy.remove_light(next(light for light in copy.lights if light.name == gone))
            copy.pose("go", 1)
            self.assertEqual(self.places(copy), (2, 2, left))
        self.assertEqual(len(self.scene.lights), 2)

    def test_what_was_added_stays(self):
        self.scene.add_light("point", position=(7, 0, 0), name="new")
        self.scene.add_instance(0, transform=np.diag([2, 2, 2, 1]))
        self.scene.instances[0].casts_shadow = False
        self.scene.pose("go", 1)
        self.assertEqual(self.places(self.scene)[2], {"moves": 2, "rests": 0, "new": 7})
        self.assertEqual(self.scene.instances[1].transform[0, 3], 0)
        self.assertFalse(self.scene.instances[0].casts_shadow)

    def test_refusals(self):
        self.assert_error("usage", "go", self.scene.pose, "stay", 0)
        self.assert_error("usage", "time: is not finite", self.scene.pose, "go", float("nan"))
        self.assert_error("usage", "nothing moves", conelight.Scene.load("builtin:cornell").pose, 0, 0)
        self.assertEqual(conelight.Scene().clips, ())


class Handles(ErrorCase):
    def test_attributes_are_the_scene(self):
        scene = triangle_scene()
        scene.instances[0].transform = [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]
        self.assertEqual(scene.bounds, ((5, 6, 7), (6, 7, 7)))
        np.testing.assert_array_equal(scene.instances[0].transform[:3, 3], [5, 6, 7])
        scene.materials[0].roughness = 0.25
        self.assertEqual(scene.materials[0].roughness, 0.25)

    def test_arrays_read_from_it_are_no_way_in(self):
        scene = triangle_scene()
        for array in (scene.instances[0].transform, scene.meshes[0].positions):
            with self.assertRaises(ValueError):
                array[0, 0] = 5

    def test_parts_are_sequences(self):
        materials = conelight.Scene.load("builtin:cornell").materials
        names = [material.name for material in materials]
        self.assertEqual(len(materials), len(names))
        self.assertEqual([material.name for material in materials[1:]], names[1:])
        self.assertEqual([material.name for material in materials[::-2]], names[::-2])
        self.assertEqual((materials[-1].name, materials[-1].index), (names[-1], len(names) - 1))
        self.assertIn(materials[1], materials)
        for index in (len(names), -len(names) - 1):
            with self.assertRaises(IndexError):
                materials[index]

    def test_removed_parts_are_an_error(self):
        scene = triangle_scene()
        light = scene.add_light("point", intensity=(1, 1, 1))
        scene.remove_light(light)
        self.assert_error("usage", "no longer has this element", lambda: light.intensity)

    def test_handles_are_compared_by_what_they_are_of(self):
        scene = triangle_scene()
        self.assertEqual(scene.materials[0], scene.materials[0])
        self.assertEqual(len({scene.materials[0], scene.materials[0]}), 1)
        self.assertNotEqual(scene.materials[0], triangle_scene().materials[0])
        for thing in (scene.materials[0], conelight.Camera((0, 0, 1), (0, 0, 0)), conelight.Settings()):
            self.assertNotEqual(thing, None)
            self.assertNotEqual(thing, 5)

    def test_handles_keep_their_scene(self):
        material = triangle_scene().materials[0]
        self.assertEqual(material.base_color, (0.5, 0.5, 0.5, 1))

    def test_copies_are_scenes_of_their_own(self):
        scene = triangle_scene()
        copy = scene.copy()
        copy.materials[0].roughness = 0.5
        self.assertEqual(scene.materials[0].roughness, 1)

    def test_flux_sets_the_intensity(self):
        light = triangle_scene().add_light("point", flux=(4 * np.pi, 0, 0))
        np.testing.assert_allclose(light.intensity, (1, 0, 0), rtol=1e-6)
        lamp = triangle_scene().add_light("sphere", half_u=(0.5, 0, 0), flux=(np.pi ** 2, 0, 0))
        self.assertEqual(lamp.type, "sphere")
        np.testing.assert_allclose(lamp.intensity, (1, 0, 0), rtol=1e-6)

    def test_meshes_are_replaced(self):
        scene = triangle_scene()
        scene.meshes[0].replace(2 * TRIANGLE, [[0, 1, 2]])
        self.assertEqual(scene.bounds, ((0, 0, 0), (2, 2, 0)))


if __name__ == "__main__":
    unittest.main()
