#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How the error of the path tracer falls with its samples, and where the renderer stands: a table of relative RMSE.

    python3 examples/python/error_against_samples.py builtin:cornell --size 256x256 --truth 4096

The truth is path-traced with another seed, in two halves, so that its own noise is not counted.
"""
import argparse
import time

import conelight


def row(name, picture, truth, seconds):
    scores = conelight.compare(picture, truth["full"], halves=(truth["half_a"], truth["half_b"]), flip=False)
    print(f"{name:>24}  {100 * scores['relrmse']:8.3f}  {100 * scores['bias']:+8.3f}  {seconds:8.2f}", flush=True)


def timed(work):
    start = time.perf_counter()
    pictures = work()
    return pictures["full"], time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", nargs="?", default="builtin:cornell")
    parser.add_argument("--size", type=lambda text: tuple(int(n) for n in text.split("x")), default=(128, 128))
    parser.add_argument("--truth", type=int, default=2048, help="samples per pixel of the truth")
    parser.add_argument("--most", type=int, default=256, help="most samples of the rows")
    parser.add_argument("--voxels", type=int, default=128)
    options = parser.parse_args()

    scene = conelight.Scene.load(options.scene)
    camera = scene.cameras[0]
    tracer = conelight.PathTracer(scene)
    truth = tracer.render(camera, options.size, samples=options.truth, seed=2,
                          components=["full", "half_a", "half_b"])
    print(f"{'':>24}  relRMSE %    bias %   seconds")
    samples = 4
    while samples <= options.most:
        picture, seconds = timed(lambda n=samples: tracer.render(camera, options.size, samples=n))
        row(f"path tracer, {samples} samples", picture, truth, seconds)
        samples *= 4
    renderer = conelight.Renderer()
    for quality in ("draft", "interactive", "high"):
        settings = conelight.Settings({"voxels.size": options.voxels}, quality=quality)
        renderer.set_scene(scene)
        picture, seconds = timed(lambda chosen=settings: renderer.render(None, camera, options.size, chosen))
        row(f"renderer, {quality}", picture, truth, seconds)


if __name__ == "__main__":
    main()
