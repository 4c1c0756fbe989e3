# Fails when a room includes what it must not know. Every private include, in C, C++ and GLSL, is a path from the root of the
# repository; each room lists the folders that it may take from. Dependencies run one way: the tool, then jobs, measurements and
# images, then the rooms that make data, then the sdk's rooms, then core.
cmake_minimum_required(VERSION 3.25)

set(violations "")

# room(FOLDER ALLOWED...): includes in quotes of the files below FOLDER begin with one of ALLOWED, which are folders or
# headers, and name a file.
function(room folder)
  file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.inl
       ${ROOT}/${folder}/*.c ${ROOT}/${folder}/*.glsl ${ROOT}/${folder}/*.frag ${ROOT}/${folder}/*.vert
       ${ROOT}/${folder}/*.comp)
  if(NOT files)
    message(FATAL_ERROR "architecture: ${folder} holds no source; the rule on it checks nothing")
  endif()
  list(JOIN ARGN "|" allowed)
  foreach(file ${files})
    file(STRINGS ${file} lines REGEX "^[ ]*#[ ]*include[ ]*\"")
    foreach(line ${lines})
      string(REGEX REPLACE ".*\"([^\"]+)\".*" "\\1" path "${line}")
      if(NOT EXISTS ${ROOT}/${path})
        string(APPEND violations "${file}: ${line}\n  no file of this path from the root\n")
      elseif(NOT path MATCHES "^(${allowed})(/|$)")
        string(APPEND violations "${file}: ${line}\n  ${folder} may take from ${ARGN}\n")
      endif()
    endforeach()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# forbid(FOLDER PATTERN REASON [EXCEPT]): no include line of the files below FOLDER matches PATTERN, but in files whose paths match
# EXCEPT.
function(forbid folder pattern reason)
  file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.inl
       ${ROOT}/${folder}/*.c)
  if(ARGC GREATER 3)
    list(FILTER files EXCLUDE REGEX "${ARGV3}")
  endif()
  foreach(file ${files})
    file(STRINGS ${file} lines REGEX "^[ ]*#[ ]*include.*(${pattern})")
    foreach(line ${lines})
      string(APPEND violations "${file}: ${line}\n  ${reason}\n")
    endforeach()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# A system's room and its shaders share numbers: headers of constants lie beside the shaders.
set(systems sdk/src/character sdk/src/nnao sdk/src/probe sdk/src/material sdk/src/synthesis sdk/src/transfer sdk/src/world)
room(sdk/src/core sdk/src/core shaders/core)
room(shaders/core shaders/core)
foreach(system character nnao probe material synthesis transfer world)
  room(sdk/src/${system} sdk/src/${system} shaders/${system} shaders/core sdk/src/core)
endforeach()
# The kernels of the systems, compiled for each instruction set.
room(sdk/src/isa sdk/src/isa sdk/src/character sdk/src/probe sdk/src/transfer sdk/src/world sdk/src/core)
room(sdk/src/gl sdk/src/gl shaders ${systems} sdk/src/core)
room(sdk/src/api sdk/src/api sdk/src/gl ${systems} sdk/src/core)
foreach(system nnao probe material synthesis transfer)
  room(shaders/${system} shaders/${system} shaders/core)
endforeach()
# The world pass takes the frame of the screen pass.
room(shaders/world shaders/world shaders/nnao shaders/core)
room(shaders/clips shaders/clips shaders/core)
room(shaders/character shaders/character shaders/probe shaders/core)

room(platform platform)

room(bakers/import bakers/import sdk/src/core)
room(bakers/raytrace bakers/raytrace bakers/import sdk/src/core)
room(bakers/algebra bakers/algebra)
room(bakers/mannequin bakers/mannequin platform/output_file.h platform/standard_streams.h)
room(bakers/tensor bakers/tensor bakers/algebra sdk/src/core)
set(ground bakers/algebra bakers/import bakers/raytrace sdk/src/core)
set(stopwatch platform/stopwatch.h)
set(process ${stopwatch} platform/peak_memory.h)
room(bakers/character bakers/character ${stopwatch} ${ground} sdk/src/character)
room(bakers/world bakers/world ${stopwatch} ${ground} sdk/src/character sdk/src/world)
room(bakers/nnao bakers/nnao ${ground} sdk/src/nnao)
room(bakers/probe bakers/probe ${ground} sdk/src/probe)
room(bakers/material bakers/material bakers/tensor ${process} ${ground} sdk/src/material)
room(bakers/synthesis bakers/synthesis bakers/tensor ${ground} sdk/src/synthesis)
room(bakers/transfer bakers/transfer bakers/tensor ${ground} sdk/src/material sdk/src/transfer)
set(makers bakers/character bakers/world bakers/nnao bakers/probe bakers/material bakers/synthesis bakers/tensor
    bakers/transfer ${ground} ${systems})
room(bakers/images bakers/images platform ${makers})
# Glossy characters are lit by the form of the screen pass with numbers of their own.
room(bakers/measure/character bakers/measure/character bakers/images bakers/character bakers/nnao ${ground} sdk/src/character
     sdk/src/nnao shaders/character/specular_numbers.h)
room(bakers/measure/transfer bakers/measure/transfer bakers/measure/material/raw_reflectance.h bakers/images bakers/transfer
     ${stopwatch} ${ground} sdk/src/material sdk/src/transfer)
# Floors are lit by the lobes of maps.
room(bakers/measure/world bakers/measure/world bakers/images bakers/probe bakers/world ${ground} sdk/src/character
     sdk/src/probe sdk/src/world)
room(bakers/measure/nnao bakers/measure/nnao bakers/nnao platform ${ground} sdk/src/nnao)
# Rooms are lit as floors are.
room(bakers/measure/composite bakers/measure/composite bakers/measure/nnao bakers/measure/world bakers/nnao bakers/world
     platform ${ground} sdk/src/character sdk/src/world sdk/src/nnao)
room(bakers/measure/probe bakers/measure/probe bakers/probe ${ground} sdk/src/probe)
# Materials are shown on planes that a coordinate texture spreads them over.
room(bakers/measure/material bakers/measure/material bakers/images bakers/material bakers/tensor
     ${ground} sdk/src/material sdk/src/synthesis)
# Pages show what the other measures have, and draw nothing.
room(bakers/measure/report bakers/measure bakers/images platform ${makers})
room(bakers/job bakers/job ${process} ${makers})
room(bakers/api bakers/api bakers/job ${makers})
# Keys and caches need hashes and the instruction set; models say which meshes they were baked from.
room(bakers/tool bakers/tool bakers/import/content_hash.h bakers/import/foreign_formats.h bakers/import/gltf.h bakers/import/gltf_contents.h
     bakers/import/import_options.h bakers/import/sha256.h bakers/raytrace/instruction_set.h bakers/raytrace/worker_arena.h
     bakers/character/recipe.h bakers/job bakers/measure bakers/images platform
     ${systems} sdk/src/core)

# The lab compares Nook with other methods. It takes from every room and, to measure it, from the
# crowd of the samples, but not from tests. No room takes from it.
room(bakers/lab bakers/lab samples/crowd bakers/measure bakers/tool bakers/images bakers/job platform shaders sdk/src/gl/material/material_glsl.h
     sdk/src/gl/embedded_shaders.h ${makers})

forbid(sdk/src "tbb/|embree|Eigen|tiny_gltf|OpenImageIO|nlohmann|LBFGS|CLI/" "the runtime depends on nothing")
foreach(folder core character nnao probe material synthesis transfer world isa)
  forbid(sdk/src/${folder} "nook_gl|glad" "only gl and api/gl know OpenGL")
endforeach()
foreach(folder import raytrace tensor mannequin character world nnao probe material synthesis transfer job api images)
  forbid(bakers/${folder} "nook_gl|nook_nnao|glad" "only measurements draw")
endforeach()
foreach(folder import raytrace tensor character world nnao probe material synthesis transfer job api measure tool)
  forbid(bakers/${folder} "OpenImageIO" "only images knows OpenImageIO")
endforeach()
# Headers with Embree or with the instructions of one processor would keep half of the bakers from ARM64.
forbid(bakers "embree|[a-z]mmintrin|arm_neon|<intrin" "only sources of raytrace know Embree and the processor" "/bakers/raytrace/[^/]*[.]cpp$")
foreach(folder platform samples tests)
  forbid(${folder} "embree[0-9]*/" "only sources of bakers/raytrace know Embree")
