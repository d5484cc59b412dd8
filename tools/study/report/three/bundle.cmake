# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DESBUILD=.../bin/esbuild -DMODULES=.../node_modules -DOUTPUT=three.js -P bundle.cmake: the script for browsers.
# esbuild ends no script early: it writes "</script" as "<\/script".
file(READ ${MODULES}/three/LICENSE licence)
set(ENV{NODE_PATH} ${MODULES})
execute_process(
  COMMAND ${ESBUILD} ${CMAKE_CURRENT_LIST_DIR}/library.js --bundle --minify --format=iife --global-name=THREE
    --target=es2020 --legal-comments=none "--banner:js=/*! three.js\n\n${licence}*/" --outfile=${OUTPUT}
    --log-level=warning
  COMMAND_ERROR_IS_FATAL ANY)
