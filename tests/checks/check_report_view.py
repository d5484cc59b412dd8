#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What a reader does with a report, in a headless browser: looks at it in three dimensions, goes along the time line to
what is not valid, lays a second run beside it, and takes pictures and numbers away.

usage: check_report_view.py REPORT.html TABLE.html SECOND.csv HAS_THREE [SCREENSHOT_PREFIX]
SECOND.csv is a table of `pose_wall run` of the same frames. TABLE.html is a report of such a table alone."""

import csv
import io
import json
import pathlib
import sys
import tempfile
import time

from check_report_page import INK, Browser, Checks, check_chinese, check_quiet

TEXT = "document.getElementById('%s').textContent"
QUANTITIES = ("roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb")
# A canvas as a number that changes with what is drawn.
INK_OF_VIEW = """
const scene = viewer.space.scene;
scene.render();
const copy = document.createElement('canvas');
[copy.width, copy.height] = [scene.canvas.width, scene.canvas.height];
copy.getContext('2d').drawImage(scene.canvas, 0, 0);
return Array.from(copy.getContext('2d').getImageData(0, 0, copy.width, copy.height).data)
  .reduce((sum, x) => (sum * 31 + x) >>> 0, 0);
"""
# The frames at which a stretch begins that is not valid, by the data alone.
BEGINNINGS = """
const out = [];
for (let f = 0; f < recording.frames; ++f) {
  const bad = (g, q) => recording.state[7 * g + q] !== 3;
  if (%s.some((q) => bad(f, q) && (f === 0 || !bad(f - 1, q)))) out.push(f);
}
return out;
"""


def check_three(browser, checks, has_three):
    run = browser.run
    fault = run("return viewer.space.scene.fault")
    if not has_three:
        checks.hold("a build without three.js says so", fault == "no_library" and
                    "no 3D view" in run(f"return {TEXT % 'space-note'}"))
        return
    checks.hold(f"there is a view in three dimensions {fault}", fault is None)
    if fault:
        return
    run("document.getElementById('space').scrollIntoView({block: 'center'})")
    checks.become("it is drawn", lambda: run("return viewer.space.scene.drawn > 0"))
    first = run(INK_OF_VIEW)
    run("show_frame(recording.frames - 1)")
    checks.hold("another frame is another picture", run(INK_OF_VIEW) != first)
    run("show_frame(0)")
    checks.hold("the same frame is the same picture", run(INK_OF_VIEW) == first)
    run("document.querySelectorAll('#layers input')[2].click()")
    checks.hold("a layer can be taken away", run(INK_OF_VIEW) != first)
    run("document.querySelectorAll('#layers input')[2].click()")
    run("document.querySelector('[data-look=above]').click()")
    checks.hold("it can be seen from above", run(INK_OF_VIEW) != first)
    # The wall that was fitted passes through its points: both were taken back to base by ways of their own.
    off_m = run("""
