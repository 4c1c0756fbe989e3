# Precompiled headers for all targets except the library. Most of the cost of a translation unit is parsing the standard
# library, Catch2, Eigen and nlohmann-json. The library itself is compiled without them, as its users compile it. There are
# two exceptions: builds with sanitizers, which build nothing else, and NOOK_PRECOMPILE_LIBRARY, which samples/run.sh sets.
#
# Programs (the tool, samples and tests) are compiled with -O1, because optimising took a third of their compile time. They
# spend their run time in the libraries, which keep their optimisation. Programs that measure time keep their optimisation,
# too, and have no precompiled header.
#
# A library with the property NOOK_PROGRAM_PART is compiled like a program.
#
# All targets with the same flags share one precompiled header. Only libraries have position-independent code, so libraries
# All targets with the same flags share one precompiled header. Libraries and programs have different options for
# position-independent code, so they have different headers. Each target below compiles one empty source, and the other
# targets reuse its header.
# nook_precompiled(NAME TYPE HEADER...): the headers, compiled with the flags of all targets. If targets have sources in C,
# CMake also requires a header for C.
function(nook_precompiled name type)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled/${name}.cpp CONTENT "int main() { return 0; }\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled/${name}.c CONTENT "typedef int ${name};\n")
  set(sources ${CMAKE_CURRENT_BINARY_DIR}/precompiled/${name}.cpp ${CMAKE_CURRENT_BINARY_DIR}/precompiled/${name}.c)
  if(type STREQUAL "EXECUTABLE")
    add_executable(${name} ${sources})
    target_compile_options(${name} PRIVATE -O1)
  else()
    add_library(${name} OBJECT ${sources})
  endif()
  nook_target_options(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  list(TRANSFORM ARGN REPLACE ">" "$<ANGLE-R>")
  list(TRANSFORM ARGN REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:\\1>")
  target_precompile_headers(${name} PRIVATE ${ARGN} $<$<COMPILE_LANGUAGE:C>:<stddef.h$<ANGLE-R>>)
endfunction()

# nook_cxx_options(RESULT TARGET): the target's options for C++. Under the sanitizers, bakers/ and
# tests/bakers also have options for both languages in CMAKE_CXX_FLAGS.
function(nook_cxx_options result target)
  get_target_property(options ${target} COMPILE_OPTIONS)
  string(REGEX REPLACE "\\$<\\$<COMPILE_LANGUAGE:C>:[^>]*>" "" options "${options}")
  list(REMOVE_ITEM options "" -O1 -g1)
  set(${result} "${options}" PARENT_SCOPE)
endfunction()

# nook_kind(RESULT TARGET): the target's type, EXECUTABLE for parts of programs.
function(nook_kind result target)
  get_target_property(type ${target} TYPE)
  get_target_property(part ${target} NOOK_PROGRAM_PART)
  if(part)
    set(type EXECUTABLE)
  endif()
  set(${result} ${type} PARENT_SCOPE)
endfunction()

# nook_precompiled_name(RESULT TARGET): the target that has the precompiled headers of this one; nothing if no
# target has its options.
function(nook_precompiled_name result target)
  set(${result} "" PARENT_SCOPE)
  get_target_property(standard ${target} CXX_STANDARD)
  nook_kind(type ${target})
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if(type MATCHES "LIBRARY")
    set(candidates nook_precompiled_rooms nook_precompiled_fuzzed)
  elseif("Catch2::Catch2WithMain" IN_LIST libraries)
    set(candidates nook_precompiled_tests)
  else()
    set(candidates nook_precompiled_programs)
  endif()
  foreach(candidate IN LISTS candidates)
    if(standard EQUAL 20 AND TARGET ${candidate})
      nook_cxx_options(wanted ${target})
      nook_cxx_options(options ${candidate})
      if(options STREQUAL wanted)
        set(${result} ${candidate} PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

# nook_precompile_directory(DIRECTORY): the targets of this directory and below take precompiled headers.
function(nook_precompile_directory directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    nook_precompiled_name(precompiled ${target})
    if(NOT precompiled)
      continue()
    endif()
    nook_kind(type ${target})
    if(type STREQUAL "EXECUTABLE")
      if(directory MATCHES "^${PROJECT_SOURCE_DIR}/(tests/bench|bakers/lab/gpu_(cost|time))(/|$)")
        continue()
      endif()
      target_compile_options(${target} PRIVATE -O1)
    endif()
    set_target_properties(${target} PROPERTIES PRECOMPILE_HEADERS_REUSE_FROM ${precompiled}
                          PCH_WARN_INVALID OFF)
    add_dependencies(${target} ${precompiled})
    # With precompiled headers, gcc 12 gives these warnings for correct strings of the standard library.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>)
    # Skips targets in C, and targets with their own flags.
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.(c|cpp)$")
    # A relative name would be looked up in the folder of this script.
    get_target_property(folder ${target} SOURCE_DIR)
    foreach(name IN LISTS sources)
      cmake_path(ABSOLUTE_PATH name BASE_DIRECTORY ${folder} OUTPUT_VARIABLE source)
      get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
      list(REMOVE_ITEM options -fno-sanitize-coverage=trace-cmp)
      if(options OR source MATCHES "\\.c$")
        set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
      endif()
    endforeach()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory IN LISTS subdirectories)
    nook_precompile_directory(${subdirectory})
  endforeach()
endfunction()

# By default, Clang stores the times of all headers in a precompiled header. Then ccache could not reuse objects from
# another checkout.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  string(APPEND CMAKE_CXX_FLAGS " -Xclang -fno-pch-timestamp")
endif()
set(standard <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <numeric>
             <optional> <random> <span> <stdexcept> <string> <vector>)
if(NOOK_BAKERS)
  nook_precompiled(nook_precompiled_rooms OBJECT ${standard} <Eigen/Dense> <tbb/parallel_for.h>)
  target_link_libraries(nook_precompiled_rooms PRIVATE Eigen3::Eigen TBB::tbb)
  nook_precompiled(nook_precompiled_programs EXECUTABLE ${standard} <nlohmann/json.hpp>)
  target_link_libraries(nook_precompiled_programs PRIVATE nlohmann_json::nlohmann_json)
else()
  nook_precompiled(nook_precompiled_rooms OBJECT ${standard})
  nook_precompiled(nook_precompiled_programs EXECUTABLE ${standard})
endif()
if(NOOK_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  nook_precompiled(nook_precompiled_fuzzed OBJECT ${standard})
  target_compile_options(nook_precompiled_fuzzed PRIVATE -fsanitize=fuzzer-no-link)
endif()
if(NOOK_TESTS)
  nook_precompiled(nook_precompiled_tests EXECUTABLE ${standard} <nlohmann/json.hpp> ${PROJECT_SOURCE_DIR}/tests/catch.h)
  target_link_libraries(nook_precompiled_tests PRIVATE nlohmann_json::nlohmann_json Catch2::Catch2)
endif()

set(directories platform bakers samples tests)
if(NOOK_PRECOMPILE_LIBRARY OR NOOK_SANITIZE OR NOOK_SANITIZE_THREAD OR NOT (NOOK_BAKERS OR NOOK_SAMPLES OR NOOK_TESTS))
  list(APPEND directories sdk)
endif()
foreach(directory IN LISTS directories)
  if(IS_DIRECTORY ${PROJECT_BINARY_DIR}/${directory})
    nook_precompile_directory(${PROJECT_SOURCE_DIR}/${directory})
  endif()
endforeach()
