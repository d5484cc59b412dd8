# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# Drawn encounters of the obstacle stop; README.md of src/planar/stop has the figures of long runs.
add_executable(pose_wall_planar_stop_trial planar/trials/stop_trial.cpp)
target_link_libraries(pose_wall_planar_stop_trial PRIVATE
  pose_wall::pose_wall pose_wall_planar_objects pose_wall_test_support)
target_compile_options(pose_wall_planar_stop_trial PRIVATE -O2)
add_test(NAME planar.stop_trial COMMAND pose_wall_planar_stop_trial --encounters 60 --seed 7)
set_tests_properties(planar.stop_trial PROPERTIES LABELS planar TIMEOUT 300)
