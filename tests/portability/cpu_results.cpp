// The numbers of the library on one platform, for comparison with another: AO and directional
// occlusion of a scene, fits of probes, the light of lobes and a material, by the C functions alone.
//
// cpu_results run CHARACTER.nook MATERIAL.nook VALUES
//   evaluates everything with each instruction set that the library has here, prints one hash of the bits for
//   each set, and writes the values. "all" stands for what no instruction set is chosen for.
// cpu_results compare VALUES VALUES AO_BOUND LIGHT_BOUND MATERIAL_BOUND [SET SET]
//   prints the largest differences between two files, for each instruction set of both or for the two named
//   ones, and fails above a bound. AO and materials are compared absolutely, light relative to the largest
//   magnitude.
#include <nook/experimental/nook_sg.h>
#include <nook/nook_character.h>
#include <nook/nook_material.h>
#include <nook/nook_probe.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace {

[[noreturn]] void fail(const std::string& text) {
  std::fprintf(stderr, "cpu_results: %s\n", text.c_str());
  std::exit(1);
}

void check(nook_result result) {
  if (result != NOOK_OK) fail(nook_last_message());
}

// rows_3x4 has a rest-to-world matrix for each bone, three rows of four.
nook_result set_pose(nook_scene scene, nook_instance_id instance, const float* rows_3x4,
                     std::uint32_t bone_count) {
  nook_pose_desc desc;
  check(nook_pose_desc_init(&desc));
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transforms = rows_3x4;
  desc.transform_count = bone_count;
  return nook_scene_set_pose(scene, instance, &desc);
}

// ---- Inputs: sums, products, quotients and square roots of floats alone, which have the same bits
// everywhere ----

// Numerical Recipes' linear congruential generator.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  float between(float low, float high) {
    state_ = state_ * 1664525u + 1013904223u;
    return low + (high - low) * (static_cast<float>(state_ >> 8) / 16777216.0f);
  }
  std::array<float, 3> direction() {
    for (;;) {
      const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
      const float square = x * x + y * y + z * z;
      if (square < 0.01f || square > 1) continue;
      const float norm = std::sqrt(square);
      return {x / norm, y / norm, z / norm};
    }
  }

 private:
  std::uint32_t state_;
};

// The turn of the quaternion (x, y, z, 1) with parts in [-amount, amount], and a move: a matrix of three
// rows.
void append_frame(std::vector<float>& rows, Numbers& numbers, float amount, std::array<float, 3> move) {
  const float x = numbers.between(-amount, amount), y = numbers.between(-amount, amount),
              z = numbers.between(-amount, amount), s = 2 / (x * x + y * y + z * z + 1);
  const float matrix[12] = {
      1 - s * (y * y + z * z), s * (x * y - z),         s * (x * z + y),         move[0],
      s * (x * y + z),         1 - s * (x * x + z * z), s * (y * z - x),         move[1],
      s * (x * z - y),         s * (y * z + x),         1 - s * (x * x + y * y), move[2]};
  rows.insert(rows.end(), matrix, matrix + 12);
}

std::vector<nook_lobe> some_lobes(std::uint32_t count) {
  Numbers numbers(11);
  std::vector<nook_lobe> lobes(count);
  for (nook_lobe& lobe : lobes) {
    lobe = {};
    const std::array<float, 3> axis = numbers.direction();
    std::copy(axis.begin(), axis.end(), lobe.axis);
    lobe.sharpness = numbers.between(1, 20);
    for (float& channel : lobe.amplitude) channel = numbers.between(0, 2);
  }
  return lobes;
}

std::vector<float> directions(std::uint32_t seed, std::size_t count) {
  Numbers numbers(seed);
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<float, 3> d = numbers.direction();
    values.insert(values.end(), d.begin(), d.end());
  }
  return values;
}

