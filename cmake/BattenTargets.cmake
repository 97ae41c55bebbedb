# SPDX-License-Identifier: MIT
# One folder is one target is one test program: the functions that say so.

# What every test is run with: under the leak sanitizer, graphics drivers keep memory that is not ours to free.
set(batten_test_environment "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/leaks.supp:print_suppressions=0")

# Flags that every target of Batten gets and no user of it.
function(batten_set_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
    -Wno-missing-field-initializers  # {.degree = 2} leaves the others at their defaults, on purpose
    # g++ 12 finds overlap in "a" + std::string (GCC bug 105651), where there is none.
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<BOOL:${BATTEN_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# Headers of others that most sources include: parsed once for each target, not once for each source. Every source still includes what it
# uses; the preset sanitize, which compiles without this (CMAKE_DISABLE_PRECOMPILE_HEADERS), shows where one does not.
set(batten_common_headers
  <algorithm> <cmath> <functional> <iostream> <map> <memory> <optional> <sstream> <string> <unordered_map> <variant> <vector>
  <Eigen/Dense> <Eigen/SparseCore> <boost/multiprecision/gmp.hpp>)

# batten_add_library(<folder> [DEPENDS target...] [PRIVATE_DEPENDS target...] [DEFINITIONS name...] [EXCLUDE file...])
#
# The library batten::<folder> of all *.cpp in the current folder but those in EXCLUDE. DEPENDS are seen by its headers, PRIVATE_DEPENDS
# and DEFINITIONS by its sources only. A folder of headers alone gives an INTERFACE library. Installed with its headers.
function(batten_add_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPENDS;PRIVATE_DEPENDS;DEFINITIONS;EXCLUDE")
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "*.cpp")
  file(GLOB headers CONFIGURE_DEPENDS "*.h")
  if(arg_EXCLUDE)
    list(REMOVE_ITEM sources ${arg_EXCLUDE})
  endif()

  set(target batten_${folder})
  if(sources)
    set(scope PUBLIC)
    add_library(${target} ${sources})
    batten_set_flags(${target})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_DEPENDS})
    target_compile_definitions(${target} PRIVATE ${arg_DEFINITIONS})
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_20)
  endif()
  add_library(batten::${folder} ALIAS ${target})
  target_include_directories(${target} ${scope}
    "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${target} ${scope} ${arg_DEPENDS})

  set_target_properties(${target} PROPERTIES EXPORT_NAME ${folder})
  install(TARGETS ${target} EXPORT battenTargets)
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/batten/${folder}")
endfunction()

# What is tested is in the libraries, compiled as for users; the tests' own sources are compiled faster than well.
function(batten_set_test_flags target)
  batten_set_flags(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${target} PRIVATE GTest::gmock OpenMP::OpenMP_CXX)
endfunction()

# batten_add_test(<folder> [DEPENDS target...] [DEFINITIONS name...] [PRECOMPILED])
#
# The test program test_<folder> of all tests/<folder>/*.cpp, linked to batten::<folder> where there is one, or none
# where there are no sources. PRECOMPILED: with the headers of batten_test_headers.
function(batten_add_test folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "PRECOMPILED" "" "DEPENDS;DEFINITIONS")
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp")
  if(NOT sources)
    return()
  endif()

  set(target test_${folder})
  add_executable(${target} ${sources})
  batten_set_test_flags(${target})
  target_include_directories(${target} PRIVATE "${PROJECT_BINARY_DIR}/include")
  if(TARGET batten::${folder})
    target_link_libraries(${target} PRIVATE batten::${folder})
  endif()
  target_link_libraries(${target} PRIVATE ${arg_DEPENDS} GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE ${arg_DEFINITIONS})
  if(arg_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM batten_test_headers)
  endif()
  batten_discover_tests(${target} ${folder})
endfunction()

# batten_discover_tests(<target> <label>): each test of the program on its own, its name after the label.
function(batten_discover_tests target label)
  gtest_discover_tests(${target} TEST_PREFIX "${label}." DISCOVERY_TIMEOUT 120
    PROPERTIES LABELS ${label} TIMEOUT 600 ENVIRONMENT ${batten_test_environment})
endfunction()

# batten_add_programs(<prefix> [DEPENDS target...] [TESTS])
#
# One program per *.cpp in the current folder, <prefix>_<name>; with TESTS each one is a test as well, passed when it exits with 0.
function(batten_add_programs prefix)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TESTS" "" "DEPENDS")
  file(GLOB sources CONFIGURE_DEPENDS "*.cpp")
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    set(target ${prefix}_${name})
    add_executable(${target} ${source})
    batten_set_flags(${target})
    target_link_libraries(${target} PRIVATE ${arg_DEPENDS})
    if(arg_TESTS)
      add_test(NAME ${prefix}.${name} COMMAND ${target})
      set_tests_properties(${prefix}.${name} PROPERTIES
        LABELS ${prefix} TIMEOUT 300 ENVIRONMENT ${batten_test_environment})
    endif()
  endforeach()
endfunction()
