#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The code of docs/guide/python.md: pictures of a scene, a scene from arrays, a camera of OpenCV's matrices.

    python3 examples/python/quick_start.py FOLDER
"""
import pathlib
import sys

import conelight
import numpy as np


def pictures(folder, size=(640, 480)):
    # [pictures]
    scene = conelight.Scene.load("builtin:cornell")  # or a .glb, .gltf, .obj ...
    camera = scene.cameras[0]
    renderer = conelight.Renderer()
    picture = renderer.render(scene, camera, size, {"voxels.size": 64}, components=["full", "indirect", "depth"])
    print(picture["full"].shape, picture["depth"].dtype)  # (480, 640, 3) float32

    truth = conelight.reference(scene, camera, size, samples=64)
    print(conelight.compare(picture["full"], truth["full"])["relrmse"])

    conelight.save(folder / "cornell.exr", picture)  # linear radiance; indirect and depth are layers
    conelight.save(folder / "cornell.png", picture["full"])  # tone-mapped
    # [/pictures]


def arrays(folder, size=(640, 480)):
    # [arrays]
    scene = conelight.Scene()
    corners = np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], np.float32)  # metres
    square = scene.add_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.uint32))
    scene.add_instance(square, scene.add_material(base_color=(0.8, 0.8, 0.8, 1)))
    red = scene.add_material(base_color=(0.8, 0.05, 0.05, 1))
    wall = scene.add_instance(square, red, [[0, 1, 0, -1], [-1, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])
    lamp = scene.add_light("point", position=(0.3, 1.5, 0), intensity=(8, 8, 8))  # W/sr
    camera = conelight.Camera(eye=(1.2, 1.6, 3), target=(0, 0.6, 0))

    renderer = conelight.Renderer()
    first = renderer.render(scene, camera, size)["full"]
    lamp.flux = (60, 60, 60)  # W
    red.base_color = (0.05, 0.05, 0.8, 1)
    moved = wall.transform.copy()
    moved[0, 3] = -0.8
    wall.transform = moved
    second = renderer.render(scene, camera, size)["full"]  # uploads what changed, no more
    # [/arrays]
    conelight.save(folder / "corner.png", np.concatenate([first, second], axis=1))


def opencv(folder, size=(640, 480)):
    scene = conelight.Scene.load("builtin:cornell")
    f, (width, height) = 1.4 * size[1], size
    # [opencv]
    K = np.array([[f, 0, width / 2], [0, f, height / 2], [0, 0, 1]])
    R = np.diag([1.0, -1.0, -1.0])  # world to camera: x right, y down, z forward
    t = np.array([0, 0.5, 1.94])
    camera = conelight.Camera.from_opencv(K, R, t, size, pixel_center=0.5)
    depth = conelight.Renderer().render(scene, camera, size, components="depth")["depth"]
    points = camera.positions(depth)  # (height, width, 3), world, metres
    # [/opencv]
    conelight.save(folder / "points.exr", points)


if __name__ == "__main__":
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    shape = (640, 480) if len(sys.argv) < 3 else tuple(int(n) for n in sys.argv[2].split("x"))
    out.mkdir(parents=True, exist_ok=True)
    for part in (pictures, arrays, opencv):
        part(out, shape)
