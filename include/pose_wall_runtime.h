/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * pose_wall_runtime: the engine of pose_wall.h on a machine that runs. Frames are handed over by the thread that
 * receives them and are worked by a thread of the runtime's own; results are there for every thread at any time. A
 * second archive, libpose_wall_runtime.a: POSIX threads and pose_wall.h, nothing else. Of pose_wall_motion.h it needs
 * the types; who wants motion as well links libpose_wall_motion.a and hands its functions over: see MOTION.
 *
 *     Every call returns a status to look at; it is left out here.
 *
 *     pose_wall_runtime_options options;
 *     pose_wall_runtime_options_init(&options);
 *     options.callback = on_result;                                          optional
 *     pose_wall_runtime_memory_needed(&config, &options, &bytes);
 *     pose_wall_runtime_open(&config, &options, block, bytes, &runtime);     all the memory there is
 *     pose_wall_runtime_start(runtime);
 *     for every frame: pose_wall_runtime_push(runtime, &cloud);              returns before the frame is worked
 *     elsewhere:       pose_wall_runtime_latest(runtime, &publication);      never waits, refuses what is stale
 *     for a controller: pose_wall_runtime_image(runtime, &image);            likewise
 *     pose_wall_runtime_stop(runtime);
 *     pose_wall_runtime_close(runtime);                                      then free the block
 *
 * THREADS. push: any thread, one at a time. latest, image, image2: any thread, any number of them, without a lock.
 * statistics_now, tick, request_stop: any thread, the callback too. start, stop, wait_idle, close, load: any thread but
 * the callback's and the sink's (POSE_WALL_RUNTIME_E_THREAD). save: the callback, or any thread while it is stopped.
 * last_points: the callback.
 * The callback runs on the worker's thread, the sink on the recorder's. None of these is for signal handlers.
 *
 * STATES. stopped (after open, and after stop) -> start -> running -> request_stop or stop -> stopping -> stop ->
 * stopped. stop comes back from any state and may be called twice, and by two threads at once.
 *
 * QUEUE. Newest wins: when a frame comes and all places are taken, the OLDEST that waits is dropped and counted. At any
 * time pushed = processed + in_work + waiting + filling + the sum of dropped[].
 *
 * MEMORY. The caller's block and the threads' stacks (of the system's default size). Nothing is allocated after start.
 * A cloud is copied in push, with its inputs; the caller may reuse both when push returns.
 *
 * TIME. push costs one pass over the cloud, in the caller's thread, and two short locks that no thread holds while it
 * works, calls back or writes. The worker never waits for a disk.
 *
 * SILENCE. When the newest frame that was worked is older than watchdog_ns (none came, or the worker is that late), the
 * worker publishes what pose_wall_age says: values age, are held, then invalid. A frame that has waited that long is
 * dropped, for it would look fresh, and one that was worked that late is not told as a frame: silence tells what it
 * measured, with its age (both: drop `late`). While a frame waits, silence is not told twice in a row. A clock that
 * goes back by more than watchdog_ns counts as silence of which nobody knows how long it is: an hour is taken, and all
 * is invalid. How old a frame is when it is pushed, the runtime cannot know: drain what a socket has gathered, and push
 * the newest. Values are held for as long as their levels stay within the alert limits: by default 1 degree at 0.05
 * rad/s and 0.10 m at 0.2 m/s, a third to half a second after a good frame, which is hardly longer than watchdog_ns.
 *
 * FRESHNESS. A worker that hangs, in the engine, in the callback or in the caller's clock, cannot tell silence. So
 * `latest` and `image` look at the runtime's clock themselves, in the thread that calls them. A frame is stale when it
 * was received watchdog_ns ago, silence when it was published watchdog_ns ago, and both when the clock stands more than
 * watchdog_ns before that time. What is stale is refused (POSE_WALL_RUNTIME_E_STALE). It is written all the same, with
 * every value invalid, so that nobody acts on it who forgets the status. `activity` says what the worker is at, and
 * since when: a callback that hangs is told from an engine that does. A healthy worker tells silence every
 * watchdog_every_ns: with one of watchdog_ns or more, silence itself becomes stale between two of its tellings. With
 * watchdog_ns 0 nothing is ever stale: then compare age_ns. A clock that stands still makes everything look fresh.
 *
 * OVERLOAD. When frames come faster than they are worked, frames are dropped. Only if thinning_max allows it, and only
 * when three frames in a row took longer than frame_period_max_ns to work, and some were dropped meanwhile, points are
 * left out: every second return, then three of four, and so on; they come back when twenty in a row took less than
 * three eighths of it. What the callback takes does not count: a slow one costs frames, never points. No threshold is
 * ever loosened. Because gaps in a wall may go unnoticed in a thinned cloud (pose_wall.h, pose_wall_cloud), nothing
 * from one is ever published as better than degraded, and `thinning` says so; where a held value comes from one,
 * `held_thinning` says so. The region is never narrowed: a cropped cloud looks full of holes. What was dropped shows in
 * `frame`, which counts pushes.
 *
 * MOTION. With options.motion = pose_wall_motion_functions_get() and the config's key `motion` on, each frame
 * goes through pose_wall_motion.h first, and its pose into the engine with the frame's own inputs, as
 * pose_wall_motion_process_both does: held values move with the machine. An odometry of the caller's is then not used,
 * for two of them are not comparable. The publication has the motion's result beside the engine's; silence has none.
 * Motion costs a frame nothing but time: what it refuses is worked without it, and a motion that finds its block
 * damaged is opened anew. Each start begins a new map. Dropped frames are a gap in the way, which motion bridges by a
 * wider search; a thinned cloud is worked like any other, and its levels are of what it had. Motion sees what push
 * copied: points that hold no return are not in it.
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
  POSE_WALL_RUNTIME_E_OPTION = -100, /* an option out of its range, or `reserved` not zero: options_check tells which */
  POSE_WALL_RUNTIME_E_HANDLE = -101, /* not an open runtime */
  POSE_WALL_RUNTIME_E_STATE = -102,  /* not in this state: not running, not stopped, or not called back */
  POSE_WALL_RUNTIME_E_THREAD = -103, /* not from the callback or the sink: it would wait for itself */
  POSE_WALL_RUNTIME_E_BUSY = -104,   /* another thread is inside push */
  POSE_WALL_RUNTIME_E_LARGE = -105,  /* more points than cloud_points_max, or wider than point_bytes_max */
  POSE_WALL_RUNTIME_E_NOTHING = -106, /* nothing published since start */
  POSE_WALL_RUNTIME_E_SYSTEM = -107,  /* the system refused a thread, or what `required` asks for */
  POSE_WALL_RUNTIME_E_STALE = -108,   /* what was published last is watchdog_ns old: see FRESHNESS */
  POSE_WALL_RUNTIME_E_MOTION = -109   /* this runtime has no motion: see MOTION */
};
/* One English sentence, static storage; for every status of pose_wall.h too. */
const char* pose_wall_runtime_status_text(int32_t status);

