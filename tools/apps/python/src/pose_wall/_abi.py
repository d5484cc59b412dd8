# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The C ABI as ctypes sees it. Written by tools/apps/python/generate.py from the headers; edit those."""

from ctypes import (CFUNCTYPE, POINTER, Structure, c_char, c_char_p, c_double, c_float, c_int32,
                    c_int64, c_uint8, c_uint32, c_uint64, c_void_p)
from enum import IntEnum, IntFlag

POSE_WALL_VERSION_MAJOR = 0
POSE_WALL_VERSION_MINOR = 2
POSE_WALL_VERSION_PATCH = 0
POSE_WALL_ABI_VERSION = 2
POSE_WALL_TEXT_MAX = 64
POSE_WALL_CONFIG_NUMBERS = 160
POSE_WALL_CONFIG_TEXTS = 3
POSE_WALL_INPUT_BOXES = 4
POSE_WALL_ODOMETRY_DIRECTIONS = 6
POSE_WALL_REASON_COUNT = 31
POSE_WALL_BLOCK_ALIGNMENT = 64
POSE_WALL_SELF_TEST_FRAMES = 4
POSE_WALL_SELF_TEST_POINTS = 19200
POSE_WALL_IMAGE_VERSION = 1
POSE_WALL_IMAGE2_VERSION = 2
POSE_WALL_IMAGE_NO_VALUE = -2147483648
POSE_WALL_IMAGE_NO_BOUND = 2147483647
POSE_WALL_IMAGE_BYTES = 240
POSE_WALL_IMAGE2_BYTES = 248
POSE_WALL_QUANTITIES = 7
POSE_WALL_PARTS = 7
POSE_WALL_STAGES = 6
POSE_WALL_MOTION_ABI_VERSION = 1
POSE_WALL_MOTION_REASON_COUNT = 14
POSE_WALL_MOTION_BLOCK_MOST = 6291456
POSE_WALL_MOTION_IMAGE_VERSION = 3
POSE_WALL_MOTION_IMAGE_BYTES = 132
POSE_WALL_MOTION_DIRECTIONS = 6
POSE_WALL_RUNTIME_ABI_VERSION = 3
POSE_WALL_RUNTIME_ACTIVITIES = 6
POSE_WALL_RUNTIME_DROPS = 7


class Status(IntEnum):
    OK = 0
    NULL = -1
    STRUCT_SIZE = -2
    BLOCK_SMALL = -3
    BLOCK_ALIGN = -4
    ENGINE = -5
    INDEX = -6
    BUFFER_SMALL = -7
    MEMENTO = -8
    BUSY = -9
    ABI = -10
    STRUCT_NEWER = -11
    INPUT = -12
    KEY_UNKNOWN = -20
    VALUE_TYPE = -21
    VALUE_RANGE = -22
    CONFIG_RULE = -23
    TEXT_LONG = -24
    CLOUD_FIELD = -40
    CLOUD_STEP = -41
    CLOUD_SIZE = -42
    IMAGE_VERSION = -60
    IMAGE_CRC = -61
    RESULT = -62
    SELF_TEST = -80
    RUNTIME_OPTION = -100
    RUNTIME_HANDLE = -101
    RUNTIME_STATE = -102
    RUNTIME_THREAD = -103
    RUNTIME_BUSY = -104
    RUNTIME_LARGE = -105
    RUNTIME_NOTHING = -106
    RUNTIME_SYSTEM = -107
    RUNTIME_STALE = -108
    RUNTIME_MOTION = -109


class KeyType(IntEnum):
    NUMBER = 1
    INTEGER = 2
    CHOICE = 3
    TEXT = 4
    BOX = 5


class FieldType(IntEnum):
    NONE = 0
    INT8 = 1
    UINT8 = 2
    INT16 = 3
    UINT16 = 4
    INT32 = 5
    UINT32 = 6
    FLOAT32 = 7
    FLOAT64 = 8


class Input(IntFlag):
    STANDING = 1
    SPEED = 2
    TURN_RATE = 4
    ODOMETRY = 8


class Quantity(IntEnum):
    ROLL = 0
    PITCH = 1
    YAW = 2
    D_LF = 3
    D_LB = 4
    D_RF = 5
    D_RB = 6


class State(IntEnum):
    INVALID = 0
    HELD = 1
    DEGRADED = 2
    VALID = 3


