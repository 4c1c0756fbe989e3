#include "sdk/src/gl/probe/capture.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/probe/fit.h"

namespace nook::gl {
namespace {

void write_map(const CapturePlan& plan, const Vector<double>& map, float* out) {
  const std::uint32_t columns = plan.lobes + probe::band_functions;
  for (std::uint32_t row = 0; row < plan.lobes; ++row, out += plan.sums())
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t sum =
          column < plan.lobes ? column : plan.lobe_groups() * NOOK_CAPTURE_GROUP + column - plan.lobes;
      out[sum] = float(map[std::size_t{row} * columns + column]);
    }
}

}  // namespace

Vector<float> capture_texels(const CapturePlan& plan, const probe::Basis& basis, probe::Constraint constraint,
                             Memory* memory) {
  Vector<float> texels(4 * plan.texels(), 0.0f, memory);
  if (plan.lobes == 0) return texels;
  float* lobe = texels.data() + 4 * CapturePlan::first_lobe;
  for (std::uint32_t i = 0; i < plan.lobes; ++i, lobe += 4) {
    lobe[0] = basis.axis[i].x;
    lobe[1] = basis.axis[i].y;
    lobe[2] = basis.axis[i].z;
    lobe[3] = basis.sharpness[i];
  }
  write_map(plan, probe::solution_map(basis, constraint, memory), texels.data() + 4 * plan.first_map_row());
  return texels;
}

namespace {

constexpr std::uint64_t texel_bytes = 4 * sizeof(float);
constexpr float sphere = 4 * std::numbers::pi_v<float>;
// The number of iterations that find the luminance limit above which light belongs to suns. Each iteration
// averages only the light below the limit of the previous iteration. A sun that covers 1e-4 of the sphere
// adds at most a hundredth of the previous limit to the next limit, so few iterations are enough.
constexpr int limit_rounds = 4;

CapturePlan plan_of(const CaptureTargets& targets, const CaptureSettings& settings) {
  return {targets.lobes ? targets.lobes->basis().count : 0, settings.face_size_px, targets.places().size()};
}

void check_plan(const Device& device, const CapturePlan& plan) {
  if (plan.texels() > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the capture is too large for a texture buffer of this OpenGL (%llu probes with faces of "
                  "%u texels take %llu texels, need at most %u); split the grid or make the faces smaller",
                  static_cast<unsigned long long>(plan.probes), plan.face_size_px,
                  static_cast<unsigned long long>(plan.texels()), device.max_texels);
}

Buffer working_buffer(Device& device, const char* label, std::uint64_t texels) {
  return Buffer(device, label, texels * texel_bytes, nullptr, GL_DYNAMIC_COPY);
}

void set_unit(const Device& device, const Object& program, const char* name, GLint unit) {
  device.gl.Uniform1i(uniform_location(device, program, name), unit);
}

Object make_sampler(Device& device, std::uint32_t level) {
  const Functions& gl = device.gl;
  Object sampler = Object::make(device, Object::Kind::sampler);
  gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER,
                       level > 0 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl.SamplerParameteri(sampler.name(), wrap, GL_CLAMP_TO_EDGE);
  return sampler;
}

Vec3 vec3(const float* texel) {
  return {texel[0], texel[1], texel[2]};
}

}  // namespace

ProbeCapture::ProbeCapture(Device& device, const CaptureTargets& targets, const CaptureSettings& settings)
    : device_(device),
      targets_(targets),
      settings_(settings),
      basis_(targets.lobes ? targets.lobes->basis() : probe::harmonic_basis(2)),
      grid_(targets.places()),
      plan_(plan_of(targets, settings)),
      feedback_(device),
      vertex_array_(Object::make(device, Object::Kind::vertex_array)),
      sampler_(make_sampler(device, settings.level)),
      table_(device.memory),
      maps_(plan_.probes, 0u, device.memory) {
  check_plan(device, plan_);
  band_rows_ = make_row_program(NOOK_CAPTURE_BANDS);
  if (targets.lobes) lobe_rows_ = make_row_program(NOOK_CAPTURE_LOBES);
  if (settings.sky) luminance_rows_ = make_row_program(NOOK_CAPTURE_LUMINANCE);
  mean_ = feedback_program(device, "probe/capture/mean.vert", "", "nook_mean");
  mean_rows_ = uniform_location(device, mean_, "nook_rows");
  mean_scale_share_ = uniform_location(device, mean_, "nook_scale_share");
  device.gl.UseProgram(mean_.name());
  set_unit(device, mean_, "nook_table", NOOK_CAPTURE_UNIT_TABLE);
  if (targets.lobes) amplitudes_ = make_solve_program(NOOK_CAPTURE_AMPLITUDES);
  if (targets.grid)
    texels_ = make_solve_program(targets.grid->form() == GridForm::harmonics ? NOOK_CAPTURE_HARMONICS
                                                                             : NOOK_CAPTURE_ZONAL);
  const Vector<float> texels = capture_texels(plan_, basis_, settings.constraint, device.memory);
  table_.replace(device, GL_RGBA32F, plan_.texels(), texels.data(), "nook: capture");
  rows_ =
      working_buffer(device, "nook: rows of a cube map", std::uint64_t{plan_.rows()} * NOOK_CAPTURE_GROUP);
  sums_ = Buffer(device, "nook: sums of probes", plan_.probes * plan_.sums() * texel_bytes,
                 texels.data() + 4 * plan_.first_sum(0), GL_DYNAMIC_COPY);
  numbers_ = working_buffer(
      device, "nook: a probe",
      std::max<std::uint64_t>(plan_.lobes, targets.grid ? texels_of(targets.grid->form()) : 0));
  device.check("making a capture of probes");
}

ProbeCapture::RowProgram ProbeCapture::make_row_program(int kind) const {
  char defines[48];
  std::snprintf(defines, sizeof defines, "#define NOOK_CAPTURE_KIND %d\n", kind);
  RowProgram program;
  program.object = feedback_program(device_, "probe/capture/rows.vert", defines, "nook_sums");
  program.first_lobe = uniform_location(device_, program.object, "nook_first_lobe");
  program.limited = uniform_location(device_, program.object, "nook_limited");
  const Functions& gl = device_.gl;
  gl.UseProgram(program.object.name());
  set_unit(device_, program.object, "nook_table", NOOK_CAPTURE_UNIT_TABLE);
  set_unit(device_, program.object, "nook_cube", NOOK_CAPTURE_UNIT_CUBE);
  gl.Uniform1i(uniform_location(device_, program.object, "nook_face_size"), GLint(settings_.face_size_px));
  gl.Uniform1f(uniform_location(device_, program.object, "nook_level"), GLfloat(settings_.level));
  return program;
}

Object ProbeCapture::make_solve_program(int form) const {
  char defines[48];
  std::snprintf(defines, sizeof defines, "#define NOOK_CAPTURE_FORM %d\n", form);
  Object program = feedback_program(device_, "probe/capture/solve.vert", defines, "nook_number");
  device_.gl.UseProgram(program.name());
  set_unit(device_, program, "nook_table", NOOK_CAPTURE_UNIT_TABLE);
  return program;
}

void ProbeCapture::check_targets() const {
  const bool same =
      (!targets_.lobes || (targets_.lobes->basis() == basis_ && targets_.lobes->grid() == grid_)) &&
      (!targets_.grid || targets_.grid->grid() == grid_);
  if (!same)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.probe or desc.grid was updated with other functions or another grid after the "
                  "capture was created; create a new capture");
}

