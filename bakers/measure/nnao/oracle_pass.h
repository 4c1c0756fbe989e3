// The oracle integrates AO from about a thousand taps per pixel on the depth image. It has no tuned
// parameters.
#pragma once

#include "bakers/measure/nnao/gpu_image.h"

namespace nook::measure {

// `solid` assumes that all space behind a visible surface within the radius is solid, as horizon methods do.
// `bitmask` assumes that each visible surface is half a radius thick, and that light passes through the space
// behind it.
enum class Oracle { solid, bitmask };
inline constexpr Oracle all_oracles[] = {Oracle::solid, Oracle::bitmask};
inline constexpr int oracle_taps = 1024;

const char* oracle_name(Oracle oracle);  // the name in tables

class OraclePass {
 public:
  OraclePass(const GladGLContext& gl, int width, int height);
  ~OraclePass();
  OraclePass(const OraclePass&) = delete;
  OraclePass& operator=(const OraclePass&) = delete;

  // Returns the texture (R8) that holds the AO until the next call.
  GLuint draw(Oracle oracle, const GpuView& view, float radius) const;

 private:
  const GladGLContext& gl_;
  GLuint vertex_array_ = 0;
  GpuProgram program_;
  GpuImage image_;
};

}  // namespace nook::measure