class Reason(IntFlag):
    NO_POINTS = 1
    LEAF_GROWN = 2
    STAMP_STILL = 4
    STAMP_BACK = 8
    STAMP_LEAP = 16
    FROZEN = 32
    FLOOR_NOT_FOUND = 64
    FLOOR_FEW_INLIERS = 128
    FLOOR_THIN = 256
    FLOOR_AMBIGUOUS = 512
    WALL_NOT_FOUND = 1024
    WALL_FEW_INLIERS = 2048
    WALL_SHORT = 4096
    WALL_LEANS = 8192
    WALL_SEEN_THROUGH = 16384
    WALL_AMBIGUOUS = 32768
    WALLS_NOT_PARALLEL = 65536
    YAW_OUT_OF_RANGE = 131072
    CROSS_ROAD = 262144
    CURVED = 524288
    EXTRAPOLATED = 1048576
    LEVEL_MISSING = 2097152
    ALERT_LIMIT = 4194304
    INNOVATION = 8388608
    RATE_LIMITED = 16777216
    HOLD_EXPIRED = 33554432
    WALL_TOO_NEAR = 67108864
    NEVER_MEASURED = 134217728
    NO_FRAME = 268435456
    WORK_LIMIT = 536870912
    PRIOR = 1073741824


class Part(IntEnum):
    RANDOM = 0
    RANGE_BIAS = 1
    BEND = 2
    RIVAL = 3
    EXTRAPOLATION = 4
    LAG = 5
    AGE = 6


class Stage(IntEnum):
    VOXEL = 0
    OUTLIERS = 1
    FLOOR = 2
    BAND = 3
    WALLS = 4
    OUTPUT = 5


class Sense(IntEnum):
    UNKNOWN = 0
    RIGHT_DOWN = 1
    LEFT_DOWN = 2
    NOSE_DOWN = 3
    NOSE_UP = 4
    TURNED_RIGHT = 5


class MomentKnown(IntFlag):
    BOOT = 1
    WALL = 2
    SAME_CLOCK = 4


class Label(IntEnum):
    OTHER = 0
    FLOOR = 1
    LEFT = 2
    RIGHT = 3


class AlongState(IntEnum):
    LOST = 0
    UNOBSERVABLE = 1
    AMBIGUOUS = 2
    MEASURED = 3


class MotionReason(IntFlag):
    FIRST = 1
    FEW_POINTS = 2
    FEW_MATCHES = 4
    SMOOTH = 8
    FEW_PATCHES = 16
    HALVES_DIFFER = 32
    SECOND_PEAK = 64
    AT_EDGE = 128
    NO_GROUND = 256
    STAMP = 512
    GAP = 1024
    PRIOR = 2048
    MAP_FULL = 4096
    REPEATED = 8192


class MotionDirection(IntEnum):
    ALONG = 0
    ACROSS = 1
    UP = 2
    ROLL = 3
    PITCH = 4
    YAW = 5


class Cause(IntEnum):
    FRAME = 1
    SILENCE = 2


class Activity(IntEnum):
    NOTHING = 0
    WAIT = 1
    CHOICE = 2
    FRAME = 3
    SILENCE = 4
    CALLBACK = 5


class Wish(IntFlag):
    PRIORITY = 1
    AFFINITY = 2
    LOCK = 4


class RuntimeState(IntEnum):
    STOPPED = 0
    STARTING = 1
    RUNNING = 2
    STOPPING = 3


class Drop(IntEnum):
    DESCRIPTION = 0
    LARGE = 1
    BUSY = 2
    OVERTAKEN = 3
    STOPPED = 4
    ENGINE = 5
    LATE = 6


class pose_wall_config(Structure):
    pass


class pose_wall_key_info(Structure):
    pass


class pose_wall_rule_fault(Structure):
    pass


class pose_wall_field(Structure):
    pass


class pose_wall_cloud(Structure):
    pass


class pose_wall_odometry(Structure):
    pass


class pose_wall_inputs(Structure):
    pass


class pose_wall_value(Structure):
    pass


class pose_wall_plane(Structure):
    pass


class pose_wall_result(Structure):
    pass


class pose_wall_moment(Structure):
    pass


class pose_wall_points(Structure):
    pass


class pose_wall_self_test_report(Structure):
    pass


class pose_wall_image_angle(Structure):
    pass


class pose_wall_image_distance(Structure):
    pass


class pose_wall_image(Structure):
    pass


class pose_wall_image2_angle(Structure):
    pass


class pose_wall_image2_distance(Structure):
    pass


class pose_wall_image2(Structure):
    pass


class pose_wall_image_source(Structure):
    pass


