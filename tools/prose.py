# SPDX-License-Identifier: MIT
"""Sentences of Markdown pages and their words: text -> (line, sentence). What stands in backticks or between dollars is
one word, a source in brackets with its year is none. Code, headings and comments are left out. Used by check_docs and
check_words."""
import re

FENCE = re.compile(r"^(```|~~~)")


def outside_code(lines):
    """(number, line) of the lines that are not in a fenced block."""
    fenced = False
    for number, line in enumerate(lines, 1):
        if FENCE.match(line.strip()):
            fenced = not fenced
        elif not fenced:
            yield number, line


def paragraphs(lines):
    """(number, text) of each paragraph and list item outside code, tables, headings and comments."""
    first, text = 0, []
    for number, line in [*outside_code(lines), (len(lines) + 1, "")]:
        item = re.match(r"^\s*([-*]|\d+\.)\s+(.*)", line)
        apart = not line.strip() or re.match(r"^(\||#|<!--)|^    ", line) and not (text and line.startswith("    "))
        if (apart or item or text and first + len(text) != number) and text:
            yield first, " ".join(text)
            text = []
        if not apart:
            first = first if text else number
            text.append(item[2] if item else line.strip())


def cells(lines):
    """(number, text) of each cell of a table."""
    for number, line in outside_code(lines):
        if line.startswith("|"):
            yield from ((number, cell) for cell in re.sub(r"`[^`]*`", "`X`", line).replace("\\|", "").split("|"))


def sentences(text, parts=False):
    """The sentences of a paragraph; with `parts` a colon or a semicolon ends one as a full stop does."""
    text = re.sub(r"`[^`]*`|\$\$.*?\$\$|\$[^$]*\$", lambda part: "X." if part[0][:2] == "$$" else "X", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\([^()]*\b[12]\d{3}\b[^()]*\)", "", text)
    return re.split(r"(?<=[.!?])[)*]*\s+(?=[^a-z])" + (r"|(?<=[:;])\*?\s+" if parts else ""), text)


def too_long(sentence, limit):
    """What is wrong with a sentence of more words than the limit, or None."""
    count = len(re.findall(r"[^\W_][\w'%.,/-]*", sentence))
    return f"{count} words, at most {limit}: {' '.join(sentence.split()[:6])} ..." if count > limit else None
