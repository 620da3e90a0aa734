# SPDX-License-Identifier: MIT
"""Conelight: global illumination in real time, from Python.

Metres, radians, y up, linear Rec.709 radiance in W/(sr m^2). Pictures are float32 arrays, first row on top.

    import conelight
    scene = conelight.Scene.load("builtin:cornell")
    pictures = conelight.Renderer().render(scene, None, (640, 480), components=["full", "depth"])
    conelight.save("out.exr", pictures)
"""
from ._conelight import *  # noqa: F401,F403
from ._conelight import __version__  # noqa: F401


def progress_bar(label="", width=30):
    """progress_bar(label: str = "", width: int = 30) -> Callable

    A bar on the error output for the argument `progress` of calls that take long.

        conelight.reference(scene, camera, size, samples=4096, progress=conelight.progress_bar("truth"))

    label: text in front of it. width: of the bar, letters.
    """
    import sys

    def show(now):
        done = now if isinstance(now, float) else now.samples_done / max(now.samples_planned, 1)
        bar = ("#" * round(width * done)).ljust(width, ".")
        noise = "" if isinstance(now, float) or not now.noise else f", noise {100 * now.noise:.2g} %"
        end = "\n" if done >= 1 else ""
        sys.stderr.write(f"\r{label}{' ' if label else ''}[{bar}] {100 * done:3.0f} %{noise}{end}")
        sys.stderr.flush()

    return show
