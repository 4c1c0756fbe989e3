#include "bakers/import/foreign_formats.h"

#include <string_view>

namespace nook::bake {
namespace {

using namespace std::string_view_literals;

struct Format {
  std::string_view begin;
  const char* name;
};

constexpr Format formats[] = {
    {"NOOK"sv, "a .nook file"},
    {"Kaydara FBX Binary"sv, "an FBX file"},
    {"; FBX"sv, "an FBX file"},
    {"BLENDER"sv, "a Blender file"},
    {"PXR-USDC"sv, "a USD file"},
    {"#usda"sv, "a USD file"},
    {"<?xml"sv, "an XML file, such as COLLADA"},
    {"PK\x03\x04"sv, "a ZIP archive"},
    {"\x1f\x8b"sv, "compressed by gzip"},
    {"\x28\xb5\x2f\xfd"sv, "compressed by Zstandard"},
    {"\xff\xfe"sv, "text in UTF-16"},
    {"\xfe\xff"sv, "text in UTF-16"},
    {"version https://git-lfs"sv, "a pointer of Git LFS, whose file was not fetched"}};

}  // namespace

const char* foreign_format(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Format& format : formats)
    if (text.starts_with(format.begin)) return format.name;
  return nullptr;
}

}  // namespace nook::bake
