# Builds the library without its OpenGL half, by the preset, and without glad. The install test of that build comes after it.
# -DROOT= -DBUILD= -DC_COMPILER= -DCXX_COMPILER= -DLAUNCHER= -DWERROR= -DSHARED=
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
# The build goes without optimisation, which takes a third of the compiler's time and changes nothing of what is tested here.
run(${CMAKE_COMMAND} --preset cpu-only -S ${ROOT} -B ${BUILD} -DCMAKE_C_COMPILER=${C_COMPILER}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DNOOK_WERROR=${WERROR}
    -DBUILD_SHARED_LIBS=${SHARED} -DGLAD_EXECUTABLE=absent
    "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG")
run(${CMAKE_COMMAND} --build ${BUILD})
# The wrappers do without the headers that are not installed.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${BUILD}/prefix)
run(${CXX_COMPILER} -x c++ -std=c++17 -Wall -Wextra -pedantic -Werror -fsyntax-only -I ${BUILD}/prefix/include
    -include nook/nook.hpp /dev/null)
