// SPDX-License-Identifier: MIT
#include "scene/gltf_compression.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

#include "base/error.h"

#ifdef IZB_HAVE_MESHOPT
#include <meshoptimizer.h>
#endif
#ifdef IZB_HAVE_DRACO
#include <draco/compression/decode.h>
#endif

namespace izb {
namespace {

using nlohmann::json;
using Bytes = std::vector<unsigned char>;

constexpr const char* meshopt_name = "EXT_meshopt_compression";
constexpr const char* draco_name = "KHR_draco_mesh_compression";

const json* extension_of(const json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto extension = extensions->find(name);
  return extension == extensions->end() ? nullptr : &*extension;
}

/// The view shows its compressed bytes from now on.
MeshoptView take_meshopt_view(json& root, size_t i) {
  json& view = root["bufferViews"][i];
  const json extension = *extension_of(view, meshopt_name);
  const uint64_t buffer = extension["buffer"], length = extension["byteLength"];
  const uint64_t offset = extension.value("byteOffset", uint64_t(0));
  const uint64_t available = root["buffers"][buffer]["byteLength"];
  if (length == 0 || offset > available || length > available - offset)
    fail("the compressed bytes of bufferViews[{}] do not lie in buffers[{}], which has {} bytes", i, buffer, available);
  view["buffer"] = buffer;
  view["byteOffset"] = offset;
  view["byteLength"] = length;
  view.erase("byteStride");
  view.erase("extensions");
  return {i, extension["count"], extension["byteStride"], extension["mode"], extension.value("filter", "NONE")};
}

/// Buffers without content of their own, which no view may show any more.
void drop_fallback_buffers(json& root) {
  for (size_t b = 0; b < root["buffers"].size(); ++b) {
    json& buffer = root["buffers"][b];
    const json* extension = extension_of(buffer, meshopt_name);
    if (!extension || !extension->value("fallback", false) || buffer.contains("uri")) continue;
    for (size_t v = 0; v < root["bufferViews"].size(); ++v)
      if (root["bufferViews"][v]["buffer"] == b)
        fail("bufferViews[{}] shows buffers[{}], which has no bytes but only stands for compressed ones", v, b);
    buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  }
}

std::span<const unsigned char> bytes_of(const tinygltf::Model& model, size_t index) {
  const tinygltf::BufferView& view = model.bufferViews[index];
  const Bytes& buffer = model.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    fail("bufferViews[{}] does not lie in its buffer", index);
  return {buffer.data() + view.byteOffset, view.byteLength};
}

int add_buffer(tinygltf::Model& model, Bytes bytes) {
  model.buffers.emplace_back();
  model.buffers.back().data = std::move(bytes);
  return static_cast<int>(model.buffers.size() - 1);
}

#ifdef IZB_HAVE_MESHOPT
/// What the library asks of its callers, and that so few bytes can hold so many elements: 64 bytes of a column of
/// vertices take at least one, a triangle or an index of a sequence takes one.
void check_meshopt(const MeshoptView& v, size_t bytes) {
  const auto require = [&](bool condition, const char* what) {
    if (!condition) fail("bufferViews[{}] cannot be decompressed ({}): {}", v.view, meshopt_name, what);
  };
  const bool attributes = v.mode == "ATTRIBUTES", triangles = v.mode == "TRIANGLES", indices = v.mode == "INDICES";
  require(attributes || triangles || indices, "its mode is none of ATTRIBUTES, TRIANGLES and INDICES");
  if (attributes) {
    require(v.stride > 0 && v.stride % 4 == 0 && v.stride <= 256, "its byteStride is no multiple of 4 up to 256");
    require(v.count <= 64 * bytes / v.stride + 256, "its count is more than its bytes can hold");
  } else {
    require(v.stride == 2 || v.stride == 4, "its byteStride is neither 2 nor 4");
    require(v.count <= (triangles ? 3 : 1) * bytes, "its count is more than its bytes can hold");
    require(!triangles || v.count % 3 == 0, "its count is no multiple of 3");
  }
  if (v.filter == "NONE") return;
  require(attributes, "only attributes have a filter");
  require((v.filter == "OCTAHEDRAL" && (v.stride == 4 || v.stride == 8)) ||
              (v.filter == "QUATERNION" && v.stride == 8) || v.filter == "EXPONENTIAL",
          "its filter and its byteStride do not go together");
}

void decompress_view(tinygltf::Model& model, const MeshoptView& v) {
  const std::span<const unsigned char> from = bytes_of(model, v.view);
  check_meshopt(v, from.size());
  Bytes to(v.count * v.stride);
  const int failure =
      v.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to.data(), v.count, v.stride, from.data(), from.size())
      : v.mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(to.data(), v.count, v.stride, from.data(), from.size())
                              : meshopt_decodeIndexSequence(to.data(), v.count, v.stride, from.data(), from.size());
  if (failure != 0) fail("bufferViews[{}] cannot be decompressed ({}): its bytes are broken", v.view, meshopt_name);
  if (v.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to.data(), v.count, v.stride);
  if (v.filter == "QUATERNION") meshopt_decodeFilterQuat(to.data(), v.count, v.stride);
  if (v.filter == "EXPONENTIAL") meshopt_decodeFilterExp(to.data(), v.count, v.stride);
  tinygltf::BufferView& view = model.bufferViews[v.view];
  view.byteOffset = 0;
  view.byteLength = to.size();
  view.byteStride = v.mode == "ATTRIBUTES" ? v.stride : 0;
  view.buffer = add_buffer(model, std::move(to));
}
#else
void decompress_view(tinygltf::Model&, const MeshoptView&) {}
#endif

#ifdef IZB_HAVE_DRACO
int add_view(tinygltf::Model& model, Bytes bytes) {
  tinygltf::BufferView view;
  view.byteLength = bytes.size();
  view.buffer = add_buffer(model, std::move(bytes));
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size() - 1);
}

