// SPDX-License-Identifier: MIT
// Compressed geometry: what the libraries' own encoders made comes out as it went in, and broken streams are sentences.
#include "scene/gltf_compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "cpu/compressed_files.h"
#include "scene/gltf.h"

namespace izb::test {
namespace {

using Triangle = std::array<std::array<float, 3>, 3>;

/// Every triangle from its smallest corner on, in order.
std::vector<Triangle> triangles_of(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices) {
  std::vector<Triangle> all;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    Triangle t;
    for (size_t k = 0; k < 3; ++k) {
      const glm::vec3 p = positions[indices[i + k]];
      t[k] = {p.x, p.y, p.z};
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  return all;
}

struct GltfCompression : testing::Test {
  const TemporaryFolder folder;

  Scene load(const GltfWriter& gltf) const { return load_gltf(write_file(folder / "compressed.glb", gltf.glb())); }
  std::string refusal(const GltfWriter& gltf) const {
    try {
      load(gltf);
    } catch (const Error& e) {
      return e.what();
    }
    return "no refusal";
  }
};

#ifdef IZB_HAVE_MESHOPT

TEST_F(GltfCompression, MeshoptComesOutAsItWentIn) {
  const Bumps bumps(40);
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const Scene scene = load(meshopt_file(bumps, mode));
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(triangles_of(scene.meshes[0].positions, scene.meshes[0].indices),
              triangles_of(bumps.positions, bumps.indices))
        << mode;
  }
}

TEST_F(GltfCompression, MeshoptFiltersAreApplied) {
  // Normals as octahedral pairs of signed bytes.
  GltfWriter gltf = one_triangle();
  const std::vector<glm::vec4> normals{{0, 0, 1, 0}, {0.6f, 0, 0.8f, 0}, {0, -1, 0, 0}};
  std::vector<uint8_t> packed(12);
  meshopt_encodeFilterOct(packed.data(), 3, 4, 8, &normals[0].x);
  std::string bytes(meshopt_encodeVertexBufferBound(3, 4), '\0');
  auto* data = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(meshopt_encodeVertexBuffer(data, bytes.size(), packed.data(), 3, 4));
  const int view = add_meshopt_view(gltf, bytes, 3, 4, "ATTRIBUTES");
  gltf.root["bufferViews"][static_cast<size_t>(view)]["extensions"]["EXT_meshopt_compression"]["filter"] = "OCTAHEDRAL";
  const int accessor = gltf.add_accessor(view, type_int8, "VEC3", 3);
  gltf.root["accessors"][static_cast<size_t>(accessor)]["normalized"] = true;
  gltf.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = accessor;
  gltf.root["buffers"] = {{{"byteLength", gltf.buffer.size()}}, {{"byteLength", 12}}};
  gltf.root["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.meshes[0].normals.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_GT(glm::dot(scene.meshes[0].normals[i], glm::vec3(normals[i])), 0.999f) << i;
}

TEST_F(GltfCompression, BrokenMeshoptStreamsAreSentences) {
  const GltfWriter good = meshopt_file(Bumps(6));
  const auto broken = [&](size_t view, const char* key, const json& value) {
    GltfWriter gltf = good;
    gltf.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
    return refusal(gltf);
  };
  const auto expect = [](const std::string& sentence, const std::string& part) {
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  };
  expect(broken(0, "byteStride", 10), "multiple of 4");
  expect(broken(0, "byteStride", 260), "multiple of 4");
  expect(broken(0, "byteStride", 16), "broken");
  expect(broken(0, "count", uint64_t(1) << 40), "more than its bytes can hold");
  expect(broken(1, "count", uint64_t(1) << 40), "more than its bytes can hold");
  expect(broken(1, "count", 4), "multiple of 3");
  expect(broken(1, "byteStride", 8), "neither 2 nor 4");
  expect(broken(0, "mode", "LINES"), "its mode");
  expect(broken(0, "filter", "QUATERNION"), "do not go together");
  expect(broken(1, "filter", "OCTAHEDRAL"), "only attributes");
  expect(broken(0, "byteLength", 1 << 20), "do not lie in buffers[0]");
  expect(broken(0, "buffer", 7), "buffers");
  expect(broken(1, "byteLength", 80), "broken");
  GltfWriter uncompressed = good;  // found by the fuzzer
  uncompressed.root["bufferViews"][0].erase("extensions");
  expect(refusal(uncompressed), "bufferViews[0] shows buffers[1]");
  for (size_t at = 20; at < good.buffer.size(); at += 37) {  // no flipped byte is more than another picture
    GltfWriter gltf = good;
    gltf.buffer[at] = static_cast<char>(gltf.buffer[at] ^ 0x5a);
    refusal(gltf);
  }
}

#endif
#ifdef IZB_HAVE_DRACO

TEST_F(GltfCompression, DracoComesOutAsItWentIn) {
  const Bumps bumps(40);
  const Scene scene = load(draco_file(bumps));
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(triangles_of(scene.meshes[0].positions, scene.meshes[0].indices),
            triangles_of(bumps.positions, bumps.indices));
}

TEST_F(GltfCompression, BrokenDracoStreamsAreSentences) {
  const GltfWriter good = draco_file(Bumps(6));
  const auto expect = [&](const std::string& part, auto&& change) {
    GltfWriter gltf = good;
    change(gltf, gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
    const std::string sentence = refusal(gltf);
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  };
  expect("bufferView is 9", [](GltfWriter&, json& d) { d["bufferView"] = 9; });
  expect("has no 'bufferView'", [](GltfWriter&, json& d) { d.erase("bufferView"); });
  expect("there is no attribute 77", [](GltfWriter&, json& d) { d["attributes"]["POSITION"] = 77; });
  expect("compresses NORMAL", [](GltfWriter&, json& d) { d["attributes"]["NORMAL"] = 0; });
  expect("its bytes are broken", [](GltfWriter& g, json&) { g.buffer[0] = 'x'; });
  expect("its bytes are broken", [](GltfWriter& g, json&) { g.root["bufferViews"][0]["byteLength"] = 20; });
  expect("has no indices", [](GltfWriter& g, json&) { g.root["meshes"][0]["primitives"][0].erase("indices"); });
}

#endif

TEST_F(GltfCompression, WithoutItsLibraryARequiredExtensionIsRefusedByName) {
  for (const auto& [name, available] : {std::pair{"EXT_meshopt_compression", meshopt_available()},
                                        std::pair{"KHR_draco_mesh_compression", draco_available()}}) {
    GltfWriter gltf = one_triangle();
    gltf.root["extensionsRequired"] = {name};
    const std::string sentence = refusal(gltf);
    EXPECT_EQ(sentence.find(std::string("requires the extension ") + name) == std::string::npos, available) << sentence;
  }
}

}  // namespace
}  // namespace izb::test
