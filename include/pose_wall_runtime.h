/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * pose_wall_runtime: threads around the engine of pose_wall.h. The receiving thread hands frames over, a thread of the
 * runtime works them, and every thread can read the results at any time. It is a second archive,
 * libpose_wall_runtime.a, and needs POSIX threads and pose_wall.h, nothing else. From pose_wall_motion.h it needs only
 * the types. For motion, link libpose_wall_motion.a as well and pass its functions: see MOTION.
 *
 *     Check the status that every call returns; this sketch leaves it out.
 *
 *     pose_wall_runtime_options options;
 *     pose_wall_runtime_options_init(&options);
 *     options.callback = on_result;                                          optional
 *     pose_wall_runtime_memory_needed(&config, &options, &bytes);
 *     pose_wall_runtime_open(&config, &options, block, bytes, &runtime);     all the memory there is
 *     pose_wall_runtime_start(runtime);
 *     for every frame: pose_wall_runtime_push(runtime, &cloud);              returns before the frame is worked
 *     elsewhere:       pose_wall_runtime_latest(runtime, &publication);      never waits, refuses stale results
 *     for a controller: pose_wall_runtime_image(runtime, &image);            likewise
 *     pose_wall_runtime_stop(runtime);
 *     pose_wall_runtime_close(runtime);                                      then free the block
 *
 * THREADS. The callback runs on the worker's thread, the sink on the recorder's. None of these calls is for signal
 * handlers.
 * - push: any thread, one at a time.
 * - latest, image, image2: any number of threads at once, without a lock.
 * - statistics_now, tick, request_stop: any thread, including the callback.
 * - start, stop, wait_idle, close, load: any thread except the callback's and the sink's (POSE_WALL_RUNTIME_E_THREAD).
 * - save: the callback, or any thread while the runtime is stopped.
 * - last_points: the callback.
 *
 * STATES. stopped (after open, and after stop) -> start -> running -> request_stop or stop -> stopping -> stop ->
 * stopped. The call stop returns from any state. It may be called twice, and by two threads at once.
 *
 * QUEUE. Newest wins: when a frame comes and all places are taken, the OLDEST waiting frame is dropped and counted. At
 * any time pushed = processed + in_work + waiting + filling + the sum of dropped[].
 *
 * MEMORY. The caller's block and the threads' stacks (of the system's default size). Nothing is allocated after start.
 * push copies the cloud with its inputs; the caller may reuse both when push returns.
 *
 * TIME. push costs one pass over the cloud in the caller's thread, and two short locks. No thread holds these locks
 * while it works, calls back or writes. The worker never waits for a disk.
 *
 * SILENCE. When the newest worked frame is older than watchdog_ns, the worker publishes the result of pose_wall_age:
 * values age, are held, then invalid. The reason may be that no frame came, or that the worker is late. A frame that
 * waited so long is dropped, because it would look fresh. A frame that was worked so late is not published as a frame:
 * the next silence carries its measurements with their age. Both count as dropped (`late`). While a frame waits, two
 * silences never follow each other. A clock that goes back by more than watchdog_ns counts as a silence of unknown
 * length: the runtime assumes an hour, and all values are invalid. The runtime cannot know the age of a frame when it
 * is pushed: drain the socket's backlog, and push the newest frame. Values are held while their levels stay within the
 * alert limits. The defaults are 1 degree at 0.05 rad/s and 0.10 m at 0.2 m/s. So a hold ends a third to half a second
 * after a good frame, hardly later than watchdog_ns.
 *
 * FRESHNESS. A worker that hangs in the engine, in the callback or in the caller's clock cannot publish silence. So
 * `latest` and `image` read the runtime's clock themselves, in the calling thread. A frame is stale watchdog_ns after
 * its reception, a silence watchdog_ns after its publication. Both are stale when the clock stands more than
 * watchdog_ns before that time. The calls refuse stale publications (POSE_WALL_RUNTIME_E_STALE). They write them all
 * the same, with every value invalid: a caller that ignores the status cannot act on them. `activity` shows what the
 * worker does, and since when, so a hanging callback can be told from a hanging engine. A healthy worker publishes
 * silence every watchdog_every_ns. If that is watchdog_ns or more, silence itself becomes stale in between. With
 * watchdog_ns 0 nothing is ever stale: then compare age_ns. A clock that stands still makes everything look fresh.
 *
 * OVERLOAD. When frames come faster than they are worked, frames are dropped. Points are left out only if thinning_max
 * allows it, and only after three frames in a row took longer than frame_period_max_ns to work while some were dropped.
 * First every second return is left out, then three of four, and so on. They come back when twenty frames in a row took
 * less than three eighths of that time. The callback's time does not count: a slow callback costs frames, never points.
 * No threshold is ever loosened. Gaps in a wall may go unnoticed in a thinned cloud (pose_wall.h, pose_wall_cloud). So
 * values from a thinned cloud are at best degraded, and `thinning` shows the factor; `held_thinning` shows it for held
 * values. The region is never narrowed, because a cropped cloud looks full of holes. Dropped frames show in `frame`,
 * which counts pushes.
 *
 * MOTION. Set options.motion = pose_wall_motion_functions_get() and the config's key `motion` on. Each frame then goes
 * through pose_wall_motion.h first. Its pose enters the engine with the frame's own inputs, as in
 * pose_wall_motion_process_both, so held values move with the machine. An odometry from the caller is then not used,
 * because two odometries are not comparable. The publication has the motion's result beside the engine's; silence has
 * none. Motion costs a frame only time. A frame that the motion refuses is worked without it, and a motion with a
 * damaged block is opened again. Each start begins a new map. After dropped frames the motion searches wider. A thinned
 * cloud is worked like any other, with levels for its own points. The motion sees the points that push copied: points
 * without a return are not in it.
 *
 * ERRORS. POSE_WALL_OK or a negative status, of pose_wall.h or of this header. A refused call changes nothing but the
 * counters.
 */

#ifndef POSE_WALL_RUNTIME_H
#define POSE_WALL_RUNTIME_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall.h"
#include "pose_wall_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when a struct or function of this header changes incompatibly. */
#define POSE_WALL_RUNTIME_ABI_VERSION 3
uint32_t pose_wall_runtime_abi_version(void);

/* ---------------------------------------------------------------------------------------------- status */

/* Beside those of pose_wall.h. Pinned by a test and never reused. */
enum pose_wall_runtime_status {
  POSE_WALL_RUNTIME_E_OPTION = -100,  /* an option out of its range, or `reserved` not zero: options_check names it */
  POSE_WALL_RUNTIME_E_HANDLE = -101,  /* not an open runtime */
  POSE_WALL_RUNTIME_E_STATE = -102,   /* not in this state: not running, not stopped, or not called back */
  POSE_WALL_RUNTIME_E_THREAD = -103,  /* not from the callback or the sink: it would wait for itself */
  POSE_WALL_RUNTIME_E_BUSY = -104,    /* another thread is inside push */
  POSE_WALL_RUNTIME_E_LARGE = -105,   /* more points than cloud_points_max, or wider than point_bytes_max */
  POSE_WALL_RUNTIME_E_NOTHING = -106, /* nothing published since start */
  POSE_WALL_RUNTIME_E_SYSTEM = -107,  /* the system refused a thread, or a wish of `required` */
  POSE_WALL_RUNTIME_E_STALE = -108,   /* the last publication is watchdog_ns old: see FRESHNESS */
  POSE_WALL_RUNTIME_E_MOTION = -109   /* this runtime has no motion: see MOTION */
};
/* The same as pose_wall_status_text, which knows the statuses of all libraries; static storage. */
const char* pose_wall_runtime_status_text(int32_t status);

/* ---------------------------------------------------------------------------------------------- publications */

enum pose_wall_runtime_cause {
  POSE_WALL_RUNTIME_FRAME = 1,  /* a frame was worked */
  POSE_WALL_RUNTIME_SILENCE = 2 /* the newest worked frame is older than watchdog_ns: aged values, R_NO_FRAME */
};

/* What the worker does. It is stuck if one activity lasts longer than a frame takes. */
enum pose_wall_runtime_activity {
  POSE_WALL_RUNTIME_AT_NOTHING = 0,  /* there is no worker: stopped */
  POSE_WALL_RUNTIME_AT_WAIT = 1,     /* waits for a frame, a tick or the watchdog's time */
  POSE_WALL_RUNTIME_AT_CHOICE = 2,   /* takes the lock, reads the clock, chooses what comes next */
  POSE_WALL_RUNTIME_AT_FRAME = 3,    /* measures a frame: in the engine, or in the clock that it reads meanwhile */
  POSE_WALL_RUNTIME_AT_SILENCE = 4,  /* publishes silence: likewise in the engine or in the clock */
  POSE_WALL_RUNTIME_AT_CALLBACK = 5, /* in the callback */
  POSE_WALL_RUNTIME_ACTIVITIES = 6
};
/* "frame"; static storage. */
const char* pose_wall_runtime_activity_name(uint32_t activity);

typedef struct pose_wall_publication {
  uint32_t struct_size;   /* set by the caller of pose_wall_runtime_latest to sizeof */
  uint32_t cause;         /* pose_wall_runtime_cause; 0: nothing was published, see pose_wall_runtime_latest */
  uint32_t thinning;      /* 4: one of four returns was used; 1: all. Above 1 no state is better than degraded */
  uint32_t held_thinning; /* the largest thinning of the frames that held values of this result come from; 1: none */
  uint64_t index;         /* counts publications from 0, over all starts */
  uint64_t frame;         /* counts pushes from 0, over all starts; of a silence: the last worked, 0 before any */
  int64_t received_ns;    /* runtime's clock, at the start of that frame's push; before the first frame, of start, or of
                             the load before it */
  int64_t published_ns;   /* runtime's clock */
  int64_t age_ns; /* now minus received_ns, by the runtime's clock at the call; in the callback, at its publication.
                     Never negative: 0 where the clock went back by up to watchdog_ns, INT64_MAX where it went back by
                     more or nothing was published */
  int64_t activity_since_ns; /* runtime's clock, rounded down to a multiple of 8 ns: start of the activity */
  uint32_t activity;         /* pose_wall_runtime_activity, at the call */
  uint32_t reserved[5];      /* 0 */
  pose_wall_result
      result; /* Its counts include the points without a return that push left out. Its struct_size: bytes written */
  uint32_t has_motion;            /* 1: `motion` is of this frame. 0: silence, no motion, or motion_status */
  int32_t motion_status;          /* why this frame has no motion although the runtime has: the motion's status */
  pose_wall_motion_result motion; /* without has_motion: as pose_wall_motion_blank, and all zero where the runtime has
                                     no motion. points_in includes what push left out */
  pose_wall_odometry odometry;    /* with has_motion: the pose of `motion` as the engine got it. run 0: there is none */
} pose_wall_publication;

/* Called on the worker's thread after `latest` holds the same. The next frame waits until it returns. The pointer is
 * valid until then. */
typedef void (*pose_wall_runtime_callback)(void* user, const pose_wall_publication* publication);

/* ---------------------------------------------------------------------------------------------- black box */

/* Writes the black box: `count` bytes at `offset` of a file of at most box_bytes. Return 0 for written. Anything else
 * means not written: the record counts as failed, and the next one is tried. The sink may be as slow as a disk, since
 * only the recorder's thread waits for it. But stop waits for that thread: give a sink that may hang its own time
 * limit. A record takes up to four calls; the last one makes it whole. The header is retried until it is written. A
 * loss of power takes all bytes that the sink did not sync. The first record of a silence is written, then one whenever
 * a state or a reason changes, and one a minute. Format and reader: pose_wall_box.h. */
typedef int32_t (*pose_wall_runtime_sink)(void* user, uint64_t offset, const void* bytes, uint64_t count);

/* ---------------------------------------------------------------------------------------------- options */

/* Bits of `required`. */
enum pose_wall_runtime_wish {
  POSE_WALL_RUNTIME_PRIORITY = 1,
  POSE_WALL_RUNTIME_AFFINITY = 2,
  POSE_WALL_RUNTIME_LOCK = 4
};

typedef struct pose_wall_runtime_options {
  uint32_t struct_size;      /* set by pose_wall_runtime_options_init */
  uint32_t queue_frames;     /* 2; 1 to 64 waiting frames. More of them hide longer stalls and make results older */
  uint32_t cloud_points_max; /* 262144; 1 to 2^26 points a cloud may hold, including points without a return */
  uint32_t point_bytes_max;  /* 16; 12 to 48: x, y, z of 4 or 8 bytes each, and intensity where intensity_weight > 0.
                                With an odometry, the runtime's or the caller's, time is copied as well where it fits,
                                then ring for motion. 24 has room for both beside floats, as known drivers write them.
                                Without time the scan's own motion cannot be removed */
  uint32_t thinning_max;     /* 1: never leave out a return. 2, 4, 8 or 16: see OVERLOAD */
  uint32_t box_clouds;  /* 1: the black box holds whole clouds. 0: only their digests; no frame can be computed again */
  uint32_t box_backlog; /* 2; 1 to 64 records that may wait for the sink; further ones are not recorded */
  int32_t
      worker_priority;  /* 0: as the caller's thread. 1 to 99: SCHED_FIFO. The recorder always has the usual priority */
  int32_t worker_cpu;   /* -1: any. Else the worker runs on this processor only, 0 to 1023 */
  uint32_t lock_memory; /* 0 or 1: mlock the block (not the stacks) */
  uint32_t required;    /* of pose_wall_runtime_wish: start fails without these; other refusals are only reported */
  uint32_t reserved;    /* 0 */
  int64_t
      frame_period_max_ns; /* 100 ms; 1 ms to 1 h: frames are dropped, not thinned, while none takes longer to work */
  int64_t watchdog_ns; /* 300 ms; 1 ns to 1 h, 0: never. After so much silence a publication says so; frames so old are
                          not published; publications so old are refused: see FRESHNESS */
  int64_t watchdog_every_ns; /* 100 ms; 1 ms to 1 h: period of further silences, until a frame comes. Best below
                                watchdog_ns */
  pose_wall_clock clock; /* NULL: clock_gettime(CLOCK_MONOTONIC). Called by all threads at once, also under the lock: it
                            must not call the runtime. With a clock of the caller's, only pose_wall_runtime_tick wakes
                            the worker for the watchdog */
  void* clock_user;
  pose_wall_runtime_callback callback; /* or NULL */
  void* callback_user;
  pose_wall_runtime_sink sink; /* or NULL: no black box */
  void* sink_user;
  uint64_t box_bytes;  /* 0; of the ring file. With a sink at least what the header and one whole record need: 4288
                          bytes, sizeof(pose_wall_inputs), pose_wall_memento_bytes(), sizeof(pose_wall_result),
                          sizeof(pose_wall_motion_result) and, with box_clouds, cloud_points_max x point_bytes_max,
                          these five rounded up to multiples of 64. Used in multiples of 64 */
  uint64_t reserved_2; /* 0. Their size distinguishes these options from those of ABI 2 */
  const pose_wall_motion_functions* motion;         /* NULL: no motion. Else kept as it is, not copied */
  const pose_wall_motion_settings* motion_settings; /* NULL: defaults. Copied by open */
} pose_wall_runtime_options;

/* Fills every option with its default (the figure in its comment). Fails iff: NULL. */
int32_t pose_wall_runtime_options_init_3(pose_wall_runtime_options* options);
/* The name that programs built against ABI 2 call: writes nothing and always returns POSE_WALL_E_ABI. */
int32_t pose_wall_runtime_options_init(pose_wall_runtime_options* options);
#define pose_wall_runtime_options_init pose_wall_runtime_options_init_3

/* Checks whether memory_needed and open take these options. Fails iff: options NULL, struct_size (as in pose_wall.h,
 * STRUCTS: POSE_WALL_E_STRUCT_SIZE, _ABI or _STRUCT_NEWER; so in all calls below), POSE_WALL_RUNTIME_E_OPTION. Only in
 * the last case *option is the name of the first member out of its range ("watchdog_ns"; static storage). The pointer
 * option may be NULL. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_options_check(const pose_wall_runtime_options* options,
                                                          const char** option);

/* ---------------------------------------------------------------------------------------------- life */

typedef struct pose_wall_runtime pose_wall_runtime;

/* Bytes of the block. It holds the engine, the motion if there is one, and queue_frames + 2 frames of cloud_points_max
 * x point_bytes_max bytes. A sink adds box_backlog frames. options NULL: the defaults. Fails iff: config or bytes
 * NULL, struct_size, an option, the config (as pose_wall_memory_needed). */
POSE_WALL_CHECKED int32_t pose_wall_runtime_memory_needed(const pose_wall_config* config,
                                                          const pose_wall_runtime_options* options, uint64_t* bytes);

/* Places a runtime in block, which may hold anything, must be aligned to POSE_WALL_BLOCK_ALIGNMENT, stays the caller's
 * and must not move. Starts no thread. *runtime is set only on success. options NULL: the defaults, so without a
 * callback and a sink. Fails as memory_needed, for a block misaligned or too small, and for one in which a runtime was
 * started and not stopped (POSE_WALL_E_BUSY). A block in shared memory outlives its process: clear it if that process
 * died with the runtime running. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_open(const pose_wall_config* config,
                                                 const pose_wall_runtime_options* options, void* block,
                                                 uint64_t block_bytes, pose_wall_runtime** runtime);

/* Starts the threads and returns when the worker runs. The engine starts without memory, except for a load since the
 * last start. The black box starts at its beginning: the header is overwritten at once, earlier records follow. Give
 * each start its own file, or a restart after an incident overwrites the incident. Counters continue. Fails iff: NULL,
 * not open, not stopped, called back, POSE_WALL_RUNTIME_E_SYSTEM, POSE_WALL_E_ENGINE (others changed the block, perhaps
 * the config in it: open it again). The runtime is then stopped. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_start(pose_wall_runtime* runtime);

/* Waits until every frame is worked, every tick handled and every record written, including frames pushed meanwhile.
 * For tests and offline work. Fails iff: NULL, not open, called back, not running or stopped meanwhile
 * (POSE_WALL_RUNTIME_E_STATE). */
POSE_WALL_CHECKED int32_t pose_wall_runtime_wait_idle(pose_wall_runtime* runtime);

/* Asks the worker to end after its present activity; push is refused from now on. Returns at once. Fails iff: NULL, not
 * open, not running. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_request_stop(pose_wall_runtime* runtime);

/* Ends the threads and waits for them: for the frame in work, the callback, and the records that wait for the sink.
 * Waiting frames are dropped and counted. Does nothing if already stopped. Fails iff: NULL, not open, called back. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_stop(pose_wall_runtime* runtime);

/* Gives the block back to the caller. Fails iff: NULL, not open, called back, not stopped, or a push, wait_idle or stop
 * is still inside (POSE_WALL_RUNTIME_E_STATE). No other call may be made meanwhile. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_close(pose_wall_runtime* runtime);

/* Saves the engine's memory as pose_wall_save does, for a start after a loss of power. Call it while the runtime is
 * stopped, or from the callback: the memento then includes the present publication. Fails iff: NULL, not open,
 * POSE_WALL_RUNTIME_E_STATE (running, and not from the callback), and as pose_wall_save. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_save(pose_wall_runtime* runtime, const pose_wall_moment* now, void* memento,
                                                 uint64_t bytes);

/* Gives a memento to the next start only, with the age that pose_wall_load finds. Silence before the first frame
 * continues to hold its values from the moment's stamp_ns. That must be the present time, also with
 * POSE_WALL_MOMENT_SAME_CLOCK. Values held from it report thinning_max as held_thinning, because a memento does not
 * store theirs. Fails iff: NULL, not open, called back, not stopped (POSE_WALL_RUNTIME_E_STATE), and as pose_wall_load.
 * After a failure the next start is as without this call. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_load(pose_wall_runtime* runtime, const pose_wall_moment* now,
                                                 const void* memento, uint64_t bytes);

/* ---------------------------------------------------------------------------------------------- frames and results */

/* Checks the cloud and its inputs, copies what the engine needs, and queues it. Inputs describe the time since the
 * frame pushed before. If that frame was dropped, only their boxes and their odometry are used. Points that are not
 * finite or exactly zero are not copied. There are two exceptions: with intensity_weight > 0, where they count in the
 * mean, and with times the first and the last of them. Refused frames count as pushed and dropped, except for NULL and
 * a runtime that is not running. Fails iff: NULL, not open, not running or stopped before the copy was done (which is
 * counted), another thread inside push, struct_size, a description that pose_wall_cloud_check refuses, or
 * POSE_WALL_RUNTIME_E_LARGE. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_push(pose_wall_runtime* runtime, const pose_wall_cloud* cloud);

/* The newest publication, with its age and the worker's activity. No lock, no wait: one read of the clock and one copy,
 * repeated only if three newer ones were published meanwhile. Set publication->struct_size first. Fails iff: NULL, not
 * open, struct_size, or one of the following, which all write *publication with every value invalid:
 * - POSE_WALL_RUNTIME_E_STALE: the newest publication, aged until now. Confidence is 0, raw values, planes and counts
 * are missing, levels have no bound, and the reason is POSE_WALL_R_NO_FRAME.
 * - Not running, POSE_WALL_RUNTIME_E_NOTHING: as of an engine before its first frame, with cause 0.
 * - POSE_WALL_E_ENGINE: likewise. Others changed the publication since; the next one will be sound. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_latest(const pose_wall_runtime* runtime,
                                                   pose_wall_publication* publication);

/* The image of the newest publication for a controller, made as by pose_wall_image_fill. Set image->struct_size first.
 * Fails as pose_wall_runtime_latest does. Where that call writes a publication, this one writes an image with a correct
 * CRC. If the publication is stale, damaged or missing, every value and the verdict of the image are invalid. So the
 * image may be passed on whatever the status, as long as struct_size and handle are good. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_image(const pose_wall_runtime* runtime, pose_wall_image* image);

/* Image 2 of the same, likewise. Its publication is index + 1, and 0 where nothing was published. Its latency is
 * published_ns minus received_ns: for silence, the age of its last frame. It has told_by, thinning and held_thinning of
 * the publication. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_image2(const pose_wall_runtime* runtime, pose_wall_image2* image);

/* The motion image (pose_wall_motion.h) of the same, likewise. In silence and when stale it has no values, and its run
 * is 0. Fails also iff: POSE_WALL_RUNTIME_E_MOTION; the image is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_motion_image(const pose_wall_runtime* runtime,
                                                         pose_wall_motion_image* image);

/* The labelled points of the callback's frame, as by pose_wall_last_points: for pictures and logs. The pointers are
 * valid until the callback returns. In a silence they are those of the last worked frame. Only from the callback. Fails
 * iff: NULL, not open, POSE_WALL_RUNTIME_E_STATE (not from the callback), and as pose_wall_last_points. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_last_points(const pose_wall_runtime* runtime, pose_wall_points* points);

/* Makes the worker read its clock. Fails iff: NULL, not open, not running. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_tick(pose_wall_runtime* runtime);

/* ---------------------------------------------------------------------------------------------- statistics */

enum pose_wall_runtime_state {
  POSE_WALL_RUNTIME_STOPPED = 0,
  POSE_WALL_RUNTIME_STARTING = 1,
  POSE_WALL_RUNTIME_RUNNING = 2,
  POSE_WALL_RUNTIME_STOPPING = 3
};

/* Why a pushed frame was not worked; index of dropped[]. */
enum pose_wall_runtime_drop {
  POSE_WALL_RUNTIME_DROP_DESCRIPTION = 0, /* refused: the cloud's description */
  POSE_WALL_RUNTIME_DROP_LARGE = 1,       /* refused: too large */
  POSE_WALL_RUNTIME_DROP_BUSY = 2,        /* refused: another thread was inside push */
  POSE_WALL_RUNTIME_DROP_OVERTAKEN = 3,   /* the oldest that waited, when a newer one needed its place */
  POSE_WALL_RUNTIME_DROP_STOPPED = 4,     /* still waiting, or being copied, at stop */
  POSE_WALL_RUNTIME_DROP_ENGINE = 5,      /* the engine refused it: it found its block damaged, and was opened anew */
  POSE_WALL_RUNTIME_DROP_LATE = 6,        /* it waited, or was worked, until it was watchdog_ns old */
  POSE_WALL_RUNTIME_DROPS = 7
};
const char* pose_wall_runtime_drop_name(uint32_t drop);

/* From a histogram of 32 steps per doubling: quantiles are rounded up by at most 1/32, worst is exact. 0 when count is
 * 0. Since open. */
typedef struct pose_wall_runtime_times {
  uint64_t count;
  int64_t p50_ns;
  int64_t p99_ns;
  int64_t p999_ns;
  int64_t worst_ns;
} pose_wall_runtime_times;

typedef struct pose_wall_runtime_statistics {
  uint32_t struct_size; /* set by the caller to sizeof */
  uint32_t state;       /* pose_wall_runtime_state */
  uint64_t pushed;
  uint64_t processed;
  uint64_t dropped[POSE_WALL_RUNTIME_DROPS];
  uint32_t filling; /* 0 or 1: being copied by push */
  uint32_t waiting; /* queue depth */
  uint32_t in_work; /* 0 or 1 */
  uint32_t waiting_worst;
  uint64_t published;
  uint64_t silences; /* of those published: by the watchdog */
  uint64_t thinned;  /* of those processed: thinned */
  uint32_t thinning; /* of the next push */
  uint32_t thinning_worst;
  uint32_t activity;         /* pose_wall_runtime_activity, now */
  uint32_t reserved;         /* 0 */
  int64_t activity_since_ns; /* as in pose_wall_publication */
  int64_t newest_age_ns; /* now minus received_ns of the newest worked frame; -1: not known (none yet, or the clock went
                            back) */
  uint64_t box_written;  /* records */
  uint64_t box_lost;     /* not recorded: box_backlog records were waiting for the sink */
  uint64_t box_failed;   /* refused by the sink: records, and the header at the start */
  uint64_t box_bytes_written;
  int32_t priority_error; /* of the last start: 0 granted or not requested, else errno */
  int32_t affinity_error;
  int32_t lock_error;
  int32_t thread_error;
  pose_wall_runtime_times push;     /* inside push, accepted frames */
  pose_wall_runtime_times wait;     /* from the start of push until the worker takes it */
  pose_wall_runtime_times work;     /* inside the engine */
  pose_wall_runtime_times latency;  /* from the start of push until published */
  pose_wall_runtime_times callback; /* inside the callback */
  pose_wall_runtime_times sink;     /* to write one record, or to fail to */
  pose_wall_runtime_times stage[POSE_WALL_STAGES];
  uint64_t motion_refused;        /* of the frames worked: without motion, see pose_wall_publication.motion_status */
  pose_wall_runtime_times motion; /* inside motion, beside `work` */
} pose_wall_runtime_statistics;

/* A consistent copy of the counters; the times are read beside them without a lock. Set struct_size first. Fails iff:
 * NULL, not open, struct_size. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_statistics_now(const pose_wall_runtime* runtime,
                                                           pose_wall_runtime_statistics* statistics);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_RUNTIME_H */
