# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DOUTPUT=a.cpp -DFUNCTION=assets "-DPARTS=a.html;a.css;b.css;a.js;b.js" -P embed.cmake: the page, then its
# styles as one and its scripts as one. With -DFUNCTION=three_library and one part: that script alone.
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

set(styles ${PARTS})
list(FILTER styles INCLUDE REGEX "\\.css$")
set(scripts ${PARTS})
list(FILTER scripts INCLUDE REGEX "\\.js$")
if(FUNCTION STREQUAL three_library)
  file(WRITE ${OUTPUT} "// Made by tools/study/report/embed.cmake.\n#include \"study/report/assets.hpp\"\n\n")
  file(APPEND ${OUTPUT} "namespace pose_wall::tools::report {\nnamespace {\n")
  append_array(kLibrary ${PARTS})
  file(APPEND ${OUTPUT} "}  // namespace\nstd::string_view ${FUNCTION}() {\n")
  file(APPEND ${OUTPUT} "  return {kLibrary, sizeof kLibrary};\n}\n}\n")
  return()
endif()
list(POP_FRONT PARTS html)
file(WRITE ${OUTPUT} "// Made by tools/study/report/embed.cmake.\n#include \"study/report/assets.hpp\"\n\n")
file(APPEND ${OUTPUT} "namespace pose_wall::tools::report {\nnamespace {\n")
append_array(kHtml ${html})
append_array(kStyle ${styles})
append_array(kScript ${scripts})
file(APPEND ${OUTPUT} "}  // namespace\nAssets ${FUNCTION}() {\n")
file(APPEND ${OUTPUT} "  return {{kHtml, sizeof kHtml}, {kStyle, sizeof kStyle}, {kScript, sizeof kScript}, {}};\n")
file(APPEND ${OUTPUT} "}\n}\n")
