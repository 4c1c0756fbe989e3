// Handles the versions of structs in the C interfaces. New versions may append fields to a struct. If the
// caller was compiled with an older header, its struct is smaller than the library's struct. With a newer
// header, it is larger.
#pragma once

#include <nook/nook.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sdk/src/core/failure.h"

namespace nook {

// Throws VERSION unless a caller with headers of `version` can use this library. The major version must be
// equal, and the minor version must not be newer than the library's.
void check_version(std::uint32_t version);

// The properties of a descriptor type: its NOOK_DESC_ value, the name of its init function, and its defaults.
// Each library specialises these three for its descriptors. The specialisations are generated from the list
// in descriptor_list.h, which is in the folder of the library's C functions.
template <class Desc>
inline constexpr std::uint32_t descriptor_type = 0;
template <class Desc>
inline constexpr const char* descriptor_init = nullptr;
template <class Desc>
Desc default_desc();

// The size of a struct in release 1.0. When you append a field to a struct for the first time, specialise
// this with the old size.
template <class Struct>
inline constexpr std::size_t first_size = sizeof(Struct);

// Fills the caller's struct of `size` bytes with defaults. Any bytes after the library's struct become 0.
template <class Desc>
void init_descriptor(Desc* desc, std::size_t size, std::uint32_t version) {
  need(desc, "desc");
  if (size < first_size<Desc> || size > UINT32_MAX)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "size is out of range (got %zu, need at least %zu); pass sizeof *desc", size,
                  first_size<Desc>);
  check_version(version);
  Desc defaults = default_desc<Desc>();
  defaults.struct_size = static_cast<std::uint32_t>(size);
  defaults.type = descriptor_type<Desc>;
  std::memset(static_cast<void*>(desc), 0, size);
  std::memcpy(static_cast<void*>(desc), &defaults, std::min(size, sizeof defaults));
}

// The fields that all descriptors and extensions begin with.
struct DescriptorHead {
  std::uint32_t struct_size;
  std::uint32_t type;
  const void* next;
};

inline DescriptorHead head_of(const void* desc) {
  DescriptorHead head;
  std::memcpy(&head, desc, sizeof head);
  return head;
}

// Returns the first extension of this type in the chain that starts at a descriptor's `next`, or nullptr.
template <class Ext>
const Ext* find_extension(const void* next) {
  for (; next; next = head_of(next).next)
    if (head_of(next).type == descriptor_type<Ext>) return static_cast<const Ext*>(next);
  return nullptr;
}

// Throws if the chain contains an extension that is not one of the types Ext, or an extension twice.
template <class... Ext>
void check_extensions(const void* next) {
  if constexpr (sizeof...(Ext) == 0) {
    if (next)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.next is not NULL; this descriptor has no extensions, set it to NULL");
  } else {
    std::size_t seen[sizeof...(Ext)] = {};
    for (; next; next = head_of(next).next) {
      const std::uint32_t type = head_of(next).type;
      std::size_t i = 0, times = 0;
      ((type == descriptor_type<Ext> ? times = ++seen[i] : 0, ++i), ...);
      if (times == 0)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.next points to a descriptor that cannot extend this one (got type %u); remove it",
                      type);
      if (times > 1)
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "the list in desc.next contains two descriptors of the same type (got type %u); remove one",
            type);
    }
  }
}

// Returns a copy of the caller's struct in this library's version. Fields that are missing in the caller's
// struct get their defaults. Fields that this library does not know, from a newer header, must be 0. The
// struct's `next` may point to extensions of the types Ext; get them with find_extension. Read each extension
// with this function too, and pass the same list of types as Ext.
template <class Desc, class... Ext>
Desc read_descriptor(const Desc* desc) {
  need(desc, "desc");
  const std::size_t size = desc->struct_size;
  if (size < first_size<Desc>)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.struct_size is too small (got %zu, need at least %zu); call %s", size,
                  first_size<Desc>, descriptor_init<Desc>);
  if (desc->type != descriptor_type<Desc>)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.type belongs to another descriptor (got %u, need %u); call %s", desc->type,
                  descriptor_type<Desc>, descriptor_init<Desc>);
  check_extensions<Ext...>(desc->next);
  const auto* bytes = reinterpret_cast<const unsigned char*>(desc);
  for (std::size_t i = sizeof(Desc); i < size; ++i)
    if (bytes[i])
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc holds fields that this library does not know (struct_size %zu, known %zu); use a "
                    "newer library",
                    size, sizeof(Desc));
  Desc known = default_desc<Desc>();
  std::memcpy(static_cast<void*>(&known), desc, std::min(size, sizeof known));
  return known;
}

// Copies as much of `value` as fits into the caller's struct. The caller's struct_size stays unchanged.
template <class Info>
void write_info(Info* info, Info value) {
  need(info, "the struct for the answer");
  const std::size_t size = info->struct_size;
  if (size < first_size<Info>)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "struct_size is too small (got %zu, need at least %zu); set it to sizeof", size,
                  first_size<Info>);
  value.struct_size = info->struct_size;
  std::memcpy(static_cast<void*>(info), &value, std::min(size, sizeof value));
}

}  // namespace nook
