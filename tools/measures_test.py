#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the tools that measure GPUs, the window and scenes of people's kinds: pages are made from figures made up here, and what got worse
is named. Nothing is drawn, nothing is compiled. Run by tools/check."""
import importlib.machinery
import importlib.util
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parent


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(TOOLS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class MeasureGpu(unittest.TestCase):
    def test_page_shows_what_is_there_and_what_failed(self):
        row = {"frame_ms": {"median": 5.0}, "passes_ms": {"gbuffer": 2.0, "diffuse rays": 2.5, "shade": 0.25}, "memory_mb": 240.0}
        key = "builtin:cornell?block=1|1920x1080|%d|at rest|traced|interactive"
        data = {"version": 1, "device": "card", "program": "it", "runs": {key % 128: row, key % 512: {"failed": "no memory"}},
                "pictures": {"cornell_traced": 0.002, "cornell_phong": 0, "glass_cones": "GL error"}, "pictures_against": "another"}
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "gpu")
            out.with_suffix(".json").write_text(json.dumps(data))
            subprocess.run([sys.executable, TOOLS / "measure_gpu", "--page", "--out", out], check=True)
            page = out.with_suffix(".md").read_text()
        self.assertIn("Device: card.", page)
        self.assertIn("| `cornell?block=1` | at rest |  | 5.00 |  | fails |", page)
        # Indirect light is what is left without the G-buffer.
        self.assertIn("| at rest, `cornell?block=1` | `interactive` | 128 | 2.75 | 0.50 |", page)
        self.assertIn("| `cornell` | same | 2.0e-03 |  |  |  |", page)
        self.assertIn("512, at rest, traced, interactive: no memory", page)
        self.assertIn("picture glass_cones: GL error", page)

    def test_every_run_is_asked_for_once(self):
        runs = load("measure_gpu").runs()
        self.assertEqual(len(runs), len({run.key for run in runs}))
        self.assertGreater(len(runs), 40)


class MeasureViewer(unittest.TestCase):
    def test_page_names_the_longest_pause_and_the_clicks(self):
        pauses = {step: [30.0, 40.0] for step in load("measure_viewer").STEPS} | {"open": [170.0, 190.0]}
        data = {"version": 1, "scene": "builtin:cornell", "other": "builtin:spheres", "window": "1280x800", "view": ["--voxels", "64"],
                "minutes": 5, "rounds": 2, "click_ms": [45.0, 61.0, 90.0], "pauses_ms": pauses, "moving": ["9.5 frames/s"],
                "gui": "2.5 ms of CPU a frame", "first_frame": "1.50 s after the start", "device": "driver", "cores": 2, "load": 0.5}
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "viewer")
            out.with_suffix(".json").write_text(json.dumps(data))
            subprocess.run([sys.executable, TOOLS / "measure_viewer", "--page", "--out", out], check=True)
            page = out.with_suffix(".md").read_text()
        self.assertIn("| from a click until the panel shows what was selected | 61 (45 to 90) | 100 |", page)
        self.assertIn("| the longest time in which the window did not look for input | 190 | 200 |", page)
        self.assertIn("| orbit | 35 (30 to 40) |", page)
        self.assertIn("tools/measure_viewer --minutes 5 --scene builtin:cornell -- --voxels 64", page)


class MeasureRealModels(unittest.TestCase):
    def test_page_marks_what_misses_a_bar(self):
        part = {"bias": 0.01, "relrmse": 0.2, "block_relrmse": 0.05, "reference_noise": 0.03}
        runs = []
        for scene, full, indirect in (("builtin:street", {"bias": -0.034}, {}), ("builtin:attic", {}, {"block_relrmse": 0.123})):
            variants = [{"label": "traced", "settings": {"traced.quality": quality},
                         "components": {"full": part | full, "direct": part, "indirect": part | indirect}}
                        for quality in ("interactive", "converged")]
            runs.append({"scene": scene, "view": None, "variants": variants, "reference": {"samples_per_pixel": 256}, "device": "driver",
                         "commit": "c0ffee", "command": f"conelight compare {scene}"})
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "real")
            out.with_suffix(".json").write_text(json.dumps({"version": 1, "runs": runs}))
            subprocess.run([sys.executable, TOOLS / "measure_real_models", "--text", "--out", out], check=True)
            page = out.with_suffix(".md").read_text()
        work, held_out = page.split("## Held out")
        self.assertIn("| `street` | `interactive` | **-3.40** | 20.0 | 5.00 | 1.00 | 20.0 | 5.00 | 1.00 | 20.0 | 5.00 | 3.00 |", work)
        self.assertIn("1 of 1 views miss the bar on bias, 0 the one on blocks", work)
        self.assertIn("| `attic` | `converged` | 1.00 | 20.0 | 5.00 | 1.00 | 20.0 | 5.00 | 1.00 | 20.0 | **12.3** | 3.00 |", held_out)
        self.assertIn("0 of 1 views miss the bar on bias, 1 the one on blocks", held_out)


class MeasureGrowth(unittest.TestCase):
    def test_page_and_plot_show_the_sizes_that_were_run(self):
        one = {"gl_mb": 123.4, "process_mb": 1500, "load_s": 0.5, "first_s": 12.3, "frame_s": 0.0625}
        data = {"version": 1, "device": "driver", "cores": 2, "runs": {"atrium|10000": one, "atrium|1000000": dict(one, gl_mb=456)}}
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "growth")
            out.with_suffix(".json").write_text(json.dumps(data))
            subprocess.run([sys.executable, TOOLS / "measure_growth", "--page", "--out", out], check=True)
            page, plot = out.with_suffix(".md").read_text(), out.with_suffix(".svg").read_text()
        self.assertIn("| 10,000 | 123 | 1500 | 0.5 | 12.3 | 0.062 |", page)
        self.assertIn("| 1,000,000 | 456 |", page)
        # Memory and time, each value a line of two points.
        lines = [line for line in plot.splitlines() if 'stroke="#3a8a3a" stroke-width="1.6"' in line]
        self.assertEqual(len(lines), 5)
        self.assertTrue(all(line.count("L") == 1 for line in lines))

    def test_hills_have_the_triangles_asked_for_in_both_forms(self):
        growth = load("measure_growth")
        for instances in (True, False):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "hills.glb")
                growth.write_glb(path, 30_000, instances)
                data = path.read_bytes()
            self.assertEqual(len(data), struct.unpack_from("<I", data, 8)[0])
            document = json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])
            uses = sum("mesh" in node for node in document["nodes"])
            self.assertEqual(uses, 3 if instances else 1)
            self.assertEqual(uses * document["accessors"][1]["count"], 3 * 3 * 2 * growth.HILL**2)


class GpuIsa(unittest.TestCase):
    def test_what_got_worse_is_named(self):
        isa = load("gpu_isa")
        values = {"registers": 80, "spills": 0, "scalar spills": 0, "waves": 12, "instructions": 1000, "cycles": 1}
        before = {"rays": {"families": {"navi21": values}}}
        self.assertEqual(isa.worse(before, {"rays": {"navi21": values | {"instructions": 1090}}, "new": {"navi21": values}}), [])
        self.assertEqual(isa.worse(before, {"rays": {"navi21": values | {"instructions": 1110}}}),
                         ["rays: navi21: instructions 1000 -> 1110"])
        self.assertEqual(isa.worse(before, {"rays": {"navi21": values | {"scalar spills": 1}}}), ["rays: navi21: scalar spills 0 -> 1"])
        self.assertEqual(len(isa.worse(before, {"rays": {"navi21": {}}})), 4)  # no longer compiles
        # A kernel that has another name, and one that has come beside it.
        before = {"rays-A=1": {"families": {"navi21": values}}}
        self.assertEqual(isa.worse(before, {"rays-B=1": {"navi21": values | {"registers": 96}}}), ["rays-B=1: navi21: registers 80 -> 96"])
        self.assertEqual(isa.worse(before, {"rays-A=1": {"navi21": values}, "rays-B=1": {"navi21": values | {"registers": 96}}}), [])


    def test_resources_of_a_module(self):
        word = lambda operation, *operands: struct.pack(f"<{len(operands) + 1}I", len(operands) + 1 << 16 | operation, *operands)
        code = struct.pack("<5I", 0x07230203, 0x10300, 0, 99, 0)
        code += word(71, 1, 33, 4) + word(71, 2, 33, 7) + word(71, 20, 3)  # bindings 4 and 7; 20 is a block of storage
        code += word(25, 10, 11, 5, 0, 0, 0, 1, 33) + word(27, 12, 10) + word(32, 13, 0, 12) + word(59, 13, 1, 0)  # samplerBuffer
        code += word(30, 20, 11) + word(32, 21, 2, 20) + word(59, 21, 2, 2)
        with tempfile.NamedTemporaryFile(suffix=".spv") as file:
            file.write(code)
            file.flush()
            self.assertEqual(load("gpu_isa").bindings(file.name), ["4:4", "7:7"])


class CostModel(unittest.TestCase):
    def test_the_sum(self):
        model = load("cost_model")
        card = {"tflops": 64e-6, "ghz": 1e-3, "gtexels": 1e-3}  # a million cycles of 32 lanes and a million texels in a second
        isa = {"gather/ray_diffuse-A=1": {"families": {"navi21": {"cycles": 500, "waves": 8}}}}
        told = [{"pass": "diffuse rays", "program": "gather/ray_diffuse-A=1", "dispatches": 1, "invocations": 640}]
        run = {"dispatches": told, "lookups_per_pixel": {"diffuse": 3.0}, "size": [160, 4]}
        # 10 times 64 by 500 cycles; one wave of 500 * 8 / 2; 3 lookups of 640 pixels.
        row = model.passes_of(run, isa, 1)["diffuse rays"]
        self.assertEqual(model.predicted(row, card), [5.0, 2.0, 1.92, 5.0])
        # Pixels of a picture four times as large.
        row = model.passes_of(run, isa, 4)["diffuse rays"]
        self.assertEqual((model.total(row, "invocations"), model.total(row, "cycles"), row["lookups"]), (2560, 20000.0, 7680.0))
        faces = {"pass": "irradiance: update", "program": "gather/ray_diffuse-A=1", "dispatches": 1, "invocations": 640}
        self.assertEqual(model.passes_of(run | {"dispatches": [faces]}, isa, 4)["irradiance: update"]["kernels"][0]["invocations"], 640)
        self.assertEqual(model.verdict(5.0, 2.6), "confirmed")
        self.assertEqual(model.verdict(5.0, 2.4), "refuted")


if __name__ == "__main__":
    unittest.main()
