#include "sdk/src/core/descriptors.h"

namespace nook {
namespace {

unsigned major_of(std::uint32_t version) {
  return version >> 22;
}
unsigned minor_of(std::uint32_t version) {
  return version >> 12 & 1023;
}

}  // namespace

void check_version(std::uint32_t version) {
  if (major_of(version) != NOOK_VERSION_MAJOR || minor_of(version) > NOOK_VERSION_MINOR)
    throw Failure(NOOK_ERROR_VERSION,
                  "the caller's headers do not fit this library (got version %u.%u, need %d.%d or older of "
                  "the same major version); pass NOOK_VERSION, or update the library",
                  major_of(version), minor_of(version), NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR);
}

}  // namespace nook
