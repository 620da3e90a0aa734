# SPDX-License-Identifier: MIT
"""Contact sheets of tools/measure_modes: rows are scenes, columns modes, the reference and an error map; one JPEG, by
ffmpeg."""
import os
import subprocess
import tempfile

FFMPEG = ["ffmpeg", "-y", "-loglevel", "error"]


def pixels(path):
    """RGB bytes of a picture."""
    return subprocess.run([*FFMPEG, "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], check=True,
                          stdout=subprocess.PIPE, stdin=subprocess.DEVNULL).stdout


def write_jpg(path, width, height, rgb):
    """A quarter of what the sheet takes as PNG: noise of references does not pack."""
    subprocess.run([*FFMPEG, "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-i", "-",
                    "-pix_fmt", "yuvj444p", "-q:v", "3", path], check=True, input=rgb)


def sheet(program, path, scenes, spp):
    """One JPEG: every picture as the program's tone map shows it, one row per scene."""
    cell, rgb = 128, b""
    size = ["--size", f"{cell}x{cell}"]
    columns = [["--mode", "thesis"], ["--mode", "cones"], ["--mode", "traced", "--quality", "interactive"],
               ["--mode", "traced", "--quality", "converged"], ["--mode", "reference", "--spp", spp or "256"]]
    with tempfile.TemporaryDirectory() as folder:
        def file(name):
            return os.path.join(folder, name)
        for scene in scenes:
            row = []
            for mode in columns:
                subprocess.run([program, "render", scene, "-o", file("cell.png"), *size, *mode],
                               check=True, stdout=subprocess.DEVNULL)
                row.append(pixels(file("cell.png")))
            for i, mode in enumerate(columns[-2:]):  # the error, of radiance
                subprocess.run([program, "render", scene, "-o", file(f"{i}.exr"), *size, *mode],
                               check=True, stdout=subprocess.DEVNULL)
            subprocess.run([program, "compare", file("0.exr"), file("1.exr"), "--no-flip", "--map", file("map.png")],
                           check=True, stdout=subprocess.DEVNULL)
            row.append(pixels(file("map.png")))
            for y in range(cell):
                rgb += b"".join(one[3 * cell * y:3 * cell * (y + 1)] for one in row)
    write_jpg(path, cell * (len(columns) + 1), cell * len(scenes), rgb)