class pose_wall_motion_settings(Structure):
    pass


class pose_wall_motion_fault(Structure):
    pass


class pose_wall_motion_result(Structure):
    pass


class pose_wall_motion_image(Structure):
    pass


class pose_wall_publication(Structure):
    pass


class pose_wall_runtime_options(Structure):
    pass


class pose_wall_runtime_times(Structure):
    pass


class pose_wall_runtime_statistics(Structure):
    pass


pose_wall_clock = CFUNCTYPE(c_int64, c_void_p)
pose_wall_runtime_callback = CFUNCTYPE(None, c_void_p, POINTER(pose_wall_publication))
pose_wall_runtime_sink = CFUNCTYPE(c_int32, c_void_p, c_uint64, c_void_p, c_uint64)

pose_wall_config._fields_ = [
    ("struct_size", c_uint32),
    ("layout", c_uint32),
    ("number", c_double * 160),
    ("text", (c_char * 64) * 3),
]

pose_wall_key_info._fields_ = [
    ("name", c_char_p),
    ("unit", c_char_p),
    ("choices", c_char_p),
    ("default_text", c_char_p),
    ("group", c_char_p),
    ("help", c_char_p),
    ("minimum", c_double),
    ("maximum", c_double),
    ("type", c_uint32),
    ("reserved", c_uint32),
]

pose_wall_rule_fault._fields_ = [
    ("key", c_char_p),
    ("other_key", c_char_p),
    ("rule", c_char_p),
]

pose_wall_field._fields_ = [
    ("offset", c_uint32),
    ("type", c_uint32),
]

pose_wall_cloud._fields_ = [
    ("struct_size", c_uint32),
    ("big_endian", c_uint32),
    ("data", c_void_p),
    ("data_bytes", c_uint64),
    ("width", c_uint32),
    ("height", c_uint32),
    ("point_step", c_uint32),
    ("row_step", c_uint32),
    ("stamp_ns", c_int64),
    ("x", pose_wall_field),
    ("y", pose_wall_field),
    ("z", pose_wall_field),
    ("intensity", pose_wall_field),
    ("time", pose_wall_field),
    ("inputs", POINTER(pose_wall_inputs)),
    ("ring", pose_wall_field),
]

pose_wall_odometry._fields_ = [
    ("run", c_uint64),
    ("position_m", c_double * 3),
    ("quaternion", c_double * 4),
    ("along", c_double * 3),
    ("across", c_double * 3),
    ("level", c_double * 6),
    ("drift_variance", c_double * 6),
    ("drift", c_double * 6),
    ("velocity_m_s", c_double * 3),
    ("turn_rate_rad_s", c_double * 3),
    ("rate_level", c_double * 6),
]

pose_wall_inputs._fields_ = [
    ("struct_size", c_uint32),
    ("given", c_uint32),
    ("speed_m_s", c_double),
    ("speed_sigma_m_s", c_double),
    ("turn_rate_rad_s", c_double),
    ("turn_rate_sigma_rad_s", c_double),
    ("body_box", (c_double * 6) * 4),
    ("odometry", pose_wall_odometry),
]

pose_wall_value._fields_ = [
    ("value", c_double),
    ("raw", c_double),
    ("sigma", c_double),
    ("protection_level", c_double),
    ("raw_protection_level", c_double),
    ("confidence", c_double),
    ("age_s", c_double),
    ("part", c_double * 7),
    ("state", c_uint32),
    ("reasons", c_uint32),
    ("raw_state", c_uint32),
    ("cause", c_uint32),
    ("reserved", c_uint32 * 2),
]

pose_wall_plane._fields_ = [
    ("normal", c_double * 3),
    ("d_m", c_double),
    ("rms_m", c_double),
    ("lean_rad", c_double),
    ("extent_min_m", c_double),
    ("extent_max_m", c_double),
    ("area_m2", c_double),
    ("found", c_uint32),
    ("inliers", c_uint32),
    ("iterations", c_uint32),
    ("reasons", c_uint32),
]