/// The values of one attribute at every point of the mesh, in the accessor's own component type.
template <typename T>
Bytes values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components) {
  const size_t each = sizeof(T) * static_cast<size_t>(components);
  Bytes bytes(each * mesh.num_points());
  std::vector<T> value(static_cast<size_t>(std::max(components, int(attribute.num_components()))));
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
    if (!attribute.ConvertValue<T>(index, static_cast<int8_t>(components), value.data()))
      fail("its values cannot be converted");
    std::memcpy(bytes.data() + each * i, value.data(), each);
  }
  return bytes;
}

Bytes values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const tinygltf::Accessor& accessor) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
  if (components < 1 || components > 4) fail("it is no vector");
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return values_of<int8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return values_of<uint8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return values_of<int16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return values_of<uint16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return values_of<uint32_t>(mesh, attribute, components);
    default:
      return values_of<float>(mesh, attribute, components);
  }
}

void set_accessor(tinygltf::Model& model, int index, Bytes bytes, size_t count) {
  tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(index)];
  accessor.bufferView = add_view(model, std::move(bytes));
  accessor.byteOffset = 0;
  accessor.count = count;
  accessor.sparse.isSparse = false;
}

void decompress_primitive(tinygltf::Model& model, const DracoPrimitive& d) {
  tinygltf::Primitive& primitive = model.meshes[d.mesh].primitives[d.primitive];
  const std::string where =
      fmt::format("meshes[{}].primitives[{}] cannot be decompressed ({})", d.mesh, d.primitive, draco_name);
  const std::span<const unsigned char> from = bytes_of(model, d.view);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(from.data()), from.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) fail("{}: its bytes are broken", where);
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  // An accessor that two primitives share would be overwritten by the second: each gets accessors of its own.
  const auto own_accessor = [&](int index) {
    model.accessors.push_back(model.accessors[static_cast<size_t>(index)]);
    return static_cast<int>(model.accessors.size() - 1);
  };
  for (const auto& [name, id] : d.attributes) {
    const auto it = primitive.attributes.find(name);
    if (it == primitive.attributes.end()) fail("{}: it compresses {}, which it does not have", where, name);
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
    if (!attribute) fail("{}: there is no attribute {} for {} in its bytes", where, id, name);
    it->second = own_accessor(it->second);
    try {
      Bytes bytes = values_of(*mesh, *attribute, model.accessors[static_cast<size_t>(it->second)]);
      set_accessor(model, it->second, std::move(bytes), mesh->num_points());
    } catch (const Error& e) {
      fail("{}: {}: {}", where, name, e.what());
    }
  }
  Bytes indices(sizeof(uint32_t) * 3 * mesh->num_faces());
  for (uint32_t f = 0; f < mesh->num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const uint32_t point = mesh->face(draco::FaceIndex(f))[static_cast<size_t>(k)].value();
      std::memcpy(indices.data() + sizeof point * (3 * size_t(f) + static_cast<size_t>(k)), &point, sizeof point);
    }
  if (primitive.indices < 0) fail("{}: it has no indices", where);
  primitive.indices = own_accessor(primitive.indices);
  tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(primitive.indices)];
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  set_accessor(model, primitive.indices, std::move(indices), 3 * size_t(mesh->num_faces()));
  primitive.mode = TINYGLTF_MODE_TRIANGLES;  // a strip comes out as a list
}
#else
void decompress_primitive(tinygltf::Model&, const DracoPrimitive&) {}
#endif

}  // namespace

bool meshopt_available() {
#ifdef IZB_HAVE_MESHOPT
  return true;
#else
  return false;
#endif
}

bool draco_available() {
#ifdef IZB_HAVE_DRACO
  return true;
#else
  return false;
#endif
}

Compression take_compression(json& root) {
  Compression found;
  const auto count = [&](const char* name) { return root.contains(name) ? root[name].size() : 0; };
  for (size_t i = 0; i < count("bufferViews") && meshopt_available(); ++i)
    if (extension_of(root["bufferViews"][i], meshopt_name)) found.views.push_back(take_meshopt_view(root, i));
  if (!found.views.empty()) drop_fallback_buffers(root);
  for (size_t m = 0; m < count("meshes") && draco_available(); ++m) {
    const json& primitives = root["meshes"][m]["primitives"];
    for (size_t p = 0; p < primitives.size(); ++p) {
      const json* extension = extension_of(primitives[p], draco_name);
      if (!extension) continue;
      DracoPrimitive primitive{m, p, (*extension)["bufferView"], {}};
      for (const auto& [name, id] : (*extension)["attributes"].items()) primitive.attributes.emplace_back(name, id);
      // The parser wants some view behind indices; these get their own when they are decompressed.
      if (const auto indices = primitives[p].find("indices"); indices != primitives[p].end()) {
        json& accessor = root["accessors"][indices->get<size_t>()];
        if (!accessor.contains("bufferView")) accessor["bufferView"] = primitive.view;
      }
      found.primitives.push_back(std::move(primitive));
    }
  }
  return found;
}

void decompress(tinygltf::Model& model, const Compression& compression) {
  for (const MeshoptView& view : compression.views) decompress_view(model, view);
  for (const DracoPrimitive& primitive : compression.primitives) decompress_primitive(model, primitive);
}

}  // namespace izb