/* ---------------------------------------------------------------------------------------------- publications */

enum pose_wall_runtime_cause {
  POSE_WALL_RUNTIME_FRAME = 1,  /* a frame was worked */
  POSE_WALL_RUNTIME_SILENCE = 2 /* the newest worked frame is older than watchdog_ns: aged values, R_NO_FRAME */
};

/* What the worker is at. One that stays at the same for longer than a frame takes is stuck there. */
enum pose_wall_runtime_activity {
  POSE_WALL_RUNTIME_AT_NOTHING = 0,  /* there is no worker: stopped */
  POSE_WALL_RUNTIME_AT_WAIT = 1,     /* waits for a frame, a tick or the watchdog's time */
  POSE_WALL_RUNTIME_AT_CHOICE = 2,   /* takes the lock, reads the clock, chooses what comes next */
  POSE_WALL_RUNTIME_AT_FRAME = 3,    /* measures a frame: in the engine, or in the clock that it reads meanwhile */
  POSE_WALL_RUNTIME_AT_SILENCE = 4,  /* tells silence: likewise in the engine or in the clock */
  POSE_WALL_RUNTIME_AT_CALLBACK = 5, /* in the callback */
  POSE_WALL_RUNTIME_ACTIVITIES = 6
};
/* "frame"; static storage. */
const char* pose_wall_runtime_activity_name(uint32_t activity);

