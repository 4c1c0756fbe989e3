#include "sdk/src/material/map_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "sdk/src/material/material_check.h"
#include "sdk/src/material/packed_numbers.h"

namespace nook::material {
namespace {

constexpr std::uint32_t max_quotient = 24;
constexpr int plain_bits = 26;

std::uint32_t folded(std::int32_t multiple) {
  return multiple >= 0 ? 2 * std::uint32_t(multiple) : 2 * std::uint32_t(-multiple) - 1;
}

std::int32_t unfolded(std::uint32_t n) {
  return n % 2 == 0 ? std::int32_t(n / 2) : -std::int32_t(n / 2) - 1;
}

std::size_t code_bits(std::uint32_t n, std::uint32_t k) {
  return n >> k < max_quotient ? (n >> k) + 1 + k : max_quotient + plain_bits;
}

}  // namespace

std::uint32_t best_k(std::span<const std::int32_t> multiples) {
  std::uint32_t best = 0;
  std::size_t fewest = SIZE_MAX;
  for (std::uint32_t k = 0; k < max_quotient; ++k) {
    std::size_t bits = 0;
    for (const std::int32_t multiple : multiples) bits += code_bits(folded(multiple), k);
    // The number of bits has a single minimum over k, so the search can stop here.
    if (bits >= fewest) break;
    fewest = bits;
    best = k;
  }
  return best;
}

void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k) {
  const std::uint32_t n = folded(multiple), quotient = std::min(n >> k, max_quotient);
  out.bits((1u << quotient) - 1, int(quotient));
  if (quotient == max_quotient) return out.bits(n, plain_bits);
  out.bits(0, 1);
  out.bits(n, int(k));
}

std::uint32_t read_k(ByteReader& in) {
  const std::uint32_t k = in.bits(k_bits);
  if (k >= max_quotient)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s holds a code out of range (got %u, need less than %u); bake the file again",
                  in.name(), k, max_quotient);
  return k;
}

std::int32_t read_multiple(ByteReader& in, std::uint32_t k) {
  std::uint32_t quotient = 0;
  while (quotient < max_quotient && in.bits(1)) ++quotient;
  return unfolded(quotient == max_quotient ? in.bits(plain_bits) : quotient << k | in.bits(int(k)));
}

namespace {

enum class Members : std::uint32_t { own = 0, of_row = 1, of_column = 2 };

// The clusters and multiples of the cells of a map that is being written or read.
class Cells {
 public:
  Cells(const TensorShape& shape, std::uint32_t side, Memory* memory)
      : members(memory),
        multiples(memory),
        terms_(shape.mixture),
        each_(shape.mixture * shape.rank_view),
        side_(side) {
    const std::size_t cells = std::size_t(side) * side;
    members.resize(cells * terms_);
    multiples.resize(cells * each_);
  }

  Vector<std::uint16_t> members;
  Vector<std::int32_t> multiples;

  std::size_t each() const { return each_; }
  std::uint16_t* clusters(std::size_t cell) { return &members[cell * terms_]; }
  std::int32_t* numbers(std::size_t cell) { return &multiples[cell * each_]; }

  bool has_row(std::size_t cell) const { return cell % side_ != 0; }
  bool has_column(std::size_t cell) const { return cell >= side_; }
  bool same(std::size_t a, std::size_t b) {
    return std::equal(clusters(a), clusters(a) + terms_, clusters(b));
  }
  Members known(std::size_t cell) {
    if (has_row(cell) && same(cell, cell - 1)) return Members::of_row;
    return has_column(cell) && same(cell, cell - side_) ? Members::of_column : Members::own;
  }
  std::size_t source(std::size_t cell, Members members_of) const {
    return members_of == Members::of_row ? cell - 1 : cell - side_;
  }
  // Predicts value i of a cell. The clusters of the cell and all values before it must already be known.
  std::int32_t predicted(std::size_t cell, Members members_of, std::size_t i) {
    if (members_of == Members::own) return 0;
    if (members_of == Members::of_column || !has_column(cell) || !same(cell, cell - side_) ||
        !same(cell, cell - side_ - 1))
      return numbers(source(cell, members_of))[i];
    return numbers(cell - 1)[i] + numbers(cell - side_)[i] - numbers(cell - side_ - 1)[i];
  }

