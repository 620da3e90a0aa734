#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the site's gallery: two of each scene, which a slider parts. Called by scripts/site.

  tools/site/draw_gallery.py PROGRAM OUT

A picture whose command is the same as when it was last drawn, by the same program, is kept."""
import hashlib
import json
import pathlib
import subprocess
import sys

# name, title, text, scene and options of both, then label and options of the left and of the right picture.
PAIRS = (
    ("bounces", "What the walls return", "Direct light alone, and all bounces.", "builtin:atrium",
     ("direct light", "--component direct"), ("all light", "")),
    ("cones_rays", "Cones and rays", "One room, one sun: prefiltered cones, and rays through the same voxels.",
     "builtin:sunroom", ("mode cones", "--mode cones"), ("mode traced", "")),
    ("truth", "Rays and truth", "The default mode, and the path tracer over the same scene.", "builtin:cornell",
     ("mode traced", "--aa 0"), ("path tracer", "--mode reference --spp 256")),
    ("thesis", "The thesis's room", "The renderer of the thesis, and the default mode.", "builtin:thesis-room",
     ("mode thesis", "--mode thesis"), ("mode traced", "")),
    ("metals", "Metals", "Phong's local light, and reflections of what stands around.", "builtin:glossy",
     ("mode phong", "--mode phong"), ("mode traced", "--quality converged")),
)
SIZE = "640x400"


def main():
    program, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    kept = out / "drawn.json"
    drawn = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
    build = hashlib.sha256(program.read_bytes()).hexdigest()
    pairs = []
    for name, title, text, scene, *sides in PAIRS:
        pair = {"name": name, "title": title, "text": text}
        for side, (label, options) in zip(("left", "right"), sides):
            arguments = ["render", scene, "--size", SIZE, *options.split()]
            picture = out / f"{name}_{side}.png"
            if drawn.get(picture.name) != [build, arguments] or not picture.exists():
                print("conelight", *arguments, flush=True)
                subprocess.run([program, *arguments, "-o", picture], check=True)
                drawn[picture.name] = [build, arguments]
                kept.write_text(json.dumps(drawn), encoding="utf-8")
            pair[side] = {"label": label, "command": "conelight " + " ".join(arguments) + f" -o {side}.png"}
        pairs.append(pair)
    (out / "gallery.json").write_text(json.dumps(pairs), encoding="utf-8")


if __name__ == "__main__":
    main()