// A smooth sky with one bright side, which is never negative.
std::vector<float> sky(const std::vector<float>& directions_of) {
  std::vector<float> radiance;
  for (std::size_t i = 0; i < directions_of.size(); i += 3) {
    const float x = directions_of[i], y = directions_of[i + 1], z = directions_of[i + 2];
    const float side = (1 + x) * (1 + x) * (1 + x) * (1 + x);
    radiance.insert(radiance.end(), {0.2f + side, 0.3f + 0.2f * y + 0.8f * side, 0.5f + 0.4f * z * z});
  }
  return radiance;
}

// ---- Values ----

enum class Kind : std::uint32_t { ao, light, material };
constexpr const char* kind_names[] = {"AO", "light", "material"};

struct Section {
  std::string set, name;  // of at most 15 characters
  Kind kind;
  std::vector<float> values;
};
using Sections = std::vector<Section>;

constexpr const char* set_names[] = {"auto", "scalar", "sse2", "avx2", "avx512", "neon", "wasm128"};

std::string set_name(nook_isa isa) {
  return isa < nook_isa(std::size(set_names)) ? set_names[isa] : "set " + std::to_string(isa);
}

// FNV-1a over the 32-bit words.
std::uint64_t hash_of(const Sections& sections, std::string_view set) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Section& section : sections) {
    if (section.set != set) continue;
    for (const float value : section.values) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3;
    }
  }
  return hash;
}

std::vector<std::uint8_t> read_file(const char* path) {
  std::FILE* const file = std::fopen(path, "rb");
  if (!file) fail(std::string(path) + " cannot be read");
  std::vector<std::uint8_t> bytes;
  std::uint8_t block[65536];
  for (std::size_t n; (n = std::fread(block, 1, sizeof block, file)) > 0;)
    bytes.insert(bytes.end(), block, block + n);
  std::fclose(file);
  return bytes;
}

// A section of the file: two names of 16 bytes, kind and count as 32-bit numbers, then the floats;
// little-endian, as all platforms of the library are.
void write_sections(const char* path, const Sections& sections) {
  std::FILE* const file = std::fopen(path, "wb");
  if (!file) fail(std::string(path) + " cannot be written");
  bool good = true;
  for (const Section& section : sections) {
    char names[32] = {};
    section.set.copy(names, 15);
    section.name.copy(names + 16, 15);
    const std::uint32_t head[2] = {std::uint32_t(section.kind), std::uint32_t(section.values.size())};
    good = good && std::fwrite(names, sizeof names, 1, file) == 1 &&
           std::fwrite(head, sizeof head, 1, file) == 1 &&
           std::fwrite(section.values.data(), sizeof(float), section.values.size(), file) ==
               section.values.size();
  }
  if (std::fclose(file) != 0 || !good) fail(std::string(path) + " cannot be written");
}

Sections read_sections(const char* path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  Sections sections;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint32_t head[2];
    if (bytes.size() - at < 32 + sizeof head) fail(std::string(path) + " is cut");
    const char* const names = reinterpret_cast<const char*>(&bytes[at]);
    std::memcpy(head, &bytes[at + 32], sizeof head);
    at += 32 + sizeof head;
    if (head[0] > 2 || (bytes.size() - at) / sizeof(float) < head[1]) fail(std::string(path) + " is cut");
    sections.push_back({names, names + 16, Kind(head[0]), std::vector<float>(head[1])});
    if (head[1] > 0) std::memcpy(sections.back().values.data(), &bytes[at], head[1] * sizeof(float));
    at += head[1] * sizeof(float);
  }
  return sections;
}

// ---- Evaluation ----