const r = recording, [from, to] = r.cloud_range(r.cloud_at(0)), off = [];
const [a, b, , d] = viewer.space.wall_corners(0, -5, 5);
const minus = (p, q) => p.map((v, i) => v - q[i]), u = minus(b, a), v = minus(d, a);
const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], long = Math.hypot(...n);
const xyz = viewer.space.scene.cloud.geometry.getAttribute('position').array;
for (let k = from; k < to; ++k) {
  const at = Array.from(xyz.slice(3 * (k - from), 3 * (k - from) + 3));
  if (r.point_label[k] === 2) off.push(Math.abs(minus(at, a).reduce((s, x, i) => s + x * n[i] / long, 0)));
}
return off.length > 100 ? off.reduce((s, x) => s + x, 0) / off.length : 99;""")
    checks.hold(f"the left wall's points lie on the left wall's plane: {off_m:.3f} m", off_m < 0.1)


def check_time_line(browser, checks):
    run = browser.run
    jump = lambda way: run(f"document.getElementById('jump-{way}').click(); return page.frame")
    for chosen, quantities in ((-1, "[0, 1, 2, 3, 4, 5, 6]"), (1, "[1]")):
        beginnings = run(BEGINNINGS % quantities)
        run(f"const s = document.getElementById('jump-of'); s.value = {chosen}; s.dispatchEvent(new Event('change'));"
            "show_frame(0)")
        expected = [f for f in beginnings if f > 0]
        went = [jump("next") for _ in expected]
        checks.hold(f"next goes to each beginning in turn {went[:5]}", went == expected and len(went) > 0)
        checks.hold("it says which values", "Here begins what is not valid: " in run(f"return {TEXT % 'jump-note'}"))
        last = run("return page.frame")
        checks.hold("after the last one it stays, and says so", jump("next") == last and
                    "None begins after" in run(f"return {TEXT % 'jump-note'}"))
        back = [jump("back") for _ in expected[:-1]]
        checks.hold("and back", back == expected[:-1][::-1])
    ticks = run("return clock_ticks(recording, 0, 30, 4)")
    checks.hold("stamps of a simulation are no times of day", "Seconds since the first frame" in
                run(f"return {TEXT % 'clock-note'}") and ticks[0][1].endswith(" s"))
    clock = run("const kept = recording.stamp_s.slice(), begin_s = new Date(2026, 4, 3, 14, 59, 58).getTime() / 1000;"
                "recording.stamp_s = kept.map((s) => begin_s + s - kept[0]); show_frame(12);"
                "const said = [document.getElementById('frame-name').textContent, "
                "document.getElementById('clock-note').textContent,"
                " clock_ticks(recording, 0, recording.frames - 1, 4)];"
                "recording.stamp_s = kept; show_frame(0); return said;")
    checks.hold(f"those of a clock are {clock}", "14:59:59.2" in clock[0] and "2026-05-03" in clock[1] and
                [20, "15:00:00"] in clock[2])
    run("const c = document.getElementById('timeline'), b = c.getBoundingClientRect();"
        "c.dispatchEvent(new PointerEvent('pointerdown', {clientX: b.left + 0.5 * b.width, clientY: b.top + 8}))")
    middle = run("return recording.frames / 2")
    checks.hold("a click into it goes there", abs(run("return page.frame") - middle) <= 1)


def check_without_stamps(browser, checks):
    """A recording without stamps begins at 0, for its reader as for `explain --stamp`."""
    said = browser.run("const kept = recording.stamp_s.slice(); recording.stamp_s = kept.map((_, f) => f / 10);"
                       "show_frame(3);"
                       "const said = [document.getElementById('frame-name').textContent, file_name('top', 'png'),"
                       " csv_text(3, 3).split('\\n')[1].slice(0, 11), moment_text(recording, 0, 1),"
                       " clock_ticks(recording, 0, 30, 4)[0]];"
                       "recording.stamp_s = kept; show_frame(0); return said;")
    checks.hold(f"its page, pictures and numbers count from frame 0: {said}", " · 0.3 s · " in said[0] and
                "_0.3-s_top" in said[1] and said[2] == "3,0.300000," and said[3] == "0.0 s" and said[4] == [10, "1 s"])


CONTRASTS = """
const part = (x) => (x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
const light = (name) => colour(name).match(/[0-9a-f]{2}/g).map((x) => part(parseInt(x, 16) / 255))
  .reduce((sum, x, k) => sum + x * [0.2126, 0.7152, 0.0722][k], 0);
const names = ['ink', 'faint', 'valid', 'degraded', 'held', 'invalid', 'unreadable', 'not-valid'];
return names.map((name) => {
  const [least, most] = [light(name), light('panel')].sort((a, b) => a - b);
  return [(most + 0.05) / (least + 0.05), name];
}).sort((a, b) => a[0] - b[0])[0];
"""


def check_themes(browser, checks):
    run, theme = browser.run, "document.documentElement.dataset.theme"
    scheme = lambda name: browser.cdp("Emulation.setEmulatedMedia", media="",
                                      features=[{"name": "prefers-color-scheme", "value": name}])
    for name in ("dark", "light"):
        scheme(name)
        checks.become(f"the page follows the system to {name}", lambda: run(f"return {theme}") == name)
        least, what = run(CONTRASTS)
        checks.hold(f"words can be read, {name}: {what} {least:.2f}", least >= 4.5)
        checks.hold("so can what the browser draws", run(
            "return getComputedStyle(document.documentElement).colorScheme") == name)
    scheme("dark")
    checks.become("and back", lambda: run(f"return {theme}") == "dark")
    screen = run(INK % "top")
    run("window.dispatchEvent(new Event('beforeprint'))")
    checks.hold("paper is light, pictures as well", run(f"return {theme}") == "light" and run(INK % "top") != screen)
    run("window.dispatchEvent(new Event('afterprint'))")
    checks.hold("the screen is dark again", run(f"return {theme}") == "dark" and run(INK % "top") == screen)
    browser.cdp("Emulation.setEmulatedMedia", media="print", features=[])
    seen = run("return ['frame-name', 'slider', 'space-panel', 'top'].map((id) => "
               "document.getElementById(id).offsetHeight > 0)")
    checks.hold(f"the number of the frame is printed, slider and 3D view are not {seen}",
                seen == [True, False, False, True])
    browser.cdp("Emulation.setEmulatedMedia", media="", features=[])


def take_second(browser, text):
    browser.run(f"compare.take(new File([{json.dumps(text)}], 'second.csv'))")


def check_second_run(browser, checks, table):
    run = browser.run
    rows = list(csv.DictReader(io.StringIO(table)))
    take_second(browser, "a,b\n1,2\n")
    checks.become("what is no table is refused",
                  lambda: "no table of pose_wall run" in run(f"return {TEXT % 'compare-fault'}"))
    # Each distance of the second run is longer by 0.125 m, in another order of rows, and one frame is missing.
    missing = int(rows[5]["frame"])
    for row in rows:
        row["d_lf"] = str(float(row["d_lf"]) + 0.125) if row["d_lf"] else ""
    out = io.StringIO()
    writer = csv.DictWriter(out, rows[0].keys())
    writer.writeheader()
    writer.writerows(row for row in rows[::-1] if int(row["frame"]) != missing)
    take_second(browser, out.getvalue())
    checks.become("a second run is taken", lambda: run("return Boolean(recording.other)"))
    line = run(f"return {TEXT % 'compare-line'}")
    checks.hold(f"it says which, and how it fits: {line}", "second.csv" in line and "by their stamps" in line)
    lf, lb = run("return [3, 4].map((q) => recording.other.summary(q))")
    # The table's nine digits and the page's floats round in two ways: by a step of a float below 4 m.
    step = 2.4e-7
    checks.hold(f"the difference is told {lf['median']:.4f}", abs(lf["median"] - 0.125) < 1e-5 and
                abs(lf["largest"] - 0.125) < 1e-5 and lb["largest"] <= step)
    checks.hold("a frame that it lacks has none", run(f"return Number.isNaN(recording.other.difference({missing}, 3))"))
    ink = INK % "chart-d_lf"
    both = run(ink)
    run("document.getElementById('compare-apart').click()")
    apart = run(ink)
    written = run("return csv_text(3, 8)")
    numbers = list(csv.DictReader(io.StringIO(written)))
    checks.hold("the numbers hold both runs", len(numbers) == 6 and numbers[0]["d_lf_difference_m"] == "0.125" and
                numbers[missing - 3]["d_lf_second_m"] == "")
    run("document.getElementById('compare-end').click()")
    checks.hold("both, the difference and one alone are three pictures", len({both, apart, run(ink)}) == 3)
    check_doubts(browser, checks, rows)


def check_doubts(browser, checks, rows):
    """What is not valid in the second run looks so, and another recording is no second run of this one."""
    run, ink, doubt = browser.run, INK % "chart-d_lf", f"return {TEXT % 'compare-doubt'}"

    def take(**changed):
        out = io.StringIO()
        writer = csv.DictWriter(out, rows[0].keys())
        writer.writeheader()
        writer.writerows({**row, **{key: change(row) for key, change in changed.items()}} for row in rows)
        run("compare.end()")
        take_second(browser, out.getvalue())
        checks.become("it is taken", lambda: run("return Boolean(recording.other)"))
        return run(doubt), run(ink)

    said, valid = take(d_lf_state=lambda row: "valid")
    checks.hold(f"a run of the same recording is not doubted {said}", said == "")
    _, held = take(d_lf_state=lambda row: "degraded")
    checks.hold("what is not valid in it is not drawn as if it were", held != valid)
    said, _ = take(source=lambda row: "elsewhere/" + row["source"].rsplit("/", 1)[-1])
    checks.hold(f"one of another recording is: {said}", "another recording" in said and "elsewhere/" in said)
    said, _ = take(source=lambda row: "./" + row["source"].split("/", 2)[-1])
    checks.hold("a folder that is named otherwise is the same", said == "")
    said, _ = take(**{f"{name}_state": (lambda row: "invalid") for name in QUANTITIES})
    checks.hold(f"so is one without a frame in common that counts: {said}", "nothing to compare" in said)
    run("compare.end()")


def check_files(browser, checks, table):
    run = browser.run
    with tempfile.TemporaryDirectory() as folder:
        browser.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
        run("charts.show(2, 12); document.getElementById('charts-csv').click()")
        run("document.getElementById('charts-png').click()")
        buttons = run("return document.querySelectorAll('figure .save').length")
        for k in range(buttons):
            run(f"document.querySelectorAll('figure .save')[{k}].click()")
            time.sleep(0.2)  # a browser takes many files at once for an attack
        found = lambda: sorted(p for p in pathlib.Path(folder).iterdir() if p.suffix in (".csv", ".png"))
        shown = run("return Array.from(document.querySelectorAll('figure .save')).filter((b) => b.offsetHeight).length")
        checks.become(f"the files come {shown}", lambda: len(found()) >= 2 + shown)
        time.sleep(0.2)
        pictures = [p.read_bytes() for p in found() if p.suffix == ".png"]
        checks.hold("pictures are PNG, and none is empty",
                    all(p[:8] == b"\x89PNG\r\n\x1a\n" and len(p) > 3000 for p in pictures))
        numbers = list(csv.DictReader(io.StringIO(next(p for p in found() if p.suffix == ".csv").read_text())))
        checks.hold("the numbers are those of the frames shown",
                    [n["frame"] for n in numbers] == [str(f) for f in range(2, 13)])
        rows = {row["frame"]: row for row in csv.DictReader(io.StringIO(table))}
        off = [abs(float(n["d_rb_m"]) - float(rows[n["frame"]]["d_rb"])) for n in numbers]
        checks.hold(f"and the same as in the table of run {max(off):.1e}", max(off) < 1e-5)


def check_table_alone(browser, checks, page):
    browser.open(page.as_uri())
    size = page.stat().st_size
    checks.hold(f"a report without clouds does not carry the library: {size} bytes", size < 400_000)
    checks.hold("and has no view", browser.run("return document.getElementById('space') === null"))
    checks.hold("its time line is there", browser.run(
        "document.getElementById('jump-next').click(); return page.frame") > 0)
    check_quiet(browser, checks)


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    page, table_page = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    table, has_three = pathlib.Path(sys.argv[3]).read_text(encoding="utf-8"), sys.argv[4] in ("1", "ON")
    browser = Browser()
    try:
        checks = Checks(browser)
        browser.open(page.as_uri())
        check_three(browser, checks, has_three)
        check_time_line(browser, checks)
        check_without_stamps(browser, checks)
        check_themes(browser, checks)
        check_second_run(browser, checks, table)
        check_files(browser, checks, table)
        take_second(browser, table)
        checks.become("the table of the same run is the same", lambda: browser.run(
            "return Boolean(recording.other) && "
            "[0, 1, 2, 3, 4, 5, 6].every((q) => recording.other.summary(q).largest < 1e-5)"))
        browser.run("document.getElementById('language').click(); document.getElementById('jump-next').click()")
        check_chinese(browser, checks)
        whole = browser.run("return document.body.innerText")
        checks.hold("no word is missing", "undefined" not in whole and "NaN" not in whole)
        if len(sys.argv) > 5:
            browser.screenshot(f"{sys.argv[5]}_view_zh.png")
        check_quiet(browser, checks)
        check_table_alone(browser, checks, table_page)
    finally:
        browser.close()
    sys.exit(1 if checks.failed else 0)


if __name__ == "__main__":
    main()
