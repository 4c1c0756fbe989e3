# Reads the version from nook.h, which is the only file that contains it. Sets nook_version for project(), and
# nook_version_text, which also has the suffix of a release candidate.
set(version_home ${CMAKE_CURRENT_LIST_DIR}/../sdk/include/nook/nook.h)
foreach(part MAJOR MINOR PATCH SUFFIX)
  file(STRINGS ${version_home} line REGEX "^#define NOOK_VERSION_${part} ")
  string(REGEX REPLACE "^#define NOOK_VERSION_${part} \"?([^\"]*)\"?$" "\\1" nook_version_${part} "${line}")
endforeach()
set(nook_version ${nook_version_MAJOR}.${nook_version_MINOR}.${nook_version_PATCH})
set(nook_version_text ${nook_version}${nook_version_SUFFIX})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${version_home})
