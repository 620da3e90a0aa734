#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the pages of the site: what tools/site/mkdocs.yml builds from. Called by scripts/site.

  tools/site/make_pages.py OUT [--gallery FOLDER]

OUT gets every Markdown file of the project at its own path, so that links between them hold. A file of the sources
that a page links to becomes a page of its own, and so does a folder. Pictures are copied. Of Markdown only that is
changed which the site's parser takes in another way than GitHub's: links, lists, equations. OUT.yml is the
configuration for mkdocs: tools/site/mkdocs.yml, folders and navigation; the site comes beside OUT.
--gallery adds the page of FOLDER, which draw_gallery.py has filled."""
import argparse
import json
import pathlib
import posixpath
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"(?<!\\)(!?\[[^\]]*\]\()([^)\s]+)((?:\s+\"[^\"]*\")?\))")
FENCE = re.compile(r"^\s*(```|~~~)")
LIST_ITEM = re.compile(r"^\s*([-*+]|\d+\.)\s")
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".glsl": "glsl", ".py": "python", ".pyi": "python", ".cmake": "cmake",
             ".js": "javascript", ".json": "json", ".sh": "bash"}
PICTURES = (".png", ".jpg", ".svg")


def page_of(path, root=ROOT):
    """The page that stands for a file or folder of the project, as a path below OUT; None: there is no such thing."""
    file = root / path
    if file.is_dir():
        return posixpath.join(path, "README.md")
    if not file.is_file() or path.endswith(".md") or path.endswith(PICTURES):
        return path if file.is_file() else None
    if file.name == "index.html":  # would be the page of its folder
        return path + ".source.md"
    return path + ".md"


def resolve(page, target):
    """The path in the project that a relative link of a page leads to, and its #anchor."""
    target, mark, anchor = target.partition("#")
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page), target)) if target else page
    return path, mark + anchor


class Pages:
    """Path below OUT -> text, of all pages; pictures: the paths of those that pages show."""

    def __init__(self, root=ROOT):
        self.root = root
        self.texts = {}
        self.pictures = set()

    def add(self, path):
        """The page of a file or folder of the project, with the pages that it links to."""
        page = page_of(path, self.root)
        if page is None or page in self.texts:
            return
        if page.endswith(PICTURES):
            self.pictures.add(page)
            return
        self.texts[page] = ""  # so that pages which link to each other end
        file = self.root / path
        if file.is_dir():
            readme = file / "README.md"
            text = readme.read_text(encoding="utf-8") if readme.is_file() else self.listing(path)
        else:
            text = file.read_text(encoding="utf-8")
            if not path.endswith(".md"):
                language = LANGUAGES.get(pathlib.Path(path).suffix, "bash" if text.startswith("#!") else "text")
                text = f"---\nsearch: {{exclude: true}}\n---\n\n# `{path}`\n\n~~~~~~{language}\n{text}~~~~~~\n"
        self.texts[page] = self.rewrite(page, text)

    def listing(self, path):
        found = sorted(entry.name for entry in (self.root / path).iterdir()
                       if entry.is_file() and not entry.name.startswith("."))
        return f"# `{path}`\n\n" + "".join(f"- [{name}]({name})\n" for name in found)

    def rewrite(self, page, text):
        def link(match):
            if re.match(r"[a-z]+:", match[2]):
                return match[0]
            path, anchor = resolve(page, match[2])
            wanted = page_of(path, self.root)
            if wanted is None:
                return match[0]  # mkdocs --strict tells of it
            self.add(path)
            return match[1] + posixpath.relpath(wanted, posixpath.dirname(page) or ".") + anchor + match[3]

        return "\n".join(for_parser(text.split("\n"), lambda line: LINK.sub(link, line)))


