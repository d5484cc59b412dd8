#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""How the project reads: lines, words, sentences, their mean and their longest, of each page and each public header.

usage: check_prose.py ROOT [FILE...]    a table of all pages and headers, or of FILE; exit status 1 and one line per
                                        broken rule: a sentence of more than 40 words (80 Chinese characters), a page
                                        whose mean is above 20 (40), README.md longer than 120 lines
       check_prose.py ROOT --long N     lists the sentences of more than N words as well

A sentence ends at . ! ? or where its paragraph, list item or table cell ends. A colon or a semicolon ends none. Code,
headings and links' addresses do not count; `a name in code` is one word. The mean is that of paragraphs and list items:
cells of tables are no sentences, but the longest may stand in one. Of source files (.cpp .hpp .def) the words that the
program says are read, literals of three words or more, with the same limits."""

import argparse
import dataclasses
import pathlib
import re
import statistics
import sys

LONGEST_WORDS, MEAN_WORDS = 40, 20
LONGEST_SIGNS, MEAN_SIGNS = 80, 40  # of Chinese, where a word is about two characters
FRONT_DOOR_LINES = 120
MEAN_OF = 10  # sentences that a mean needs

HAN = re.compile(r"[\u3400-\u9fff]")
END = re.compile(r"(?<=[.!?])[\"')*_]*\s+(?=[\"'(*_`\[]*[A-Z0-9`\[(+-])|(?<=[。！？])\s*")
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|etc|vs|cf|Eq|Eqs|Fig|No|approx|Inc)\.")
ITEM = re.compile(r"^\s*([-*+]|\d+\.)\s+")


@dataclasses.dataclass
class Sentence:
    text: str
    line: int
    in_table: bool

    @property
    def chinese(self):
        return len(HAN.findall(self.text)) > len(self.text.split())

    @property
    def length(self):
        if self.chinese:
            return len(re.sub(r"[\W_]", "", re.sub(r"[A-Za-z0-9_.+-]+", "X", self.text)))
        return sum(1 for word in self.text.split() if re.search(r"\w", word))


def plain(text):
    """Markdown without its marks: what is read aloud."""
    text = re.sub(r"!\[([^\]]*)\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"``[^`]+``|`[^`]+`", "code", text)
    text = re.sub(r"<[^>\s][^>]*>", "", text)
    text = ABBREVIATIONS.sub(lambda found: found.group(1).replace(".", ""), text)
    return text.replace("**", "").strip()


def sentences_of(block, line, in_table=False):
    for text in END.split(plain(" ".join(block.split()))):
        if text and re.search(r"\w", text):
            yield Sentence(text, line, in_table)


def blocks_of_markdown(text):
    """(line, block, in a table) of all that is prose."""
    fenced, block, start = False, [], 0
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        fence = stripped.startswith("```")
        row = stripped.startswith("|")
        ends = fence or fenced or row or not stripped or stripped.startswith(("#", "<!--")) or ITEM.match(line)
        if ends and block:
            yield start, " ".join(block), False
            block = []
        if fence:
            fenced = not fenced
        elif fenced or not stripped or stripped.startswith(("#", "<!--")):
            continue
        elif row:
            for cell in re.split(r"(?<!\\)\|", stripped.strip("|")):
                yield number, cell, True
        else:
            if not block:
                start = number
            block.append(ITEM.sub("", line))
    if block:
        yield start, " ".join(block), False


def blocks_of_header(text):
    """Comments of C: runs of lines, ended by an empty one, a drawing (two spaces within) or the comment's end."""
    for comment in re.finditer(r"/\*.*?\*/|(?://[^\n]*\n[ \t]*)+", text, re.S):
        line = text.count("\n", 0, comment.start()) + 1
        block, start = [], line
        body = re.sub(r"\*/$", "", comment.group())
        for number, raw in enumerate(body.splitlines(), line):
            words = re.sub(r"^\s*(/\*\*?<?|//[/!<]*|\*)", "", raw).rstrip()
            drawing = re.search(r"\S\s{2,}\S", words) or words.startswith("     ") or "SPDX" in words or "(c)" in words
            if (drawing or not words.strip() or ITEM.match(words)) and block:
                yield start, " ".join(block), False
                block = []
            if not drawing and words.strip():
                start = start if block else number
                block.append(ITEM.sub("", words))
        if block:
            yield start, " ".join(block), False


