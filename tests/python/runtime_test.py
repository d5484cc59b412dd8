# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The runtime in Python gives the same bits as the engine, from several threads. Callbacks that raise, objects that are
collected in odd orders, forks and the end of the program neither crash nor hang. No test asserts a time."""

import dataclasses
import gc
import os
import subprocess
import sys
import threading
import unittest
import weakref
from contextlib import contextmanager

from support import np, pose_wall, road, untimed

from pose_wall import _abi  # pylint: disable=wrong-import-order
from pose_wall import Activity, Cause, Drop, Runtime, RuntimeOptions, RuntimeState, State, Status

# Silence is not told while a test thinks.
PATIENT = RuntimeOptions(watchdog_ns=3600 * 10**9, cloud_points_max=30_000)


@contextmanager
def unraised():
    """What goes to sys.unraisablehook meanwhile."""
    seen, before = [], sys.unraisablehook
    sys.unraisablehook = lambda told: seen.append(told.exc_type)
    try:
        yield seen
    finally:
        sys.unraisablehook = before


def run_python(code):
    """A program of its own, which must end by itself."""
    return subprocess.run([sys.executable, "-c", "import sys; sys.path.insert(0, sys.argv[1])\n" + code,
                           os.path.dirname(os.path.abspath(__file__))], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, timeout=120, check=False)


class Refusing(unittest.TestCase):
    def refused(self, status, call, *words, kind=pose_wall.Error):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual(caught.exception.status, status)
        for word in words:
            self.assertIn(word, str(caught.exception))
        return caught.exception


class Frames(Refusing):
    def test_the_bits_of_the_engine(self):
        engine = pose_wall.Engine()
        expected = [untimed(engine.process(road(), stamp_ns=n * 10**8)) for n in range(4)]
        told = []
        with Runtime(options=PATIENT, callback=told.append) as runtime:
            latest = []
            for number in range(4):
                runtime.push(road(), stamp_ns=number * 10**8)
                runtime.wait_idle()
                latest.append(runtime.latest())
            statistics = runtime.statistics()
        for found in (told, latest):
            self.assertEqual([untimed(publication.result) for publication in found], expected)
            self.assertEqual([publication.frame for publication in found], [0, 1, 2, 3])
            self.assertEqual({publication.cause for publication in found}, {Cause.FRAME})
            self.assertEqual({publication.thinning for publication in found}, {1})
        self.assertEqual((statistics.pushed, statistics.processed, statistics.dropped_total), (4, 4, 0))
        self.assertEqual(statistics.latency.count, 4)
        self.assertGreaterEqual(statistics.latency.worst_ns, statistics.latency.p50_ns)
        self.assertIs(statistics.state, RuntimeState.RUNNING)

    def test_layouts_that_are_no_plain_ones(self):
        kind = np.dtype([("x", ">f8"), ("y", ">f8"), ("z", ">f8")])
        points = np.empty(len(road()), kind)
        for column, name in enumerate("xyz"):
            points[name] = road()[:, column]
        expected = untimed(pose_wall.Engine().process(points, stamp_ns=0))
        options = dataclasses.replace(PATIENT, point_bytes_max=24)
        with Runtime(options=options) as runtime:
            runtime.push(points, stamp_ns=0)
            runtime.wait_idle()
            self.assertEqual(untimed(runtime.latest().result), expected)
        with Runtime(options=PATIENT) as runtime:
            self.refused(Status.RUNTIME_LARGE, lambda: runtime.push(np.repeat(road(), 2, axis=0), stamp_ns=0))
            self.assertEqual(runtime.statistics().dropped[Drop.LARGE], 1)
            with self.assertRaises(TypeError):
                runtime.push([1.0], stamp_ns=0)

    def test_the_points_may_be_used_again_after_push(self):
        points = road().copy()
        expected = untimed(pose_wall.Engine().process(points, stamp_ns=0))
        with Runtime(options=PATIENT) as runtime:
            runtime.push(points, stamp_ns=0)
            points[:] = np.nan
            del points
            gc.collect()
            runtime.wait_idle()
            self.assertEqual(untimed(runtime.latest().result), expected)

    def test_what_is_not_fresh(self):
        with Runtime(options=PATIENT) as runtime:
            error = self.refused(Status.RUNTIME_NOTHING, runtime.latest, kind=pose_wall.StaleError)
            self.assertIsNone(error.publication.cause)
            self.assertIs(error.publication.result.worst_state, State.INVALID)
            self.assertEqual(pose_wall.read_image(runtime.image2_bytes()).publication, 0)
        with Runtime(options=RuntimeOptions(watchdog_ns=1, watchdog_every_ns=3600 * 10**9)) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            error = self.refused(Status.RUNTIME_STALE, runtime.latest, kind=pose_wall.StaleError)
            self.assertIs(error.publication.result.worst_state, State.INVALID)
            self.assertEqual(pose_wall.read_image(runtime.image_bytes()).valid, 0)

    def test_images(self):
        with Runtime(options=PATIENT) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            newest = runtime.latest()
            self.assertEqual(runtime.image_bytes(), pose_wall.image_bytes(newest.result))
            image = pose_wall.read_image(runtime.image2_bytes())
            self.assertEqual((image.publication, image.told_by, image.thinning, image.valid), (1, 1, 1, 0b1111111))

    def test_memento(self):
        with Runtime(options=PATIENT) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            self.refused(Status.RUNTIME_STATE, runtime.save)
            runtime.stop()
            memento = runtime.save()
            self.refused(Status.MEMENTO, lambda: runtime.load(b"no memento"))
            runtime.load(memento, pose_wall.Moment(10**8, same_clock=True))
            runtime.start()
            runtime.push(road(), stamp_ns=10**8)
            runtime.wait_idle()
            self.assertEqual(runtime.latest().result.frame_index, 1)


class Options(Refusing):
    def test_refused_by_name(self):
        for name, value in (("queue_frames", 0), ("queue_frames", 65), ("thinning_max", 3), ("watchdog_every_ns", 0),
                            ("worker_cpu", 5000), ("point_bytes_max", 8), ("queue_frames", 2**32 + 1),
                            ("worker_priority", -1), ("lock_memory", 2)):
            options = RuntimeOptions(**{name: value})
            self.refused(Status.RUNTIME_OPTION, lambda options=options: Runtime(options=options), name, str(value))
        with self.assertRaisesRegex(TypeError, "watchdog_ns: a whole number"):
            Runtime(options=RuntimeOptions(watchdog_ns=0.3))
        with self.assertRaisesRegex(TypeError, "callback"):
            Runtime(callback=3)
        with self.assertRaises(pose_wall.ConfigError):
            Runtime(pose_wall.Config(yaw_max_deg=1000))
        self.refused(Status.CONFIG_RULE, lambda: Runtime(pose_wall.Config(range_min=9, range_max=8)))

    def test_defaults_are_the_headers(self):
        options, plain = RuntimeOptions().to_c(), _abi.pose_wall_runtime_options()
        self.assertEqual((options.queue_frames, options.watchdog_ns, options.worker_cpu), (2, 300_000_000, -1))
        self.assertEqual(options.struct_size, len(bytes(plain)))


class Threads(Refusing):
    def test_pushed_and_read_by_several(self):
        """Whatever order they come in: nothing torn, and every push is accounted for."""
        faults, stop = [], threading.Event()
        with Runtime(options=PATIENT) as runtime:
            def push(first):
                for number in range(12):
                    try:
                        runtime.push(road(), stamp_ns=(first + number) * 10**7)
                    except pose_wall.Error as error:
                        if error.status != Status.RUNTIME_BUSY:
                            faults.append(error)

            def read():
                while not stop.is_set():
                    try:
                        newest = runtime.latest()
                        if newest.result.counts.points_in != len(road()):
                            faults.append(newest)
                        pose_wall.read_image(runtime.image2_bytes())
                        runtime.statistics()
                    except pose_wall.StaleError:
                        pass
                    except Exception as error:  # pylint: disable=broad-except
                        faults.append(error)

            pushers = [threading.Thread(target=push, args=(first * 100,)) for first in range(3)]
            readers = [threading.Thread(target=read) for _ in range(3)]
            for thread in pushers + readers:
                thread.start()
            for thread in pushers:
                thread.join()
            runtime.wait_idle()
            stop.set()
            for thread in readers:
                thread.join()
            statistics = runtime.statistics()
        self.assertEqual(faults, [])
        self.assertEqual(statistics.pushed, 36)
        self.assertEqual(statistics.pushed, statistics.processed + statistics.dropped_total)

    def test_closed_while_others_are_inside(self):
        for _ in range(5):
            runtime = Runtime(options=PATIENT)
            runtime.start()
            told = []

            def use(runtime=runtime, told=told):
                while True:
                    try:
                        runtime.push(road()[:200], stamp_ns=0)
                        runtime.statistics()
                        runtime.wait_idle()
                    except pose_wall.Error as error:
                        told.append(error.status)
                        if error.status == Status.RUNTIME_HANDLE:
                            return

            threads = [threading.Thread(target=use) for _ in range(3)]
            for thread in threads:
                thread.start()
            closers = [threading.Thread(target=runtime.close) for _ in range(2)]
            for thread in closers:
                thread.start()
            for thread in closers + threads:
                thread.join()
            self.assertEqual(told.count(Status.RUNTIME_HANDLE), 3)
            self.assertLessEqual(set(told), {Status.RUNTIME_HANDLE, Status.RUNTIME_STATE, Status.RUNTIME_BUSY})

    def test_stopped_and_closed(self):
        runtime = Runtime(options=PATIENT)
        self.refused(Status.RUNTIME_STATE, lambda: runtime.push(road(), stamp_ns=0))
        runtime.start()
        self.refused(Status.RUNTIME_STATE, runtime.start)
        runtime.request_stop()
        runtime.stop()
        runtime.stop()
        self.assertIs(runtime.statistics().activity, Activity.NOTHING)
        runtime.close()
        runtime.close()
        for call in (runtime.start, runtime.stop, runtime.latest, runtime.statistics, runtime.image_bytes, runtime.tick,
                     runtime.wait_idle, runtime.save, lambda: runtime.push(road(), stamp_ns=0)):
            self.refused(Status.RUNTIME_HANDLE, call, "closed")


class Callbacks(Refusing):
    def test_what_it_raises_is_told_and_ends_nothing(self):
        raised = [ValueError("x"), SystemExit(3), KeyboardInterrupt(), MemoryError()]

        def callback(publication):
            if publication.index < len(raised):
                raise raised[publication.index]

        with unraised() as seen, Runtime(options=PATIENT, callback=callback) as runtime:
            for number in range(6):
                runtime.push(road(), stamp_ns=number * 10**8)
                runtime.wait_idle()
            self.assertEqual(runtime.latest().index, 5)
            self.assertEqual(runtime.callback_failures, len(raised))
            self.assertEqual(runtime.callback_error, "MemoryError()")
        self.assertEqual(seen, [type(error) for error in raised])

    def test_by_default_it_is_printed(self):
        done = run_python("""
