// Reads and writes image files with OpenImageIO. OpenImageIO needs more than 200 shared libraries, and
// loading them takes a third of a second. So all code that calls OpenImageIO is in a module, and a program
// loads this module when it uses its first image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace platform {

struct ImageHead {
  int width = 0, height = 0;
  int depth = 1;  // layers of a volume
  int channels = 0;
  int tile_width = 0, tile_height = 0;  // 0 if the image is stored in rows
  std::string value_type;               // name of the type in OpenImageIO: uint8, uint16, half, float
  bool is_floating_point = false;
  std::vector<std::string> channel_names;
};

// An image whose header was read. Rows and columns are counted from the upper left corner. The read functions
// return false if the image is damaged; why() then returns the reason.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  virtual const ImageHead& head() const = 0;
  virtual const char* format_name() const = 0;
  // Reads the first `channels` channels of the rows `top` to `bottom` - 1. An image with tiles must be read
  // as a whole.
  virtual bool read_rows(int top, int bottom, int channels, float* values) = 0;
  virtual bool read_rows(int top, int bottom, int channels, std::uint8_t* values) = 0;
  // Each side of the region must be at the border of a tile or of the image.
  virtual bool read_tiles(int left, int right, int top, int bottom, int channels, float* values) = 0;
  virtual std::string why() = 0;
};

// In some formats, colours are multiplied by alpha. With `unassociated`, colours are returned without this
// multiplication.
enum class ImageAlpha { associated, unassociated };

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // Opens a file with the reader for one format, or opens bytes, which must outlive the image. `format` is
  // the usual file extension of the format. Returns null if the reader cannot read the image; `why` is then
  // the reason.
  virtual std::unique_ptr<ImageSource> open(const std::string& format, const std::string& path,
                                            ImageAlpha alpha, std::string& why) const = 0;
  virtual std::unique_ptr<ImageSource> open(const std::string& format, std::span<const std::byte> bytes,
                                            ImageAlpha alpha, std::string& why) const = 0;
  // Encodes pixels, top row first, in the format of the name's extension. Returns an empty vector on failure.
  virtual std::vector<std::byte> encode(const std::string& name, int width, int height, int channels,
                                        std::span<const std::uint8_t> pixels, std::string& why) const = 0;
};

// Loads the module once, from any thread. Throws std::runtime_error if it is missing.
const ImageCodec& image_codec();

}  // namespace platform
