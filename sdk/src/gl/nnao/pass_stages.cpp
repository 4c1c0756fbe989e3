#include "sdk/src/gl/nnao/pass_stages.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>

#include "sdk/src/core/floats.h"
#include "sdk/src/gl/nnao/network_shader.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/nnao/taps.h"

namespace nook::gl {
namespace {

static_assert(NOOK_NNAO_STAGE_CONSTANTS == 4 * (NOOK_FRAME_VEC4S + NOOK_EARLIER_VEC4S));

constexpr unsigned first_image_binding = 2;

// The samplers of the shaders, and the image that each one reads unless a stage overrides it.
struct ShaderImage {
  std::string_view sampler;
  nook_nnao_image image;
};
constexpr ShaderImage shader_images[] = {
    {"nook_host_depth", NOOK_NNAO_IMAGE_HOST_DEPTH}, {"nook_host_normal", NOOK_NNAO_IMAGE_HOST_NORMAL},
    {"nook_layer", NOOK_NNAO_IMAGE_HOST_GBUFFER_AO}, {"nook_motion", NOOK_NNAO_IMAGE_HOST_MOTION_VECTORS},
    {"nook_depth", NOOK_NNAO_IMAGE_DEPTH},           {"nook_ao", NOOK_NNAO_IMAGE_AO},
    {"nook_history", NOOK_NNAO_IMAGE_HISTORY_AO},    {"nook_history_depth", NOOK_NNAO_IMAGE_HISTORY_DEPTH}};

constexpr std::string_view blocks =
    "layout(NOOK_SET binding = 0, std140) uniform nook_frame_block {\n"
    "  highp vec4 nook_frame[NOOK_FRAME_VEC4S];\n"
    "  vec4 nook_earlier[NOOK_EARLIER_VEC4S];\n"
    "};\n";
constexpr std::string_view network_block =
    "layout(NOOK_SET binding = 1, std140) uniform nook_network_block {\n"
    "  vec4 nook_network[NOOK_HORIZON_VEC4S];\n"
    "  ivec4 nook_groups;\n"
    "};\n";
// The start of the text for Vulkan, which has descriptor sets and a different name for the vertex index.
constexpr std::string_view head =
    "#version 450\n"
    "#ifdef VULKAN\n#define NOOK_SET set = 0,\n#define NOOK_VERTEX gl_VertexIndex\n"
    "#else\n#define NOOK_SET\n#define NOOK_VERTEX gl_VertexID\n#endif\n";

bool begins_with(std::string_view line, std::string_view start) {
  return line.substr(0, start.size()) == start;
}

// Returns `name` from a declaration `uniform type name;`.
std::string_view declared_name(std::string_view line) {
  const std::string_view before = line.substr(0, line.find(';'));
  return before.substr(before.rfind(' ') + 1);
}

// Appends the declaration of a sampler with its binding. Samplers that other forms of the pass use get no
// binding: the #define lines exclude the code that declares them.
void append_sampler(String& out, std::string_view line, std::span<const std::string_view> samplers) {
  const auto found = std::find(samplers.begin(), samplers.end(), declared_name(line));
  char layout[48] = "";
  if (found != samplers.end())
    std::snprintf(layout, sizeof layout, "layout(NOOK_SET binding = %u) ",
                  first_image_binding + unsigned(found - samplers.begin()));
  out.append(layout).append(line).append("\n");
}

// Converts one line of the pass's shaders to the form for hosts. Uniforms outside blocks become members of
// uniform blocks.
void append_line(String& out, std::string_view line, std::span<const std::string_view> samplers) {
  if (begins_with(line, "uniform highp vec4 nook_frame["))
    out.append(blocks);
  else if (begins_with(line, "uniform vec4 nook_network["))
    out.append(network_block);
  else if (begins_with(line, "uniform vec4 nook_earlier["))
    return;
  else if (begins_with(line, "uniform int nook_tap_groups;"))
    out.append("#define nook_tap_groups nook_groups.x\n");
  else if (begins_with(line, "uniform "))
    append_sampler(out, line, samplers);
  else if (begins_with(line, "out "))
    out.append("layout(location = 0) ").append(line).append("\n");
  else
    out.append(line).append("\n");
}

String converted(std::string_view text, std::string_view defines, std::span<const std::string_view> samplers,
                 Memory* memory) {
  String out(head, memory);
  out.append(defines);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    append_line(out, text.substr(0, end), samplers);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

String vertex_text(Memory* memory) {
  String text = converted(embedded_text("nnao/screen.vert"), "", {}, memory);
  constexpr std::string_view name = "gl_VertexID";
  for (std::size_t at = head.size(); (at = text.find(name, at)) != String::npos;)
    text.replace(at, name.size(), "NOOK_VERTEX");
  return text;
}

class StageList {
 public:
  StageList(const NnaoSettings& desc, const nnao::TapGrid& grid, PassStages& out, Memory* memory)
      : defines_(pass_defines(desc, true, grid)), out_(out), memory_(memory) {}

  // `ao` is the image that the sampler nook_ao reads.
  void add(const char* name, const char* path, nook_nnao_image output,
           std::initializer_list<std::string_view> samplers, nook_nnao_image ao = NOOK_NNAO_IMAGE_AO,
           const char* more_defines = "") {
    StageText stage(memory_);
    stage.name = name;
    String defines(defines_.text, memory_);
    defines.append(more_defines);
    stage.fragment = converted(embedded_text(path), defines, {samplers.begin(), samplers.size()}, memory_);
    stage.output = output;
    stage.draws_viewport = output == NOOK_NNAO_IMAGE_TARGET;
    stage.reads_network = std::strcmp(name, "occlusion") == 0;
    for (const std::string_view sampler : samplers) {
      const auto* const found =
          std::find_if(std::begin(shader_images), std::end(shader_images),
                       [&](const ShaderImage& image) { return image.sampler == sampler; });
      stage.inputs[stage.input_count++] = sampler == "nook_ao" ? ao : found->image;
    }
    out_.stages.push_back(std::move(stage));
  }

 private:
  PassDefines defines_;
  PassStages& out_;
  Memory* memory_;
};

bool uses(const nook_nnao_desc& desc, nook_nnao_image image) {
  switch (image) {
    case NOOK_NNAO_IMAGE_DEPTH:
    case NOOK_NNAO_IMAGE_AO:
    case NOOK_NNAO_IMAGE_TARGET:
      return true;
    case NOOK_NNAO_IMAGE_FILTERED:
      return filter_draws(desc) > 0;
    case NOOK_NNAO_IMAGE_ACCUMULATED_AO:
    case NOOK_NNAO_IMAGE_HISTORY_DEPTH:
    case NOOK_NNAO_IMAGE_HISTORY_AO:
      return desc.max_history_frames != 0;
    default:
      return false;
  }
}

nook_nnao_format format_of(const nook_nnao_desc& desc, nook_nnao_image image) {
  switch (image) {
    case NOOK_NNAO_IMAGE_DEPTH:
    case NOOK_NNAO_IMAGE_HISTORY_DEPTH:
      return desc.normal_samples ? NOOK_NNAO_FORMAT_R32G32_UINT : NOOK_NNAO_FORMAT_R32_UINT;
    case NOOK_NNAO_IMAGE_ACCUMULATED_AO:
    case NOOK_NNAO_IMAGE_HISTORY_AO:
      return NOOK_NNAO_FORMAT_R8G8B8A8_UNORM;
    case NOOK_NNAO_IMAGE_TARGET:
      return desc.bent_normals ? NOOK_NNAO_FORMAT_R8G8B8A8_UNORM : NOOK_NNAO_FORMAT_R8_UNORM;
    default:
      return desc.bent_normals ? NOOK_NNAO_FORMAT_R8G8B8A8_UNORM : NOOK_NNAO_FORMAT_R8G8_UNORM;
  }
}

}  // namespace

PassStages pass_stages(const NnaoSettings& desc, const nnao::Network& network, Memory* memory) {
  const nnao::TapGrid grid = nnao::horizon_grid(std::uint32_t(desc.taps));
  PassStages out(memory);
  out.vertex = vertex_text(memory);
  out.network = network_constants(network, grid, memory);
  out.network.resize(4 * NOOK_HORIZON_VEC4S);
  out.network.push_back(bit_cast<float>(grid.directions));
  out.network.resize(out.network.size() + 3);
  StageList list(desc, grid, out, memory);
  list.add("depth", "nnao/depth.frag", NOOK_NNAO_IMAGE_DEPTH, {"nook_host_depth"});
  list.add("depth_apart", "nnao/depth.frag", NOOK_NNAO_IMAGE_DEPTH, {"nook_host_depth", "nook_layer"},
           NOOK_NNAO_IMAGE_AO, "#define NOOK_NO_SURFACE_ABOVE NOOK_EXCLUDED_ABOVE\n");
  list.add("occlusion", "nnao/occlusion.frag", NOOK_NNAO_IMAGE_AO, {"nook_depth", "nook_host_normal"});
  nook_nnao_image ao = NOOK_NNAO_IMAGE_AO;
  if (desc.max_history_frames) {
    list.add("accumulate", "nnao/accumulate.frag", NOOK_NNAO_IMAGE_ACCUMULATED_AO,
             {"nook_depth", "nook_ao", "nook_history", "nook_history_depth", "nook_motion"});
    ao = NOOK_NNAO_IMAGE_ACCUMULATED_AO;
  }
  for (int filter = 0; filter < filter_draws(desc); ++filter) {
    const nook_nnao_image to = filter % 2 == 0 ? NOOK_NNAO_IMAGE_FILTERED : NOOK_NNAO_IMAGE_AO;
    const bool along_y = filter % 2 == 1;
    list.add(along_y ? "filter_y" : "filter_x", "nnao/filter.frag", to, {"nook_ao"}, ao,
             along_y ? "#define NOOK_FILTER_ALONG_Y 1\n" : "");
    ao = to;
  }
  const auto resolve = [&](const char* name, const char* more, bool layered) {
    const auto add = [&](std::initializer_list<std::string_view> samplers) {
      list.add(name, "nnao/resolve.frag", NOOK_NNAO_IMAGE_TARGET, samplers, ao, more);
    };
    if (desc.half_resolution && layered)
      add({"nook_ao", "nook_depth", "nook_host_depth", "nook_layer"});
    else if (desc.half_resolution)
      add({"nook_ao", "nook_depth", "nook_host_depth"});
    else if (layered)
      add({"nook_ao", "nook_layer"});
    else
      add({"nook_ao"});
  };
  resolve("resolve", "", false);
  resolve("resolve_layered", "#define NOOK_LAYERED 1\n", true);
  return out;
}

nook_nnao_image_info stage_image(const nook_nnao_desc& desc, nook_nnao_image image) {
  nook_nnao_image_info info{};
  if (!uses(desc, image)) return info;
  const bool half = desc.half_resolution && image != NOOK_NNAO_IMAGE_TARGET;
  info.format = format_of(desc, image);
  info.width = surface_length(desc.max_width, half);
  info.height = surface_length(desc.max_height, half);
  return info;
}

std::uint32_t drawn_stages(std::size_t count, nook_gbuffer_ao layer) {
  const std::size_t skipped_depth = layer == NOOK_GBUFFER_AO_EXCLUDE ? 0 : 1;
  const std::size_t skipped_resolve = layer == NOOK_GBUFFER_AO_NONE ? count - 1 : count - 2;
  return ((1u << count) - 1) & ~(1u << skipped_depth) & ~(1u << skipped_resolve);
}

nook_nnao_frame_values frame_values(const nook_nnao_desc& desc, const NnaoFrame& frame,
                                    const NnaoFrame* earlier, std::uint32_t number, int layer) {
  const auto constants_of = [&](const NnaoFrame& of) {
    return frame_constants(layer_frame(of, layer), desc, number, layer);
  };
  const auto surface_of = [&](const NnaoFrame& of) {
    const Viewport viewport = viewport_of(of);
    const bool half = desc.half_resolution != 0;
    return Viewport{0, 0, surface_length(viewport.width, half), surface_length(viewport.height, half)};
  };
  const FrameConstants constants = constants_of(frame);
  const Viewport viewport = viewport_of(frame), surface = surface_of(frame);
  EarlierFrame before;
  if (earlier) {
    const Viewport size = surface_of(*earlier);
    before = {number, true, constants_of(*earlier), size.width, size.height, {}};
    const NnaoFrame one = layer_frame(*earlier, layer);
    std::copy(std::begin(one.view), std::end(one.view), before.view);
  }
  const HistoryConstants history = history_constants(layer_frame(frame, layer), desc, constants, before);
  nook_nnao_frame_values values{};
  values.surface_width = surface.width;
  values.surface_height = surface.height;
  const int box[] = {viewport.x, viewport.y, viewport.width, viewport.height};
  std::copy(std::begin(box), std::end(box), values.viewport);
  const auto end = std::copy(constants.values.begin(), constants.values.end(), values.constants);
  std::copy(history.begin(), history.end(), end);
  return values;
}

}  // namespace nook::gl