typedef struct pose_wall_publication {
  uint32_t struct_size;   /* set by the caller of pose_wall_runtime_latest to sizeof */
  uint32_t cause;         /* pose_wall_runtime_cause; 0: nothing was published, see pose_wall_runtime_latest */
  uint32_t thinning;      /* of every so many returns one was used; 1: all. Above 1 no state is better than degraded */
  uint32_t held_thinning; /* the largest thinning of the frames that held values of this result come from; 1: none */
  uint64_t index;         /* counts publications from 0, over all starts */
  uint64_t frame;         /* counts pushes from 0, over all starts; of a silence: the last worked, 0 before any */
  int64_t received_ns;    /* runtime's clock, at the start of that frame's push; before the first frame, of start, or of
                             the load before it */
  int64_t published_ns;   /* runtime's clock */
  int64_t age_ns;         /* now minus received_ns, by the runtime's clock when this was asked for; in the callback,
                             when it was published. Never negative: 0 where the clock went back by no more than
                             watchdog_ns, INT64_MAX where by more, and where nothing was published */
  int64_t activity_since_ns; /* runtime's clock, rounded down to a multiple of 8 ns: since when the worker is at it */
  uint32_t activity;         /* pose_wall_runtime_activity, when this was asked for */
  uint32_t reserved[5];      /* 0 */
  pose_wall_result result;   /* Points that push left out because they hold no return are included in its counts. Its
                                struct_size says how much of it was written */
  uint32_t has_motion;       /* 1: `motion` is of this frame. 0: silence, no motion, or motion_status */
  int32_t motion_status;     /* why a frame has no motion though the runtime has: what motion said of it */
  pose_wall_motion_result motion; /* without has_motion: as pose_wall_motion_blank, and all zero where the runtime has
                                     no motion. points_in includes what push left out */
} pose_wall_publication;

/* Called on the worker's thread after `latest` holds the same. What it takes, the next frame waits for. The pointer is
 * good until it returns. */
typedef void (*pose_wall_runtime_callback)(void* user, const pose_wall_publication* publication);

/* ---------------------------------------------------------------------------------------------- black box */

/* Where the black box is written: `count` bytes at `offset` of a file of at most box_bytes. 0: written. Anything else:
 * not written, the record counts as failed and the next one is tried. It may be as slow as a disk is: only the
 * recorder's thread waits for it; but stop waits for that thread, so a sink that may hang needs a time limit of its
 * own: up to four calls a record, the one that makes it whole last, and the header until it was written. What it does
 * not sync, a loss of power takes. Of a silence that goes on, the first is recorded, then whenever a
 * state or a reason changes, and one a minute. Format and reader: pose_wall_box.h. */
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
  uint32_t queue_frames;     /* 2; 1 to 64 that may wait. More hide longer stalls and make results older */
  uint32_t cloud_points_max; /* 262144; 1 to 2^26 points a cloud may hold, with those that hold no return */
  uint32_t point_bytes_max;  /* 16; 12 to 48: x, y, z of 4 or 8 bytes each, and intensity where intensity_weight > 0.
                                With an odometry, the runtime's or the caller's, time is copied as well where it fits,
                                and then ring for motion: 24 has room for both beside floats, as known drivers write
                                them. Without time nothing takes the scan's own motion out of it */
  uint32_t thinning_max;     /* 1: never leave out a return. 2, 4, 8 or 16: see OVERLOAD */
  uint32_t box_clouds;       /* 1: the black box holds whole clouds. 0: their digests; nothing can be computed again */
  uint32_t box_backlog;      /* 2; 1 to 64 records that may wait for the sink; what comes then is not recorded */
  int32_t worker_priority;   /* 0: as the caller's thread. 1 to 99: SCHED_FIFO. The recorder is never more than usual */
  int32_t worker_cpu;        /* -1: any. Else the worker runs on this processor only, 0 to 1023 */
  uint32_t lock_memory;      /* 0 or 1: mlock the block (not the stacks) */
  uint32_t required;         /* of pose_wall_runtime_wish: what start must be granted; the rest is only reported */
  uint32_t reserved;         /* 0 */
  int64_t
      frame_period_max_ns;   /* 100 ms; 1 ms to 1 h: frames are dropped, not thinned, while none takes longer to work */
  int64_t watchdog_ns;       /* 300 ms; 1 ns to 1 h, 0: never. Silence that long is published, frames that old are not,
                                and what was published so long ago is refused: see FRESHNESS */
  int64_t watchdog_every_ns; /* 100 ms; 1 ms to 1 h: and again so often, until a frame comes. Best below watchdog_ns */
  pose_wall_clock clock;     /* NULL: clock_gettime(CLOCK_MONOTONIC). Called by all threads at once, also
                                under the lock: it must not call the runtime. With a clock of the caller's nothing but
                                pose_wall_runtime_tick wakes the worker for the watchdog */
  void* clock_user;
  pose_wall_runtime_callback callback; /* or NULL */
  void* callback_user;
  pose_wall_runtime_sink sink; /* or NULL: no black box */
  void* sink_user;
  uint64_t box_bytes;  /* 0; of the ring file. With a sink at least what the header and one whole record need: 4288
                          bytes, sizeof(pose_wall_inputs), pose_wall_memento_bytes(), sizeof(pose_wall_result),
                          sizeof(pose_wall_motion_result) and, with box_clouds, cloud_points_max x point_bytes_max,
                          these five rounded up to multiples of 64. Used in multiples of 64 */
  uint64_t reserved_2; /* 0. It tells these options from those of ABI 2 by their size */
  const pose_wall_motion_functions* motion;         /* NULL: no motion. Else kept as it is, not copied */
  const pose_wall_motion_settings* motion_settings; /* NULL: defaults. Copied by open */
} pose_wall_runtime_options;

