# SPDX-License-Identifier: MIT
import contextlib
import copy
import io
import math
import os
import pickle
import tempfile
import unittest

import conelight
import numpy as np
from support import SETTINGS, SIZE, ErrorCase, renderer

EYE, TARGET = np.array([0.2, 0.7, 1.8]), np.array([-0.1, 0.4, 0])


def matrices(vfov=0.7, center=0.0):
    """K, R, t of a camera at EYE that looks at TARGET, written out as textbooks do."""
    forward = (TARGET - EYE) / np.linalg.norm(TARGET - EYE)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    rotation = np.array([right, np.cross(forward, right), forward])
    width, height = SIZE
    f = 0.5 * height / math.tan(0.5 * vfov)
    k = np.array([[f, 0, width / 2 - 0.5 + center], [0, f, height / 2 - 0.5 + center], [0, 0, 1]])
    return k, rotation, -rotation @ EYE


class OpenCv(ErrorCase):
    def test_is_the_camera_of_eye_and_target(self):
        scene = conelight.Scene.load("builtin:cornell")
        ours = conelight.Camera(EYE, TARGET, vfov=0.7)
        theirs = conelight.Camera.from_opencv(*matrices(), SIZE)
        np.testing.assert_allclose(theirs.eye, ours.eye, atol=1e-6)
        self.assertAlmostEqual(theirs.vfov, ours.vfov, places=6)
        names = ["full", "depth"]
        a, b = (renderer().render(scene, camera, SIZE, SETTINGS, components=names) for camera in (ours, theirs))
        np.testing.assert_allclose(a["depth"], b["depth"], atol=1e-3)
        self.assertLess(conelight.compare(b["full"], a["full"], flip=False)["relrmse"], 0.01)

    def test_pixels_are_where_the_matrices_project_to(self):
        """World points of the depth picture, projected by K (R x + t), come out at their pixels' indices."""
        scene = conelight.Scene.load("builtin:cornell")
        k, rotation, t = matrices()
        camera = conelight.Camera.from_opencv(k, rotation, t, SIZE)
        depth = renderer().render(scene, camera, SIZE, SETTINGS, components=["depth"])["depth"]
        points = camera.positions(depth)
        seen = depth > 0
        self.assertGreater(seen.sum(), 500)
        cameras = points[seen] @ rotation.T + t
        np.testing.assert_allclose(cameras[:, 2], depth[seen], rtol=1e-5)
        pixels = cameras @ k.T
        rows, columns = np.nonzero(seen)
        np.testing.assert_allclose(pixels[:, 0] / pixels[:, 2], columns, atol=1e-3)
        np.testing.assert_allclose(pixels[:, 1] / pixels[:, 2], rows, atol=1e-3)
        # Whatever positions() does, what is seen lies in the box.
        self.assertTrue((np.abs(points[seen] - [0, 0.5, 0]) < 0.501).all())

    def test_there_and_back(self):
        for center in (0.0, 0.5):
            given = matrices(center=center)
            camera = conelight.Camera.from_opencv(*given, SIZE, pixel_center=center)
            for wanted, got in zip(given, camera.to_opencv(SIZE, pixel_center=center), strict=True):
                np.testing.assert_allclose(got, wanted, rtol=1e-5, atol=1e-5)

    def test_what_cannot_be_shown_is_refused(self):
        k, rotation, t = matrices()

        def refuse(text, k=k, rotation=rotation, t=t):
            self.assert_error("usage", text, conelight.Camera.from_opencv, k, rotation, t, SIZE)

        refuse("is not the picture's centre; 23.5, 15.5, or pixel_center=0.5", k=matrices(center=0.5)[0])
        refuse("principal point", k=k + [[0, 0, 5], [0, 0, 0], [0, 0, 0]])
        refuse("focal lengths", k=k * [[2], [1], [1]])
        refuse("has skew", k=k + [[0, 1, 0], [0, 0, 0], [0, 0, 0]])
        refuse("focal lengths", k=k * np.nan)
        refuse("R: is no rotation", rotation=rotation * 2)
        refuse("R: is no rotation", rotation=np.diag([1, 1, -1]))
        refuse("R: has shape (4, 4)", rotation=np.eye(4))
        refuse("t: has shape (2,)", t=[1, 2])
        refuse("t: is not finite", t=[np.inf, 0, 0])


