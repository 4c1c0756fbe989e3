#include "sdk/src/core/checks.h"

#include <cstdint>
#include <cstdio>

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

NumberText::NumberText(double value) noexcept {
  std::snprintf(text_, sizeof text_, "%g", value);
}

void NumberText::write(const char* sign, std::uint64_t magnitude) noexcept {
  std::snprintf(text_, sizeof text_, "%s%llu", sign, static_cast<unsigned long long>(magnitude));
}

void fail_range(nook_result code, const char* name, const NumberText& got, const char* need) {
  throw Failure(code, "%s is out of range (got %s, need %s)", name, got.get(), need);
}

void fail_range(nook_result code, const char* name, const NumberText& got, const NumberText& low,
                const NumberText& high) {
  throw Failure(code, "%s is out of range (got %s, need %s to %s)", name, got.get(), low.get(), high.get());
}

void fail_unknown(const char* name, std::int32_t got, std::int32_t last) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is unknown (got %d, need 0 to %d)", name, got, last);
}

void check_at_most(const char* name, std::uint32_t value, std::uint32_t most) {
  if (value > most)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %u, need at most %u)", name, value,
                  most);
}

void check_switch(const char* name, std::int32_t value) {
  if (value != 0 && value != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is neither on nor off (got %d, need 0 or 1)", name, value);
}

namespace {

// Maximum size of an array. It is PTRDIFF_MAX, because differences of addresses are signed.
constexpr std::size_t max_array_bytes = PTRDIFF_MAX;

}  // namespace

std::size_t checked_stride(const char* name, std::size_t stride, std::size_t count,
                           std::size_t element_bytes) {
  if (stride == 0) stride = element_bytes;
  if (stride < element_bytes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is too small (got %zu bytes, need 0 or at least %zu)",
                  name, stride, element_bytes);
  if (count > 0 && stride > max_array_bytes / count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s is too large (got %zu bytes for each of %zu, need at most %zu)", name, stride, count,
                  max_array_bytes / count);
  return stride;
}

void check_array(const char* name, std::size_t count, std::size_t element_bytes) {
  if (count > max_array_bytes / element_bytes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is too large (got %zu, need at most %zu)", name, count,
                  max_array_bytes / element_bytes);
}

void check_index(const char* name, std::size_t index, std::size_t count) {
  if (index >= count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %zu, need less than %zu)", name,
                  index, count);
}

}  // namespace nook