pose_wall_result._fields_ = [
    ("struct_size", c_uint32),
    ("frame_reasons", c_uint32),
    ("mark", c_uint32),
    ("config_crc32", c_uint32),
    ("source_id", c_uint32),
    ("positive_means", c_uint32 * 3),
    ("publication", c_uint64),
    ("work", c_uint64),
    ("stamp_ns", c_int64),
    ("frame_index", c_uint64),
    ("confidence", c_double),
    ("quantity", pose_wall_value * 7),
    ("floor", pose_wall_plane),
    ("left", pose_wall_plane),
    ("right", pose_wall_plane),
    ("R_level_base", c_double * 9),
    ("left_right_yaw_difference_rad", c_double),
    ("voxel_leaf_m", c_double),
    ("stage_ns", c_int64 * 6),
    ("points_in", c_uint32),
    ("dropped_not_finite", c_uint32),
    ("dropped_zero", c_uint32),
    ("dropped_near", c_uint32),
    ("dropped_far", c_uint32),
    ("dropped_body", c_uint32),
    ("voxels", c_uint32),
    ("outliers", c_uint32),
    ("open_points", c_uint32),
    ("wall_points", c_uint32),
]

pose_wall_moment._fields_ = [
    ("struct_size", c_uint32),
    ("known", c_uint32),
    ("boot_id", c_uint8 * 16),
    ("wall_ns", c_int64),
    ("stamp_ns", c_int64),
]

pose_wall_points._fields_ = [
    ("x_base_m", POINTER(c_float)),
    ("y_base_m", POINTER(c_float)),
    ("z_base_m", POINTER(c_float)),
    ("label", POINTER(c_uint8)),
    ("count", c_uint32),
    ("reserved", c_uint32),
]

pose_wall_self_test_report._fields_ = [
    ("struct_size", c_uint32),
    ("frames", c_uint32),
    ("digest_expected", c_uint64),
    ("digest_found", c_uint64),
    ("code_bytes", c_uint64),
    ("code_crc32", c_uint32),
    ("values_wrong", c_uint32),
    ("refused", c_int32),
    ("reserved", c_uint32),
]

pose_wall_image_angle._fields_ = [
    ("value_mdeg", c_int32),
    ("protection_mdeg", c_int32),
    ("value_rad", c_float),
    ("protection_rad", c_float),
    ("age_ms", c_uint32),
    ("state", c_uint32),
    ("reasons", c_uint32),
]

pose_wall_image_distance._fields_ = [
    ("value_mm", c_int32),
    ("protection_mm", c_int32),
    ("value_m", c_float),
    ("protection_m", c_float),
    ("age_ms", c_uint32),
    ("state", c_uint32),
    ("reasons", c_uint32),
]

pose_wall_image._fields_ = [
    ("struct_size", c_uint32),
    ("version", c_uint32),
    ("crc32", c_uint32),
    ("sequence", c_uint32),
    ("config_crc32", c_uint32),
    ("library_version", c_uint32),
    ("stamp_low", c_uint32),
    ("stamp_high", c_uint32),
    ("verdict", c_uint32),
    ("valid", c_uint32),
    ("frame_reasons", c_uint32),
    ("roll", pose_wall_image_angle),
    ("pitch", pose_wall_image_angle),
    ("yaw", pose_wall_image_angle),
    ("d_lf", pose_wall_image_distance),
    ("d_lb", pose_wall_image_distance),
    ("d_rf", pose_wall_image_distance),
    ("d_rb", pose_wall_image_distance),
]

pose_wall_image2_angle._fields_ = [
    ("value_mdeg", c_int32),
    ("protection_mdeg", c_int32),
    ("age_ms", c_uint32),
    ("state", c_uint32),
    ("reasons", c_uint32),
    ("cause", c_uint32),
    ("positive_means", c_uint32),
]

pose_wall_image2_distance._fields_ = [
    ("value_mm", c_int32),
    ("protection_mm", c_int32),
    ("age_ms", c_uint32),
    ("state", c_uint32),
    ("reasons", c_uint32),
    ("cause", c_uint32),
]

pose_wall_image2._fields_ = [
    ("struct_size", c_uint32),
    ("version", c_uint32),
    ("crc32c", c_uint32),
    ("sequence", c_uint32),
    ("publication", c_uint32),
    ("config_crc32", c_uint32),
    ("library_version", c_uint32),
    ("stamp_low", c_uint32),
    ("stamp_high", c_uint32),
    ("source_id", c_uint32),
    ("latency_ms", c_uint32),
    ("thinning", c_uint32),
    ("held_thinning", c_uint32),
    ("told_by", c_uint32),
    ("verdict", c_uint32),
    ("valid", c_uint32),
    ("frame_reasons", c_uint32),
    ("roll", pose_wall_image2_angle),
    ("pitch", pose_wall_image2_angle),
    ("yaw", pose_wall_image2_angle),
    ("d_lf", pose_wall_image2_distance),
    ("d_lb", pose_wall_image2_distance),
    ("d_rf", pose_wall_image2_distance),
    ("d_rb", pose_wall_image2_distance),
]

