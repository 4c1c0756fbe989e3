# An overlay port that builds the checkout that contains it. A port in a registry would get its sources with vcpkg_from_git
# instead.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(options -DNOOK_BAKERS=OFF -DNOOK_SAMPLES=OFF -DNOOK_TESTS=OFF)
if("gl" IN_LIST FEATURES)
  # The generator of the OpenGL header is a Python package.
  vcpkg_find_acquire_program(PYTHON3)
  x_vcpkg_get_python_packages(PYTHON_EXECUTABLE "${PYTHON3}" PACKAGES glad2 OUT_PYTHON_VAR NOOK_PYTHON)
  get_filename_component(scripts "${NOOK_PYTHON}" DIRECTORY)
  find_program(NOOK_GLAD glad PATHS "${scripts}" "${scripts}/Scripts" NO_DEFAULT_PATH REQUIRED)
  list(APPEND options -DNOOK_GL=ON "-DGLAD_EXECUTABLE=${NOOK_GLAD}")
else()
  list(APPEND options -DNOOK_GL=OFF)
endif()

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS ${options})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/nook)
vcpkg_fixup_pkgconfig()
vcpkg_copy_pdbs()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
                    "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/NOTICE")
