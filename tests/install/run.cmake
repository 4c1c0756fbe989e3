# run(COMMAND...): runs a command, leaves what it prints in run_output, and fails with that if the command fails.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  set(run_output "${output}" PARENT_SCOPE)
endfunction()

# pkg_config(OUT FOLDER ARGUMENT...): what pkg-config says of the package nook of an installed prefix.
function(pkg_config out prefix)
  file(GLOB_RECURSE pc "${prefix}/*/nook.pc")
  get_filename_component(pc_dir "${pc}" DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} "${pc_dir}")
  execute_process(COMMAND ${PKG_CONFIG} ${ARGN} nook OUTPUT_VARIABLE flags RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    message(FATAL_ERROR "pkg-config ${ARGN} fails for nook.pc in ${pc_dir}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  set(${out} ${flags} PARENT_SCOPE)
endfunction()