// Four frames of three instances: two that are linked, a third one under lobes of light with its nearest
// neighbour, all on the ground, with one sphere for all of them and one for the first.
void add_scene(nook_context context, nook_model model, nook_isa isa, Sections& sections) {
  nook_scene_desc desc;
  check(nook_scene_desc_init(&desc));
  nook_scene scene;
  check(nook_scene_create(context, &desc, &scene));

  nook_model_info info = {};
  info.struct_size = sizeof info;
  check(nook_model_describe(model, &info));
  std::array<nook_instance_id, 3> instances;
  for (nook_instance_id& instance : instances) check(nook_scene_add_instance(scene, model, &instance));
  check(nook_scene_link(scene, instances[0], instances[1]));
  check(nook_scene_link(scene, instances[1], instances[0]));
  check(nook_scene_link_nearest(scene, 1, 10));
  const float r = info.bounding_radius, plane[4] = {0, 1, 0, -0.8f * r};
  for (const nook_instance_id instance : instances) check(nook_scene_set_ground(scene, instance, plane));
  const std::vector<nook_lobe> lobes = some_lobes(12);
  check(nook_scene_set_light(scene, instances[2], lobes.data(), std::uint32_t(lobes.size())));
  nook_occluder_id occluder;
  const nook_occluder shared{{0.7f * r, 0.2f * r, r}, 0.3f * r, 0};
  const nook_occluder own{{-r, 0.4f * r, -0.6f * r}, 0.2f * r, instances[0]};
  check(nook_scene_add_occluder(scene, &shared, &occluder));
  check(nook_scene_add_occluder(scene, &own, &occluder));

  Section ao{set_name(isa), "ao", Kind::ao, {}}, colour{set_name(isa), "directional", Kind::ao, {}};
  std::vector<float> read(info.file_vertex_count), read_rgb(3 * std::size_t(info.file_vertex_count));
  Numbers numbers(5);
  for (int frame = 0; frame < 4; ++frame) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      std::vector<float> rows;
      const std::array<float, 3> place = {1.2f * r * float(i), 0.05f * r * float(frame), 0.3f * r * float(i)};
      for (std::uint32_t bone = 0; bone < info.bone_count; ++bone)
        append_frame(rows, numbers, 0.03f * float(frame + 1), place);
      check(set_pose(scene, instances[i], rows.data(), info.bone_count));
    }
    check(nook_scene_update(scene));
    for (const nook_instance_id instance : instances) {
      check(nook_scene_read(scene, instance, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, read.data(),
                            info.file_vertex_count, 0));
      ao.values.insert(ao.values.end(), read.begin(), read.end());
    }
    check(nook_scene_read(scene, instances[2], NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT,
                          read_rgb.data(), info.file_vertex_count, 0));
    colour.values.insert(colour.values.end(), read_rgb.begin(), read_rgb.end());
  }
  nook_scene_destroy(&scene);
  sections.push_back(std::move(ao));
  sections.push_back(std::move(colour));
}

// Radiance and irradiance of probes that were fitted to the same samples by three methods.
void add_fits(nook_context context, nook_isa isa, Sections& sections) {
  const std::vector<float> samples = directions(3, 4096), light = sky(samples), normals = directions(4, 64);
  Section section{set_name(isa), "probe fits", Kind::light, {}};
  for (const nook_probe_method method : {NOOK_PROBE_FIT_LEAST_SQUARES, NOOK_PROBE_FIT_RUNNING_AVERAGE,
                                         NOOK_PROBE_FIT_LEAST_SQUARES_NON_NEGATIVE}) {
    nook_probe_fit_desc desc;
    check(nook_probe_fit_desc_init(&desc));
    desc.method = method;
    nook_probe_fit fit;
    check(nook_probe_fit_create(context, &desc, &fit));
    check(nook_probe_fit_add_samples(fit, samples.data(), light.data(), nullptr, samples.size() / 3));
    nook_probe probe;
    check(nook_probe_fit_solve(fit, &probe));
    std::vector<float> read(normals.size());
    check(nook_probe_radiance(probe, nullptr, normals.data(), read.data(), normals.size() / 3));
    section.values.insert(section.values.end(), read.begin(), read.end());
    check(nook_probe_irradiance(probe, nullptr, normals.data(), read.data(), normals.size() / 3));
    section.values.insert(section.values.end(), read.begin(), read.end());
    nook_probe_destroy(&probe);
    nook_probe_fit_destroy(&fit);
  }
  sections.push_back(std::move(section));
}