pose_wall_image_source._fields_ = [
    ("struct_size", c_uint32),
    ("cause", c_uint32),
    ("thinning", c_uint32),
    ("held_thinning", c_uint32),
    ("publication", c_uint64),
    ("latency_ns", c_int64),
]

pose_wall_motion_settings._fields_ = [
    ("struct_size", c_uint32),
    ("reserved", c_uint32),
    ("speed_max_m_s", c_double),
    ("turn_max_rad_s", c_double),
    ("range_max_m", c_double),
    ("keyframe_m", c_double),
]

pose_wall_motion_fault._fields_ = [
    ("member", c_char_p),
    ("rule", c_char_p),
]

pose_wall_motion_result._fields_ = [
    ("struct_size", c_uint32),
    ("along_state", c_uint32),
    ("reasons", c_uint32),
    ("mark", c_uint32),
    ("stamp_ns", c_int64),
    ("frame_index", c_uint64),
    ("position_m", c_double * 3),
    ("quaternion", c_double * 4),
    ("sigma", c_double * 6),
    ("protection_level", c_double * 6),
    ("road_axis", c_double * 3),
    ("along_m", c_double),
    ("step_m", c_double * 3),
    ("step_rad", c_double * 3),
    ("step_s", c_double),
    ("step_sigma", c_double * 6),
    ("step_protection_level", c_double * 6),
    ("contrast", c_double),
    ("patches", c_double),
    ("halves_m", c_double),
    ("second_m", c_double),
    ("second_gain", c_double),
    ("points_in", c_uint32),
    ("points_used", c_uint32),
    ("ground_points", c_uint32),
    ("clusters", c_uint32),
    ("edge_points", c_uint32),
    ("plane_points", c_uint32),
    ("matched", c_uint32),
    ("tiles", c_uint32),
    ("keyframes", c_uint32),
    ("wide_start", c_uint32),
    ("run", c_uint64),
    ("config_crc32", c_uint32),
    ("source_id", c_uint32),
]

pose_wall_motion_image._fields_ = [
    ("struct_size", c_uint32),
    ("version", c_uint32),
    ("crc32c", c_uint32),
    ("sequence", c_uint32),
    ("publication", c_uint32),
    ("run", c_uint32),
    ("config_crc32", c_uint32),
    ("library_version", c_uint32),
    ("stamp_low", c_uint32),
    ("stamp_high", c_uint32),
    ("source_id", c_uint32),
    ("latency_ms", c_uint32),
    ("thinning", c_uint32),
    ("told_by", c_uint32),
    ("along_state", c_uint32),
    ("reasons", c_uint32),
    ("travel_mm", c_int32),
    ("travel_protection_mm", c_int32),
    ("x_mm", c_int32),
    ("y_mm", c_int32),
    ("z_mm", c_int32),
    ("across_protection_mm", c_int32),
    ("up_protection_mm", c_int32),
    ("roll_mdeg", c_int32),
    ("pitch_mdeg", c_int32),
    ("yaw_mdeg", c_int32),
    ("roll_protection_mdeg", c_int32),
    ("pitch_protection_mdeg", c_int32),
    ("yaw_protection_mdeg", c_int32),
    ("speed_mm_s", c_int32),
    ("speed_protection_mm_s", c_int32),
    ("turn_mdeg_s", c_int32),
    ("turn_protection_mdeg_s", c_int32),
]

pose_wall_publication._fields_ = [
    ("struct_size", c_uint32),
    ("cause", c_uint32),
    ("thinning", c_uint32),
    ("held_thinning", c_uint32),
    ("index", c_uint64),
    ("frame", c_uint64),
    ("received_ns", c_int64),
    ("published_ns", c_int64),
    ("age_ns", c_int64),
    ("activity_since_ns", c_int64),
    ("activity", c_uint32),
    ("reserved", c_uint32 * 5),
    ("result", pose_wall_result),
    ("has_motion", c_uint32),
    ("motion_status", c_int32),
    ("motion", pose_wall_motion_result),
    ("odometry", pose_wall_odometry),
]