/* Fills every option with its default (the figure in its comment). Fails iff: NULL. */
int32_t pose_wall_runtime_options_init_3(pose_wall_runtime_options* options);
/* What a program built against ABI 2 calls first: writes nothing, and always gives POSE_WALL_E_ABI. */
int32_t pose_wall_runtime_options_init(pose_wall_runtime_options* options);
#define pose_wall_runtime_options_init pose_wall_runtime_options_init_3

/* Whether memory_needed and open take these options. Fails iff: options NULL, struct_size (as in pose_wall.h, STRUCTS:
 * POSE_WALL_E_STRUCT_SIZE, _ABI or _STRUCT_NEWER; so in all calls below), POSE_WALL_RUNTIME_E_OPTION; only then *option
 * is the name of the first member that is out of its range ("watchdog_ns"; static storage; option may be NULL). */
POSE_WALL_CHECKED int32_t pose_wall_runtime_options_check(const pose_wall_runtime_options* options,
                                                          const char** option);

/* ---------------------------------------------------------------------------------------------- life */

typedef struct pose_wall_runtime pose_wall_runtime;

/* Bytes of the block: the engine's, the motion's where there is one, and (queue_frames + 2, with a sink + box_backlog)
 * frames of cloud_points_max x point_bytes_max bytes. Fails iff: NULL, struct_size, an option, the config (as
 * pose_wall_memory_needed). */
POSE_WALL_CHECKED int32_t pose_wall_runtime_memory_needed(const pose_wall_config* config,
                                                          const pose_wall_runtime_options* options, uint64_t* bytes);

/* Places a runtime in block, which may hold anything, must be aligned to POSE_WALL_BLOCK_ALIGNMENT, stays the caller's
 * and must not move. Starts no thread. Fails as memory_needed, for a block misaligned or too small, and for one in
 * which a runtime was started and not stopped (POSE_WALL_E_BUSY; a block that outlives its process, in shared memory,
 * must be cleared if that died meanwhile). *runtime is set only on success. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_open(const pose_wall_config* config,
                                                 const pose_wall_runtime_options* options, void* block,
                                                 uint64_t block_bytes, pose_wall_runtime** runtime);

/* Starts the threads, with an engine that remembers nothing but what was loaded since the last start, and a black box
 * from its beginning (what the sink wrote before is overwritten, its header at once: give each start a file of its own,
 * or a restart after an incident takes the incident's). Counters go on. Returns when the worker runs. Fails iff: NULL,
 * not open, not stopped, called back, POSE_WALL_RUNTIME_E_SYSTEM, POSE_WALL_E_ENGINE (the block was changed by others,
 * the config in it too: open it anew); then it is stopped. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_start(pose_wall_runtime* runtime);

/* Waits until every frame is worked, every tick looked at and every record written. For tests and for work offline: a
 * frame that is pushed meanwhile is waited for as well. Fails iff: NULL, not open, called back, not running or stopped
 * meanwhile (POSE_WALL_RUNTIME_E_STATE). */
int32_t pose_wall_runtime_wait_idle(pose_wall_runtime* runtime);

/* Asks the worker to end after what it is at; push is refused from now on. Returns at once. Fails iff: NULL, not
 * open, not running. */
int32_t pose_wall_runtime_request_stop(pose_wall_runtime* runtime);

/* Ends the threads and waits for them: for the frame in work, the callback, and the records that wait for the sink.
 * Frames that wait are dropped and counted. Stopped already: nothing happens. Fails iff: NULL, not open,
 * called back. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_stop(pose_wall_runtime* runtime);

/* After this the block is the caller's again. Fails iff: NULL, not open, called back, not stopped, or a push, wait_idle
 * or stop is still inside (POSE_WALL_RUNTIME_E_STATE). Of the other calls none may be made meanwhile. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_close(pose_wall_runtime* runtime);

/* What the engine remembers, as pose_wall_save gives it, for a start after a loss of power: from the callback, where
 * the publication that was called back with is in it, or while the runtime is stopped. Fails iff: NULL, not open,
 * POSE_WALL_RUNTIME_E_STATE (running, and not from the callback), and as pose_wall_save. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_save(pose_wall_runtime* runtime, const pose_wall_moment* now, void* memento,
                                                 uint64_t bytes);

/* Gives the next start, and it alone, what was saved, as old as pose_wall_load takes it to be. Silence before the first
 * frame holds it on from the moment's stamp_ns, which must be that of now, with POSE_WALL_MOMENT_SAME_CLOCK too. Values
 * held from it report thinning_max as held_thinning, because a memento does not store theirs. Fails iff: NULL, not
 * open, called back, not stopped (POSE_WALL_RUNTIME_E_STATE), and as pose_wall_load: then the next start remembers what
 * it would have without this call. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_load(pose_wall_runtime* runtime, const pose_wall_moment* now,
                                                 const void* memento, uint64_t bytes);

/* ---------------------------------------------------------------------------------------------- frames and results */

