# SPDX-License-Identifier: MIT
# CHOLMOD of SuiteSparse, which has no CMake package of its own before version 7.
# Defines the target CHOLMOD::CHOLMOD; sets CHOLMOD_FOUND, CHOLMOD_VERSION, CHOLMOD_INCLUDE_DIR, CHOLMOD_LIBRARY.

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

set(CHOLMOD_VERSION "")
if(CHOLMOD_INCLUDE_DIR)
  file(GLOB _cholmod_headers "${CHOLMOD_INCLUDE_DIR}/cholmod*.h")
  foreach(_part IN ITEMS MAIN SUB SUBSUB)
    foreach(_header IN LISTS _cholmod_headers)
      file(STRINGS "${_header}" _line REGEX "^#define[ \t]+CHOLMOD_${_part}_VERSION[ \t]+[0-9]+" LIMIT_COUNT 1)
      if(_line MATCHES "VERSION[ \t]+([0-9]+)")
        list(APPEND _cholmod_version ${CMAKE_MATCH_1})
        break()
      endif()
    endforeach()
  endforeach()
  list(JOIN _cholmod_version "." CHOLMOD_VERSION)
  unset(_cholmod_version)
  unset(_cholmod_headers)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR VERSION_VAR CHOLMOD_VERSION)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