class EyeAndTarget(ErrorCase):
    def test_attributes(self):
        camera = conelight.Camera((0, 0, 3), (0, 0, 0))
        self.assertEqual((camera.eye, camera.up), ((0, 0, 3), (0, 1, 0)))
        self.assertAlmostEqual(camera.vfov, math.pi / 4, places=6)
        camera.eye = np.array([1, 2, 3])
        self.assertEqual(camera.eye, (1, 2, 3))
        camera.name = "door"
        for copied in (camera.copy(), copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
            self.assertEqual(copied, camera)
            copied.eye = (0, 0, 9)
            self.assertEqual(camera.eye, (1, 2, 3))

    def test_parallel_rays(self):
        """Points behind pixels are as far apart near and far; matrices have no such camera."""
        scene = conelight.Scene.load("builtin:cornell")
        camera = conelight.Camera((0.2, 0.7, 2), (0, 0.5, 0))
        camera.orthographic_height = 1.2
        self.assertIn("orthographic_height=1.2", repr(camera))
        self.assertEqual(pickle.loads(pickle.dumps(camera)), camera)
        pictures = renderer().render(scene, camera, SIZE, SETTINGS, components=["depth", "normal"])
        seen = pictures["depth"] > 0
        self.assertGreater(seen.sum(), 500)
        points = camera.positions(pictures["depth"])
        floor = seen & (pictures["normal"][..., 1] > 0.99) & (points[..., 1] < 0.1)
        self.assertGreater(floor.sum(), 20)
        np.testing.assert_allclose(points[floor][:, 1], 0, atol=1e-3)
        self.assert_error("usage", "focal length", camera.to_opencv, SIZE)
        camera.orthographic_height = -1
        self.assert_error("usage", "orthographic_height -1", renderer().render, scene, camera, SIZE)

    def test_cameras_that_see_nothing(self):
        for text, named in [("vfov 45", {"vfov": 45}), ("vfov 0", {"vfov": 0}), ("near 0", {"near": 0}),
                            ("near 2 and far 1", {"near": 2, "far": 1}),
                            ("not finite", {"up": (0, np.nan, 0)})]:
            self.assert_error("usage", text, conelight.Camera, (0, 0, 3), (0, 0, 0), **named)
        self.assert_error("usage", "same point", conelight.Camera, (0, 0, 3), (0, 0, 3))
        self.assert_error("usage", "eye: has shape (2,)", conelight.Camera, (0, 0), (0, 0, 3))
        # A camera that was good may be changed; what draws looks again.
        camera = conelight.Camera((0, 0, 3), (0, 0, 0))
        camera.target = (0, 0, 3)
        scene = conelight.Scene.load("builtin:cornell")
        self.assert_error("usage", "same point", renderer().render, scene, camera, SIZE)
        self.assert_error("usage", "same point", conelight.reference, scene, camera, SIZE)

    def test_up_along_the_view(self):
        """The renderer turns such a camera in a way of its own; positions and matrices know it."""
        scene = conelight.Scene.load("builtin:cornell")
        camera = conelight.Camera((0.1, 0.8, 0.1), (0.1, 0, 0.1), up=(0, 1, 0))
        pictures = renderer().render(scene, camera, SIZE, SETTINGS, components=["depth", "normal"])
        floor = pictures["normal"][..., 1] > 0.99
        low = floor & (pictures["depth"] > 0.79)
        self.assertGreater(low.sum(), 100)
        points = camera.positions(pictures["depth"])
        np.testing.assert_allclose(points[low][:, 1], 0, atol=1e-3)
        k, rotation, t = camera.to_opencv(SIZE)
        pixels = (points[low] @ rotation.T + t) @ k.T
        rows, columns = np.nonzero(low)
        np.testing.assert_allclose(pixels[:, 0] / pixels[:, 2], columns, atol=1e-3)
        np.testing.assert_allclose(pixels[:, 1] / pixels[:, 2], rows, atol=1e-3)
        again = conelight.Camera.from_opencv(k, rotation, t, SIZE)
        np.testing.assert_allclose(
            renderer().render(scene, again, SIZE, SETTINGS, components="depth")["depth"], pictures["depth"], atol=1e-3)

    def test_a_camera_that_sees_the_whole_scene(self):
        scene = conelight.Scene.load("builtin:cornell")
        depth = renderer().render(scene, scene.frame_camera(), SIZE, SETTINGS, components=["depth"])["depth"]
        self.assertEqual(depth[0].max(), 0)
        self.assertGreater((depth > 0).sum(), 100)


class Paths(ErrorCase):
    def test_frames(self):
        keys = [(2.0, conelight.Camera((1, 0, 3), (0, 0, 0))), (0.0, conelight.Camera((0, 0, 3), (0, 0, 0))),
                (1.0, conelight.Camera((0, 1, 3), (0, 0, 0)))]
        path = conelight.CameraPath(keys)
        self.assertEqual((path.start, path.end), (0, 2))
        self.assertEqual([seconds for seconds, _ in path.keys], [0, 1, 2])
        self.assertEqual(path.at(1).eye, (0, 1, 3))
        self.assertEqual([camera.eye for camera in path.frames(3)], [(0, 0, 3), (0, 1, 3), (1, 0, 3)])
        self.assertEqual(len(path.frames(7)), 7)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "way.json")
            path.save(file)
            self.assertEqual(conelight.CameraPath.load(file).at(0.3).eye, path.at(0.3).eye)
            self.assert_error("usage", "way.json", path.save, file)
        self.assert_error("usage", "keys", conelight.CameraPath([]).at, 0)
        self.assert_error("usage", "count", path.frames, 0)