pose_wall_runtime_options._fields_ = [
    ("struct_size", c_uint32),
    ("queue_frames", c_uint32),
    ("cloud_points_max", c_uint32),
    ("point_bytes_max", c_uint32),
    ("thinning_max", c_uint32),
    ("box_clouds", c_uint32),
    ("box_backlog", c_uint32),
    ("worker_priority", c_int32),
    ("worker_cpu", c_int32),
    ("lock_memory", c_uint32),
    ("required", c_uint32),
    ("reserved", c_uint32),
    ("frame_period_max_ns", c_int64),
    ("watchdog_ns", c_int64),
    ("watchdog_every_ns", c_int64),
    ("clock", pose_wall_clock),
    ("clock_user", c_void_p),
    ("callback", pose_wall_runtime_callback),
    ("callback_user", c_void_p),
    ("sink", pose_wall_runtime_sink),
    ("sink_user", c_void_p),
    ("box_bytes", c_uint64),
    ("reserved_2", c_uint64),
    ("motion", c_void_p),
    ("motion_settings", POINTER(pose_wall_motion_settings)),
]

pose_wall_runtime_times._fields_ = [
    ("count", c_uint64),
    ("p50_ns", c_int64),
    ("p99_ns", c_int64),
    ("p999_ns", c_int64),
    ("worst_ns", c_int64),
]

pose_wall_runtime_statistics._fields_ = [
    ("struct_size", c_uint32),
    ("state", c_uint32),
    ("pushed", c_uint64),
    ("processed", c_uint64),
    ("dropped", c_uint64 * 7),
    ("filling", c_uint32),
    ("waiting", c_uint32),
    ("in_work", c_uint32),
    ("waiting_worst", c_uint32),
    ("published", c_uint64),
    ("silences", c_uint64),
    ("thinned", c_uint64),
    ("thinning", c_uint32),
    ("thinning_worst", c_uint32),
    ("activity", c_uint32),
    ("reserved", c_uint32),
    ("activity_since_ns", c_int64),
    ("newest_age_ns", c_int64),
    ("box_written", c_uint64),
    ("box_lost", c_uint64),
    ("box_failed", c_uint64),
    ("box_bytes_written", c_uint64),
    ("priority_error", c_int32),
    ("affinity_error", c_int32),
    ("lock_error", c_int32),
    ("thread_error", c_int32),
    ("push", pose_wall_runtime_times),
    ("wait", pose_wall_runtime_times),
    ("work", pose_wall_runtime_times),
    ("latency", pose_wall_runtime_times),
    ("callback", pose_wall_runtime_times),
    ("sink", pose_wall_runtime_times),
    ("stage", pose_wall_runtime_times * 6),
    ("motion_refused", c_uint64),
    ("motion", pose_wall_runtime_times),
]

