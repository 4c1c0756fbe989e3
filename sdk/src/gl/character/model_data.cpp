#include "sdk/src/gl/character/model_data.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {

Buffer static_buffer(Device& device, const char* label, const void* data, std::uint64_t bytes) {
  if (bytes > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "a model needs %llu bytes in one buffer, this OpenGL allows %llu; use a model with fewer vertices",
        static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(device.max_piece_bytes));
  return Buffer(device, label, bytes, data, GL_STATIC_DRAW);
}

}  // namespace nook::gl
