#include "samples/crowd/gpu_program.h"

#include "platform/program.h"

namespace crowd {

GpuProgram::GpuProgram(const GladGLContext& gl, const char* vertex_source,
                       std::initializer_list<const char*> fragment_sources)
    : gl_(gl), name_(platform::link_program(gl, {vertex_source}, fragment_sources)) {}

GpuProgram::~GpuProgram() {
  gl_.DeleteProgram(name_);
}

}  // namespace crowd
