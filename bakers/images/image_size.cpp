#include "bakers/images/image_size.h"

#include "sdk/src/core/failure.h"

namespace nook::bake {

void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes) {
  // Deflate packs 1032 bytes into one, which are 8256 texels of one bit; a block of 64 texels takes a bit or
  // more of a JPEG, and an EXR file packs at most 11,000 of one colour into a byte.
  constexpr std::uintmax_t max_texels_per_byte = std::uintmax_t{1} << 14;
  if (width < 1 || height < 1 || std::size_t(width) > max_texels / std::size_t(height))
    throw Failure(NOOK_ERROR_BAD_FILE, "%.250s has %d x %d texels (need 1 to %zu); make it smaller", what,
                  width, height, max_texels);
  const std::uintmax_t texels = std::uintmax_t(width) * std::uintmax_t(height);
  if (texels / max_texels_per_byte > file_bytes)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%.250s says that it has %d x %d texels, too many for its %ju bytes; it is damaged", what,
                  width, height, file_bytes);
}

}  // namespace nook::bake