LITERAL = re.compile(r'(?:\b[uUL]?8?)?"((?:[^"\\\n]|\\.)*)"')
RAW = re.compile(r'R"(\w*)\((.*?)\)\1"', re.S)


def blocks_of_source(text):
    """Literals that follow each other with only space between are one."""
    text = re.sub(r"^\s*#\s*include.*$", "", text, flags=re.M)
    text = re.sub(r"//[^\n]*", lambda found: found.group() if '"' in found.group() else "", text)
    said, start, end = "", 0, -1
    for literal in LITERAL.finditer(text):
        if said and text[end:literal.start()].strip():
            yield text.count("\n", 0, start) + 1, said, False
            said = ""
        if not said:
            start = literal.start()
        said += re.sub(r"\\n", " ", literal.group(1)).replace("\\t", " ").replace('\\"', '"')
        end = literal.end()
    if said:
        yield text.count("\n", 0, start) + 1, said, False


def sentences_in(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        blocks = blocks_of_markdown(text)
    elif path.suffix in {".h", ".c"}:
        blocks = blocks_of_header(text)
    else:
        blocks = (block for block in blocks_of_source(text) if len(block[1].split()) >= 3)
    return [sentence for line, block, in_table in blocks for sentence in sentences_of(block, line, in_table)]


def mean(sentences):
    return statistics.mean(sentence.length for sentence in sentences) if sentences else 0.0


def limits(sentence):
    return (LONGEST_SIGNS, MEAN_SIGNS) if sentence.chinese else (LONGEST_WORDS, MEAN_WORDS)


def faults(path, name, sentences):
    for sentence in sentences:
        longest = limits(sentence)[0]
        if sentence.length > longest:
            yield (f"{name}:{sentence.line}: a sentence of {sentence.length}; {longest} are allowed: "
                   f"{sentence.text[:70]}...")
    for chinese in (False, True):
        prose = [sentence for sentence in sentences if not sentence.in_table and sentence.chinese == chinese]
        if len(prose) >= MEAN_OF and mean(prose) > limits(prose[0])[1]:
            yield f"{name}: sentences of {mean(prose):.1f} in the mean; {limits(prose[0])[1]} are allowed"
    if name == "README.md" and (lines := len(path.read_text(encoding="utf-8").splitlines())) > FRONT_DOOR_LINES:
        yield f"README.md: {lines} lines; {FRONT_DOOR_LINES} are allowed"


def row(path, name, sentences):
    text = path.read_text(encoding="utf-8")
    english = [sentence for sentence in sentences if not sentence.chinese]
    prose = [sentence for sentence in english if not sentence.in_table]
    longest = max((sentence.length for sentence in english), default=0)
    return f"{name:44} {len(text.splitlines()):5} {len(text.split()):6} {len(prose):9} {mean(prose):5.1f} {longest:7}"


def pages(root):
    built = {"build", "out", "node_modules", ".git"}
    yield from sorted(path for path in root.rglob("*.md") if not built & set(path.relative_to(root).parts))
    yield from sorted((root / "include").glob("*.h"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("file", nargs="*", type=pathlib.Path)
    parser.add_argument("--long", type=int, metavar="N")
    arguments = parser.parse_args()
    paths = [path.resolve() for path in arguments.file] or list(pages(arguments.root.resolve()))
    if not paths:
        sys.exit(f"{arguments.root} holds no pages: nothing was checked")
    print(f"{'page':44} {'lines':>5} {'words':>6} {'sentences':>9} {'mean':>5} {'longest':>7}")
    found = []
    for path in paths:
        name = str(path.relative_to(arguments.root.resolve()))
        sentences = sentences_in(path)
        print(row(path, name, sentences))
        found += faults(path, name, sentences)
        for sentence in sentences if arguments.long else ():
            if sentence.length > arguments.long:
                print(f"  {sentence.line}: ({sentence.length}) {sentence.text}")
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
