# Levels are made by the bakers, of which these tests need no other part.
add_executable(nook_scene_tests
  ${PROJECT_SOURCE_DIR}/bakers/character/levels.cpp
  ${PROJECT_SOURCE_DIR}/bakers/raytrace/instruction_set.cpp
  bent_normal_test.cpp
  body_check_test.cpp
  clips_test.cpp
  model_file_test.cpp
  pose_source_test.cpp
  posed_shapes_test.cpp
  scene_test.cpp
  scene_casters_test.cpp
  scene_light_test.cpp
  scene_levels_test.cpp
  scene_pool_test.cpp
  sphere_groups_test.cpp)
nook_target_options(nook_scene_tests)
target_include_directories(nook_scene_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(nook_scene_tests PRIVATE nook_rooms Threads::Threads Catch2::Catch2WithMain)
catch_discover_tests(nook_scene_tests)
