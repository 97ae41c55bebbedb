# SPDX-License-Identifier: MIT
# The package that find_package(batten) reads.
include(CMakePackageConfigHelpers)

set(batten_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/batten")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/battenConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/battenConfig.cmake" INSTALL_DESTINATION "${batten_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/battenConfigVersion.cmake" COMPATIBILITY SameMinorVersion)

install(EXPORT battenTargets NAMESPACE batten:: DESTINATION "${batten_package_dir}")
install(FILES
  "${PROJECT_BINARY_DIR}/battenConfig.cmake" "${PROJECT_BINARY_DIR}/battenConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake" "${PROJECT_SOURCE_DIR}/cmake/FindClp.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindGMP.cmake"
  DESTINATION "${batten_package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/batten")
