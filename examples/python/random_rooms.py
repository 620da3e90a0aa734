#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A data set of random rooms: boxes in a box under a lamp, each with pictures, depth, normals and its camera.

    python3 examples/python/random_rooms.py --count 100 --out rooms
    python3 examples/python/random_rooms.py --count 10 --truth 1024 --out rooms   # path-traced, too

Writes NAME.npz with the arrays full, indirect, albedo, normal, depth, instance, K, R, t (and truth), and
NAME.png to look at. A room follows from its number and the seed alone.
"""
import argparse
import pathlib

import conelight
import numpy as np

PARTS = ["full", "indirect", "albedo", "normal", "depth"]


def box_mesh(scene, inward=False):
    """The cube [-1, 1]^3 with flat faces; inward: its inside is the front."""
    positions, indices = [], []
    for axis in range(3):
        for side in (-1, 1):
            u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            normal = side * np.eye(3)[axis]
            first = len(positions)
            positions += [normal - u - v, normal + u - v, normal + u + v, normal - u + v]
            forwards = (side > 0) != inward
            for triangle in ((0, 1, 2), (0, 2, 3)):
                indices.append([first + i for i in (triangle if forwards else triangle[::-1])])
    return scene.add_mesh(np.array(positions, np.float32), np.array(indices, np.uint32))


def placed(position, half_size, turn=0.0):
    """World from object: scaled, turned about y, moved."""
    cos, sin = np.cos(turn), np.sin(turn)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]]) * half_size
    matrix[:3, 3] = position
    return matrix


def room(random):
    """A scene and a camera in it."""
    scene = conelight.Scene()
    cube = box_mesh(scene)
    half = random.uniform([1.5, 1.2, 1.5], [3, 1.6, 3])  # metres
    walls = scene.add_material(base_color=(*random.uniform(0.4, 0.8, 3), 1))
    scene.add_instance(box_mesh(scene, inward=True), walls, placed((0, half[1], 0), half))
    for _ in range(random.integers(2, 7)):
        is_metal = random.random() < 0.2
        material = scene.add_material(base_color=(*random.uniform(0.1, 0.8, 3), 1), metallic=float(is_metal),
                                      roughness=random.uniform(0.2, 1.0))
        size = random.uniform(0.12, 0.45, 3)
        place = random.uniform(-0.6, 0.6, 3) * half
        place[1] = size[1] + 0.001  # on the floor
        scene.add_instance(cube, material, placed(place, size, random.uniform(0, np.pi)))
    lamp = 0.25 * half[0] * np.array([1.0, 0, 0]), 0.25 * half[2] * np.array([0, 0, 1.0])
    scene.add_light("rect", position=(0, 2 * half[1] - 0.01, 0), direction=(0, -1, 0), half_u=lamp[0],
                    half_v=lamp[1], flux=random.uniform(80, 120, 3))
    angle = random.uniform(0, 2 * np.pi)
    eye = np.array([0.85 * half[0] * np.cos(angle), random.uniform(1.2, 1.8), 0.85 * half[2] * np.sin(angle)])
    return scene, conelight.Camera(eye, (0, 0.6, 0), vfov=np.radians(60))


def write(folder, number, options, renderer):
    random = np.random.default_rng([options.seed, number])
    scene, camera = room(random)
    settings = conelight.Settings({"voxels.size": options.voxels}, quality=options.quality)
    arrays = renderer.render(scene, camera, options.size, settings, components=PARTS)
    tracer = conelight.PathTracer(scene)
    arrays["instance"] = tracer.surfaces(camera, options.size)["instance"]
    if options.truth:
        arrays["truth"] = tracer.render(camera, options.size, samples=options.truth)["full"]
    k, r, t = camera.to_opencv(options.size)
    name = f"room{number:04d}"
    np.savez_compressed(folder / f"{name}.npz", **arrays, K=k, R=r, t=t)
    conelight.save(folder / f"{name}.png", arrays["full"], {"image.exposure": "auto"})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--size", type=lambda text: tuple(int(n) for n in text.split("x")), default=(320, 240))
    parser.add_argument("--voxels", type=int, default=128)
    parser.add_argument("--quality", default="interactive")
    parser.add_argument("--truth", type=int, default=0, help="samples per pixel of the path tracer; 0: none")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("rooms"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    renderer = conelight.Renderer()
    for number in range(options.count):
        write(options.out, number, options, renderer)


if __name__ == "__main__":
    main()