// Irradiance and reflections of lobes.
void add_lobes(Sections& sections) {
  const std::vector<nook_lobe> lobes = some_lobes(12);
  const auto count = std::uint32_t(lobes.size());
  const std::vector<float> normals = directions(6, 256), tilts = directions(7, 256);
  const std::size_t surfaces = normals.size() / 3;
  Section section{"all", "lobes", Kind::light, {}};
  std::vector<float> read(normals.size());
  for (const nook_probe_irradiance_form form :
       {NOOK_PROBE_IRRADIANCE_FITTED, NOOK_PROBE_IRRADIANCE_INNER_PRODUCT, NOOK_PROBE_IRRADIANCE_BANDS}) {
    check(nook_sg_irradiance(lobes.data(), count, form, normals.data(), read.data(), surfaces));
    section.values.insert(section.values.end(), read.begin(), read.end());
  }
  Numbers numbers(8);
  std::vector<nook_probe_surface> shiny(surfaces);
  for (std::size_t i = 0; i < surfaces; ++i) {
    nook_probe_surface& surface = shiny[i];
    surface = {};
    std::array<float, 3> view;
    float square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      surface.normal[c] = normals[3 * i + c];
      view[c] = normals[3 * i + c] + 0.9f * tilts[3 * i + c];
      square += view[c] * view[c];
    }
    for (std::size_t c = 0; c < 3; ++c) surface.view[c] = view[c] / std::sqrt(square);
    surface.alpha_x = surface.alpha_y = numbers.between(0.05f, 1);
    surface.reflectance = numbers.between(0.04f, 1);
  }
  for (const nook_probe_specular_form form :
       {NOOK_PROBE_SPECULAR_ISOTROPIC, NOOK_PROBE_SPECULAR_ANISOTROPIC}) {
    check(nook_sg_specular(lobes.data(), count, form, shiny.data(), read.data(), surfaces));
    section.values.insert(section.values.end(), read.begin(), read.end());
  }
  sections.push_back(std::move(section));
}

void add_material(nook_context context, const std::vector<std::uint8_t>& file, Sections& sections) {
  nook_material material;
  check(nook_material_load(context, file.data(), file.size(), nullptr, &material));
  nook_material_info info{};
  info.struct_size = sizeof info;
  check(nook_material_describe(material, &info));
  Numbers numbers(9);
  const std::vector<float> views = directions(10, 2048), lights = directions(12, 2048);
  std::vector<nook_material_pixel> samples(views.size() / 3);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    nook_material_pixel& sample = samples[i];
    sample = {};
    sample.uv[0] = numbers.between(-1, 2);
    sample.uv[1] = numbers.between(-1, 2);
    const float texels = std::exp2(numbers.between(0, 2));
    sample.dx[0] = texels / float(info.width);
    sample.dy[1] = texels / float(info.height);
    for (std::size_t c = 0; c < 3; ++c) {
      sample.view[c] = views[3 * i + c];
      sample.light[c] = lights[3 * i + c];
    }
    sample.view[2] = std::abs(sample.view[2]);
    sample.light[2] = std::abs(sample.light[2]);
  }
  std::vector<nook_material_value> values(samples.size());
  check(nook_material_evaluate(material, samples.data(), std::uint32_t(samples.size()), 1, values.data()));
  // Without the visibility, a step function of the occlusion.
  Section section{"all", "material", Kind::material, {}};
  for (const nook_material_value& value : values)
    section.values.insert(section.values.end(),
                          {value.radiance[0], value.radiance[1], value.radiance[2], value.occlusion});
  nook_material_destroy(&material);
  sections.push_back(std::move(section));
}

// Returns NULL for a set that this library or processor lacks.
nook_context context_of(nook_isa isa) {
  nook_context_desc desc;
  check(nook_context_desc_init(&desc));
  desc.isa = isa;
  nook_context context = nullptr;
  const nook_result created = nook_context_create(&desc, &context);
  if (created == NOOK_ERROR_UNSUPPORTED || created == NOOK_ERROR_INVALID_ARGUMENT) return nullptr;
  check(created);
  return context;
}

