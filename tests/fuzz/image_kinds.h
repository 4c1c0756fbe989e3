// The meaning of the first byte of an input of the image target: it chooses the reader that gets the rest as
// a file, and its ending.
#pragma once

#include <array>
#include <cstddef>

namespace nook::test {

enum class ImageReader { texture, environment, measured, measured_file };

struct ImageKind {
  ImageReader reader;
  const char* ending;
};

inline constexpr std::array image_kinds{
    ImageKind{ImageReader::texture, "png"},     ImageKind{ImageReader::texture, "jpg"},
    ImageKind{ImageReader::environment, "hdr"}, ImageKind{ImageReader::environment, "exr"},
    ImageKind{ImageReader::measured, "png"},    ImageKind{ImageReader::measured, "jpg"},
    ImageKind{ImageReader::measured, "exr"},    ImageKind{ImageReader::measured, "hdr"},
    ImageKind{ImageReader::measured, "tif"},    ImageKind{ImageReader::measured, "bmp"},
    ImageKind{ImageReader::measured, "ppm"},    ImageKind{ImageReader::measured_file, "btf"}};

}  // namespace nook::test
