// An environment map as the bytes of a .hdr file.
#pragma once

#include <string>

// A bluish sky over a dark ground, and a lamp of a hundred times its brightness.
inline std::string rgbe_map(int width, int height) {
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                     std::to_string(width) + "\n";
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      // Mantissas of 8 bits and a common exponent; the exponent 128 stands for values below 1.
      const bool lamp = y == height / 4 && x >= width / 4 && x < width / 4 + 2;
      const bool sky = y < height / 2;
      const unsigned char texel[4] = {
          static_cast<unsigned char>(sky ? 120 + x % 16 : 40 + y), static_cast<unsigned char>(sky ? 140 : 50),
          static_cast<unsigned char>(sky ? 200 - y : 30), static_cast<unsigned char>(lamp ? 136 : 128)};
      file.append(reinterpret_cast<const char*>(texel), 4);
    }
  return file;
}
