// Image files, read and written by OpenImageIO. It needs more than 200 shared libraries, and loading them
// takes a third of a second. So a module holds all code that calls it, and a program loads the module with
// its first image.
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
  int tile_width = 0, tile_height = 0;  // 0 if the image has rows and no tiles
  std::string value_type;               // as OpenImageIO names it: uint8, uint16, half, float
  bool is_floating_point = false;
  std::vector<std::string> channel_names;
};

// An image whose head was read. Rows and columns count from its upper left. All functions that read return
// false if the image is damaged; why() is then the reason.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  virtual const ImageHead& head() const = 0;
  virtual const char* format_name() const = 0;
  // Read the first channels of the rows from `top` to before `bottom`. Images with tiles are read as a whole.
  virtual bool read_rows(int top, int bottom, int channels, float* values) = 0;
  virtual bool read_rows(int top, int bottom, int channels, std::uint8_t* values) = 0;
  // The region begins and ends at tiles' borders, or at the image's.
  virtual bool read_tiles(int left, int right, int top, int bottom, int channels, float* values) = 0;
  virtual std::string why() = 0;
};

// Some formats multiply colours by alpha; `unassociated` returns colours as files mean them.
enum class ImageAlpha { associated, unassociated };

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // Opens a file, or bytes that outlive the image, with one reader. `format` is the usual ending of its
  // names. Returns null if the reader refuses the image; `why` is then the reason.
  virtual std::unique_ptr<ImageSource> open(const std::string& format, const std::string& path,
                                            ImageAlpha alpha, std::string& why) const = 0;
  virtual std::unique_ptr<ImageSource> open(const std::string& format, std::span<const std::byte> bytes,
                                            ImageAlpha alpha, std::string& why) const = 0;
  // Encodes pixels, rows top first, in the format of the name's ending. Returns nothing on failure.
  virtual std::vector<std::byte> encode(const std::string& name, int width, int height, int channels,
                                        std::span<const std::uint8_t> pixels, std::string& why) const = 0;
};

// Loads the module once, from any thread. Throws std::runtime_error if it is missing.
const ImageCodec& image_codec();

}  // namespace platform
