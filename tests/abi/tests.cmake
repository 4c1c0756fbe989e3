# The checks of each library's C interface; the scripts describe them.
set(nook_abi_dir ${CMAKE_CURRENT_LIST_DIR})

# nook_add_symbols_test(LIBRARY HEADER...): the library shows the functions of its headers and nothing else. The sanitizers add
# symbols of their own.
function(nook_add_symbols_test library)
  if(NOT CMAKE_NM OR NOOK_SANITIZE OR NOOK_SANITIZE_THREAD)
    return()
  endif()
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/sdk/include/nook/)
  add_test(NAME symbols_${library}
           COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} -DLIBRARY=$<TARGET_FILE:${library}> "-DHEADERS=$<JOIN:${ARGN},|>"
                   -P ${nook_abi_dir}/symbols.cmake)
endfunction()
