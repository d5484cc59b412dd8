# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DOUTPUT= "-DLIBRARIES=<archive>;..." -DVERSION= -DEIGEN=<include folders> -DCOMPILER="GNU 12.2.0"
#   -P write_sbom.cmake
# With SOURCE_DATE_EPOCH set, the same archives give the same file.
foreach(folder IN LISTS EIGEN)
  if(EXISTS ${folder}/Eigen/src/Core/util/Macros.h)
    file(STRINGS ${folder}/Eigen/src/Core/util/Macros.h lines REGEX "#define EIGEN_(WORLD|MAJOR|MINOR)_VERSION [0-9]+")
  endif()
endforeach()
list(TRANSFORM lines REPLACE ".*VERSION ([0-9]+).*" "\\1")
list(JOIN lines "." eigen_version)
if(NOT eigen_version MATCHES "^[0-9]+\\.[0-9]+\\.[0-9]+$")
  message(FATAL_ERROR "Eigen's version is not to be found in its headers in '${EIGEN}'")
endif()
set(packages)
set(relationships)
set(files)
set(digests)
foreach(library IN LISTS LIBRARIES)
  get_filename_component(file ${library} NAME)
  string(REGEX REPLACE "^lib(.*)\\.a$" "\\1" name ${file})
  string(REPLACE "_" "-" id ${name})
  file(SHA256 ${library} digest)
  list(APPEND files ${file})
  string(APPEND digests ${digest})
  string(APPEND packages "    {
      \"SPDXID\": \"SPDXRef-${id}\",
      \"name\": \"${name}\",
      \"versionInfo\": \"${VERSION}\",
      \"primaryPackagePurpose\": \"LIBRARY\",
      \"supplier\": \"Organization: the pose_wall authors\",
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"packageFileName\": \"${file}\",
      \"checksums\": [ { \"algorithm\": \"SHA256\", \"checksumValue\": \"${digest}\" } ],
      \"licenseConcluded\": \"BSD-3-Clause AND MPL-2.0\",
      \"licenseDeclared\": \"BSD-3-Clause\",
      \"copyrightText\": \"Copyright (c) 2026 the pose_wall authors\"
    },
")
  string(APPEND relationships "    { \"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\",
      \"relatedSpdxElement\": \"SPDXRef-${id}\" },
    { \"spdxElementId\": \"SPDXRef-${id}\", \"relationshipType\": \"STATIC_LINK\",
      \"relatedSpdxElement\": \"SPDXRef-Eigen\" },
")
endforeach()
list(JOIN files " and " files)
string(SHA256 digest "${digests}")  # of the document
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
string(REPLACE " " ";" compiler ${COMPILER})
list(GET compiler 0 compiler_name)
list(GET compiler 1 compiler_version)
file(WRITE ${OUTPUT} "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"pose_wall-${VERSION}\",
  \"documentNamespace\": \"https://spdx.org/spdxdocs/pose_wall-${VERSION}-${digest}\",
  \"creationInfo\": { \"created\": \"${created}\", \"creators\": [ \"Organization: the pose_wall authors\" ] },
  \"packages\": [
${packages}    {
      \"SPDXID\": \"SPDXRef-Eigen\",
      \"name\": \"Eigen\",
      \"versionInfo\": \"${eigen_version}\",
      \"primaryPackagePurpose\": \"LIBRARY\",
      \"downloadLocation\": \"https://gitlab.com/libeigen/eigen\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"MPL-2.0\",
      \"licenseDeclared\": \"MPL-2.0\",
      \"copyrightText\": \"NOASSERTION\",
      \"comment\": \"Header-only; its instantiations are compiled into ${files}.\"
    },
    {
      \"SPDXID\": \"SPDXRef-compiler\",
      \"name\": \"${compiler_name}\",
      \"versionInfo\": \"${compiler_version}\",
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"NOASSERTION\",
      \"licenseDeclared\": \"NOASSERTION\",
      \"copyrightText\": \"NOASSERTION\"
    }
  ],
  \"relationships\": [
${relationships}    { \"spdxElementId\": \"SPDXRef-compiler\", \"relationshipType\": \"BUILD_TOOL_OF\",
      \"relatedSpdxElement\": \"SPDXRef-pose-wall\" }
  ]
}
")
