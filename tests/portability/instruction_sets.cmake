# Runs cpu_results and compares every instruction set with scalar. -DWRITE= -DRESULTS= -DDIRECTORY=
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${DIRECTORY} OUTPUT_VARIABLE out ERROR_VARIABLE out RESULT_VARIABLE failed)
  message(STATUS "${out}")
  if(failed)
    message(FATAL_ERROR "${ARGN} failed")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()
run(${WRITE} character.nook material.nook)
run(${RESULTS} run character.nook material.nook native.values)
string(REGEX MATCHALL "[a-z0-9]+ +[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]+" lines "${output}")
foreach(line ${lines})
  string(REGEX REPLACE " .*" "" name "${line}")
  # The vector kernels have other roots and exponentials, within a few of the last bits, and add in another order, and shadows
  # that differ by rounding may have codes a step apart, for 7e-5 of AO (kernel_agreement.cpp): 8.3e-5 for AO and 2e-7 for light
  # were seen. A material is evaluated by one code.
  if(NOT name STREQUAL "all")
    run(${RESULTS} compare native.values native.values 1.2e-4 1e-6 0 scalar ${name})
  endif()
endforeach()
