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
