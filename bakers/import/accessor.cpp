#include "bakers/import/accessor.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// An accessor without a buffer view takes no bytes in the file. Without this limit, a small file could make
// us allocate any amount of memory.
constexpr std::size_t max_elements = std::size_t{1} << 24;

template <typename T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

int component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

// glTF 2.0, section 3.6.2.2, "accessor data types": the signed formats clamp at -1.
float load_float(const unsigned char* at, int type, bool normalised) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const float v = load<std::int8_t>(at);
      return normalised ? std::max(v / 127.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const float v = load<std::uint8_t>(at);
      return normalised ? v / 255.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const float v = load<std::int16_t>(at);
      return normalised ? std::max(v / 32767.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const float v = load<std::uint16_t>(at);
      return normalised ? v / 65535.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
      const double v = load<std::uint32_t>(at);
      return static_cast<float>(normalised ? v / 4294967295.0 : v);
    }
    default:
      return load<float>(at);
  }
}

std::uint32_t load_integer(const unsigned char* at, int type, const std::string& what) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(at);
    default:
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has component type %d (need an unsigned integer type)",
                    what.c_str(), type);
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

struct Strided {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

// Returns `count` elements of a buffer view. Fails if one of them is outside the view or its buffer.
Strided checked_view(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t count,
                     std::size_t element_size, bool may_stride, const std::string& what) {
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to buffer view %d, but the file has only %zu", what.c_str(),
                  view_index, model.bufferViews.size());
  const tinygltf::BufferView& view = model.bufferViews[view_index];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to buffer %d, but the file has only %zu", what.c_str(),
                  view.buffer, model.buffers.size());
  const std::vector<unsigned char>& data = model.buffers[view.buffer].data;
  const std::size_t stride = may_stride && view.byteStride != 0 ? view.byteStride : element_size;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s: its buffer view starts at byte %zu and has %zu bytes, but its "
                  "buffer has only %zu; the file may be truncated",
                  what.c_str(), view.byteOffset, view.byteLength, data.size());
  const bool fits = count == 0 || (offset <= view.byteLength && element_size <= view.byteLength - offset &&
                                   (count - 1) <= (view.byteLength - offset - element_size) / stride);
  if (stride < element_size || !fits)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%s: %zu elements of %zu bytes, stride %zu, offset %zu, do not fit into a buffer view of %zu bytes",
        what.c_str(), count, element_size, stride, offset, view.byteLength);
  return {data.data() + view.byteOffset + offset, stride};
}

const tinygltf::Accessor& checked_accessor(const tinygltf::Model& model, int index, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to accessor %d, but the file has only %zu", what.c_str(),
                  index, model.accessors.size());
  return model.accessors[index];
}

// Calls store(element, component, pointer) for each component of the first `most` elements. Dense data comes
// first, then the sparse overrides. Elements that are not stored get no call; their values are zero.
template <typename Prepare, typename Store>
void visit(const tinygltf::Model& model, const tinygltf::Accessor& accessor, int wanted_components,
           std::size_t most, const std::string& what, Prepare prepare, Store store) {
  const std::size_t size = component_size(accessor.componentType);
  const int components = component_count(accessor.type);
  if (size == 0 || components == 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has component type %d and type %d; at least one of these does not exist in glTF",
                  what.c_str(), accessor.componentType, accessor.type);
  if (wanted_components > 0 && components != wanted_components)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %d components per element (need %d)", what.c_str(), components,
                  wanted_components);
  if (accessor.count > max_elements)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %zu elements (need at most %zu)", what.c_str(), accessor.count,
                  max_elements);
  const std::size_t element_size = size * components, wanted = std::min(accessor.count, most);
  const auto store_element = [&](std::size_t element, const unsigned char* at) {
    for (int c = 0; c < components; ++c) store(element * components + c, at + c * size);
  };

  if (accessor.bufferView >= 0) {
    const Strided dense = checked_view(model, accessor.bufferView, accessor.byteOffset, accessor.count,
                                       element_size, true, what);
    prepare(wanted, components);
    for (std::size_t i = 0; i < wanted; ++i) store_element(i, dense.first + i * dense.stride);
  } else {
    prepare(wanted, components);
  }

  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s: the sparse count %d is out of range for an accessor of "
                  "%zu elements, or a sparse offset is negative",
                  what.c_str(), sparse.count, accessor.count);
  const std::size_t index_size = component_size(sparse.indices.componentType);
  if (!is_index_type(sparse.indices.componentType))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s: sparse indices have component type %d (need UNSIGNED_BYTE, _SHORT or _INT: 5121, 5123 "
                  "or 5125)",
                  what.c_str(), sparse.indices.componentType);
  const std::size_t count = sparse.count;
  const Strided indices = checked_view(model, sparse.indices.bufferView, sparse.indices.byteOffset, count,
                                       index_size, false, what + " (sparse indices)");
  const Strided values = checked_view(model, sparse.values.bufferView, sparse.values.byteOffset, count,
                                      element_size, false, what + " (sparse values)");
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t element =
        load_integer(indices.first + i * index_size, sparse.indices.componentType, what);
    if (element >= accessor.count)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s: a sparse index is %u, but the accessor has only %zu elements",
                    what.c_str(), element, accessor.count);
    // glTF 2.0, section 3.6.2.3.
    if (i > 0 && element <= before)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s: sparse indices do not increase (got %u after %u); export the file again",
                    what.c_str(), element, before);
    before = element;
    if (element < wanted) store_element(element, values.first + i * element_size);
  }
}

}  // namespace

std::size_t element_count(const tinygltf::Model& model, int accessor, const std::string& what) {
  return checked_accessor(model, accessor, what).count;
}

Floats read_floats(const tinygltf::Model& model, int accessor_index, int components, const std::string& what,
                   std::size_t most) {
  const tinygltf::Accessor& accessor = checked_accessor(model, accessor_index, what);
  Floats out;
  visit(
      model, accessor, components, most, what,
      [&](std::size_t count, int per_element) {
        out.count = count;
        out.components = per_element;
        out.value.assign(count * per_element, 0.0f);
      },
      [&](std::size_t at, const unsigned char* bytes) {
        out.value[at] = load_float(bytes, accessor.componentType, accessor.normalized);
      });
  return out;
}

Floats read_floats(const tinygltf::Model& model, int accessor, const std::string& what) {
  return read_floats(model, accessor, 0, what);
}

Integers read_integers(const tinygltf::Model& model, int accessor_index, int components,
                       const std::string& what) {
  const tinygltf::Accessor& accessor = checked_accessor(model, accessor_index, what);
  Integers out;
  visit(
      model, accessor, components, ~std::size_t{0}, what,
      [&](std::size_t count, int per_element) {
        out.count = count;
        out.components = per_element;
        out.value.assign(count * per_element, 0u);
      },
      [&](std::size_t at, const unsigned char* bytes) {
        out.value[at] = load_integer(bytes, accessor.componentType, what);
      });
  return out;
}

}  // namespace nook::bake
