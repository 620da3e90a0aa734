# SPDX-License-Identifier: MIT
"""What the tests of the Python module share. ctest sets PYTHONPATH, CONELIGHT_PROGRAM and CONELIGHT_SOURCE_DIR."""
import os
import subprocess
import unittest

import conelight

# Small and settled: what a test wants of pictures is that they are the same, or close.
SETTINGS = {"voxels.size": 32}
SIZE = (48, 32)
_renderers = []


def renderer():
    """One renderer for all tests of a process; skips the test where there is no OpenGL and none is required."""
    if not _renderers:
        try:
            _renderers.append(conelight.Renderer())
        except conelight.Error as error:
            if error.kind != "no_gl" or os.environ.get("CONELIGHT_REQUIRE_GL"):
                raise
            raise unittest.SkipTest(str(error)) from error
    return _renderers[0]


def run_program(*arguments):
    """Runs `conelight ARGUMENTS`; returns its standard output."""
    done = subprocess.run([os.environ["CONELIGHT_PROGRAM"], *map(str, arguments)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise AssertionError(f"conelight {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def scene_from_arrays(scene):
    """A scene of the same content, built from arrays and numbers alone. Textures and environments are left out."""
    built = conelight.Scene()
    for mesh in scene.meshes:
        built.add_mesh(mesh.positions, mesh.indices, normals=mesh.normals, uvs=mesh.uvs, tangents=mesh.tangents,
                       colors=mesh.colors, name=mesh.name)
    for material in scene.materials:
        built.add_material(**fields_of(material))
    for instance in scene.instances:
        fields = fields_of(instance)
        built.add_instance(fields.pop("mesh"), fields.pop("material"), fields.pop("transform"), **fields)
    for light in scene.lights:
        fields = fields_of(light)
        fields.pop("flux")  # follows from the intensity
        built.add_light(fields.pop("type"), **fields)
    for camera in scene.cameras:
        built.add_camera(camera)
    built.sky = scene.sky
    return built


def fields_of(part):
    names = [name for name in dir(type(part)) if isinstance(getattr(type(part), name), property)]
    return {name: getattr(part, name) for name in names if name != "index"}


class ErrorCase(unittest.TestCase):
    def assert_error(self, kind, text, call, *arguments, **named):
        """The call raises conelight.Error of this kind, in one line that holds the text."""
        with self.assertRaises(conelight.Error) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.kind, kind)
        self.assertIn(text, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
