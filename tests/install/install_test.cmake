# Installs the built tree under a path with a space, moves it, and builds and runs a C program that finds it there: by
# find_package, and by pkg-config where there is one. -DBUILD= -DWORK= -DCONSUMER= -DC_COMPILER= -DGENERATOR=
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD}/sdk --prefix "${WORK}/first place")
file(RENAME "${WORK}/first place" "${WORK}/second place")
set(prefix "${WORK}/second place")

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CONSUMER} -B ${WORK}/build "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_C_COMPILER=${C_COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

# Nothing of the build tree may be left in the package, and nothing but the C++ runtime may be needed.
file(GLOB_RECURSE texts "${prefix}/*.cmake" "${prefix}/*.pc")
foreach(text ${texts})
  file(READ "${text}" content)
  foreach(word "${BUILD}" "find_dependency" "XXHASH" "glad")
    string(FIND "${content}" "${word}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${text} mentions ${word}")
    endif()
  endforeach()
endforeach()

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(GLOB_RECURSE pc "${prefix}/*/nook.pc")
  get_filename_component(pc_dir "${pc}" DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} "${pc_dir}")
  execute_process(COMMAND ${PKG_CONFIG} --static --cflags --libs nook OUTPUT_VARIABLE flags RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    message(FATAL_ERROR "pkg-config does not find nook.pc in ${pc_dir}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${C_COMPILER} -std=c99 ${CONSUMER}/main.c ${flags} "-Wl,-rpath,${prefix}/lib" -o ${WORK}/by_pkg_config)
endif()
