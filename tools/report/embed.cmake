# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DOUTPUT=a.cpp "-DPARTS=a.html;a.css;a.js;b.js" -P embed.cmake: the first two as they are, the scripts as one.
# As bytes, which know no quotes and have no greatest length.
function(append_array name)
  set(hex "")
  foreach(part IN LISTS ARGN)
    file(READ ${part} part_hex HEX)
    string(APPEND hex "${part_hex}")
  endforeach()
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
  file(APPEND ${OUTPUT} "const char ${name}[] = {${bytes}};\n")
endfunction()

list(POP_FRONT PARTS html style)
file(WRITE ${OUTPUT} "// Made by tools/report/embed.cmake.\n#include \"report/assets.hpp\"\n\n")
file(APPEND ${OUTPUT} "namespace pose_wall::tools::report {\nnamespace {\n")
append_array(kHtml ${html})
append_array(kStyle ${style})
append_array(kScript ${PARTS})
file(APPEND ${OUTPUT} "}  // namespace\nAssets assets() {\n")
file(APPEND ${OUTPUT} "  return {{kHtml, sizeof kHtml}, {kStyle, sizeof kStyle}, {kScript, sizeof kScript}};\n}\n}\n")
