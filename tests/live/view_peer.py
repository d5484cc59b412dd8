#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The view in three dimensions of pose_walld's page, in a real browser. It is drawn, and only when something changed
and it can be seen. The face of a box follows pointer and finger by metres. One finger scrolls the page until the view
is tapped. Without WebGL, and without three.js, the page says so in one line and lives. All of it is less than 1.5 MB.

usage: view_peer.py ROOT POSE_WALL POSE_WALLD HAS_THREE [SCREENSHOT_PREFIX]"""

import pathlib
import sys
import tempfile
import time
import unittest
import urllib.request

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1), sys.argv.pop(1)
HAS_THREE = sys.argv.pop(1) in ("1", "ON")
PICTURES = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tests/checks")]

import check_report_page  # noqa: E402  pylint: disable=wrong-import-position
import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("chromium, chromium-driver", programs=("chromedriver",))

PAGE_BYTES_MOST = 1.5e6  # what was asked of it
SHORT_BOX = "[[-2.2, 2.2, -0.7, 0.7, -1.3, 0]]"

# How many colours the view has now, by a copy of what it draws.
COLOURS = """
const scene = viewer.space.scene, copy = document.createElement('canvas');
scene.render();
[copy.width, copy.height] = [scene.canvas.width, scene.canvas.height];
const pen = copy.getContext('2d');
pen.drawImage(scene.canvas, 0, 0);
return new Set(new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer)).size;
"""
# Where the handle of a face lies in the window, and where it would lie a metre further along its axis.
HANDLE = """
const scene = viewer.space.scene, box = scene.canvas.getBoundingClientRect(), face = %d;
const place = (p) => { const [x, y] = scene.place_of(p); return [box.left + x, box.top + y]; };
const here = scene.handle_places()[face], there = here.slice();
there[face >> 1] += %f;
return [place(here), place(there)];
"""


class View(unittest.TestCase):
    def setUp(self):
        self.port = live_peer.free_port()
        road = live_peer.simulated_road(POSE_WALL)
        self.daemon = live_peer.Program(*live_peer.replay_words(POSE_WALLD, road, "--http", f"127.0.0.1:{self.port}"))
        self.addCleanup(lambda: self.daemon.kill())  # a test may start another one
        self.assertTrue(self.daemon.says("runtime: measures"), self.daemon.log())

    def browser(self, width=1000, height=1000, before=""):
        browser = check_report_page.Browser(width, height, "127.0.0.1")
        self.addCleanup(browser.close)
        if before:
            browser.cdp("Page.addScriptToEvaluateOnNewDocument", source=before)
        browser.open(f"http://127.0.0.1:{self.port}/")
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return page.shown > 2")), "frames are shown")
        browser.run("document.getElementById('space-panel').scrollIntoView({block: 'center'})")
        return browser

    def still(self, browser):
        """No frame moves what is looked at; the boxes can be changed, and tell how."""
        browser.run("page.paused = true")
        self.assertTrue(live_peer.becomes_true(lambda: not browser.run("return page.drawing")), "the last one is drawn")
        browser.run("window.edits = [];"
                    f"viewer.space.scene.set_boxes({SHORT_BOX}, {{ editable: true, "
                    "on_edit: (index, box, is_done) => window.edits.push([index, box, is_done]) });"
                    "viewer.space.scene.look_from('left')")
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return !viewer.space.scene.is_asked")))

    def drawn(self, browser):
        return browser.run("return viewer.space.scene.drawn")

    def note(self, browser):
        return browser.run("return document.getElementById('space-note').textContent")

    def lives(self, browser):
        before = browser.run("return page.shown")
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return page.shown") > before + 2))


class Page(View):
    def test_the_page_is_small(self):
        total = 0
        for path in ("/", "/page.css", "/page.js", "/three.js"):
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=10) as answer:
                total += len(answer.read())
        print(f"the page has {1e-6 * total:.3f} MB")
        self.assertLess(total, PAGE_BYTES_MOST)

    def test_the_licence_of_the_library_goes_along(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/three.js", timeout=10) as answer:
            text = answer.read().decode()
        if HAS_THREE:
            self.assertIn("The MIT License", text[:200])
            self.assertIn("Permission is hereby granted", text[:2000])
        else:
            self.assertIn("no three.js", text)

    def test_pictures_and_numbers_are_saved(self):
        browser = self.browser()
        browser.run("page.paused = true; recording.stamp_s[0] = 0")  # as where the sensor was silent first
        number, shown = browser.run("return [page.told.frame, csv_text(recording.frames - 3, recording.frames - 1)]")
        rows = [line.split(",") for line in shown.strip().split("\n")]
        self.assertEqual(rows[0][:1] + rows[0][-1:], ["frame", "d_rb_state"])
        self.assertEqual([int(row[0]) for row in rows[1:]], [number - 2, number - 1, number])
        self.assertEqual(len(browser.run("return clock_ticks(recording, 0, recording.frames - 1, 3)[0][1]").split(":")),
                         1, "the simulated road's stamps are no times of day")
        with tempfile.TemporaryDirectory() as folder:
            browser.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
            browser.run("document.getElementById('charts-png').click()")
            found = lambda: list(pathlib.Path(folder).glob("*.png"))
            self.assertTrue(live_peer.becomes_true(found), "a picture comes, whatever the policy of the page")
            self.assertEqual(found()[0].read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_a_build_without_the_library_says_so(self):
        browser = self.browser(before="Object.defineProperty(window, 'THREE', { value: undefined });")
        self.assertEqual(self.note(browser), "This build has no 3D view: it was made without three.js.")
        self.assertFalse(browser.run("return document.getElementById('space').offsetHeight > 0"))
        self.lives(browser)


@unittest.skipUnless(HAS_THREE, "SKIPPED: this build has no three.js (npm ci, as tools/test.sh does)")
class InThreeDimensions(View):
    def test_it_is_drawn_when_something_changed_and_it_is_seen(self):
        browser = self.browser()
        self.assertIsNone(browser.run("return viewer.space.scene.fault"))
        self.assertTrue(live_peer.becomes_true(lambda: self.drawn(browser) > 3), "new frames are drawn")
        self.assertGreater(browser.run(COLOURS), 10, "points, planes and machine")
        self.assertTrue(browser.run("return viewer.space.scene.png().startsWith('data:image/png;base64,')"))
        browser.run("page.paused = true; viewer.shown.fill(false);"
                    "viewer.planes_shown = viewer.boxes_shown = false; viewer.draw(page.frame)")
        self.assertEqual(browser.run(COLOURS), 1, "all can be taken away")
        browser.run("viewer.shown.fill(true); viewer.planes_shown = viewer.boxes_shown = true; page.paused = false")
        browser.run("window.scrollTo(0, 1e6)")
        time.sleep(0.5)
        before = self.drawn(browser)
        self.lives(browser)
        self.assertEqual(self.drawn(browser), before, "nobody sees it")
        browser.run("page.paused = true; document.getElementById('space').scrollIntoView({block: 'center'})")
        self.assertTrue(live_peer.becomes_true(lambda: self.drawn(browser) > before))
        time.sleep(0.3)
        before = self.drawn(browser)
        time.sleep(0.7)
        self.assertEqual(self.drawn(browser), before, "nothing changed")
        browser.run("document.querySelector('[data-look=above]').click()")
        self.assertTrue(live_peer.becomes_true(lambda: self.drawn(browser) > before), "a look from elsewhere")
        errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        asked = [a for a in check_report_page.requests_made(browser)
                 if not a.startswith((f"http://127.0.0.1:{self.port}/", "data:"))]
        self.assertEqual(asked, [])

    def test_many_voxels_are_little_work(self):
        browser = self.browser()
        browser.run("page.paused = true; window.took = []; window.turns = 0; "
                    "const n = 20000, xyz = new Float32Array(3 * n), labels = new Uint8Array(n);"
                    "for (let k = 0; k < 3 * n; ++k) xyz[k] = Math.sin(k) * 5;"
                    "const turn = () => { const began = performance.now();"
                    " viewer.space.scene.set_cloud(xyz, labels, [true, true, true, true, true]);"
                    " viewer.space.scene.render(); window.took.push(performance.now() - began);"
                    " if (++window.turns < 30) setTimeout(turn, 100); };"
                    "turn();")
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return window.turns") == 30))
        middle_ms = sorted(browser.run("return window.took"))[15]
        print(f"20,000 voxels take the page {middle_ms:.1f} ms of each 100 ms")
        self.assertLess(middle_ms, 50, "half of a frame's time")

    def test_a_face_of_a_box_follows_the_pointer(self):
        browser = self.browser()
        self.still(browser)

        def mouse(kind, place, buttons=1):
            browser.cdp("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", buttons=buttons,
                        clickCount=1)

        for face, way_m in ((1, 1.0), (0, -0.6), (5, 0.4)):
            before = browser.run("return viewer.space.scene.boxes[0].slice()")
            camera = browser.run("return viewer.space.scene.camera.position.toArray()")
            here, there = browser.run(HANDLE % (face, way_m))
            browser.run("window.edits = []")
            mouse("mousePressed", here)
            mouse("mouseMoved", [(a + b) / 2 for a, b in zip(here, there)])
            mouse("mouseMoved", there)
            mouse("mouseReleased", there, 0)
            self.assertTrue(live_peer.becomes_true(lambda: browser.run("return window.edits.some((e) => e[2])")))
            index, box, _ = browser.run("return window.edits[window.edits.length - 1]")
            self.assertEqual(index, 0)
            self.assertAlmostEqual(box[face] - before[face], way_m, delta=0.05, msg=f"metres along face {face}")
            self.assertEqual(box[:face] + box[face + 1:], before[:face] + before[face + 1:])
            self.assertEqual(browser.run("return viewer.space.scene.camera.position.toArray()"), camera, "no turn")
            self.assertFalse(browser.run("return window.edits[0][2]"), "and it is told on the way")
        here, there = browser.run(HANDLE % (1, -40.0))
        mouse("mousePressed", here)
        mouse("mouseMoved", there)
        mouse("mouseReleased", there, 0)
        box = browser.run("return viewer.space.scene.boxes[0]")
        self.assertAlmostEqual(box[1] - box[0], 0.05, delta=1e-6, msg="a box keeps an inside")
        browser.run(f"viewer.space.scene.set_boxes({SHORT_BOX})")
        self.assertEqual(browser.run("return viewer.space.scene.handle_places()"), [], "only where it was asked for")
        if PICTURES:
            browser.screenshot(f"{PICTURES}_box.png")

    def test_one_finger_scrolls_until_the_view_is_tapped(self):
        browser = self.browser(768, 1024)
        self.still(browser)
        browser.cdp("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        browser.run("document.getElementById('space').scrollIntoView({block: 'center'}); page.paused = true")
        camera = lambda: browser.run("return viewer.space.scene.camera.position.toArray()")
        # By the view itself: a line above it that grows shifts the page
        # under a reader who has not scrolled, to a whole pixel.
        scrolled = lambda: browser.run("return -document.getElementById('space').getBoundingClientRect().top")
        awake = lambda: browser.run("return viewer.space.scene.is_awake")
        corner = lambda: browser.run("const b = document.getElementById('space').getBoundingClientRect();"
                                     "return [b.left + 60, b.top + b.height - 60]")

        def touch(kind, *fingers):
            browser.cdp("Input.dispatchTouchEvent", type=kind,
                        touchPoints=[{"x": fx, "y": fy, "id": k} for k, (fx, fy) in enumerate(fingers)])

        def swipe(x, y, dx, dy):
            touch("touchStart", (x, y))
            for step in range(1, 13):
                touch("touchMove", (x + dx * step, y + dy * step))
            touch("touchEnd")

        before = (camera(), scrolled())
        swipe(*corner(), 0, -10)
        self.assertTrue(live_peer.becomes_true(lambda: scrolled() > before[1] + 40), "a swipe over it scrolls the page")
        self.assertEqual(camera(), before[0], "and leaves the view")
        time.sleep(0.5)
        x, y = corner()
        before = (camera(), scrolled())
        touch("touchStart", (x, y))
        touch("touchStart", (x, y), (x + 40, y))
        for step in range(1, 11):
            touch("touchMove", (x + 4 * step, y), (x + 40 + 8 * step, y))
        touch("touchEnd")
        self.assertNotEqual(camera(), before[0], "two fingers turn and zoom it")
        self.assertAlmostEqual(scrolled(), before[1], delta=1, msg="and leave the page")
        self.assertFalse(awake())
        x, y = corner()
        touch("touchStart", (x, y))
        touch("touchEnd")
        self.assertTrue(live_peer.becomes_true(awake), "a tap wakes it")
        before = (camera(), scrolled())
        swipe(x, y, 8, -4)
        self.assertNotEqual(camera(), before[0], "then one finger turns it")
        self.assertAlmostEqual(scrolled(), before[1], delta=1, msg="and the page stays")
        note = browser.run("return document.getElementById('frame-note').getBoundingClientRect().top")
        touch("touchStart", (x, note + 5))
        touch("touchEnd")
        self.assertTrue(live_peer.becomes_true(lambda: not awake()), "a tap elsewhere puts it to sleep")
        browser.run("viewer.space.scene.look_from('left')")
        here, there = browser.run(HANDLE % (1, 0.5))
        before = scrolled()
        swipe(*here, (there[0] - here[0]) / 12, (there[1] - here[1]) / 12)
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return window.edits.some((e) => e[2])")))
        box = browser.run("return window.edits[window.edits.length - 1][1]")
        self.assertAlmostEqual(box[1], 2.7, delta=0.05, msg="a finger on a handle moves the face")
        self.assertAlmostEqual(scrolled(), before, delta=1, msg="and the page stays")
        browser.run("document.getElementById('trends-panel').scrollIntoView()")
        time.sleep(0.3)
        before = scrolled()
        swipe(300, 700, 0, -10)
        self.assertTrue(live_peer.becomes_true(lambda: scrolled() > before + 40), "elsewhere one finger scrolls")

    def test_without_webgl_the_page_says_so_and_lives(self):
        browser = self.browser(before="const usual = HTMLCanvasElement.prototype.getContext;"
                               "HTMLCanvasElement.prototype.getContext = function (kind, ...more) {"
                               " return kind === 'webgl2' ? null : usual.call(this, kind, ...more); };")
        self.assertEqual(self.note(browser), "No 3D view here: this browser has no WebGL 2.")
        self.lives(browser)
        self.assertTrue(browser.run("const c = document.getElementById('top'), pen = c.getContext('2d');"
                                    "return pen.getImageData(0, 0, c.width, c.height).data.some((x) => x)"))

    def test_webgl_that_is_lost_is_told_and_comes_back(self):
        browser = self.browser()
        browser.run("window.loss = viewer.space.scene.renderer.getContext().getExtension('WEBGL_lose_context');"
                    "window.loss.loseContext()")
        self.assertTrue(live_peer.becomes_true(lambda: self.note(browser).startswith("The 3D view has stopped")))
        self.lives(browser)
        browser.run("window.loss.restoreContext()")
        self.assertTrue(live_peer.becomes_true(lambda: self.note(browser).startswith("In three dimensions")))
        self.assertTrue(live_peer.becomes_true(lambda: browser.run(COLOURS) > 10))

    def test_the_way_of_the_stop_is_drawn(self):
        self.daemon.kill()
        road = live_peer.simulated_road(POSE_WALL)
        self.daemon = live_peer.Program(*live_peer.replay_words(
            POSE_WALLD, road, "--http", f"127.0.0.1:{self.port}", "--set", "planar=map"))
        self.assertTrue(self.daemon.says("planar roadway: maps"), self.daemon.log())
        browser = self.browser()
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return viewer.space.scene.parts.sweep.length > 0")))
        ends = lambda speed, turn: browser.run(
            "const kept = [roadway.stop, roadway.stop_heard_ms]; roadway.stop_heard_ms = performance.now();"
            f"roadway.stop = {{ state: 'go', speed_m_s: {speed}, turn_rad_s: {turn}, nearest_m: [4, 1] }};"
            "const sweep = roadway.sweep([1, 0]); [roadway.stop, roadway.stop_heard_ms] = kept;"
            "const rings = sweep.patches.map((p) => p.corners), p = roadway.planar;"
            "return { first: rings[0], last: rings[rings.length - 1], nearest: sweep.nearest,"
            " tint: sweep.patches[0].tint,"
            " way: Math.abs(%s) * p.latency_s + %s ** 2 / (2 * p.deceleration_m_s2) };" % (speed, f"({speed})"))
        driven = ends(0.8, 0)
        self.assertAlmostEqual(driven["last"][1][0] - driven["first"][1][0], driven["way"], places=6)
        self.assertGreater(driven["way"], 0.3)
        self.assertEqual(driven["tint"], "valid")
        self.assertEqual(driven["nearest"][:2], [4, 1])
        back = ends(-0.8, 0)
        self.assertAlmostEqual(back["last"][0][0] - back["first"][0][0], -back["way"], places=6)
        turned = ends(0.8, 0.2)
        self.assertGreater(turned["last"][1][1], driven["last"][1][1] + 0.05, "to the left by a positive turn")
        self.assertEqual(ends("null", "null")["way"], 0, "a motion that nobody knows draws no way")
        if PICTURES:
            time.sleep(0.5)
            browser.screenshot(f"{PICTURES}_sweep.png")


if __name__ == "__main__":
    live_peer.main()
