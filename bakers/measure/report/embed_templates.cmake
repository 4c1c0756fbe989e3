# cmake -DTEMPLATES=dir -DOUTPUT=file.cpp -P embed_templates.cmake
# Writes all files of TEMPLATES into one C++ source file, so that the tool needs no template files at run time.
cmake_minimum_required(VERSION 3.25)

file(GLOB paths RELATIVE "${TEMPLATES}" "${TEMPLATES}/*")
list(SORT paths)
set(source "// Made from templates at build; do not edit.\n#include \"bakers/measure/report/html.h\"\n\nnamespace nook::report {\nnamespace {\n")
set(table "")
set(number 0)
foreach(path IN LISTS paths)
  file(READ "${TEMPLATES}/${path}" text)
  # MSVC accepts at most 16,380 characters in one string literal, so long texts are split. The compiler
  # concatenates adjacent literals.
  set(literals "")
  string(LENGTH "${text}" length)
  foreach(at RANGE 0 ${length} 12000)
    string(SUBSTRING "${text}" ${at} 12000 piece)
    string(APPEND literals "\nR\"page(${piece})page\"")
  endforeach()
  string(APPEND source "constexpr char text_${number}[] =${literals};\n")
  string(APPEND table "    {\"${path}\", text_${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
string(APPEND source "constexpr Template templates[] = {\n${table}};\n}  // namespace\n\n"
       "const Template* templates_begin() { return templates; }\n"
       "const Template* templates_end() { return templates + ${number}; }\n\n}  // namespace nook::report\n")
file(WRITE "${OUTPUT}" "${source}")
