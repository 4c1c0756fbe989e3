#include "bakers/measure/crowd/errors.h"

#include <glm/glm.hpp>

#include "bakers/measure/truth/visible_truth.h"

namespace nook::measure::crowd {
namespace {

glm::vec3 point(const std::vector<float>& positions, std::uint32_t vertex) {
  return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

// Each vertex has a third of the area of each triangle that uses it. Square metres.
std::vector<double> vertex_areas(const PosedCrowd& crowd, const std::vector<float>& positions) {
  std::vector<double> areas(crowd.vertex_count(), 0.0);
  for (std::size_t t = 0; t < crowd.triangles().size(); t += 3) {
    const std::uint32_t* v = &crowd.triangles()[t];
    const glm::vec3 a = point(positions, v[0]);
    const double area =
        0.5 * double(glm::length(glm::cross(point(positions, v[1]) - a, point(positions, v[2]) - a)));
    for (int k = 0; k < 3; ++k) areas[v[k]] += area / 3;
  }
  return areas;
}

}  // namespace

Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels, float unit) {
  double squares = 0, visible_squares = 0, weighted_squares = 0, vertices = 0, visible = 0, area = 0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const std::vector<double> areas = vertex_areas(crowd, crowd.body(receivers[r]).positions);
    for (std::size_t v = 0; v < areas.size(); ++v) {
      if (areas[v] <= 0) continue;
      double square = 0;
      for (std::uint32_t c = 0; c < channels; ++c) {
        const double error =
            (double(values[r][channels * v + c]) - double(reference[r][channels * v + c])) / double(unit);
        square += error * error / channels;
      }
      squares += square;
      weighted_squares += areas[v] * square;
      vertices += 1;
      area += areas[v];
      if (channels != 1 || double(reference[r][v]) < visible_truth) continue;
      visible_squares += square;
      visible += 1;
    }
  }
  return {vertices > 0 ? squares / vertices : 0, visible > 0 ? visible_squares / visible : 0,
          area > 0 ? weighted_squares / area : 0};
}

}  // namespace nook::measure::crowd