 private:
  std::size_t terms_, each_, side_;
};

std::int32_t clamped(std::int32_t multiple) {
  return std::clamp(multiple, -max_multiple, max_multiple);
}

}  // namespace

ViewRows sorted_rows(const ViewRows& rows, const TensorShape& s, Memory* memory) {
  ViewRows sorted(memory);
  sorted.membership.resize(rows.membership.size());
  sorted.coefficients.resize(rows.coefficients.size());
  std::array<std::uint32_t, max_mixture> order;
  for (std::size_t first = 0; first < rows.membership.size(); first += s.mixture) {
    const std::uint16_t* const clusters = &rows.membership[first];
    for (std::uint32_t k = 0; k < s.mixture; ++k) {
      std::uint32_t at = k;
      for (; at > 0 && clusters[order[at - 1]] > clusters[k]; --at) order[at] = order[at - 1];
      order[at] = k;
    }
    for (std::uint32_t k = 0; k < s.mixture; ++k) {
      sorted.membership[first + k] = clusters[order[k]];
      std::copy_n(&rows.coefficients[(first + order[k]) * s.rank_view], s.rank_view,
                  &sorted.coefficients[(first + k) * s.rank_view]);
    }
  }
  return sorted;
}

void write_map_rows(ByteWriter& out, const ViewMap& map, const TensorShape& shape) {
  const ViewRows rows = sorted_rows(map.rows, shape);
  const float step = step_of_largest(rows.coefficients, steps_of_largest);
  Cells cells(shape, map.side, default_memory());
  cells.members = rows.membership;
  const std::int32_t limit = largest_multiple(rows.coefficients, step);
  for (std::size_t i = 0; i < rows.coefficients.size(); ++i)
    cells.multiples[i] = multiple_of(rows.coefficients[i], step, limit);
  const std::size_t count = std::size_t(map.side) * map.side;
  std::vector<std::int32_t> rest[2];
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Members members = cells.known(cell);
    for (std::size_t i = 0; i < cells.each(); ++i)
      rest[members != Members::own].push_back(cells.numbers(cell)[i] - cells.predicted(cell, members, i));
  }
  const std::uint32_t k[2] = {best_k(rest[0]), best_k(rest[1])};
  out.f32(step);
  for (const std::uint32_t one : k) out.bits(one, k_bits);
  std::size_t at[2] = {};
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Members members = cells.known(cell);
    out.bits(std::uint32_t(members), 2);
    for (std::uint32_t term = 0; members == Members::own && term < shape.mixture; ++term)
      out.bits(cells.clusters(cell)[term], shape.clusters > 256 ? 16 : 8);
    const int which = members != Members::own;
    for (std::size_t i = 0; i < cells.each(); ++i) write_multiple(out, rest[which][at[which]++], k[which]);
  }
  out.align();
}

void read_map_rows(ByteReader& in, const TensorShape& shape, ViewMap& map) {
  const float step = read_step(in);
  const std::uint32_t k[2] = {read_k(in), read_k(in)};
  Cells cells(shape, map.side, map.rows.coefficients.get_allocator().memory());
  const std::size_t count = std::size_t(map.side) * map.side;
  for (std::size_t cell = 0; cell < count; ++cell) {
    const std::uint32_t code = in.bits(2);
    const auto members = Members(code);
    if (code > 2 || (members == Members::of_row && !cells.has_row(cell)) ||
        (members == Members::of_column && !cells.has_column(cell)))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s: cell %zu takes the clusters of a cell that does not exist (got code %u); "
                    "bake the file again",
                    in.name(), cell, code);
    for (std::uint32_t term = 0; term < shape.mixture; ++term)
      cells.clusters(cell)[term] = members != Members::own
                                       ? cells.clusters(cells.source(cell, members))[term]
                                       : std::uint16_t(in.bits(shape.clusters > 256 ? 16 : 8));
    for (std::size_t i = 0; i < cells.each(); ++i) {
      const std::int32_t difference = read_multiple(in, k[members != Members::own]);
      cells.numbers(cell)[i] = clamped(cells.predicted(cell, members, i) + difference);
    }
  }
  in.align();
  map.rows.membership = std::move(cells.members);
  map.rows.coefficients.resize(cells.multiples.size());
  for (std::size_t i = 0; i < cells.multiples.size(); ++i)
    map.rows.coefficients[i] = float(cells.multiples[i]) * step;
}

}  // namespace nook::material
