# Functions that bake assets with nook::tool when you build a project. A bake runs again when one of its input files or
# the tool changes. docs/guide/pipeline.md has examples.
#
#   nook_bake_character(TARGET FILE hero.glb [settings])
#   nook_bake_bent(TARGET FILE hero.glb MODEL body.nook OUTPUT hero.nook [settings])
#   nook_bake_lod(TARGET FILE hero_lod1.glb MODEL hero.nook [settings])
#
# Building TARGET bakes the files. If TARGET is a target of this folder, such as a program, the files are added to its
# sources. Otherwise, the function creates a custom target with this name that belongs to `all`.
#
#   FILE     the .glb or .gltf file
#   MODEL    the baked character that the bake starts from; it may be the OUTPUT of another call in this folder
#   OUTPUT   the .nook file to write; default: the name of FILE with .nook, in the current build folder
#   REPORT   a .json file for the numbers of the bake
#   CACHE    a folder that keeps results; default: the variable NOOK_BAKE_CACHE
#   ISA      the instruction set; default: the variable NOOK_BAKE_ISA
#   OPTIONS  further options of the command
#
# Relative paths in FILE, MODEL, CACHE and OPTIONS are relative to the current source folder. Relative paths in
# OUTPUT and REPORT are relative to the current build folder. If the source folder does not contain MODEL, the
# function looks for it in the current build folder.
cmake_policy(PUSH)
cmake_policy(VERSION 3.20...3.25)

