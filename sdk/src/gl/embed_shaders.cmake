# cmake -DROOT=dir -DSHADERS=dir -DOUTPUT=file.cpp [-DHEADER=path -DNAMESPACE=name] -P embed_shaders.cmake
# Turns every *.vert, *.frag and *.comp file below SHADERS, and every host.glsl, which hosts put into shaders of their own, into
# one C++ source. A line `#include "path"` (relative to ROOT, the
# repository's) is replaced by that file's text, once per shader; the host needs no files at run time.
cmake_minimum_required(VERSION 3.25)

if(NOT HEADER)
  set(HEADER sdk/src/gl/embedded_shaders.h)
  set(NAMESPACE nook::gl)
endif()

function(nook_expand path included out)
  file(READ "${path}" text)
  # Semicolons and brackets would split or join the elements of CMake's lists.
  string(REPLACE ";" "@semicolon@" text "${text}")
  string(REPLACE "[" "@open@" text "${text}")
  string(REPLACE "]" "@close@" text "${text}")
  string(REPLACE "\\" "@backslash@" text "${text}")
  string(REPLACE "\n" ";" lines "${text}")
  set(result "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^#include \"([^\"]+)\"$")
      set(child "${CMAKE_MATCH_1}")
      if(NOT child IN_LIST included)
        list(APPEND included "${child}")
        nook_expand("${ROOT}/${child}" "${included}" child_text)
        list(APPEND included ${nook_included})
        list(REMOVE_DUPLICATES included)
        string(APPEND result "${child_text}")
      endif()
    else()
      string(APPEND result "${line}\n")
    endif()
  endforeach()
  set(${out} "${result}" PARENT_SCOPE)
  set(nook_included "${included}" PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE paths RELATIVE "${SHADERS}" "${SHADERS}/*.vert" "${SHADERS}/*.frag" "${SHADERS}/*.comp"
     "${SHADERS}/*/host.glsl")
list(SORT paths)
set(source "// Made from shaders at build; do not edit.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\nnamespace {\n")
set(table "")
set(number 0)
foreach(path IN LISTS paths)
  nook_expand("${SHADERS}/${path}" "" text)
  string(REPLACE "@semicolon@" ";" text "${text}")
  string(REPLACE "@open@" "[" text "${text}")
  string(REPLACE "@close@" "]" text "${text}")
  string(REPLACE "@backslash@" "\\" text "${text}")
  string(APPEND source "constexpr char shader_${number}[] = R\"glsl(${text})glsl\";\n")
  string(APPEND table "    {\"${path}\", shader_${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
string(APPEND source "constexpr EmbeddedShader shaders[] = {\n${table}};\n}  // namespace\n\n"
       "const EmbeddedShader* embedded_shaders_begin() { return shaders; }\n"
       "const EmbeddedShader* embedded_shaders_end() { return shaders + ${number}; }\n\n}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUTPUT}" "${source}")