void ProbeCapture::add(std::size_t probe, GLuint cube_map, bool restart) {
  check_targets();
  const Functions& gl = device_.gl;
  gl.ActiveTexture(GL_TEXTURE0 + NOOK_CAPTURE_UNIT_CUBE);
  bind_checked(device_, {cube_map, settings_.face_size_px, settings_.level});
  gl.BindSampler(NOOK_CAPTURE_UNIT_CUBE, sampler_.name());
  gl.BindSampler(NOOK_CAPTURE_UNIT_TABLE, 0);
  gl.BindVertexArray(vertex_array_.name());
  feedback_.begin(device_);
  maps_[probe] = restart ? 1 : std::min(maps_[probe] + 1, settings_.history);
  if (settings_.sky) find_limit();
  for (std::uint32_t group = 0; group < plan_.groups(); ++group) {
    sum_rows(group < plan_.lobe_groups() ? lobe_rows_ : band_rows_, group, NOOK_CAPTURE_GROUP);
    average(probe, group);
  }
  solve(probe);
  FeedbackTarget::end(device_);
  device_.check("adding a cube map to a probe");
}

void ProbeCapture::use(const Object& program) const {
  device_.gl.UseProgram(program.name());
  table_.bind(device_);
}

// Draws with transform feedback. Afterwards unbinds the buffer that was written, because the next step copies
// from it.
void ProbeCapture::draw(const Draw& draw) const {
  const Functions& gl = device_.gl;
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, draw.out.name(),
                     static_cast<GLintptr>(draw.first_texel * texel_bytes),
                     static_cast<GLsizeiptr>(draw.texels * texel_bytes));
  gl.BeginTransformFeedback(GL_POINTS);
  gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(draw.points));
  gl.EndTransformFeedback();
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

// As in map_suns.cpp, the limit is sun_ratio times the mean luminance of all light below the limit.
void ProbeCapture::find_limit() const {
  const Functions& gl = device_.gl;
  for (int round = 0; round < limit_rounds; ++round) {
    use(luminance_rows_.object);
    gl.Uniform1i(luminance_rows_.limited, round > 0);
    draw({luminance_rows_.object, rows_, 0, plan_.rows(), plan_.rows()});
    table_.copy(device_, rows_.name(), 0, plan_.first_row(), plan_.rows());
    use(mean_);
    gl.Uniform4i(mean_rows_, GLint(plan_.first_row()), 1, GLint(plan_.rows()), 0);
    gl.Uniform2f(mean_scale_share_, float(sun_ratio), 1);
    draw({mean_, numbers_, 0, 1, 1});
    table_.copy(device_, numbers_.name(), 0, 0, 1);
  }
}

