// The structs of the C interfaces grow, so that a caller compiled with an older or newer header passes fewer
// or more bytes than the library's struct has.
#pragma once

#include <nook/nook.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sdk/src/core/failure.h"

namespace nook {

// Throws VERSION unless headers of `version` fit this library: the major version must be the same, and the
// minor version not newer.
void check_version(std::uint32_t version);

// Fills the caller's struct of `size` bytes with `defaults`, and bytes beyond the library's struct with 0.
// first_size is the size of the struct in its first release.
template <class Desc>
void init_descriptor(Desc* desc, std::size_t size, std::uint32_t version, std::size_t first_size,
                     Desc defaults) {
  need(desc, "desc");
  if (size < first_size || size > UINT32_MAX)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "size is out of range (got %zu, need at least %zu); pass sizeof *desc", size, first_size);
  check_version(version);
  defaults.struct_size = static_cast<std::uint32_t>(size);
  defaults.header_version = version;
  std::memset(static_cast<void*>(desc), 0, size);
  std::memcpy(static_cast<void*>(desc), &defaults, std::min(size, sizeof defaults));
}

// Returns the caller's struct in this library's version: fields beyond the caller's size keep `defaults`.
// Fields that only a newer header has must be 0.
template <class Desc>
Desc read_descriptor(const Desc* desc, const char* init_function, std::size_t first_size, Desc defaults) {
  need(desc, "desc");
  const std::size_t size = desc->struct_size;
  if (size < first_size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.struct_size is too small (got %zu, need at least %zu); call %s", size, first_size,
                  init_function);
  check_version(desc->header_version);
  if (desc->next)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.next is not NULL; this library has no extensions, set it to NULL");
  const auto* bytes = reinterpret_cast<const unsigned char*>(desc);
  for (std::size_t i = sizeof(Desc); i < size; ++i)
    if (bytes[i])
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc holds fields that this library does not know (struct_size %zu, known %zu); use a "
                    "newer library",
                    size, sizeof(Desc));
  std::memcpy(static_cast<void*>(&defaults), desc, std::min(size, sizeof defaults));
  return defaults;
}

// Copies as much of `value` as the caller's struct holds. The caller's struct_size stays.
template <class Info>
void write_info(Info* info, std::size_t first_size, Info value) {
  need(info, "the struct for the answer");
  const std::size_t size = info->struct_size;
  if (size < first_size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "struct_size is too small (got %zu, need at least %zu); set it to sizeof", size,
                  first_size);
  value.struct_size = info->struct_size;
  std::memcpy(static_cast<void*>(info), &value, std::min(size, sizeof value));
}

}  // namespace nook
