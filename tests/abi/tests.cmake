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

# nook_add_called_from_c_test(HEADER TARGET...): the C files of the test programs call every function of the header.
function(nook_add_called_from_c_test header)
  if(CMAKE_NM)
    foreach(target ${ARGN})
      list(APPEND objects "$<JOIN:$<FILTER:$<TARGET_OBJECTS:${target}>,INCLUDE,\\.c\\.o(bj)?$>,|>")
    endforeach()
    list(JOIN objects "|" objects)
    add_test(NAME called_from_c_${header}
             COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} -DHEADER=${PROJECT_SOURCE_DIR}/sdk/include/nook/${header}
                     "-DOBJECTS=${objects}"
                     -P ${nook_abi_dir}/called_from_c.cmake)
  endif()
endfunction()