# Makes the paths in OPTIONS absolute, because relative paths in the depfile would refer to another folder.
function(nook_bake_absolute_options out)
  set(options "")
  set(is_file FALSE)
  foreach(option IN LISTS ARGN)
    if(is_file)
      cmake_path(ABSOLUTE_PATH option BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
      set(is_file FALSE)
    elseif(option MATCHES "^--(rig|calibrate|model)$")
      set(is_file TRUE)
    elseif(option MATCHES "^(--(rig|calibrate|model))=(.*)$")
      set(file "${CMAKE_MATCH_3}")
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
      set(option "${CMAKE_MATCH_1}=${file}")
    endif()
    list(APPEND options "${option}")
  endforeach()
  set(${out} "${options}" PARENT_SCOPE)
endfunction()

# The part that all kinds of bakes share. INPUTS are the positional arguments of the command, in this order.
function(nook_bake_command kind target output inputs)
  cmake_parse_arguments(PARSE_ARGV 4 bake "" "REPORT;CACHE;ISA" "OPTIONS")
  set(call "nook_bake_${kind}(${target})")
  if(NOT TARGET nook::tool)
    message(FATAL_ERROR "${call}: there is no target nook::tool here; call find_package(nook_bake REQUIRED COMPONENTS tool) "
                        "in this folder or above it")
  endif()
  foreach(option IN LISTS bake_OPTIONS)
    if(option MATCHES "^(-o|--output|--depfile|--report|--cache|--isa|--print-key)(=|$)")
      message(FATAL_ERROR "${call}: OPTIONS holds ${CMAKE_MATCH_1}, which the function sets itself; use OUTPUT, "
                          "REPORT, CACHE or ISA")
    endif()
  endforeach()
  nook_bake_absolute_options(options ${bake_OPTIONS})
  set(report "")
  if(bake_REPORT)
    cmake_path(ABSOLUTE_PATH bake_REPORT BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE OUTPUT_VARIABLE report)
    list(APPEND options --report "${report}")
  endif()
  if(NOT bake_CACHE AND NOOK_BAKE_CACHE)
    set(bake_CACHE "${NOOK_BAKE_CACHE}")
  endif()
  if(bake_CACHE)
    cmake_path(ABSOLUTE_PATH bake_CACHE BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    list(APPEND options --cache "${bake_CACHE}")
  endif()
  if(NOT bake_ISA AND NOOK_BAKE_ISA)
    set(bake_ISA "${NOOK_BAKE_ISA}")
  endif()
  if(bake_ISA)
    list(APPEND options --isa "${bake_ISA}")
  endif()

  # The tool does not create the output folder.
  cmake_path(GET output PARENT_PATH folder)
  cmake_path(GET output FILENAME name)
  file(MAKE_DIRECTORY "${folder}")
  add_custom_command(OUTPUT "${output}" ${report}
    COMMAND nook::tool bake ${kind} ${inputs} -o "${output}" --depfile "${output}.d" --quiet ${options}
    DEPENDS nook::tool ${inputs}
    DEPFILE "${output}.d"
    COMMENT "Baking ${name}"
    VERBATIM)
  if(NOT TARGET "${target}")
    add_custom_target("${target}" ALL)
  endif()
  get_target_property(target_folder "${target}" SOURCE_DIR)
  if(NOT target_folder STREQUAL CMAKE_CURRENT_SOURCE_DIR)
    message(FATAL_ERROR "${call}: the target belongs to ${target_folder}; call the function there, or name another target")
  endif()
  target_sources("${target}" PRIVATE "${output}")
endfunction()

# Checks the arguments of a call, and makes the paths of FILE, MODEL and OUTPUT absolute. Sets bake_FILE,
# bake_MODEL and bake_OUTPUT. Stores the remaining arguments in bake_settings.
macro(nook_bake_parse kind target takes_model)
  set(bake_call "nook_bake_${kind}(${target})")
  cmake_parse_arguments(PARSE_ARGV 1 bake "" "FILE;MODEL;OUTPUT;REPORT;CACHE;ISA" "OPTIONS")
  if(bake_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${bake_call} does not know: ${bake_UNPARSED_ARGUMENTS}; options of `nook bake ${kind}` follow OPTIONS")
  endif()
  if(bake_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${bake_call}: a value is missing after ${bake_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT bake_FILE)
    message(FATAL_ERROR "${bake_call}: FILE is missing; give the .glb or .gltf file")
  endif()
  cmake_path(GET bake_FILE STEM LAST_ONLY bake_stem)
  cmake_path(ABSOLUTE_PATH bake_FILE BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  if(NOT bake_OUTPUT)
    set(bake_OUTPUT "${bake_stem}.nook")
  endif()
  cmake_path(ABSOLUTE_PATH bake_OUTPUT BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE)
  if(${takes_model})
    if(NOT bake_MODEL)
      message(FATAL_ERROR "${bake_call}: MODEL is missing; give the .nook file of the character")
    endif()
    set(bake_of_build "${bake_MODEL}")
    cmake_path(ABSOLUTE_PATH bake_MODEL BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    if(NOT EXISTS "${bake_MODEL}")
      cmake_path(ABSOLUTE_PATH bake_of_build BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE OUTPUT_VARIABLE bake_MODEL)
    endif()
    if(bake_MODEL STREQUAL bake_OUTPUT)
      message(FATAL_ERROR "${bake_call}: MODEL and OUTPUT are one file, ${bake_OUTPUT}; give another OUTPUT")
    endif()
  elseif(bake_MODEL)
    message(FATAL_ERROR "${bake_call} takes no MODEL; nook_bake_bent and nook_bake_lod do")
  endif()
  set(bake_settings "")
  foreach(bake_name REPORT CACHE ISA OPTIONS)
    if(bake_${bake_name})
      list(APPEND bake_settings ${bake_name} ${bake_${bake_name}})
    endif()
  endforeach()
endmacro()

function(nook_bake_character target)
  nook_bake_parse(character "${target}" FALSE)
  nook_bake_command(character "${target}" "${bake_OUTPUT}" "${bake_FILE}" ${bake_settings})
endfunction()

function(nook_bake_bent target)
  nook_bake_parse(bent "${target}" TRUE)
  nook_bake_command(bent "${target}" "${bake_OUTPUT}" "${bake_FILE};${bake_MODEL}" ${bake_settings})
endfunction()

function(nook_bake_lod target)
  nook_bake_parse(lod "${target}" TRUE)
  nook_bake_command(lod "${target}" "${bake_OUTPUT}" "${bake_MODEL};${bake_FILE}" ${bake_settings})
endfunction()

cmake_policy(POP)
