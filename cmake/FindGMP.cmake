# SPDX-License-Identifier: MIT
# GMP, the GNU multiple precision arithmetic library, which has no CMake package.
# Defines the target GMP::GMP; sets GMP_FOUND, GMP_INCLUDE_DIR, GMP_LIBRARIES (the names that CGAL reads too).

find_path(GMP_INCLUDE_DIR gmp.h)
find_library(GMP_LIBRARIES gmp)
mark_as_advanced(GMP_INCLUDE_DIR GMP_LIBRARIES)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GMP REQUIRED_VARS GMP_LIBRARIES GMP_INCLUDE_DIR)

if(GMP_FOUND AND NOT TARGET GMP::GMP)
  add_library(GMP::GMP UNKNOWN IMPORTED)
  set_target_properties(GMP::GMP PROPERTIES
    IMPORTED_LOCATION "${GMP_LIBRARIES}"
    INTERFACE_INCLUDE_DIRECTORIES "${GMP_INCLUDE_DIR}")
endif()
