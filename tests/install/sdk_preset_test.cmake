# The preset sdk configures without the packages of the bakers, samples and tests. -DROOT= -DBUILD= -DC_COMPILER= -DCXX_COMPILER=
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${BUILD})
foreach(package embree TBB Eigen3 CLI11 PkgConfig nlohmann_json TinyGLTF glm Catch2 benchmark glfw3 OpenGL)
  list(APPEND absent -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} --preset sdk -S ${ROOT} -B ${BUILD} -DCMAKE_C_COMPILER=${C_COMPILER}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} ${absent})
