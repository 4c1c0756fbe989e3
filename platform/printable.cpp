#include "platform/printable.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace platform {
namespace {

// Decodes the first character of a text to its code point. Returns the length of the character in bytes, or 0
// if the bytes are not valid UTF-8 (RFC 3629).
std::size_t decode(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  code = byte(0);
  if (code < 0x80) return 1;
  const std::size_t size = code >= 0xf0 ? 4 : code >= 0xe0 ? 3 : 2;
  if (code < 0xc2 || code > 0xf4 || text.size() < size) return 0;
  code &= 0x7fu >> size;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // the smallest code point that needs this
                                                                   // many bytes
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < least[size] || code > 0x10ffff || surrogate ? 0 : size;
}

bool is_harmless(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code <= 0x9f);
  const bool separates_lines = code == 0x2028 || code == 0x2029;
  const bool turns_direction = code == 0x200e || code == 0x200f || code == 0x061c ||
                               (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return !control && !separates_lines && !turns_direction;
}

std::string escape(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    char hex[5];
    std::snprintf(hex, sizeof hex, "\\x%02x", unsigned(static_cast<unsigned char>(c)));
    text += hex;
  }
  return text;
}

std::string clean(std::string_view text, bool keep_line_feeds) {
  std::string result;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t valid = decode(text, code), size = std::max<std::size_t>(valid, 1);
    const bool kept = valid > 0 && (is_harmless(code) || (keep_line_feeds && code == '\n'));
    result += kept ? std::string(text.substr(0, size)) : escape(text.substr(0, size));
    text.remove_prefix(size);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return clean(text, false);
}

std::string printable_lines(std::string_view text) {
  return clean(text, true);
}

}  // namespace platform