class Motion(ErrorCase):
    def test_is_what_moves(self):
        scene = conelight.Scene.load("builtin:cornell")
        block = next(one for one in scene.instances if one.name == "short block")
        camera, size = scene.cameras[0], (80, 60)
        now = conelight.PathTracer(scene).surfaces(camera, size)
        self.assertNotIn("motion", now)
        before = scene.copy()
        moved = block.transform.copy()
        moved[0, 3] -= 0.1
        next(one for one in before.instances if one.name == "short block").transform = moved
        seen = conelight.PathTracer(scene).surfaces(camera, size, previous_scene=before)
        on_block = seen["instance"] == int(block)
        self.assertGreater(on_block.sum(), 50)
        np.testing.assert_array_equal(seen["motion"][~on_block], 0)
        # 0.1 m to the left, by depth.
        k, _, _ = camera.to_opencv(size)
        np.testing.assert_allclose(seen["motion"][on_block][:, 0], -0.1 * k[0, 0] / seen["depth"][on_block], rtol=1e-3)
        np.testing.assert_allclose(seen["motion"][on_block][:, 1], 0, atol=1e-4)
        # A camera that stood elsewhere: what it saw at the place is what is seen now.
        other = camera.copy()
        other.eye = tuple(np.add(camera.eye, (0.05, 0.02, 0)))
        motion = conelight.PathTracer(scene).surfaces(camera, size, previous_camera=other)["motion"]
        k, r, t = other.to_opencv(size, pixel_center=0.5)
        pixels = np.einsum("ij,hwj->hwi", k @ r, now["position"]) + k @ t
        there = pixels[..., :2] / pixels[..., 2:]
        here = np.stack(np.meshgrid(np.arange(80) + 0.5, np.arange(60) + 0.5), axis=-1)
        lit = now["instance"] >= 0
        np.testing.assert_allclose(motion[lit], (there - here)[lit], atol=2e-3)
        self.assert_error("usage", "previous_scene", conelight.PathTracer(scene).surfaces, camera, size,
                          previous_scene=conelight.Scene())


class Bar(unittest.TestCase):
    def test_shows_how_far(self):
        scene = conelight.Scene.load("builtin:cornell")
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown):
            conelight.reference(scene, scene.cameras[0], (16, 12), samples=8, progress=conelight.progress_bar("truth"))
            conelight.progress_bar("bake")(0.5)
        self.assertIn("truth [##############################] 100 %", shown.getvalue())
        self.assertIn("bake [###############...............]  50 %", shown.getvalue())


if __name__ == "__main__":
    unittest.main()