/* Checks the cloud and its inputs, copies what the engine reads of them, and queues it. Inputs speak of the time since
 * the frame that was pushed before: where that was dropped, only their boxes and their odometry are used. Points that
 * are not finite or exactly zero are left out of the copy (not with intensity_weight > 0, where they count in the mean,
 * nor where times are copied the first and the last of them). What is refused is counted as pushed and dropped, but not
 * NULL, nor when the runtime is not running. Fails iff: NULL, not open, not running or stopped before the copy was done
 * (which is counted), another thread inside push, struct_size or a description that pose_wall_cloud_check refuses,
 * POSE_WALL_RUNTIME_E_LARGE. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_push(pose_wall_runtime* runtime, const pose_wall_cloud* cloud);

/* The newest publication, with its age and what the worker is at. No lock, no wait: one look at the clock and one copy,
 * repeated only if three newer ones were published meanwhile. Set publication->struct_size first. Fails iff: NULL, not
 * open, struct_size, and with the following, which write *publication all the same, with every value invalid:
 * POSE_WALL_RUNTIME_E_STALE (the newest one, aged until now: confidence 0, no raw values, no planes, no counts, levels
 * without a bound, POSE_WALL_R_NO_FRAME), and, as of an engine before its first frame, with cause 0: not running,
 * POSE_WALL_RUNTIME_E_NOTHING, POSE_WALL_E_ENGINE (it was changed by others since; the next publication will be sound).
 */
POSE_WALL_CHECKED int32_t pose_wall_runtime_latest(const pose_wall_runtime* runtime,
                                                   pose_wall_publication* publication);

/* The image of the newest publication for a controller, as pose_wall_image_fill makes it of the result. Set
 * image->struct_size first. Fails as pose_wall_runtime_latest does. Where that writes a publication this writes an
 * image, with a true CRC: what is stale, what was damaged and what is not there gives one with every value and the
 * verdict invalid. So it may be passed on whatever the status, as long as struct_size and handle are good. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_image(const pose_wall_runtime* runtime, pose_wall_image* image);

/* Image 2 of the same, likewise. Its publication is index + 1, and 0 where nothing was published; its latency is
 * published_ns minus received_ns, so for silence the age of what it tells of. It has told_by, thinning and
 * held_thinning of the publication. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_image2(const pose_wall_runtime* runtime, pose_wall_image2* image);

/* The motion image (pose_wall_motion.h) of the same, likewise: of silence and of what is stale without a value, and
 * with the run 0. Fails also iff: POSE_WALL_RUNTIME_E_MOTION; the image is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_motion_image(const pose_wall_runtime* runtime,
                                                         pose_wall_motion_image* image);

/* What became of the points of the frame that the callback is called back with, as pose_wall_last_points tells it:
 * for pictures and logs. The pointers are good until the callback returns; of a silence they are the last worked
 * frame's. Only from the callback. Fails iff: NULL, not open, POSE_WALL_RUNTIME_E_STATE (not from the callback), and as
 * pose_wall_last_points. */
POSE_WALL_CHECKED int32_t pose_wall_runtime_last_points(const pose_wall_runtime* runtime, pose_wall_points* points);

/* Has the worker look at its clock. Fails iff: NULL, not open, not running. */
int32_t pose_wall_runtime_tick(pose_wall_runtime* runtime);

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
  uint64_t box_failed;   /* the sink said so: records, and the header at the start */
  uint64_t box_bytes_written;
  int32_t priority_error; /* of the last start: 0 granted or not asked for, else errno */
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

/* A consistent picture of the counters; the times are read beside them without a lock. Set struct_size first. Fails
 * iff: NULL, not open, struct_size. */
int32_t pose_wall_runtime_statistics_now(const pose_wall_runtime* runtime, pose_wall_runtime_statistics* statistics);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_RUNTIME_H */
