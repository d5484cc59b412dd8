#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The texts of the pages in both languages. Every key of one language is in the other, with the same kind of text. All
Chinese texts are Chinese. Every text that a page uses is there. English sentences have at most 40 words, Chinese ones
at most 80 signs. (What the daemon reports of its parts it tells in both languages: check_translations.py.)

check_page_words.py ROOT

Reads the words in a headless Chromium, then does it again with broken words, which must fail."""

import pathlib
import re
import sys
import tempfile

from check_report_page import Browser

PAGES = {
    "report and live page": (("words.js", "live_words.js", "commission_words.js"),
                             ("report.html", "live.html", "commission.js", "report.js", "live.js", "roadway.js",
                              "tables.js", "viewer.js", "space.js", "charts.js", "reader.js", "steer.js",
                              "verdict.js", "timeline.js", "compare.js", "save.js")),
    "motion page": (("motion_words.js",), ("motion.html", "motion.js", "motion_views.js")),
}
# The English of these comes from the program.
CHINESE_ALONE = ("reason_texts.", "senses.", "commission_errors.")
NAMES_ITS_LANGUAGE = "other_language"
WORDS_MOST, SIGNS_MOST = 40, 80
HAN = re.compile(r"[\u3400-\u9fff]")

FLAT = """
const out = {}, walk = (node, path) => {
  if (typeof node === 'object') {
    for (const key of Object.keys(node)) walk(node[key], path ? `${path}.${key}` : key);
    return;
  }
  out[path] = [typeof node, String(node)];
};
walk(WORDS.%s, '');
return out;
"""


def words_of(browser, folder, scripts):
    with tempfile.TemporaryDirectory() as made:
        page = pathlib.Path(made, "words.html")
        text = "\n".join((folder / name).read_text(encoding="utf-8") for name in scripts)
        page.write_text(f"<!DOCTYPE html><meta charset=utf-8><script>{text}</script>", encoding="utf-8")
        browser.open(page.as_uri())
        return browser.run(FLAT % "en"), browser.run(FLAT % "zh")


def texts_in(kind, text):
    """What a word or a function that makes one shows, with x for what it fills in."""
    if kind != "function":
        return [text]
    literals = re.findall(r"`((?:[^`\\]|\\.)*)`|'((?:[^'\\]|\\.)*)'", text)
    return ["".join(re.sub(r"\$\{[^}]*\}", "x", one or other) for one, other in literals)]


def faults_of_pair(english, chinese):
    for key in sorted(english.keys() ^ chinese.keys()):
        if key in english or not key.startswith(CHINESE_ALONE):
            yield f"{key}: in one language alone"
    for key, (kind, text) in english.items():
        if key in chinese and chinese[key][0] != kind:
            yield f"{key}: {kind} in English, {chinese[key][0]} in Chinese"
        for shown in texts_in(kind, text):
            if HAN.search(shown) and key != NAMES_ITS_LANGUAGE:
                yield f"{key}: Chinese in the English text"
            for sentence in re.split(r"[.!?:;](?:\s|$)", shown):
                if len(sentence.split()) > WORDS_MOST:
                    yield f"{key}: a sentence of {len(sentence.split())} words: {sentence[:50]}"
    for key, (kind, text) in chinese.items():
        for shown in texts_in(kind, text):
            # What has three letters in a row in English is more than a unit.
            source = " ".join(texts_in(*english[key])) if key in english else "text"
            if re.search(r"[A-Za-z]{3}", source) and not HAN.search(shown) and key != NAMES_ITS_LANGUAGE:
                yield f"{key}: no Chinese"
            for sentence in re.split(r"[。！？]", shown):
                if len(sentence) > SIGNS_MOST:
                    yield f"{key}: a sentence of {len(sentence)} signs: {sentence[:25]}"


def faults_of_use(folder, sources, english):
    known = {key.split(".")[0] for key in english}
    for name in sources:
        text = (folder / name).read_text(encoding="utf-8")
        used = re.findall(r"(?:\bw|words\(\))\.(\w+)", text) + re.findall(r'data-word="(\w+)"', text)
        for word in sorted(set(used) - known):
            if not any(alone.startswith(word + ".") for alone in CHINESE_ALONE):
                yield f"{name} uses '{word}', which is no word"


def faults(browser, folder):
    for page, (scripts, sources) in PAGES.items():
        english, chinese = words_of(browser, folder, scripts)
        if len(english) < 40:
            yield f"{page}: only {len(english)} words were found"
        yield from (f"{page}: {fault}" for fault in faults_of_pair(english, chinese))
        yield from (f"{page}: {fault}" for fault in faults_of_use(folder, sources, english))


BROKEN = [("words.js", "series: '七个输出随时间变化',", ""), ("words.js", "summary: '汇总'", "summary: 'Summary'"),
          ("motion_words.js", "truth: '与真值对比'", "truths: '与真值对比'"), ("words.js", "none: 'none'", "no: 'none'"),
          ("live_words.js", "whole_map: '全图',", ""),
          ("words.js", "summary: 'Summary'", "summary: '" + "word " * (WORDS_MOST + 1) + "'")]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1]).resolve()
    folder = root / "tools/study/report/page"
    browser = Browser()
    try:
        found = list(faults(browser, folder))
        for name, good, bad in BROKEN:
            with tempfile.TemporaryDirectory() as made:
                for path in folder.iterdir():
                    text = path.read_text(encoding="utf-8")
                    if path.name == name and good not in text:
                        found.append(f"{name} no longer holds what the check breaks: {good}")
                    pathlib.Path(made, path.name).write_text(text.replace(good, bad) if path.name == name else text,
                                                             encoding="utf-8")
                if not list(faults(browser, pathlib.Path(made))):
                    found.append(f"broken words were let through: {good} -> {bad[:30]}")
    finally:
        browser.close()
    print("\n".join(found) or "the words of both languages belong together")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