endforeach()
forbid(bakers/tool "CLI/" "CLI11 costs every file seconds: take bakers/tool/command_line.h" "/(command_line|main|command_program)[.]cpp$")
forbid(bakers/lab/tool "CLI/" "CLI11 costs every file seconds: take bakers/tool/command_line.h" "/main[.]cpp$")
forbid(bakers/lab/crowd "nook_gl|glad" "the program draws what is measured"
       "/(debug_overlay|debug_shapes|timed_frames|main|light_file|crowd_options|panels|plain_look|dressed_bodies|given_values|motion_main|motion_scenes)[.](h|cpp)$")
foreach(sample offscreen minimal)
  room(samples/${sample} samples/${sample})
endforeach()
foreach(sample nnao probe clips)
  room(samples/${sample} samples/${sample} samples/offscreen platform/standard_streams.h)
endforeach()
room(samples/material samples/material platform)
room(samples/transfer samples/transfer samples/offscreen platform/standard_streams.h)
room(samples/gltf_viewer samples/gltf_viewer platform)
room(samples/hosts samples/hosts samples/gltf_viewer platform)
room(samples/crowd samples/crowd bakers/mannequin/mannequin.h platform)

# Sources are listed in their own room.
file(GLOB_RECURSE lists ${ROOT}/sdk/CMakeLists.txt ${ROOT}/bakers/CMakeLists.txt ${ROOT}/platform/CMakeLists.txt
     ${ROOT}/samples/CMakeLists.txt)
foreach(list ${lists})
  file(STRINGS ${list} lines REGEX "[.][.]/|PROJECT_SOURCE_DIR}/[^ ]*[.](c|cpp)[ )]?$")
  foreach(line ${lines})
    string(APPEND violations "${list}: ${line}\n  a list names sources of its own folder\n")
  endforeach()
endforeach()

if(violations)
  message(FATAL_ERROR "architecture: a room takes from where it must not\n${violations}")
endif()
