# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DOUTPUT=a.cpp "-DPARTS=a.po;b.po" -P embed_po.cmake: the catalogues, one after the other, as bytes.
set(hex "")
foreach(part IN LISTS PARTS)
  file(READ ${part} part_hex HEX)
  string(APPEND hex "${part_hex}0a")
endforeach()
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
file(WRITE ${OUTPUT} "// Made by tools/io/language/embed_po.cmake.\n#include \"io/language/po_catalogue.hpp\"\n\n")
file(APPEND ${OUTPUT} "namespace pose_wall::tools {\nnamespace {\nconst char kText[] = {${bytes}};\n}  // namespace\n")
file(APPEND ${OUTPUT} "std::string_view chinese_catalogues() {\n  return {kText, sizeof kText};\n}\n}\n")