def for_parser(lines, change):
    """The lines of a page as Python-Markdown wants them: a list and a display equation with an empty line before them,
    what belongs to a list item indented by four. `change` is called for each line outside code."""
    result, fenced, item = [], False, 0
    for line in lines:
        if FENCE.match(line):
            fenced = not fenced
        if fenced or FENCE.match(line):
            result.append(line)
            continue
        indent = len(line) - len(line.lstrip())
        is_item = bool(LIST_ITEM.match(line))
        previous = result[-1] if result else ""
        if is_item and previous.strip() and not item:
            result.append("")
        if line.startswith("$$") and previous.strip():
            result.append("")
        if is_item:
            item = indent + len(re.match(r"\s*([-*+]|\d+\.)\s+", line)[0])
        elif line.strip() and indent < 2 and not previous.strip():
            item = 0
        inside = item and not is_item and indent >= 2
        result.append(change(" " * max(4 - item, 0) + line if inside and not previous.strip() else line))
    return result


def gallery_page(folder):
    """One slider for each pair of pictures that draw_gallery.py has drawn."""
    parts = ["# Gallery\n\nDrag the line. Each picture is drawn by the command below it when the site is built.\n"]
    for pair in json.loads((folder / "gallery.json").read_text(encoding="utf-8")):
        sides = "".join(f'<img src="../{pair["name"]}_{side}.png" alt="{pair[side]["label"]}">' for side in
                        ("right", "left"))
        parts.append(f'## {pair["title"]}\n\n{pair["text"]}\n\n<div class="pair">{sides}'
                     f'<span class="tag left">{pair["left"]["label"]}</span>'
                     f'<span class="tag right">{pair["right"]["label"]}</span>'
                     f'<input type="range" min="0" max="100" value="50" aria-label="{pair["title"]}"></div>\n\n'
                     f'    {pair["left"]["command"]}\n    {pair["right"]["command"]}\n')
    return "\n".join(parts)


SECTIONS = ("guide", "theory", "reference", "measurements", "thesis", "design", "development", "notes")


def navigation(texts, gallery):
    """The tabs of the site: one for each folder below docs, the guide in the order of docs/index.md, the others by
    name."""
    named = re.findall(r"\]\(([^)#]+\.md)", texts["docs/index.md"])
    tabs = [{"Conelight": ["README.md", "docs/index.md", "docs/glossary.md", "CHANGELOG.md"]}]
    for section in SECTIONS:
        folder = f"docs/{section}/"
        pages = sorted(page for page in texts if page.startswith(folder))
        if section == "guide":
            pages.sort(key=lambda page: named.index(page[5:]) if page[5:] in named else len(named))
        pages.sort(key=lambda page: not page.endswith("README.md"))  # the page of the folder is the first
        tabs.append({section.capitalize(): pages})
    if gallery:
        tabs.append({"Gallery": "gallery/gallery.md"})
    tabs.append({"API": "api/index.html"})
    return tabs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gallery", type=pathlib.Path)
    arguments = parser.parse_args()
    pages = Pages()
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "*.md"], capture_output=True,
                            text=True, check=True)
    for name in filter(None, listed.stdout.split("\n")):
        pages.add(name)
    shutil.rmtree(arguments.out, ignore_errors=True)
    for page, text in pages.texts.items():
        file = arguments.out / page
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    for picture in pages.pictures:
        (arguments.out / picture).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / picture, arguments.out / picture)
    for name in ("site.css", "site.js"):
        shutil.copyfile(pathlib.Path(__file__).parent / name, arguments.out / name)
    if arguments.gallery:
        shutil.copytree(arguments.gallery, arguments.out / "gallery", dirs_exist_ok=True)
        (arguments.out / "gallery" / "gallery.md").write_text(gallery_page(arguments.gallery), encoding="utf-8")
    inherited = posixpath.relpath(pathlib.Path(__file__).parent / "mkdocs.yml", arguments.out.parent.resolve())
    config = {"INHERIT": inherited, "docs_dir": arguments.out.name, "site_dir": "site",
              "nav": navigation(pages.texts, arguments.gallery)}
    arguments.out.with_suffix(".yml").write_text(json.dumps(config, indent=1), encoding="utf-8")  # JSON is YAML
    print(f"make_pages: {len(pages.texts)} pages, {len(pages.pictures)} pictures in {arguments.out}")


if __name__ == "__main__":
    main()