int run(const char* character, const char* material, const char* out) {
  const std::vector<std::uint8_t> bytes = read_file(character);

  Sections sections;
  std::vector<std::string> sets;
  for (nook_isa isa = NOOK_ISA_SCALAR; isa < 16; ++isa) {
    nook_context context = context_of(isa);
    if (!context) continue;
    nook_model model;
    check(nook_model_load(context, bytes.data(), bytes.size(), &model));
    add_scene(context, model, isa, sections);
    add_fits(context, isa, sections);
    sets.push_back(set_name(isa));
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  if (sets.empty()) fail("no context can be created with any instruction set");
  add_lobes(sections);
  nook_context context = context_of(NOOK_ISA_AUTO);
  add_material(context, read_file(material), sections);
  sets.emplace_back("all");
  nook_context_destroy(&context);

  for (const Section& section : sections)
    for (const float value : section.values)
      if (!std::isfinite(value)) fail("a value of " + section.set + " " + section.name + " is not finite");
  std::size_t partly = 0;
  const std::vector<float>& ao = sections.front().values;
  for (const float value : ao) partly += value > 0 && value < 1;
  std::printf("%-8s %zu AO values, %zu of them between 0 and 1\n", "", ao.size(), partly);
  for (const std::string& set : sets)
    std::printf("%-8s %016llx\n", set.c_str(), static_cast<unsigned long long>(hash_of(sections, set)));
  write_sections(out, sections);
  return 0;
}

// ---- Comparison ----

const Section* find(const Sections& sections, std::string_view set, std::string_view name) {
  for (const Section& section : sections)
    if (section.set == set && section.name == name) return &section;
  return nullptr;
}

// The largest differences by kind.
std::array<double, 3> differences(const Sections& a, std::string_view set_a, const Sections& b,
                                  std::string_view set_b) {
  std::array<double, 3> largest{};
  for (const Section& section : a) {
    if (section.set != set_a) continue;
    const Section* const other = find(b, set_b, section.name);
    if (!other || other->values.size() != section.values.size() || other->kind != section.kind)
      fail("the files hold different values of " + section.set + " " + section.name);
    double magnitude = 1, difference = 0;
    if (section.kind == Kind::light) {
      magnitude = 0;
      for (const float value : section.values) magnitude = std::max(magnitude, std::abs(double(value)));
    }
    for (std::size_t i = 0; i < section.values.size(); ++i)
      difference = std::max(difference, std::abs(double(section.values[i]) - double(other->values[i])));
    double& kind = largest[std::size_t(section.kind)];
    kind = std::max(kind, difference / magnitude);
  }
  return largest;
}

int compare(const Sections& a, const Sections& b, const std::array<double, 3>& bounds,
            std::vector<std::array<std::string, 2>> pairs) {
  if (pairs.empty())
    for (const Section& section : a)
      if ((pairs.empty() || pairs.back()[0] != section.set) && find(b, section.set, section.name))
        pairs.push_back({section.set, section.set});
  bool above = pairs.empty();
  for (const auto& [set_a, set_b] : pairs) {
    const std::array<double, 3> largest = differences(a, set_a, b, set_b);
    std::printf("%-8s %-8s", set_a.c_str(), set_b.c_str());
    for (std::size_t kind = 0; kind < 3; ++kind) {
      std::printf("  %s %.2e", kind_names[kind], largest[kind]);
      if (!(largest[kind] <= bounds[kind])) {
        std::printf(" (above %.2e)", bounds[kind]);
        above = true;
      }
    }
    std::printf("%s\n", hash_of(a, set_a) == hash_of(b, set_b) ? "  same bits" : "");
  }
  return above ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == "run" && argc == 5) return run(argv[2], argv[3], argv[4]);
  if (command == "compare" && (argc == 7 || argc == 9)) {
    std::vector<std::array<std::string, 2>> pairs;
    if (argc == 9) pairs.push_back({argv[7], argv[8]});
    return compare(read_sections(argv[2]), read_sections(argv[3]),
                   {std::atof(argv[4]), std::atof(argv[5]), std::atof(argv[6])}, std::move(pairs));
  }
  std::fputs(
      "usage: cpu_results run CHARACTER.nook MATERIAL.nook VALUES\n"
      "       cpu_results compare VALUES VALUES AO_BOUND LIGHT_BOUND MATERIAL_BOUND [SET SET]\n",
      stderr);
  return 2;
}
