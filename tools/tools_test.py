#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the checkers in this folder: each must report what it exists to report, and accept what is right.
Every test builds a small project in a temporary folder. Run by tools/check."""
import importlib.machinery
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

TOOLS = pathlib.Path(__file__).resolve().parent


class Project(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(textwrap.dedent(text), encoding="utf-8")

    def run_tool(self, name, *arguments):
        run = subprocess.run([sys.executable, TOOLS / name, *arguments], capture_output=True, text=True)
        return run.returncode, run.stdout


class Layers(Project):
    def problems(self):
        _, output = self.run_tool("check_layers", self.root)
        # The exceptions of the real project are unused in this one; that is not what is tested here.
        return [line for line in output.splitlines() if "no longer used" not in line]

    def test_order_of_stages(self):
        self.write("src/light/a.cpp", '#include "voxels/grid.h"\n#include "light/a.h"\n')
        self.assertEqual(self.problems(), [])
        self.write("src/voxels/b.cpp", '#include "base/log.h"\n#include "light/a.h"\n')
        self.assertEqual(len(self.problems()), 1)
        self.assertIn("src/voxels/b.cpp:2", self.problems()[0])

    def test_public_functions_are_marked(self):
        self.write("include/conelight/a.h", "CONELIGHT_API int marked(int a);\ninline int one() { return 1; }\n"
                   "struct Values {\n    int sum() const;\n};\nusing Call = void (*)(int);\n"
                   "class CONELIGHT_API Kept {\n};\nclass Later;\n")
        self.assertEqual(self.problems(), [])
        self.write("include/conelight/b.h", "std::vector<int> lost(int a,\n                      int b);\nclass Hidden {\n};\n"
                   "const Values* found();\n")
        self.assertEqual([line.split(" is not")[0] for line in self.problems()],
                         ["include/conelight/b.h:1: lost", "include/conelight/b.h:3: Hidden", "include/conelight/b.h:5: found"])

    def test_light_must_not_see_the_camera(self):
        self.write("src/light/a.cpp", '#include "view/camera.h"\n')
        self.assertEqual(len(self.problems()), 1)

    def test_view_must_not_see_the_gather(self):
        self.write("src/view/a.h", '#  include "gather/cone_set.h"\n')
        self.assertEqual(len(self.problems()), 1)

    def test_library_must_not_see_io_or_apps(self):
        self.write("src/modes/a.cpp", '#include "io/import.h"\n#include "platform/headless_context.h"\n')
        self.assertEqual(len(self.problems()), 2)

    def test_program_sees_only_the_public_headers(self):
        self.write("apps/conelight/a.cpp", '#include <conelight/renderer.h>\n#include "io/import.h"\n')
        self.assertEqual(self.problems(), [])
        self.write("apps/conelight/b.cpp", '#include "voxels/grid.h"\n')
        self.assertEqual(len(self.problems()), 1)

    def test_python_module_sees_what_the_program_sees_and_little_of_it(self):
        self.write("python/a.cpp", '#include "io/files.h"\n#include "guests.h"\n#include "session/session.h"\n#include "own.h"\n')
        self.assertEqual(self.problems(), [])
        self.write("python/b.cpp", '#include "voxels/grid.h"\n#include "viewer/viewer.h"\n#include <epoxy/gl.h>\n')
        self.assertEqual(len(self.problems()), 3)

    def test_gl_calls_stay_in_one_folder(self):
        self.write("src/gl/a.cpp", "#include <epoxy/gl.h>\n")
        self.assertEqual(self.problems(), [])
        self.write("src/voxels/a.cpp", "#include <epoxy/gl.h>\n// glFinish() waits\nformat = GL_RGBA8;\nglFinish();\n")
        self.assertEqual(len(self.problems()), 2)

    def test_nobody_includes_a_guest_but_the_program_in_one_place(self):
        self.write("modes/visitor/render/a.h", '#include "gl/buffer.h"\n#include "visitor/shaders/a.h"\n')
        self.write("modes/visitor/format/b.cpp", '#include "io/files.h"\n#include "conelight/visitor/visitor.h"\n')
        self.write("modes/visitor/console/c.cpp", '#include "session/session.h"\n#include "visitor/format/b.h"\n')
        self.write("apps/conelight/guests.cpp", '#include "conelight/visitor/visitor.h"\n')
        self.assertEqual(self.problems(), [])
        self.write("apps/conelight/d.cpp", '#include "visitor/format/b.h"\n')
        self.write("modes/visitor/render/e.cpp", '#include "io/files.h"\n#include "visitor/format/b.h"\n')
        self.write("modes/visitor/format/f.cpp", '#include "gl/buffer.h"\n')
        self.assertEqual(len(self.problems()), 4)

    def test_the_library_names_no_guest(self):
        self.write("modes/visitor/render/a.h", "// visitor\n")
        self.write("src/modes/a.cpp", "// revisitors' visits\n")
        self.assertEqual(self.problems(), [])
        self.write("src/modes/b.cpp", "// a visitor's\nMode::Visitor\nisVisitor\nVISITOR_SIZE\n")
        self.write("include/conelight/c.h", "#include <conelight/visitor/visitor.h>\n")
        self.assertEqual(len(self.problems()), 6)

    def test_public_headers_stand_alone(self):
        self.write("include/conelight/a.h", "#include <conelight/b.h>\n#include <glm/glm.hpp>\n#include <vector>\n")
        self.assertEqual(self.problems(), [])
        self.write("include/conelight/c.h", '#include "gl/buffer.h"\n#include <fmt/format.h>\n')
        self.assertEqual(len(self.problems()), 2)

    def test_shader_functions_know_no_stage(self):
        self.write("shaders/lib/a.glsl", '#include "lib/math.glsl"\n#include "voxels/grid.glsl"\n')
        self.assertEqual(len(self.problems()), 1)
        self.write("shaders/voxels/a.comp.glsl", '#include "gather/cone.glsl"\n')
        self.assertEqual(len(self.problems()), 2)


class Values(Project):
    def problems(self):
        _, output = self.run_tool("check_values", self.root)
        return [line for line in output.splitlines() if "no longer used" not in line]

    def test_values_with_revisions(self):
        self.write("src/light/a.cpp", "if (built.from == voxels.revision) return;\nconst bool changed = true;\n"
                   "// Scratch memory of this pass. A buffer that is bound here.\n")
        self.write("apps/a.cpp", "settingsChanged();\n")
        self.assertEqual(self.problems(), [])

    def test_flags_and_calls(self):
        self.write("src/light/a.cpp", "bool geometryDirty = true;\nif (dirty_) update();\nvoxelsChanged();\n")
        self.assertEqual([line.split(":")[1] for line in self.problems()], ["1", "2", "3"])

    def test_lent_buffers_and_foreign_bindings(self):
        self.write("modes/x/a.h", "Buffer& faceScratch();\nBuffer& layerScratch();\n// Its inputs must be\n//   bound by then.\n")
        self.write("shaders/b.glsl", "// The table is bound before.\n")
        self.assertEqual([line.split(":")[1] for line in self.problems()], ["1", "2", "3", "1"])

    def test_tables_are_written_by_their_stage(self):
        self.write("src/voxels/a.cpp", 'void Voxels::declare(gl::Inputs& inputs) const {\n    inputs.storage("FaceTable", faces_);\n}\n')
        self.write("shaders/voxels/a.comp.glsl", "layout(std430) writeonly buffer FaceTable { uint faces[]; };\n")
        self.write("shaders/light/a.comp.glsl", "layout(std430) readonly buffer FaceTable { uint faces[]; };\n"
                   "layout(std430) buffer OwnTable { uint own[]; };\n")
        self.assertEqual(self.problems(), [])
        self.write("shaders/light/b.comp.glsl", "\nlayout(std430) buffer FaceTable { uint faces[]; };\n")
        self.assertEqual([line.split(":")[:2] for line in self.problems()], [["shaders/light/b.comp.glsl", "2"]])


class Docs(Project):
    def faults(self, *arguments):
        return self.run_tool("check_docs", "--root", self.root, *arguments)[1].splitlines()

    def test_links_and_anchors(self):
        self.write("docs/a.md", "# One\n\n[good](b.md#the-two-ones) [here](#one)\n")
        self.write("docs/b.md", "# The two `ones`\n\n```\n[not a link](nowhere.md)\n```\n")
        self.assertEqual(self.faults(), [])
        self.write("docs/c.md", "[x](missing.md)\n[y](b.md#three)\n![z](p.png)\n[w](../../elsewhere)\n")
        self.assertEqual(len(self.faults()), 4)

    def test_comments_name_existing_pages(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write("docs/a.md", "# A\n")
        self.write("src/a.h", "// See docs/a.md and docs/theory/b.md.\n")
        subprocess.run(["git", "-C", self.root, "add", "."], check=True)
        self.assertEqual(self.faults(), ["src/a.h:1: names docs/theory/b.md: no such file"])

    def test_comments_name_existing_headings_and_equations(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write("docs/theory/a.md", "# A\n\n## A ray: how\n\n$$x \\qquad (4.1)$$\n")
        self.write("src/a.h", '// See docs/theory/a.md, "A\n// ray" and (4.1).\n// docs/theory/a.md, "A cone", (4.2)\n')
        subprocess.run(["git", "-C", self.root, "add", "."], check=True)
        self.assertEqual(self.faults(), ['src/a.h:3: names docs/theory/a.md: no heading "A cone"',
                                         "src/a.h:3: names docs/theory/a.md: no equation (4.2)"])

    def test_pages_name_existing_tests(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write("tests/a_test.cpp", "TEST_F(Walls, AreDark) {}\nTEST(\n    Floors, AreFlat) {}\n")
        self.write("docs/a.md", "`Walls.AreDark` and\n`Walls.AreLight` hold it.\n\n```\n`No.Test`\n```\n")
        self.write("CHANGELOG.md", "`Walls.WereDark` went.\n")
        subprocess.run(["git", "-C", self.root, "add", "."], check=True)
        self.assertEqual(self.faults(), ["docs/a.md:2: no test Walls.AreLight in the sources"])

    def test_long_sentences(self):
        long, short = "Word" + " word" * 25, "Word" + " word" * 24
        self.write("docs/a.md", f"# {long}\n\nText. {short}. {short}: {short};\n{short}.\n\n| {long} |\n\n```\n{long}\n```\n\n"
                                f"    {long}\n\n{short} (Some, *One*, 2011).\n\n`{long}` $x {long}$ [{short}](a.md).\n")
        self.write("CHANGELOG.md", f"{long}\n")
        self.assertEqual(self.faults(), ["docs/a.md:16: 27 words, at most 25: X X Word word word word ..."])
        self.write("docs/a.md", f"Text.\n\n- item\n- {short}\n  word and more.\n\n{long}\n")
        self.assertEqual([fault.split(" at ")[0] for fault in self.faults()],
                         ["docs/a.md:4: 28 words,", "docs/a.md:7: 26 words,"])

    def test_equations_have_numbers_of_their_own(self):
        self.write("docs/theory/a.md", "$$x \\qquad (4.1)$$\n\n$$y \\quad (4.1)$$\n")
        self.assertEqual(self.faults(), ["docs/theory/a.md:3: equation (4.1) has its number from docs/theory/a.md:1"])

    def test_changelog_heads_the_version(self):
        self.write("include/conelight/version.h", '#define CONELIGHT_VERSION_STRING "0.2.0"\n')
        self.write("CHANGELOG.md", "# Changelog\n\n## Unreleased\n\n## 0.2.0 - 2026-01-02\n\n## 0.1.0 - 2026-01-01\n")
        self.assertEqual(self.faults(), [])
        self.write("CHANGELOG.md", "# Changelog\n\n## 0.1.0 - 2026-01-01\n")
        self.assertEqual(self.faults(), ["CHANGELOG.md:1: heads 0.1.0 first; version.h has 0.2.0"])

    def test_snippets_equal_their_source(self):
        self.write("examples/e.cpp", "int a;\n// [part]\n    int b;\n      int c;\n// [/part]\n")
        self.write("README.md", "<!-- snippet: examples/e.cpp#part -->\n```cpp\nint b;\n  int c;\n```\n")
        self.assertEqual(self.faults(), [])
        self.write("examples/e.cpp", "// [part]\n    int d;\n// [/part]\n")
        self.assertEqual(len(self.faults()), 1)
        self.assertEqual(self.faults("--update"), [])
        self.assertIn("int d;", (self.root / "README.md").read_text())
        self.write("README.md", "<!-- snippet: examples/e.cpp#other -->\n```cpp\n```\n")
        self.assertEqual(len(self.faults()), 1)

    def test_commands_are_known_to_the_program(self):
        self.write("program", """\
            #!/bin/sh
            test "$1" = render && echo "  --size WxH   -o FILE" || echo "  render   draws"
            """)
        os.chmod(self.root / "program", 0o755)
        self.write("README.md", "`conelight render S --size 1x1 -o a.png`; conelight is fast\n")
        self.assertEqual(self.faults("--program", self.root / "program"), [])
        self.write("README.md", "    conelight render S --siz 1x1\n`conelight fly`\n")
        self.assertEqual(len(self.faults("--program", self.root / "program")), 2)


    def test_outputs_are_what_the_program_prints(self):
        self.write("program", "#!/bin/sh\necho \"$1  \"\necho two\n")
        os.chmod(self.root / "program", 0o755)
        block = "<!-- output: conelight one -->\n```\none\ntwo\n```\n<!-- /output -->\n"
        self.write("a.md", block + block.replace("```\n", ""))
        self.assertEqual(self.faults("--program", self.root / "program"), [])
        self.write("a.md", block.replace("two", "three"))
        self.assertEqual(len(self.faults("--program", self.root / "program")), 1)
        self.assertEqual(self.faults("--program", self.root / "program", "--update"), [])
        self.assertEqual((self.root / "a.md").read_text(), block)

    def test_options_of_another_command_are_left_out(self):
        more = " " * 20
        self.write("program", f"#!/bin/sh\necho Options:\necho '  --size N  of the picture'\necho '{more}in pixels'\n"
                              "[ $1 = one ] || echo '  --own  option'\n")
        os.chmod(self.root / "program", 0o755)
        block = "<!-- output: conelight two; less conelight one -->\nOptions:\n  --own  option\n<!-- /output -->\n"
        self.write("a.md", block.replace("Options:\n", ""))
        self.assertEqual(self.faults("--program", self.root / "program", "--update"), [])
        # What both print, but for options, stays: it is the frame of the text.
        self.assertEqual((self.root / "a.md").read_text(), block)


class Words(Project):
    """A project of one type and one glossary row, in which all is right."""

    def setUp(self):
        super().setUp()
        self.write("src/light/lamp.h", "// How bright a lamp is.\nstruct LampTable {\n};\n")
        self.glossary("| lamp | what shines (`LampTable`, `src/light/lamp.h`) |\n")
        self.write("tools/words/standard.txt", "# Plain.\ntable\n")
        self.write("tools/words/replaced.txt", "# Light.\nmatt -> diffuse\nbright face -> light sample\n=nol -> NoL\n")

    def glossary(self, rows):
        self.write("docs/glossary.md", "| word | meaning |\n|---|---|\n" + rows)

    def problems(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        return self.run_tool("check_words", self.root)[1].splitlines()

    def assert_one(self, *parts):
        found = self.problems()
        self.assertEqual(len(found), 1, found)
        for part in parts:
            self.assertIn(part, found[0])

    def test_right_words(self):
        self.write("src/light/lamps.cpp", "struct OnlyInHere {};\n")
        self.write("CHANGELOG.md", "Matt surfaces are called diffuse.\n")
        self.write("docs/notes/old.md", "Bright faces, as they were called.\n")
        self.write("docs/quote.md", "> A matt wall.\n\nThe mattress, never called matt. NoL.\n")
        self.assertEqual(self.problems(), [])

    def test_names_without_an_explanation(self):
        self.write("include/conelight/a.h", "struct Lamp;\nclass LampGlow {};\n")
        self.write("tools/words/standard.txt", "table\na\n")
        self.assert_one("include/conelight/a.h:2", "LampGlow", "glow")
        self.write("include/conelight/a.h", "")
        self.write("shaders/light/a.glsl", "struct Glow { int a; };\n")
        self.assert_one("shaders/light/a.glsl:1", "glow")
        self.write("shaders/light/a.glsl", "")
        self.write("src/light/glow_table.cpp", "")
        self.assertIn("glow_table", "".join(self.problems()))

    def test_standard_words_that_are_none(self):
        self.write("tools/words/standard.txt", "table\nlamps\n")
        self.assert_one("standard.txt:2", "in the glossary")
        self.write("tools/words/standard.txt", "table chair\n")
        self.assert_one("chair", "in no name")
        self.write("tools/words/standard.txt", "table table\n")
        self.assert_one("twice")

    def test_rows_that_the_sources_do_not_know(self):
        self.glossary("| lamp | what shines |\n| lamp, wick | what burns |\n")
        self.assert_one("docs/glossary.md:4", "wick")
        self.glossary("| lamp | what shines (`src/light/gone.h`) |\n")
        self.assert_one("src/light/gone.h", "no such file")
        self.glossary("| lamp | what shines (`LampList`, `src/light/lamp.h`) |\n")
        self.assert_one("does not contain LampList")

    def test_replaced_words_however_they_are_joined(self):
        for path, text in (("docs/a.md", "A Matt wall.\n"), ("docs/a.md", "bright\nfaces\n"),
                           ("tests/a.cpp", "// Rays to bright\n// faces.\n"), ("tests/a.cpp", "int brightFaces;\n"),
                           ("tests/a.cpp", "int BRIGHT_FACE;\n"), ("tests/a.cpp", "addMattMaterial();\n"),
                           ("tools/a", "#!/bin/sh\n# matt\n"), ("tests/b.cpp", "float nol;\n"), ("CMakeLists.txt", "add_library(matt)\n")):
            self.write(path, text)
            self.assert_one(path, ": write ")
            (self.root / path).unlink()

    def test_sentences_end(self):
        whole, half = "Word" + " word" * 39, "Word" + " word" * 19
        self.write("docs/a.md", f"# {whole} more\n\n{whole}. {whole}.\n\n- {whole}\n- {half}:\n  {half} `and more` and.\n\n"
                                f"| {half} {half} | `a|b` {half}; {half} |\n\n```\n{whole} more\n```\n")
        self.write("CHANGELOG.md", f"{whole} [more](a.md).\n")
        self.assertEqual([line.split(" at ")[0] for line in self.problems()],
                         ["CHANGELOG.md:1: 41 words,", "docs/a.md:6: 42 words,", "docs/a.md:9: 41 words,"])


class Files(Project):
    def problems(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        return self.run_tool("check_files", self.root)[1].splitlines()

    def test_right_file(self):
        self.write("src/a.h", "// SPDX-License-Identifier: MIT\n// What it does. TODO(#7): more.\n")
        self.assertEqual(self.problems(), [])

    def test_each_fault(self):
        self.write("src/licence.h", "#pragma once\n")
        self.write("src/todo.h", "// SPDX-License-Identifier: MIT\n// TODO: some day\n")
        self.write("src/blank.h", "// SPDX-License-Identifier: MIT \n")
        self.write("src/tab.h", "// SPDX-License-Identifier: MIT\n\tint a;\n")
        self.write("src/end.h", "// SPDX-License-Identifier: MIT")
        self.write("tools/x", "#!/bin/sh\ntrue\n")
        self.assertEqual(len(self.problems()), 6, self.problems())


@unittest.skipUnless(shutil.which("ctags"), "universal-ctags is not installed")
class ThesisSections(Project):
    """check_thesis_sections on pages that it is given."""

    def tool(self):
        loader = importlib.machinery.SourceFileLoader("sections", str(TOOLS / "check_thesis_sections"))
        tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("sections", loader))
        loader.exec_module(tool)
        return tool

    def defects(self, rows, gallery="", tex=""):
        tool = self.tool()
        page = "| section | where | shown by |\n|---|---|---|\n" + "".join(row + "\n" for row in rows)
        return list(tool.text_defects(tool.SECTIONS, page, "section", lambda names: tool.without_section(names, gallery, tex), None, ""))

    def test_right_rows(self):
        rows = ["| 1 A: F01 | [this](sections.md) | `tools/check` |", "| 1.1 B | [this](sections.md) | not there: no reason |"]
        tex = "\\chapter{A}\n\\section{B}\\label{b}\n"
        self.assertEqual(self.defects(rows, "### F01 Title\n", tex), [])

    def test_each_fault(self):
        wrong = {
            "| 1 A | | `tools/check` |": "none of them empty",
            "| 1 A | [this](nowhere.md) | `tools/check` |": "there is no nowhere.md",
            "| 1 A | here | `tools/check` |": "has no link",
            "| 1 A | [this](sections.md) | `tools/nothing` |": "there is no program tools/nothing",
            "| 1 A | [this](sections.md) | `NoTest.OfThatName` |": "there is no test NoTest.OfThatName",
            "| 1 A | [this](sections.md) | by looking |": "the last cell",
        }
        for row, message in wrong.items():
            self.assertIn(message, "\n".join(self.defects([row])), row)

    def test_what_has_no_row(self):
        row = "| 1 A | [this](sections.md) | `tools/check` |"
        found = "\n".join(self.defects([row], "### F07 Title\n", "\\chapter{A}\n\\section{B}\n"))
        self.assertIn("F07 has no row", found)
        self.assertIn("1.1 B has no row", found)

    def test_equations_are_counted_within_chapters(self):
        tex = "\\chapter{A}\n\\begin{equation}\n\\begin{multline}\n\\chapter{B}\n  \\begin{equation}\\label{x}\n"
        self.assertEqual(self.tool().without_equation(["1.1 One", "2.1 Three"], tex), ["the thesis's equation 1.2"])


class Constants(unittest.TestCase):
    def setUp(self):
        loader = importlib.machinery.SourceFileLoader("constants", str(TOOLS / "measure_constants"))
        spec = importlib.util.spec_from_loader("constants", loader)
        self.constants = importlib.util.module_from_spec(spec)
        loader.exec_module(self.constants)

    def test_every_constant_is_in_the_shaders(self):
        for name, file, _ in self.constants.VARIED + self.constants.REASONED:
            line, value = self.constants.place(name, file)
            self.assertGreater(line, 0)
            self.assertTrue(value)
        with self.assertRaises(SystemExit):
            self.constants.place("kNoSuchConstant", "lib/ray_query.glsl")

    def test_values_are_halved_and_doubled(self):
        self.assertEqual(eval(self.constants.times("1.0 / 8.0", 2)), 0.25)
        self.assertEqual(eval(self.constants.times("1e-3", 0.5)), 0.0005)
        self.assertEqual(self.constants.times("4u", 0.5), "2")
        text = "const int kLeast = 2, kMost = 4;"
        self.assertEqual(self.constants.pattern("kMost").search(text).group(2), "4")


class Sizes(Project):
    def problems(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        # The exceptions of the real project are unneeded in this one; that is not what is tested here.
        return [line for line in self.run_tool("check_sizes", self.root)[1].splitlines() if "no longer needed" not in line]

    @staticmethod
    def body(lines, head):
        return head + " {\n" + "    work();\n" * (lines - 2) + "}\n"

    def test_what_is_within_the_limits(self):
        self.write("src/a.cpp", self.body(60, "void fill(int a, std::map<int, int> b, int c, int d, int e, int f)"))
        self.write("src/b.h", "// line\n" * 500)
        self.write("docs/data/long.h", "// line\n" * 501)
        self.write("tools/tool", "#!/usr/bin/env python3\ndef f(a, b, c, d, e, g):\n" + "    pass\n" * 59)
        self.assertEqual(self.problems(), [])

    def test_long_files(self):
        self.write("src/a.h", "// line\n" * 501)
        self.write("shaders/b.glsl", "// line\n" * 501)
        self.write("tools/c", "#!/usr/bin/env python3\n" * 501)
        self.write("apps/d.js", "// line\n" * 501)
        self.assertEqual([line.split(":")[0] for line in self.problems()],
                         ["apps/d.js", "shaders/b.glsl", "src/a.h", "tools/c"])

    def test_long_functions(self):
        self.write("src/a.cpp", self.body(61, "void plain()"))
        self.write("src/b.h", "template <typename T>\nclass B {\n" + self.body(61, "B() : b_(1)") +
                   self.body(61, "template <typename U>\nU method(T t) const") + "};\n")
        self.write("tests/c.cpp", self.body(61, "TEST_F(Suite, Name)") + self.body(61, "INSTANTIATED(Suite)"))
        self.write("shaders/d.comp.glsl", "layout(local_size_x = 64) in;\n" + self.body(61, "void main()"))
        self.write("tools/e.py", "class E:\n    def method(self):\n" + "        pass\n" * 60)
        found = self.problems()
        for what in ("a.cpp:1: plain has 61", "b.h:3: B has 61", "b.h:65: method has 61", "TEST_F(Suite,Name) has 61",
                     "d.comp.glsl:2: main has 61", "e.py:2: method has 61"):
            self.assertTrue(any(what in line for line in found), (what, found))

    def test_long_parameter_lists(self):
        self.write("src/a.cpp", "void f(int a, int b, int c, int d, int e, int g, int h) {}\n"
                   "struct S { void m(int a, int b, int c, int d, int e, int g, std::array<int, 2> h) {} };\n"
                   "void ok(int a, int b, int c, int d, int e, std::function<void(int, int)> g) {}\n")
        self.write("shaders/b.glsl", "float f(float a, out float b, int c, int d, int e, vec3 g, inout vec3 h) {\n"
                   "    return a;\n}\n")
        self.write("tools/c.py", "def f(a, b, c, d, e, g, *, h):\n    pass\n")
        found = self.problems()
        self.assertEqual(len(found), 4, found)
        self.assertTrue(all("7 parameters" in line for line in found), found)


class Site(Project):
    @staticmethod
    def module(name):
        loader = importlib.machinery.SourceFileLoader(name, str(TOOLS / "site" / f"{name}.py"))
        spec = importlib.util.spec_from_loader(name, loader)
        module = importlib.util.module_from_spec(spec)
        loader.exec_module(module)
        return module

    def test_pages_and_what_they_link_to(self):
        self.write("docs/a.md", "[source](../src/b.h), [folder](../src), [web](https://x.y/z), ![](p.png)\n`[c](d.md)`\n")
        self.write("src/b.h", "int b;  // [no](link.md)\n")
        self.write("docs/p.png", "")
        pages = self.module("make_pages").Pages(self.root)
        pages.add("docs/a.md")
        self.assertEqual(sorted(pages.texts), ["docs/a.md", "src/README.md", "src/b.h.md"])
        self.assertIn("[source](../src/b.h.md), [folder](../src/README.md), [web](https://x.y/z), ![](p.png)",
                      pages.texts["docs/a.md"])
        self.assertIn("// [no](link.md)", pages.texts["src/b.h.md"])
        self.assertEqual(pages.pictures, {"docs/p.png"})

    def test_lists_and_equations_of_the_parser(self):
        made = self.module("make_pages").for_parser
        self.assertEqual(made(["Text:", "- a", "- b", "$$x$$"], str), ["Text:", "", "- a", "- b", "", "$$x$$"])
        self.assertEqual(made(["1. a", "", "   b", "", "c"], str), ["1. a", "", "    b", "", "c"])
        self.assertEqual(made(["```", "x", "- y", "```"], str), ["```", "x", "- y", "```"])

    def test_dead_links(self):
        self.write("site/index.html", '<a href="b/#here">b</a><a href="b/#gone">b</a><img src="p.png">'
                   '<a href="https://x.y/">x</a>')
        self.write("site/b/index.html", '<h1 id="here">b</h1><a href="../#">top</a>')
        status, output = self.run_tool("site/check_links.py", self.root / "site")
        self.assertEqual(status, 1)
        self.assertEqual(output.splitlines(), ["index.html: b/#gone: no such anchor", "index.html: p.png: no such file"])


if __name__ == "__main__":
    unittest.main()