from support import pose_wall, road
def callback(publication): raise ValueError("deliberately")
with pose_wall.Runtime(callback=callback) as runtime:
    runtime.push(road(), stamp_ns=0); runtime.wait_idle()
print("alive")
""")
        self.assertEqual((done.returncode, done.stdout), (0, "alive\n"))
        self.assertIn("ValueError: deliberately", done.stderr)

    def test_what_it_may_call(self):
        statuses, newest = [], []

        def callback(publication):
            for call in (runtime.start, runtime.stop, runtime.close, runtime.wait_idle, lambda: runtime.load(b"")):
                try:
                    call()
                except pose_wall.Error as error:
                    statuses.append(error.status)
            runtime.save()
            newest.append((publication.index, runtime.latest().index, runtime.statistics().activity))

        with Runtime(options=PATIENT, callback=callback) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            self.assertEqual(runtime.callback_failures, 0, runtime.callback_error)
        self.assertEqual(statuses, [Status.RUNTIME_THREAD] * 5)
        self.assertEqual(newest, [(0, 0, Activity.CALLBACK)])


    def test_points_of_the_frame_that_is_told(self):
        engine, told = pose_wall.Engine(), []
        engine.process(road(), stamp_ns=0)
        expected = engine.last_points()
        with Runtime(options=PATIENT, callback=lambda _: told.append(runtime.last_points())) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            self.assertEqual(runtime.callback_failures, 0, runtime.callback_error)
            self.refused(Status.RUNTIME_STATE, runtime.last_points)
        np.testing.assert_array_equal(told[0].xyz_base_m, expected.xyz_base_m)
        np.testing.assert_array_equal(told[0].label, expected.label)


class Collected(unittest.TestCase):
    def test_a_running_one_that_is_forgotten(self):
        told = []
        runtime = Runtime(options=PATIENT, callback=told.append)
        runtime.start()
        runtime.push(road(), stamp_ns=0)
        runtime.wait_idle()
        gone = weakref.ref(runtime)
        del runtime
        gc.collect()
        self.assertIsNone(gone())
        self.assertEqual(len(told), 1)

    def test_one_that_its_own_callback_holds(self):
        held = {}

        def callback(_publication):
            return held

        held["runtime"] = Runtime(options=PATIENT, callback=callback)
        held["runtime"].start()
        gone = weakref.ref(held["runtime"])
        del held, callback
        gc.collect()
        self.assertIsNone(gone())

    def test_one_whose_last_holder_is_its_own_callback(self):
        """It is collected on the worker's thread, which cannot wait for itself."""
        done = threading.Event()
        holder = []

        def callback(_publication):
            holder.clear()
            gc.collect()
            done.set()

        holder.append(Runtime(options=PATIENT, callback=callback))
        holder[0].start()
        gone = weakref.ref(holder[0])
        holder[0].push(road(), stamp_ns=0)
        self.assertTrue(done.wait(60))
        self.assertIsNone(gone())
        with Runtime(options=PATIENT) as runtime:  # which closes the other
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            self.assertEqual(runtime.latest().index, 0)
        from pose_wall import runtime as module  # pylint: disable=import-outside-toplevel
        self.assertEqual(module._unclosed, set())

    def test_parts_outlive_the_rest(self):
        with Runtime(options=PATIENT) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            newest = runtime.latest()
            method = runtime.latest
        del runtime
        gc.collect()
        self.assertEqual(newest.result.counts.points_in, len(road()))
        with self.assertRaises(pose_wall.Error):
            method()

    def test_the_program_ends_whatever_runs(self):
        """Running, called back at that very moment, forgotten, in a cycle, beside a thread that reads for ever."""
        for ending in ("", "sys.exit(0)", "del runtime", "runtime.me = runtime; del runtime",
                       "threading.Thread(target=read, daemon=True).start()"):
            done = run_python(f"""
import sys, threading
from support import pose_wall, road
begun = threading.Event()
def callback(publication): begun.set(); print("told", len(str(publication)) > 100, flush=True)
def read():
    while True:
        try: runtime.latest()
        except pose_wall.StaleError: pass
runtime = pose_wall.Runtime(callback=callback); runtime.start()
runtime.push(road(), stamp_ns=0); begun.wait(60)
{ending}
""")
            self.assertEqual(done.returncode, 0, ending + done.stderr)
            self.assertIn("told True", done.stdout)
            self.assertNotIn("Fatal", done.stderr)


class Forks(Refusing):
    def test_a_child_is_refused_and_harms_nobody(self):
        with Runtime(options=PATIENT) as runtime:
            runtime.push(road(), stamp_ns=0)
            runtime.wait_idle()
            child = os.fork()
            if child == 0:
                status = 1
                try:
                    runtime.latest()
                except pose_wall.Error as error:
                    status = 0 if error.status == Status.RUNTIME_HANDLE and "fork" in str(error) else 2
                runtime.close()
                del runtime
                gc.collect()
                with Runtime(options=PATIENT) as own:  # its own it may have
                    own.push(road(), stamp_ns=0)
                    own.wait_idle()
                    status += own.latest().index
                os._exit(status)
            self.assertEqual(os.waitpid(child, 0)[1], 0)
            runtime.push(road(), stamp_ns=10**8)
            runtime.wait_idle()
            self.assertEqual(runtime.latest().index, 1)


if __name__ == "__main__":
    unittest.main()