void ProbeCapture::sum_rows(const RowProgram& program, std::uint32_t group, std::uint32_t entries) const {
  use(program.object);
  device_.gl.Uniform1i(program.limited, settings_.sky);
  if (program.first_lobe >= 0)
    device_.gl.Uniform1i(program.first_lobe, GLint(CapturePlan::first_lobe + group * NOOK_CAPTURE_GROUP));
  const std::uint64_t texels = std::uint64_t{plan_.rows()} * entries;
  draw({program.object, rows_, 0, texels, plan_.rows()});
  table_.copy(device_, rows_.name(), 0, plan_.first_row(), texels);
}

void ProbeCapture::average(std::size_t probe, std::uint32_t group) const {
  const Functions& gl = device_.gl;
  const std::uint64_t place = std::uint64_t{group} * NOOK_CAPTURE_GROUP, sum = plan_.first_sum(probe) + place,
                      in_buffer = probe * std::uint64_t{plan_.sums()} + place;
  use(mean_);
  gl.Uniform4i(mean_rows_, GLint(plan_.first_row()), NOOK_CAPTURE_GROUP, GLint(plan_.rows()), GLint(sum));
  gl.Uniform2f(mean_scale_share_, sphere, 1 / float(maps_[probe]));
  draw({mean_, sums_, in_buffer, NOOK_CAPTURE_GROUP, NOOK_CAPTURE_GROUP});
  table_.copy(device_, sums_.name(), in_buffer * texel_bytes, sum, NOOK_CAPTURE_GROUP);
}

void ProbeCapture::solve(std::size_t probe) const {
  const auto answer = [&](const Object& program, std::uint32_t points) {
    use(program);
    device_.gl.Uniform4i(uniform_location(device_, program, "nook_sums_map"), GLint(plan_.first_sum(probe)),
                         GLint(plan_.groups()), GLint(plan_.first_map_row()), 0);
    draw({program, numbers_, 0, points, points});
  };
  if (targets_.lobes) {
    answer(amplitudes_, plan_.lobes);
    targets_.lobes->copy_probe(probe, numbers_.name(), 0);
  }
  if (targets_.grid) {
    answer(texels_, texels_of(targets_.grid->form()));
    targets_.grid->copy_probe(probe, numbers_.name(), 0);
  }
}

CaptureResult ProbeCapture::read(std::size_t probe) const {
  CaptureResult result;
  result.maps = maps_[probe];
  if (result.maps == 0) return result;
  std::array<float, 4 * NOOK_CAPTURE_GROUP> group;
  const std::uint64_t texel = probe * std::uint64_t{plan_.sums()} + plan_.lobe_groups() * NOOK_CAPTURE_GROUP;
  read_buffer_bytes(device_, sums_.name(), texel * texel_bytes, sizeof group, group.data());
  for (std::size_t i = 0; i < result.harmonics.size(); ++i) result.harmonics[i] = vec3(group.data() + 4 * i);
  result.sun_irradiance = vec3(group.data() + 4 * NOOK_CAPTURE_SUN_IRRADIANCE);
  const Vec3 direction = vec3(group.data() + 4 * NOOK_CAPTURE_SUN_DIRECTION);
  const float size = length(direction);
  if (size > 0) result.sun_direction = direction * (1 / size);
  result.sun_solid_angle = group[4 * NOOK_CAPTURE_SUN_ANGLE];
  result.used_solid_angle = group[3];
  device_.check("reading a capture");
  return result;
}

probe::Probes ProbeCapture::read_all() const {
  Vector<float> texels(4 * plan_.probes * plan_.sums(), 0.0f, device_.memory);
  read_buffer_bytes(device_, sums_.name(), 0, texels.size() * sizeof(float), texels.data());
  const Vector<float> constants = capture_texels(plan_, basis_, settings_.constraint, device_.memory);
  probe::Probes probes(device_.memory);
  probes.basis = basis_;
  probes.grid = grid_;
  for (std::size_t p = 0; p < plan_.probes; ++p) {
    const float* const sums = texels.data() + 4 * p * plan_.sums();
    for (std::uint32_t i = 0; i < basis_.count; ++i) {
      Vec3 coefficient = vec3(sums + 4 * i);
      if (plan_.lobes > 0) {
        const float* const row = constants.data() + 4 * (plan_.first_map_row() + i * plan_.map_row());
        coefficient = {};
        for (std::uint32_t k = 0; k < plan_.sums(); ++k)
          coefficient += vec3(sums + 4 * std::size_t{k}) * row[k];
      }
      probes.coefficients.push_back(maps_[p] > 0 ? coefficient : Vec3{});
    }
  }
  device_.check("reading a capture");
  return probes;
}

}  // namespace nook::gl
