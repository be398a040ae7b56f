// SPDX-License-Identifier: MIT
// Small compressed glTF files, made by the libraries' own encoders.
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <memory>

#include "cpu/gltf_writer.h"

#ifdef IZB_HAVE_MESHOPT
#include <meshoptimizer.h>
#endif
#ifdef IZB_HAVE_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

namespace izb::test {

/// A bumpy square of 2 * side * side triangles.
struct Bumps {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;

  explicit Bumps(int side) {
    for (int y = 0; y <= side; ++y)
      for (int x = 0; x <= side; ++x)
        positions.emplace_back(float(x), std::sin(float(x)) * std::cos(float(3 * y)), float(y));
    const auto at = [&](int x, int y) { return uint32_t(y * (side + 1) + x); };
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (const uint32_t i : {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)})
          indices.push_back(i);
  }
};

#ifdef IZB_HAVE_MESHOPT

/// A view of `count` elements of `stride` bytes that only the second, empty buffer holds uncompressed.
inline int add_meshopt_view(GltfWriter& gltf, const std::string& bytes, size_t count, size_t stride, const char* mode) {
  const int view = gltf.add_view(bytes);
  json& v = gltf.root["bufferViews"][static_cast<size_t>(view)];
  json& extension = v["extensions"]["EXT_meshopt_compression"];
  extension = {{"buffer", 0},    {"byteOffset", v["byteOffset"]}, {"byteLength", v["byteLength"]},
               {"count", count}, {"byteStride", stride},          {"mode", mode}};
  v["buffer"] = 1;
  v["byteOffset"] = 0;
  v["byteLength"] = count * stride;
  if (std::string(mode) == "ATTRIBUTES") v["byteStride"] = stride;
  return view;
}

inline GltfWriter meshopt_file(const Bumps& bumps, const char* index_mode = "TRIANGLES") {
  GltfWriter gltf;
  const size_t vertices = bumps.positions.size(), indices = bumps.indices.size();
  std::string bytes(meshopt_encodeVertexBufferBound(vertices, 12), '\0');
  auto* data = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(meshopt_encodeVertexBuffer(data, bytes.size(), bumps.positions.data(), vertices, 12));
  const int positions = add_meshopt_view(gltf, bytes, vertices, 12, "ATTRIBUTES");
  if (std::string(index_mode) == "TRIANGLES") {
    bytes.assign(meshopt_encodeIndexBufferBound(indices, vertices), '\0');
    data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeIndexBuffer(data, bytes.size(), bumps.indices.data(), indices));
  } else {
    bytes.assign(meshopt_encodeIndexSequenceBound(indices, vertices), '\0');
    data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeIndexSequence(data, bytes.size(), bumps.indices.data(), indices));
  }
  const int list = add_meshopt_view(gltf, bytes, indices, 4, index_mode);
  const json primitive = {{"attributes", {{"POSITION", gltf.add_accessor(positions, type_float, "VEC3", vertices)}}},
                          {"indices", gltf.add_accessor(list, type_uint32, "SCALAR", indices)}};
  gltf.add_root({{"mesh", gltf.add_mesh(primitive)}});
  gltf.root["extensionsUsed"] = gltf.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  json fallback = {{"byteLength", vertices * 12 + indices * 4}};
  fallback["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  gltf.root["buffers"] = {{{"byteLength", gltf.buffer.size()}}, fallback};
  return gltf;
}

#endif
#ifdef IZB_HAVE_DRACO

inline GltfWriter draco_file(const Bumps& bumps) {
  const auto faces = static_cast<int>(bumps.indices.size() / 3);
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(faces);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int f = 0; f < faces; ++f) {
    const uint32_t* v = &bumps.indices[3 * static_cast<size_t>(f)];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<uint32_t>(f)), &bumps.positions[v[0]],
                                      &bumps.positions[v[1]], &bumps.positions[v[2]]);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;  // no quantisation: floats come out as they went in
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer encoded;
  if (!encoder.EncodeMeshToBuffer(*mesh, &encoded).ok()) throw std::logic_error("Draco cannot encode");

  GltfWriter gltf;
  const int view = gltf.add_view(std::string(encoded.data(), encoded.size()));
  const auto accessor = [&](int type, const char* shape, size_t count) {
    return gltf.append("accessors", {{"componentType", type}, {"type", shape}, {"count", count}});
  };
  json primitive = {{"attributes", {{"POSITION", accessor(type_float, "VEC3", mesh->num_points())}}},
                    {"indices", accessor(type_uint16, "SCALAR", bumps.indices.size())}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(position)->unique_id()}}}};
  gltf.add_root({{"mesh", gltf.add_mesh(primitive)}});
  gltf.root["extensionsUsed"] = gltf.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return gltf;
}

#endif

}  // namespace izb::test
