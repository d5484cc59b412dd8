/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints what each library's text function says of each number: "number<TAB>library<TAB>text". check_statuses.py reads
 * it. */

#include <inttypes.h>
#include <stdio.h>

#include "pose_wall.h"
#include "pose_wall_planar_types.h"
#ifdef POSE_WALL_STATUSES_OF_RUNTIME
#include "pose_wall_runtime.h"
#endif

int main(void) {
  int32_t status;
  for (status = 1; status >= -400; --status) { /* beyond every range of include/README.md */
    printf("%" PRId32 "\tpose_wall\t%s\n", status, pose_wall_status_text(status));
    printf("%" PRId32 "\tplanar\t%s\n", status, pose_wall_planar_status_text(status));
#ifdef POSE_WALL_STATUSES_OF_RUNTIME
    printf("%" PRId32 "\truntime\t%s\n", status, pose_wall_runtime_status_text(status));
#endif
  }
  return 0;
}
