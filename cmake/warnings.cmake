# Compile options that every target of the project shares, set per target so that a host project never inherits them.
function(nook_target_options target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
                        CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                        POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wshadow>)
  if(NOOK_WERROR)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Werror>)
  endif()
  # Without these options, MSVC reads sources in the code page of the machine, accepts code that is not standard C++, and
  # sets __cplusplus to an old version. It also warns about standard C functions, such as fopen.
  if(MSVC)
    target_compile_options(${target} PRIVATE /utf-8 $<$<COMPILE_LANGUAGE:CXX>:/permissive- /Zc:__cplusplus>)
    target_compile_definitions(${target} PRIVATE _CRT_SECURE_NO_WARNINGS)
  endif()
  # Without this option, Emscripten disables exceptions. The library throws exceptions, and catches them in its C functions.
  if(EMSCRIPTEN)
    target_compile_options(${target} PRIVATE -fexceptions)
  endif()
  # A game needs a usable frame rate in its Debug build, too. If there are several -O options, GCC and Clang use the last
  # one. MSVC is left out, because it does not accept /O2 together with the /RTC1 of Debug.
  if(NOOK_OPTIMISE)
    target_compile_options(${target} PRIVATE
      $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<NOT:$<CONFIG:Release,RelWithDebInfo,MinSizeRel>>>:-O2>)
  endif()
  if(NOOK_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                           -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endif()
  if(NOOK_SANITIZE_THREAD)
    target_compile_options(${target} PRIVATE -fsanitize=thread)
    target_link_options(${target} PRIVATE -fsanitize=thread)
  endif()
endfunction()
