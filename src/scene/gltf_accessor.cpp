// SPDX-License-Identifier: MIT
#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/error.h"

namespace izb {
namespace {

/// An accessor without a buffer view is all zeros, whatever count it claims: a limit that no real file meets.
constexpr size_t max_unbacked_count = size_t(1) << 24;

const tinygltf::Accessor& accessor_at(const tinygltf::Model& model, int accessor) {
  return model.accessors[static_cast<size_t>(accessor)];
}

/// Elements in memory: `count` of them, `stride` bytes apart.
struct Elements {
  const unsigned char* data = nullptr;
  size_t count = 0, stride = 0;
};

/// Locates elements in a buffer view and makes sure that the last byte of the last one lies in it.
Elements locate(const tinygltf::Model& model, int accessor, int buffer_view, size_t byte_offset, size_t count,
                size_t element_size, size_t stride) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(buffer_view)];
  if (stride == 0) stride = element_size;
  const bool fits = count == 0 || (byte_offset <= view.byteLength && element_size <= view.byteLength - byte_offset &&
                                   count - 1 <= (view.byteLength - byte_offset - element_size) / stride);
  if (!fits)
    fail("accessors[{}] has {} elements, more than bufferViews[{}] of {} bytes holds", accessor, count, buffer_view,
         view.byteLength);
  const std::vector<unsigned char>& buffer = model.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    fail("bufferViews[{}] does not lie in its buffer", buffer_view);
  return {buffer.data() + view.byteOffset + byte_offset, count, stride};
}

template <typename T>
T load(const unsigned char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

/// Integer to float as glTF 2.0, section 3.6.2.2, or unchanged.
template <typename From, typename To>
To convert(From value, bool normalized) {
  if constexpr (std::is_floating_point_v<To> && std::is_integral_v<From>) {
    if (!normalized) return static_cast<To>(value);
    const To scaled = static_cast<To>(value) / static_cast<To>(std::numeric_limits<From>::max());
    return scaled < To(-1) ? To(-1) : scaled;
  } else {
    return static_cast<To>(value);
  }
}

/// Converts elements of `components` values into a packed array.
template <typename From, typename To>
void copy(const Elements& from, size_t components, bool normalized, To* to) {
  for (size_t i = 0; i < from.count; ++i) {
    const unsigned char* p = from.data + i * from.stride;
    To* out = to + i * components;
    for (size_t c = 0; c < components; ++c, p += sizeof(From)) out[c] = convert<From, To>(load<From>(p), normalized);
  }
}

template <typename To>
void copy_any(const Elements& from, int component_type, size_t components, bool normalized, To* to) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copy<uint8_t>(from, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copy<uint16_t>(from, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copy<uint32_t>(from, components, normalized, to);
    default:
      break;
  }
  if constexpr (std::is_floating_point_v<To>) {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copy<int8_t>(from, components, normalized, to);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copy<int16_t>(from, components, normalized, to);
      default:
        return copy<float>(from, components, normalized, to);
    }
  }
}

std::vector<uint32_t> sparse_positions(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = accessor_at(model, index);
  const auto& indices = accessor.sparse.indices;
  if (indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    fail("the sparse indices of accessors[{}] are not unsigned integers", index);
  const auto size =
      static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(indices.componentType)));
  const Elements from = locate(model, index, indices.bufferView, static_cast<size_t>(indices.byteOffset),
                               static_cast<size_t>(accessor.sparse.count), size, 0);
  std::vector<uint32_t> positions(from.count);
  copy_any(from, indices.componentType, 1, false, positions.data());
  for (const uint32_t position : positions)
    if (position >= accessor.count)
      fail("a sparse index of accessors[{}] is {}, but it has {} elements", index, position, accessor.count);
  return positions;
}

