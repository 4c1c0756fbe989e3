# Installs the library, its headers, a package for find_package(nook) and a pkg-config file; all of them may be moved.
include(CMakePackageConfigHelpers)
set(nook_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nook)

install(TARGETS nook EXPORT nook_targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/nook DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
# What hosts may put into shaders of their own; the library holds the same text.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/probe DESTINATION ${CMAKE_INSTALL_DATADIR}/nook/shaders
        FILES_MATCHING PATTERN "*.glsl")
install(EXPORT nook_targets NAMESPACE nook:: DESTINATION ${nook_package_dir} FILE nook-config.cmake)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/nook-config-version.cmake COMPATIBILITY SameMajorVersion)
file(RELATIVE_PATH nook_pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" nook_pc_to_prefix ${nook_pc_to_prefix})
list(TRANSFORM nook_runtime PREPEND -l OUTPUT_VARIABLE nook_pc_libs)
list(JOIN nook_pc_libs " " nook_pc_libs)
configure_file(nook.pc.in ${CMAKE_CURRENT_BINARY_DIR}/nook.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nook-config-version.cmake DESTINATION ${nook_package_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nook.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
