# Installs the built tree under a path with a space, moves it, and builds and runs a C program that finds it there: by
# find_package, and by pkg-config where there is one. -DBUILD= -DWORK= -DSOURCES= -DC_COMPILER= -DGENERATOR= -DNM= -DGL=
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD}/sdk --prefix "${WORK}/first place")
file(RENAME "${WORK}/first place" "${WORK}/second place")
set(prefix "${WORK}/second place")

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCES}/consumer -B ${WORK}/build "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_C_COMPILER=${C_COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

# Nothing of the build tree may be left in the package, and nothing but the C++ runtime may be needed.
file(GLOB_RECURSE texts "${prefix}/*.cmake" "${prefix}/*.pc")
foreach(text ${texts})
  file(READ "${text}" content)
  foreach(word "${BUILD}" "find_dependency" "glad")
    string(FIND "${content}" "${word}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${text} mentions ${word}")
    endif()
  endforeach()
endforeach()

foreach(file share/doc/nook/LICENSE share/doc/nook/NOTICE include/nook/nook.h include/nook/nook.hpp)
  if(NOT EXISTS "${prefix}/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
# The library of the bakers is not there, and neither are its headers. OpenGL's headers are there with its half of the library.
file(GLOB bake_headers "${prefix}/include/nook/nook_bake*" "${prefix}/include/nook/experimental/nook_trace*")
if(bake_headers)
  message(FATAL_ERROR "headers of the bakers are installed without their library: ${bake_headers}")
endif()
file(GLOB gl_headers "${prefix}/include/nook/nook_gl.h*" "${prefix}/include/nook/nook_nnao.h*" "${prefix}/include/nook/nook_world.h*")
list(LENGTH gl_headers gl_header_count)
if(GL AND gl_header_count LESS 6 OR NOT GL AND gl_header_count GREATER 0)
  message(FATAL_ERROR "with NOOK_GL=${GL} these headers of OpenGL are installed: ${gl_headers}")
endif()
# A host that needs the OpenGL half finds it or fails to configure.
execute_process(COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCES}/consumer -B ${WORK}/build_gl -DCOMPONENTS=gl
                        "-DCMAKE_PREFIX_PATH=${prefix}" -DCMAKE_C_COMPILER=${C_COMPILER}
                RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(GL AND failed OR NOT GL AND NOT failed)
  message(FATAL_ERROR "find_package(nook COMPONENTS gl) with NOOK_GL=${GL}: exit code ${failed}")
endif()

file(GLOB_RECURSE static_library "${prefix}/*/libnook.a")
if(static_library AND NM)
  execute_process(COMMAND ${NM} -g --defined-only "${static_library}" OUTPUT_VARIABLE symbols ERROR_QUIET)
  # Recorded frames are made without OpenGL.
  string(REGEX REPLACE " nook_nnao_recording_[a-z_]+" "" symbols "${symbols}")
  if(NOT GL AND symbols MATCHES " nook_(gl|nnao)_")
    message(FATAL_ERROR "a library without OpenGL has symbols of it")
  endif()
endif()

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  # This works without --static where the static library is the only one.
  pkg_config(flags "${prefix}" --cflags --libs)
  run(${C_COMPILER} -std=c99 ${SOURCES}/consumer/main.c ${flags} "-Wl,-rpath,${prefix}/lib" -o ${WORK}/by_pkg_config)
  run(${WORK}/by_pkg_config)
  pkg_config(gl "${prefix}" --variable=gl)
  if(GL AND NOT gl STREQUAL "yes" OR NOT GL AND NOT gl STREQUAL "no")
    message(FATAL_ERROR "with NOOK_GL=${GL} nook.pc says gl=${gl}")
  endif()

  # A plug-in that links the static library keeps Nook to itself.
  if(static_library AND NM)
    run(${C_COMPILER} -std=c99 -shared -fPIC ${SOURCES}/plugin/plugin.c ${flags} -o ${WORK}/plugin.so)
    run(${NM} -D --defined-only ${WORK}/plugin.so)
    if(NOT run_output MATCHES " plugin_start")
      message(FATAL_ERROR "the plug-in does not export its own function:\n${run_output}")
    endif()
    if(run_output MATCHES "nook")
      message(FATAL_ERROR "the plug-in exports functions of Nook:\n${run_output}")
    endif()
  endif()
endif()
