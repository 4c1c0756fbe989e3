#include "bakers/lab/gpu_cost/vulkan_glsl.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace nook::lab {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (is_word(text[i])) {
      while (end < text.size() && is_word(text[end])) ++end;
    }
    if (!std::isspace(static_cast<unsigned char>(text[i]))) tokens.emplace_back(text.substr(i, end - i));
    i = end;
  }
  return tokens;
}

std::string joined(const std::vector<std::string>& tokens, std::size_t first, std::size_t last) {
  std::string text;
  for (std::size_t i = first; i < last; ++i) text += (i == first ? "" : " ") + tokens[i];
  return text;
}

// A global declaration up to its semicolon: `layout(...) qualifiers type name rest;`.
struct Declaration {
  std::string layout;  // the text between the parentheses
  std::vector<std::string> qualifiers;
  std::string type, name;
  std::string array;  // the array size with its brackets

  bool has(const char* qualifier) const {
    return std::find(qualifiers.begin(), qualifiers.end(), qualifier) != qualifiers.end();
  }
};

constexpr std::array qualifier_words = {"uniform",       "in",        "out",      "flat",      "smooth",
                                        "noperspective", "centroid",  "readonly", "writeonly", "coherent",
                                        "restrict",      "highp",     "mediump",  "lowp",      "const",
                                        "shared",        "invariant", "precise"};

Declaration parse(const std::vector<std::string>& tokens) {
  Declaration d;
  std::size_t i = 0;
  for (; i < tokens.size(); ++i) {
    if (tokens[i] == "layout") {
      const auto close = std::find(tokens.begin() + std::ptrdiff_t(i), tokens.end(), ")") - tokens.begin();
      d.layout = joined(tokens, i + 2, std::size_t(close));
      i = std::size_t(close);
    } else if (std::find(qualifier_words.begin(), qualifier_words.end(), tokens[i]) !=
               qualifier_words.end()) {
      d.qualifiers.push_back(tokens[i]);
    } else {
      break;
    }
  }
  if (i + 1 >= tokens.size()) return d;
  d.type = tokens[i];
  d.name = tokens[i + 1];
  const auto end = std::find(tokens.begin() + std::ptrdiff_t(i), tokens.end(), "=") - tokens.begin();
  d.array = joined(tokens, i + 2, std::size_t(end));
  return d;
}

// Returns the number in the brackets, or 0 if there are no brackets.
int elements_of(const std::string& brackets) {
  const std::size_t digits = brackets.find_first_of("0123456789");
  return digits == std::string::npos ? 0 : std::stoi(brackets.substr(digits));
}

class Converter {
 public:
  // Returns the declaration as Vulkan GLSL. Returns an empty string if the declaration is moved into the
  // uniform block.
  std::string declaration(const std::string& text) {
    const Declaration d = parse(tokens_of(text));
    if (d.name.empty()) return text + ";";
    if (d.has("uniform")) return uniform(d);
    if (d.has("in")) return stage_variable(d, "in", out_.inputs);
    if (d.has("out")) return stage_variable(d, "out", out_.outputs);
    return text + ";";
  }

  VulkanGlsl finish(const std::string& extensions, const std::string& body) {
    out_.text = "#version 450\n" + extensions;
    if (!members_.empty())
      out_.text += "layout(std140, set = " + std::to_string(uniform_set) +
                   ", binding = 0) uniform NookUniforms {\n" + members_ + "};\n";
    out_.text += body;
    return std::move(out_);
  }

 private:
  std::string uniform(const Declaration& d) {
    if (d.type.find("sampler") != std::string::npos) {
      out_.samplers.push_back(d.type);
      return "layout(set = " + std::to_string(sampler_set) +
             ", binding = " + std::to_string(out_.samplers.size() - 1) + ") uniform " + d.type + " " +
             d.name + ";";
    }
    if (d.type.find("image") != std::string::npos) {
      std::string text = "layout(set = " + std::to_string(image_set) + ", " + d.layout + ") ";
      for (const std::string& qualifier : d.qualifiers) text += qualifier + " ";
      return text + d.type + " " + d.name + ";";
    }
    members_ += "  " + d.type + " " + d.name + d.array + ";\n";
    out_.uniforms.push_back(d.name);
    return "";
  }

  std::string stage_variable(const Declaration& d, const char* direction,
                             std::vector<StageVariable>& variables) {
    int location = 0;
    for (const StageVariable& variable : variables) location += variable.locations();
    variables.push_back({d.type, d.name, d.has("flat"), elements_of(d.array)});
    return "layout(location = " + std::to_string(location) + ") " + (d.has("flat") ? "flat " : "") +
           direction + " " + d.type + " " + d.name + d.array + ";";
  }

  VulkanGlsl out_;
  std::string members_;
};

std::string renamed_builtins(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (is_word(text[i])) {
      while (end < text.size() && is_word(text[end])) ++end;
    }
    const std::string_view word(text.data() + i, end - i);
    if (word == "gl_VertexID")
      out += "gl_VertexIndex";
    else if (word == "gl_InstanceID")
      out += "gl_InstanceIndex";
    else
      out += word;
    i = end;
  }
  return out;
}

// Returns the position after the closing brace that belongs to the opening brace at `at`.
std::size_t end_of_braces(const std::string& text, std::size_t at) {
  int depth = 0;
  for (; at < text.size(); ++at) {
    if (text[at] == '{') ++depth;
    if (text[at] == '}' && --depth == 0) return at + 1;
  }
  throw std::runtime_error("nook_gpu_cost: a brace of the shader is not closed");
}

}  // namespace

VulkanGlsl to_vulkan_glsl(const std::string& preprocessed) {
  const std::string text = renamed_builtins(preprocessed);
  Converter converter;
  std::string extensions, body;
  for (std::size_t at = 0; at < text.size();) {
    if (std::isspace(static_cast<unsigned char>(text[at]))) {
      body += text[at++];
    } else if (text[at] == '#') {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      if (line.starts_with("#extension")) extensions += line + "\n";
      at = end;
    } else {
      const std::size_t end = text.find_first_of(";{", at);
      if (end == std::string::npos)
        throw std::runtime_error("nook_gpu_cost: the shader ends within a declaration");
      if (text[end] == ';') {
        body += converter.declaration(text.substr(at, end - at));
        at = end + 1;
      } else {
        const std::size_t close = end_of_braces(text, end);
        body += text.substr(at, close - at);
        // After the braces of a block or structure, there may be a name, and then a semicolon.
        at = close;
        const std::size_t next = text.find_first_not_of(" \n\t", at);
        if (next != std::string::npos && text[next] == ';') {
          body += ";";
          at = next + 1;
        }
      }
    }
  }
  return converter.finish(extensions, body);
}

}  // namespace nook::lab
