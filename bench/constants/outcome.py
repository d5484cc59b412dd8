# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What another value of a constant does to the values of a campaign: two tables frames.csv side by side."""

import csv
import math

QUANTITIES = ("roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb")
MEASURED = ("", "_raw", "_sigma", "_pl", "_state")
ALERT = {q: math.radians(1.0) if k < 3 else 0.10 for k, q in enumerate(QUANTITIES)}  # the defaults of the alert limits
COUNTS = ("frames", "changed", "lost", "won", "misleading", "misleading_more", "beyond_more")


def frames_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else math.nan


def judged_truth(frame, q):
    """As QuantityRecord::judged_truth of tools/lab/campaign/record.cpp."""
    truth, surveyed = number(frame[q + "_truth"]), number(frame[q + "_surveyed"])
    if math.isnan(surveyed) or math.isnan(truth):
        return truth if math.isnan(surveyed) else surveyed
    told = number(frame[q]) if frame[q] else number(frame[q + "_raw"])
    low, high = min(truth, surveyed), max(truth, surveyed)
    if math.isnan(told):
        return truth
    if high - low > 2.0 * ALERT[q]:
        return low if abs(told - low) < abs(told - high) else high
    return min(max(told, low), high)


def is_misleading(frame, q):
    """Valid, and wrong by more than the alert limit, or nothing is there to be measured."""
    if frame[q + "_state"] != "valid":
        return False
    return not abs(number(frame[q]) - judged_truth(frame, q)) <= ALERT[q]


def is_beyond(frame, q):
    """The value is off by more than its protection level."""
    if frame[q + "_state"] == "invalid":
        return False
    return abs(number(frame[q]) - judged_truth(frame, q)) > number(frame[q + "_pl"])


def compare(of_sources, of_value, unobservable):
    """Counts of frames, and of values lost and won. Unobservable scenes are wrong by design: never misleading."""
    if [f["frame"] for f in of_sources] != [f["frame"] for f in of_value]:
        raise ValueError("the campaigns have other frames")
    counts = dict.fromkeys(COUNTS, 0)
    for a, b in zip(of_sources, of_value):
        counts["frames"] += 1
        counts["changed"] += any(a[q + part] != b[q + part] for q in QUANTITIES for part in MEASURED)
        for q in QUANTITIES:
            before, now = a[q + "_state"] == "valid", b[q + "_state"] == "valid"
            counts["lost"] += before and not now
            counts["won"] += now and not before
        if a["scene"] not in unobservable:
            was, is_now = ([any(wrong(f, q) for q in QUANTITIES) for wrong in (is_misleading, is_beyond)]
                           for f in (a, b))
            counts["misleading"] += is_now[0]
            counts["misleading_more"] += is_now[0] and not was[0]
            counts["beyond_more"] += is_now[1] and not was[1]
    return counts