# Structs by their names in C, and functions: what each gives and takes.
STRUCTS = {
    "pose_wall_config": pose_wall_config,
    "pose_wall_key_info": pose_wall_key_info,
    "pose_wall_rule_fault": pose_wall_rule_fault,
    "pose_wall_field": pose_wall_field,
    "pose_wall_cloud": pose_wall_cloud,
    "pose_wall_odometry": pose_wall_odometry,
    "pose_wall_inputs": pose_wall_inputs,
    "pose_wall_value": pose_wall_value,
    "pose_wall_plane": pose_wall_plane,
    "pose_wall_result": pose_wall_result,
    "pose_wall_moment": pose_wall_moment,
    "pose_wall_points": pose_wall_points,
    "pose_wall_self_test_report": pose_wall_self_test_report,
    "pose_wall_image_angle": pose_wall_image_angle,
    "pose_wall_image_distance": pose_wall_image_distance,
    "pose_wall_image": pose_wall_image,
    "pose_wall_image2_angle": pose_wall_image2_angle,
    "pose_wall_image2_distance": pose_wall_image2_distance,
    "pose_wall_image2": pose_wall_image2,
    "pose_wall_image_source": pose_wall_image_source,
    "pose_wall_motion_settings": pose_wall_motion_settings,
    "pose_wall_motion_fault": pose_wall_motion_fault,
    "pose_wall_motion_result": pose_wall_motion_result,
    "pose_wall_motion_image": pose_wall_motion_image,
    "pose_wall_publication": pose_wall_publication,
    "pose_wall_runtime_options": pose_wall_runtime_options,
    "pose_wall_runtime_times": pose_wall_runtime_times,
    "pose_wall_runtime_statistics": pose_wall_runtime_statistics,
}
FUNCTIONS = {
    "pose_wall_version": (c_char_p, ()),
    "pose_wall_abi_version": (c_uint32, ()),
    "pose_wall_status_text": (c_char_p, (c_int32,)),
    "pose_wall_config_init_2": (c_int32, (POINTER(pose_wall_config),)),
    "pose_wall_config_init": (c_int32, (POINTER(pose_wall_config),)),
    "pose_wall_config_set": (c_int32, (POINTER(pose_wall_config), c_char_p, c_char_p)),
    "pose_wall_config_set_number": (c_int32, (POINTER(pose_wall_config), c_char_p, c_double)),
    "pose_wall_config_get_number": (c_int32, (POINTER(pose_wall_config), c_char_p, POINTER(c_double))),
    "pose_wall_config_get_box": (c_int32, (POINTER(pose_wall_config), c_char_p, POINTER(c_double))),
    "pose_wall_config_get_text": (c_int32, (POINTER(pose_wall_config), c_char_p, c_char_p, c_uint64)),
    "pose_wall_config_key_count": (c_uint32, ()),
    "pose_wall_config_key": (c_int32, (c_uint32, POINTER(pose_wall_key_info))),
    "pose_wall_config_check": (c_int32, (POINTER(pose_wall_config), POINTER(pose_wall_rule_fault))),
    "pose_wall_config_crc": (c_int32, (POINTER(pose_wall_config), POINTER(c_uint32))),
    "pose_wall_cloud_xyz32_3": (c_int32, (POINTER(pose_wall_cloud), c_void_p, c_uint32, c_uint32, c_int64)),
    "pose_wall_cloud_xyz32_2": (c_int32, (POINTER(pose_wall_cloud), c_void_p, c_uint32, c_uint32, c_int64)),
    "pose_wall_cloud_xyz32": (c_int32, (POINTER(pose_wall_cloud), c_void_p, c_uint32, c_uint32, c_int64)),
    "pose_wall_cloud_check": (c_int32, (POINTER(pose_wall_cloud),)),
    "pose_wall_reason_name": (c_char_p, (c_uint32,)),
    "pose_wall_reason_text": (c_char_p, (c_uint32,)),
    "pose_wall_state_name": (c_char_p, (c_uint32,)),
    "pose_wall_quantity_name": (c_char_p, (c_uint32,)),
    "pose_wall_part_name": (c_char_p, (c_uint32,)),
    "pose_wall_stage_name": (c_char_p, (c_uint32,)),
    "pose_wall_sense_name": (c_char_p, (c_uint32,)),
    "pose_wall_memory_needed": (c_int32, (POINTER(pose_wall_config), POINTER(c_uint64))),
    "pose_wall_open": (c_int32, (POINTER(pose_wall_config), c_void_p, c_uint64, POINTER(c_void_p))),
    "pose_wall_reset": (c_int32, (c_void_p,)),
    "pose_wall_set_clock": (c_int32, (c_void_p, pose_wall_clock, c_void_p)),
    "pose_wall_process": (c_int32, (c_void_p, POINTER(pose_wall_cloud), POINTER(pose_wall_result))),
    "pose_wall_age": (c_int32, (c_void_p, c_int64, POINTER(pose_wall_result))),
    "pose_wall_memento_bytes": (c_uint64, ()),
    "pose_wall_save": (c_int32, (c_void_p, POINTER(pose_wall_moment), c_void_p, c_uint64)),
    "pose_wall_load": (c_int32, (c_void_p, POINTER(pose_wall_moment), c_void_p, c_uint64)),
    "pose_wall_last_points": (c_int32, (c_void_p, POINTER(pose_wall_points))),
    "pose_wall_self_test_bytes": (c_uint64, ()),
    "pose_wall_self_test": (c_int32, (c_void_p, c_uint64, POINTER(pose_wall_self_test_report))),
    "pose_wall_image_fill": (c_int32, (POINTER(pose_wall_result), POINTER(pose_wall_image))),
    "pose_wall_image_check": (c_int32, (POINTER(pose_wall_image),)),
    "pose_wall_image2_fill": (c_int32, (POINTER(pose_wall_result), POINTER(pose_wall_image_source),
        POINTER(pose_wall_image2))),
    "pose_wall_image2_check": (c_int32, (POINTER(pose_wall_image2),)),
    "pose_wall_motion_abi_version": (c_uint32, ()),
    "pose_wall_motion_settings_init": (c_int32, (POINTER(pose_wall_motion_settings),)),
    "pose_wall_motion_settings_check": (c_int32, (POINTER(pose_wall_motion_settings),
        POINTER(pose_wall_motion_fault))),
    "pose_wall_motion_along_state_name": (c_char_p, (c_uint32,)),
    "pose_wall_motion_reason_name": (c_char_p, (c_uint32,)),
    "pose_wall_motion_reason_text": (c_char_p, (c_uint32,)),
    "pose_wall_motion_direction_name": (c_char_p, (c_uint32,)),
    "pose_wall_motion_memory_needed": (c_uint64, ()),
    "pose_wall_motion_open": (c_int32, (POINTER(pose_wall_config), POINTER(pose_wall_motion_settings), c_void_p,
        c_uint64, POINTER(c_void_p))),
    "pose_wall_motion_reset": (c_int32, (c_void_p,)),
    "pose_wall_motion_process": (c_int32, (c_void_p, POINTER(pose_wall_cloud), POINTER(pose_wall_motion_result))),
    "pose_wall_motion_give": (c_int32, (c_void_p, POINTER(pose_wall_inputs))),
    "pose_wall_motion_process_both": (c_int32, (c_void_p, c_void_p, POINTER(pose_wall_cloud),
        POINTER(pose_wall_motion_result), POINTER(pose_wall_result))),
    "pose_wall_motion_blank": (c_int32, (c_void_p, POINTER(pose_wall_motion_result))),
    "pose_wall_motion_image_fill": (c_int32, (POINTER(pose_wall_motion_result), POINTER(pose_wall_image_source),
        POINTER(pose_wall_motion_image))),
    "pose_wall_motion_image_check": (c_int32, (POINTER(pose_wall_motion_image),)),
    "pose_wall_motion_map": (c_int32, (c_void_p, c_uint32, POINTER(c_float), c_uint32, POINTER(c_uint32))),
    "pose_wall_motion_functions_get": (c_void_p, ()),
    "pose_wall_runtime_abi_version": (c_uint32, ()),
    "pose_wall_runtime_status_text": (c_char_p, (c_int32,)),
    "pose_wall_runtime_activity_name": (c_char_p, (c_uint32,)),
    "pose_wall_runtime_options_init_3": (c_int32, (POINTER(pose_wall_runtime_options),)),
    "pose_wall_runtime_options_init": (c_int32, (POINTER(pose_wall_runtime_options),)),
    "pose_wall_runtime_options_check": (c_int32, (POINTER(pose_wall_runtime_options), POINTER(c_char_p))),
    "pose_wall_runtime_memory_needed": (c_int32, (POINTER(pose_wall_config), POINTER(pose_wall_runtime_options),
        POINTER(c_uint64))),
    "pose_wall_runtime_open": (c_int32, (POINTER(pose_wall_config), POINTER(pose_wall_runtime_options), c_void_p,
        c_uint64, POINTER(c_void_p))),
    "pose_wall_runtime_start": (c_int32, (c_void_p,)),
    "pose_wall_runtime_wait_idle": (c_int32, (c_void_p,)),
    "pose_wall_runtime_request_stop": (c_int32, (c_void_p,)),
    "pose_wall_runtime_stop": (c_int32, (c_void_p,)),
    "pose_wall_runtime_close": (c_int32, (c_void_p,)),
    "pose_wall_runtime_save": (c_int32, (c_void_p, POINTER(pose_wall_moment), c_void_p, c_uint64)),
    "pose_wall_runtime_load": (c_int32, (c_void_p, POINTER(pose_wall_moment), c_void_p, c_uint64)),
    "pose_wall_runtime_push": (c_int32, (c_void_p, POINTER(pose_wall_cloud))),
    "pose_wall_runtime_latest": (c_int32, (c_void_p, POINTER(pose_wall_publication))),
    "pose_wall_runtime_image": (c_int32, (c_void_p, POINTER(pose_wall_image))),
    "pose_wall_runtime_image2": (c_int32, (c_void_p, POINTER(pose_wall_image2))),
    "pose_wall_runtime_motion_image": (c_int32, (c_void_p, POINTER(pose_wall_motion_image))),
    "pose_wall_runtime_last_points": (c_int32, (c_void_p, POINTER(pose_wall_points))),
    "pose_wall_runtime_tick": (c_int32, (c_void_p,)),
    "pose_wall_runtime_drop_name": (c_char_p, (c_uint32,)),
    "pose_wall_runtime_statistics_now": (c_int32, (c_void_p, POINTER(pose_wall_runtime_statistics))),
}
# What a name of the header stands for.
RENAMED = {
    "pose_wall_config_init": "pose_wall_config_init_2",
    "pose_wall_cloud_xyz32": "pose_wall_cloud_xyz32_3",
    "pose_wall_runtime_options_init": "pose_wall_runtime_options_init_3",
}
