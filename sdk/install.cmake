# Installs the library, its headers, its licence, a package for find_package(nook) and a pkg-config file; all of them may be
# moved.
include(CMakePackageConfigHelpers)
set(nook_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nook)

install(TARGETS nook EXPORT nook_targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# Headers of the bakers come with the library of the bakers.
set(nook_absent_headers PATTERN "nook_bake*.h*" EXCLUDE PATTERN "nook_trace.h*" EXCLUDE)
if(NOT NOOK_GL)
  list(APPEND nook_absent_headers PATTERN "nook_gl.h*" EXCLUDE PATTERN "nook_nnao.h*" EXCLUDE PATTERN "nook_world.h*" EXCLUDE
       PATTERN "nook_stages.h*" EXCLUDE PATTERN "nook_capture.h*" EXCLUDE PATTERN "nook_transfer.hpp" EXCLUDE PATTERN "nook_synthesis.hpp" EXCLUDE)
endif()
install(DIRECTORY include/nook DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" ${nook_absent_headers})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/nook)
# What hosts may put into shaders of their own; the library holds the same text.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/probe DESTINATION ${CMAKE_INSTALL_DATADIR}/nook/shaders
        FILES_MATCHING PATTERN "*.glsl")
install(EXPORT nook_targets NAMESPACE nook:: DESTINATION ${nook_package_dir})
configure_package_config_file(nook-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/nook-config.cmake
                              INSTALL_DESTINATION ${nook_package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/nook-config-version.cmake COMPATIBILITY SameMajorVersion)
file(RELATIVE_PATH nook_pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" nook_pc_to_prefix ${nook_pc_to_prefix})
list(TRANSFORM nook_runtime PREPEND -l OUTPUT_VARIABLE nook_pc_libs)
list(JOIN nook_pc_libs " " nook_pc_libs)
# Where the static library is the only one, every host needs what pkg-config keeps for --static elsewhere.
if(nook_type STREQUAL "STATIC_LIBRARY")
  set(nook_pc_flags "Cflags: -I\${includedir} -DNOOK_STATIC\nLibs: -L\${libdir} -lnook ${nook_pc_libs}")
else()
  set(nook_pc_flags "Cflags: -I\${includedir}\nCflags.private: -DNOOK_STATIC\n")
  string(APPEND nook_pc_flags "Libs: -L\${libdir} -lnook\nLibs.private: ${nook_pc_libs}")
endif()
if(NOOK_GL)
  set(nook_pc_gl yes)
else()
  set(nook_pc_gl no)
endif()
configure_file(nook.pc.in ${CMAKE_CURRENT_BINARY_DIR}/nook.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nook-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/nook-config-version.cmake
        DESTINATION ${nook_package_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nook.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
