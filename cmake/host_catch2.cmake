# Catch2 for tests that are compiled for another machine. Catch2 2 consists only of headers, so a cross compiler can use the
# host's copy. The headers are copied to their own folder, because the cross compiler must not see other headers of the
# host.
find_path(NOOK_HOST_CATCH2 catch2/catch.hpp PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)
find_path(NOOK_HOST_CATCH2_MODULE Catch.cmake PATHS /usr/lib/cmake/Catch2 NO_CMAKE_FIND_ROOT_PATH)
if(NOT NOOK_HOST_CATCH2 OR NOT NOOK_HOST_CATCH2_MODULE)
  message(FATAL_ERROR "tests for another machine need the headers of Catch2 2 (got none, need catch2/catch.hpp); "
                      "install catch2 or set NOOK_HOST_CATCH2 and NOOK_HOST_CATCH2_MODULE")
endif()
list(APPEND CMAKE_MODULE_PATH ${NOOK_HOST_CATCH2_MODULE})
file(COPY ${NOOK_HOST_CATCH2}/catch2 DESTINATION ${CMAKE_BINARY_DIR}/host_headers)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/host_headers/catch_main.cpp
     CONTENT "#define CATCH_CONFIG_MAIN\n#include <catch2/catch.hpp>\n")
add_library(nook_host_catch2 STATIC ${CMAKE_BINARY_DIR}/host_headers/catch_main.cpp)
target_include_directories(nook_host_catch2 SYSTEM PUBLIC ${CMAKE_BINARY_DIR}/host_headers)
target_compile_features(nook_host_catch2 PUBLIC cxx_std_20)
add_library(Catch2::Catch2WithMain ALIAS nook_host_catch2)