/// `Element` is a packed array of `To`; `type` the glTF type that it stands for.
template <typename Element, typename To>
std::vector<Element> read(const tinygltf::Model& model, int index, int type, const char* type_name,
                          const ElementRange& range = {}) {
  const tinygltf::Accessor& accessor = accessor_at(model, index);
  const size_t first = std::min(range.first, accessor.count), count = std::min(range.count, accessor.count - first);
  if (accessor.type != type) fail("accessors[{}] is not of type {}", index, type_name);
  const bool is_unsigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (std::is_integral_v<To> && !is_unsigned) fail("accessors[{}] is an index but not an unsigned integer", index);
  constexpr size_t components = sizeof(Element) / sizeof(To);
  const auto component_size =
      static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
  const size_t element_size = component_size * components;

  std::vector<Element> result;
  if (accessor.bufferView >= 0) {
    const size_t stride = model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    Elements from =
        locate(model, index, accessor.bufferView, accessor.byteOffset, accessor.count, element_size, stride);
    from.data += first * from.stride;
    from.count = count;
    result.resize(count);
    To* to = reinterpret_cast<To*>(result.data());
    const bool same_type = accessor.componentType == (std::is_integral_v<To> ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                                                                             : TINYGLTF_COMPONENT_TYPE_FLOAT);
    if (same_type && from.stride == sizeof(Element) && from.count > 0)
      std::memcpy(to, from.data, from.count * sizeof(Element));
    else
      copy_any(from, accessor.componentType, components, accessor.normalized, to);
  } else {
    if (accessor.count > max_unbacked_count)
      fail("accessors[{}] claims {} elements without a buffer view", index, accessor.count);
    result.resize(count, Element(To(0)));
  }

  if (accessor.sparse.isSparse && accessor.sparse.count > 0) {
    const std::vector<uint32_t> positions = sparse_positions(model, index);
    const auto& values = accessor.sparse.values;
    const Elements from = locate(model, index, values.bufferView, static_cast<size_t>(values.byteOffset),
                                 positions.size(), element_size, 0);
    std::vector<Element> replaced(from.count);
    copy_any(from, accessor.componentType, components, accessor.normalized, reinterpret_cast<To*>(replaced.data()));
    for (size_t i = 0; i < replaced.size(); ++i)
      if (positions[i] >= first && positions[i] - first < count) result[positions[i] - first] = replaced[i];
  }
  return result;
}

}  // namespace

size_t accessor_count(const tinygltf::Model& model, int accessor) {
  return accessor_at(model, accessor).count;
}

std::vector<float> read_floats(const tinygltf::Model& model, int accessor) {
  return read<float, float>(model, accessor, TINYGLTF_TYPE_SCALAR, "SCALAR");
}

std::vector<glm::vec2> read_vec2(const tinygltf::Model& model, int accessor, const ElementRange& range) {
  return read<glm::vec2, float>(model, accessor, TINYGLTF_TYPE_VEC2, "VEC2", range);
}

std::vector<glm::vec3> read_vec3(const tinygltf::Model& model, int accessor, const ElementRange& range) {
  return read<glm::vec3, float>(model, accessor, TINYGLTF_TYPE_VEC3, "VEC3", range);
}

std::vector<glm::vec4> read_vec4(const tinygltf::Model& model, int accessor, const ElementRange& range) {
  return read<glm::vec4, float>(model, accessor, TINYGLTF_TYPE_VEC4, "VEC4", range);
}

std::vector<glm::mat4> read_mat4(const tinygltf::Model& model, int accessor) {
  if (accessor_at(model, accessor).componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    fail("accessors[{}] holds matrices that are not floats", accessor);
  return read<glm::mat4, float>(model, accessor, TINYGLTF_TYPE_MAT4, "MAT4");
}

std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor) {
  return read<uint32_t, uint32_t>(model, accessor, TINYGLTF_TYPE_SCALAR, "SCALAR");
}

std::vector<glm::uvec4> read_uvec4(const tinygltf::Model& model, int accessor, const ElementRange& range) {
  return read<glm::uvec4, uint32_t>(model, accessor, TINYGLTF_TYPE_VEC4, "VEC4", range);
}

}  // namespace izb
