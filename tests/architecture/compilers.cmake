# Fails when a source of the library uses what one compiler has only: attributes, builtins and pragmas of GCC and Clang, which
# MSVC lacks. sdk/src/core/compiler.h and prefetch.h wrap those that are needed; nook.h has the export macro, and processor.cpp queries
# the processor.
cmake_minimum_required(VERSION 3.25)
set(excepted sdk/src/core/compiler.h sdk/src/core/prefetch.h sdk/include/nook/nook.h sdk/src/core/processor.cpp)
set(extensions "__attribute__|__builtin_|__extension__|__typeof__|__int128|__PRETTY_FUNCTION__|__asm__|\\[\\[(gnu|clang)::|#[ ]*pragma[ ]+(GCC|clang)|<(unistd|sys/|pthread|strings|alloca)")
set(violations "")
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/sdk/*.h ${ROOT}/sdk/*.hpp ${ROOT}/sdk/*.cpp ${ROOT}/sdk/*.inl
     ${ROOT}/shaders/*.h)
if(NOT files)
  message(FATAL_ERROR "compilers: sdk holds no source; the rule on it checks nothing")
endif()
list(REMOVE_ITEM files ${excepted})
foreach(file ${files})
  file(STRINGS ${ROOT}/${file} lines REGEX "${extensions}")
  foreach(line IN LISTS lines)
    string(APPEND violations "${file}: ${line}\n")
  endforeach()
endforeach()
if(violations)
  message(FATAL_ERROR "compilers: MSVC does not have this; sdk/src/core/compiler.h is the place for it\n${violations}")
endif()
