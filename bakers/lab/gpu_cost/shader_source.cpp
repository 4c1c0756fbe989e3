#include "bakers/lab/gpu_cost/shader_source.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>

namespace nook::lab {
namespace {

constexpr std::string_view include_begin = "#include \"";

void expand(const std::filesystem::path& root, const std::string& text, std::set<std::string>& included,
            std::string& out) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#version")) continue;
    if (!line.starts_with(include_begin) || line.back() != '"') {
      out += line + '\n';
      continue;
    }
    const std::string path = line.substr(include_begin.size(), line.size() - include_begin.size() - 1);
    if (included.insert(path).second) expand(root, file_text(root / path), included, out);
  }
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("nook_gpu_cost: cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string expand_includes(const std::filesystem::path& root, const std::string& text) {
  std::string out;
  std::set<std::string> included;
  expand(root, text, included, out);
  return out;
}

std::string with_version(Stage stage, const std::string& defines, const std::string& text) {
  return (stage == Stage::compute ? "#version 430 core\n" : "#version 330 core\n") + defines + text;
}

namespace {

struct Process {
  Process() { glslang_initialize_process(); }
  ~Process() { glslang_finalize_process(); }
};

glslang_stage_t glslang_stage(Stage stage) {
  switch (stage) {
    case Stage::vertex:
      return GLSLANG_STAGE_VERTEX;
    case Stage::fragment:
      return GLSLANG_STAGE_FRAGMENT;
    case Stage::compute:
      break;
  }
  return GLSLANG_STAGE_COMPUTE;
}

using Shader = std::unique_ptr<glslang_shader_t, void (*)(glslang_shader_t*)>;

glslang_input_t make_input(Stage stage, const std::string& text, glslang_client_t client) {
  static const Process process;
  glslang_input_t input = {};
  input.language = GLSLANG_SOURCE_GLSL;
  input.stage = glslang_stage(stage);
  input.client = client;
  input.client_version =
      client == GLSLANG_CLIENT_VULKAN ? GLSLANG_TARGET_VULKAN_1_1 : GLSLANG_TARGET_OPENGL_450;
  input.target_language = client == GLSLANG_CLIENT_VULKAN ? GLSLANG_TARGET_SPV : GLSLANG_TARGET_NONE;
  input.target_language_version = GLSLANG_TARGET_SPV_1_3;
  input.code = text.c_str();
  input.default_version = 450;
  input.default_profile = GLSLANG_CORE_PROFILE;
  int messages = GLSLANG_MSG_DEFAULT_BIT;
  if (client == GLSLANG_CLIENT_VULKAN) messages |= GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT;
  input.messages = static_cast<glslang_messages_t>(messages);
  input.resource = reinterpret_cast<const glslang_resource_t*>(glslang_default_resource());
  return input;
}

[[noreturn]] void fail(const std::string& what, const char* log) {
  throw std::runtime_error("nook_gpu_cost: " + what + " does not compile: " + log);
}

}  // namespace

std::string preprocess(Stage stage, const std::string& text) {
  const glslang_input_t input = make_input(stage, text, GLSLANG_CLIENT_OPENGL);
  const Shader shader(glslang_shader_create(&input), glslang_shader_delete);
  if (!glslang_shader_preprocess(shader.get(), &input))
    fail("a shader", glslang_shader_get_info_log(shader.get()));
  return glslang_shader_get_preprocessed_code(shader.get());
}

std::vector<std::uint32_t> compile_spirv(Stage stage, const std::string& text, const std::string& what) {
  const glslang_input_t input = make_input(stage, text, GLSLANG_CLIENT_VULKAN);
  const Shader shader(glslang_shader_create(&input), glslang_shader_delete);
  if (!glslang_shader_preprocess(shader.get(), &input) || !glslang_shader_parse(shader.get(), &input))
    fail(what, glslang_shader_get_info_log(shader.get()));
  const std::unique_ptr<glslang_program_t, void (*)(glslang_program_t*)> program(glslang_program_create(),
                                                                                 glslang_program_delete);
  glslang_program_add_shader(program.get(), shader.get());
  if (!glslang_program_link(program.get(), input.messages))
    fail(what, glslang_program_get_info_log(program.get()));
  glslang_program_SPIRV_generate(program.get(), input.stage);
  const unsigned* words = glslang_program_SPIRV_get_ptr(program.get());
  return {words, words + glslang_program_SPIRV_get_size(program.get())};
}

}  // namespace nook::lab
