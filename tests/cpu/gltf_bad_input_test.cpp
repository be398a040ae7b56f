// SPDX-License-Identifier: MIT
// Every bad file ends in one sentence that names the file and the cause.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "base/error.h"
#include "gltf_writer.h"
#include "scene/gltf.h"

namespace izb {
namespace {

using test::GltfWriter;
using test::json;
using test::one_triangle;
using test::write_file;

/// The sentence that loading ends in; empty if it loads.
std::string sentence(const std::filesystem::path& path) {
  try {
    load_gltf(path);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

void expect_sentence(const std::filesystem::path& path, const std::string& cause) {
  const std::string text = sentence(path);
  EXPECT_NE(text.find(cause), std::string::npos) << "'" << text << "' should say '" << cause << "'";
  EXPECT_NE(text.find(path.string()), std::string::npos) << "'" << text << "' does not name the file";
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_LT(text.size(), path.string().size() + 400) << text;
}

class GltfBadInput : public testing::Test {
 protected:
  test::TemporaryFolder folder;

  std::filesystem::path write(const GltfWriter& gltf) { return write_file(folder / "scene.glb", gltf.glb()); }
};

TEST_F(GltfBadInput, TheUntouchedTriangleLoads) {
  EXPECT_EQ(sentence(write(one_triangle())), "");
}

TEST_F(GltfBadInput, NotAFile) {
  expect_sentence(folder / "absent.glb", "no such file");
  std::filesystem::create_directory(folder / "folder.glb");
  expect_sentence(folder / "folder.glb", "it is a directory");
  expect_sentence("/dev/null", "not a regular file");
}

TEST_F(GltfBadInput, UnreadableFile) {
  const auto path = write(one_triangle());
  std::filesystem::permissions(path.parent_path(), std::filesystem::perms(0755));
  std::filesystem::permissions(path, std::filesystem::perms::none);
  constexpr uid_t nobody = 65534;
  const bool is_root = geteuid() == 0;  // who may read every file
  if (is_root && seteuid(nobody) != 0) GTEST_SKIP() << "cannot give up the right to read every file";
  expect_sentence(path, "cannot be opened (Permission denied)");
  if (is_root) {
    ASSERT_EQ(seteuid(0), 0);
  }
}

TEST_F(GltfBadInput, NotGltf) {
  expect_sentence(write_file(folder / "empty.glb", ""), "it is empty");
  expect_sentence(write_file(folder / "text.gltf", "hello"), "neither a GLB nor JSON");
  expect_sentence(write_file(folder / "array.gltf", "[1, 2]"), "not glTF");
  expect_sentence(write_file(folder / "other.gltf", R"({"asset": {"name": "x"}})"), "not glTF");
  expect_sentence(write_file(folder / "old.gltf", R"({"asset": {"version": "1.0"}})"), "version '1.0'");
  expect_sentence(write_file(folder / "deep.gltf", std::string(100000, '[')), "nested deeper");
  expect_sentence(write_file(folder / "huge.gltf", R"({"asset": {"version": "2.0"}, "x": 1e999})"), "out of range");
}

TEST_F(GltfBadInput, RandomBytesNeverCrash) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    std::string bytes(1 + random() % 5000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_NE(sentence(write_file(folder / "random.glb", bytes)), "");
    bytes.replace(0, std::min<size_t>(4, bytes.size()), "glTF");
    EXPECT_NE(sentence(write_file(folder / "random.glb", bytes)), "");
  }
}

TEST_F(GltfBadInput, TruncatedAnywhere) {
  const std::string whole = one_triangle().glb();
  for (size_t size = 1; size < whole.size(); ++size)
    EXPECT_NE(sentence(write_file(folder / "cut.glb", whole.substr(0, size))), "") << size << " bytes";
  expect_sentence(write_file(folder / "cut.glb", whole.substr(0, whole.size() - 4)), "truncated");
  expect_sentence(write_file(folder / "cut.glb", whole.substr(0, 10)), "truncated");
}

TEST_F(GltfBadInput, ChunkLengthsBeyondTheFile) {
  const std::string whole = one_triangle().glb();
  std::string longer_json = whole;
  longer_json.replace(12, 4, GltfWriter::u32(whole.size()));
  expect_sentence(write_file(folder / "chunk.glb", longer_json), "JSON chunk is longer");
  std::string longer_binary = whole;
  const size_t binary_header = whole.rfind(std::string("BIN\0", 4)) - 4;
  longer_binary.replace(binary_header, 4, GltfWriter::u32(whole.size() - binary_header - 4));
  expect_sentence(write_file(folder / "chunk.glb", longer_binary), "second chunk is longer");
}

TEST_F(GltfBadInput, FlippedBytesNeverCrash) {
  const std::string whole = one_triangle().glb();
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k) bytes[12 + random() % (bytes.size() - 12)] = static_cast<char>(random());
    sentence(write_file(folder / "flipped.glb", bytes));
  }
}

/// A change to the triangle's document and the cause that the sentence must give.
struct Damage {
  const char* what;
  std::function<void(GltfWriter&)> change;
  const char* cause;
};

const std::vector<Damage> damages = {
    {"index", [](GltfWriter& g) { g.buffer[36] = 7; }, "index 7 is out of range (3 vertices)"},
    {"NaN",
     [](GltfWriter& g) {
       const float nan = std::numeric_limits<float>::quiet_NaN();
       std::memcpy(&g.buffer[16], &nan, 4);
     },
     "the position of vertex 1 is not finite"},
    {"infinity",
     [](GltfWriter& g) {
       const float infinity = std::numeric_limits<float>::infinity();
       std::memcpy(&g.buffer[0], &infinity, 4);
     },
     "the position of vertex 0 is not finite"},
    {"count", [](GltfWriter& g) { g.root["accessors"][0]["count"] = 4; }, "accessors[0] has 4 elements"},
    {"overflowing count", [](GltfWriter& g) { g.root["accessors"][1]["count"] = uint64_t(1) << 53; },
     "accessors[1] has 9007199254740992 elements"},
    {"count without view",
     [](GltfWriter& g) {
       g.root["accessors"][0]["count"] = 4000000000u;
       g.root["accessors"][0].erase("bufferView");
     },
     "claims 4000000000 elements"},
    {"accessor offset", [](GltfWriter& g) { g.root["accessors"][0]["byteOffset"] = uint64_t(1) << 52; },
     "more than bufferViews[0]"},
    {"view offset", [](GltfWriter& g) { g.root["bufferViews"][0]["byteOffset"] = uint64_t(1) << 52; },
     "but buffers[0] has"},
    {"offset too large", [](GltfWriter& g) { g.root["bufferViews"][0]["byteOffset"] = ~uint64_t(0); },
     "bufferViews[0].byteOffset is not a whole number"},
    {"negative offset", [](GltfWriter& g) { g.root["bufferViews"][0]["byteOffset"] = -4; },
     "bufferViews[0].byteOffset is not a whole number"},
    {"buffer too short",
     [](GltfWriter& g) {
       g.root["buffers"] = {{{"byteLength", 4000}}};
     },
     "4000"},
    {"buffer of nothing",
     [](GltfWriter& g) {
       g.root["buffers"] = {{{"byteLength", 0}}};
       g.root["bufferViews"] = json::array();
       g.root["accessors"] = {{{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
       g.root["meshes"][0]["primitives"][0].erase("indices");
     },
     "cannot load"},
    {"stride", [](GltfWriter& g) { g.root["bufferViews"][0]["byteStride"] = 7; }, "byteStride"},
    {"component type", [](GltfWriter& g) { g.root["accessors"][0]["componentType"] = 5124; },
     "unknown component type 5124"},
    {"index component type", [](GltfWriter& g) { g.root["accessors"][1]["componentType"] = test::type_int16; },
     "not an unsigned integer"},
    {"type", [](GltfWriter& g) { g.root["accessors"][0]["type"] = "VEC2"; }, "is not of type VEC3"},
    {"unknown type", [](GltfWriter& g) { g.root["accessors"][0]["type"] = "VEC9"; }, "unknown type 'VEC9'"},
    {"sparse index",
     [](GltfWriter& g) {
       g.root["accessors"][0]["sparse"] = {
           {"count", 1},
           {"indices", {{"bufferView", 0}, {"byteOffset", 15}, {"componentType", 5121}}},
           {"values", {{"bufferView", 0}}}};
     },
     "sparse index of accessors[0] is 63"},
    {"sparse count",
     [](GltfWriter& g) {
       g.root["accessors"][0]["sparse"] = {
           {"count", 1000}, {"indices", {{"bufferView", 1}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
     },
     "more than bufferViews[1]"},
    {"vertex arrays",
     [](GltfWriter& g) {
       const int normals = g.add_positions({0, 0, 1, 0, 0, 1});
       g.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
     },
     "NORMAL has 2 elements, but POSITION has 3"},
    {"mode", [](GltfWriter& g) { g.root["meshes"][0]["primitives"][0]["mode"] = 7; }, "no primitive mode 7"},
    {"cycle",
     [](GltfWriter& g) {
       g.append("nodes", {{"children", {2}}});
       g.append("nodes", {{"children", {1}}});
     },
     "nodes[1] is part of, or below, a cycle"},
    {"own child", [](GltfWriter& g) { g.root["nodes"][0]["children"] = {0}; }, "cycle"},
    {"two parents",
     [](GltfWriter& g) {
       g.append("nodes", {{"children", {0}}});
       g.append("nodes", {{"children", {0}}});
     },
     "nodes[0] is a child twice"},
    {"matrix length",
     [](GltfWriter& g) {
       g.root["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "nodes[0].matrix is not an array of 16 numbers"},
    {"projective matrix",
     [](GltfWriter& g) { g.root["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "not affine"},
    {"transform overflow",
     [](GltfWriter& g) {
       g.root["nodes"][0]["scale"] = {1e300, 1, 1};
     },
     "out of the range"},
    {"transform overflow to infinity",
     [](GltfWriter& g) {
       g.root["nodes"][0]["scale"] = {1e300, 1, 1};
       const int parent = g.append("nodes", {{"scale", {1e300, 1, 1}}, {"children", {0}}});
       g.root["scenes"][0]["nodes"] = {parent};
     },
     "not finite"},
    {"zero rotation",
     [](GltfWriter& g) {
       g.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "no length"},
    {"mesh index", [](GltfWriter& g) { g.root["nodes"][0]["mesh"] = 5; },
     "nodes[0].mesh is 5, but the file's number of meshes is 1"},
    {"negative index", [](GltfWriter& g) { g.root["nodes"][0]["mesh"] = -1; }, "nodes[0].mesh is not an index"},
    {"scene index", [](GltfWriter& g) { g.root["scene"] = 3; }, "scene is 3"},
    {"scene node", [](GltfWriter& g) { g.root["scenes"][0]["nodes"] = {8}; }, "scenes[0].nodes[0] is 8"},
    {"wrong type", [](GltfWriter& g) { g.root["nodes"] = "none"; }, "nodes is not an array"},
    {"wrong element", [](GltfWriter& g) { g.root["accessors"][0] = 1; }, "accessors[0] is not an object"},
    {"missing property", [](GltfWriter& g) { g.root["accessors"][0].erase("count"); }, "accessors[0] has no 'count'"},
    {"required extension", [](GltfWriter& g) { g.root["extensionsRequired"] = {"KHR_future_geometry"}; },
     "requires the extension KHR_future_geometry"},
    {"image view",
     [](GltfWriter& g) {
       g.root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 4000}});
       g.root["images"] = {{{"bufferView", 2}, {"mimeType", "image/png"}}};
     },
     "bufferViews[2] ends at byte 4040"},
    {"joint",
     [](GltfWriter& g) {
       const int joints = g.add_array(std::vector<uint8_t>(12, 3), test::type_uint8, "VEC4", 4);
       const int weights = g.add_array(std::vector<float>(12, 0.25f), test::type_float, "VEC4", 4);
       json& attributes = g.root["meshes"][0]["primitives"][0]["attributes"];
       attributes["JOINTS_0"] = joints, attributes["WEIGHTS_0"] = weights;
       g.root["skins"] = {{{"joints", {0}}}};
       g.root["nodes"][0]["skin"] = 0;
     },
     "joint 3 of a vertex is out of range (skins[0] has 1 joints)"},
    {"no triangle", [](GltfWriter& g) { g.root["scenes"][0]["nodes"] = json::array(); }, "holds no triangle"},
    {"lines only", [](GltfWriter& g) { g.root["meshes"][0]["primitives"][0]["mode"] = 1; },
     "holds no triangle, only points or lines"},
    {"external buffer",
     [](GltfWriter& g) {
       g.root["buffers"] = {{{"byteLength", 42}, {"uri", "absent.bin"}}};
     },
     "absent.bin' is missing"},
    {"unknown data URI",
     [](GltfWriter& g) {
       g.root["buffers"] = {{{"byteLength", 42}, {"uri", "data:x;base64,AAAA"}}};
     },
     "data URI"},
    {"short data URI",
     [](GltfWriter& g) {
       g.root["buffers"] = {
           {{"byteLength", 42}, {"uri", "data:application/octet-stream;base64," + std::string(100000, 'A')}}};
     },
     "the data URI of a buffer is broken"},
};

TEST_F(GltfBadInput, DamagedDocuments) {
  for (const Damage& damage : damages) {
    SCOPED_TRACE(damage.what);
    GltfWriter gltf = one_triangle();
    damage.change(gltf);
    expect_sentence(write(gltf), damage.cause);
  }
}

TEST_F(GltfBadInput, ExternalBufferTooShort) {
  GltfWriter gltf = one_triangle();
  gltf.root["buffers"] = {{{"byteLength", gltf.buffer.size()}, {"uri", "short.bin"}}};
  write_file(folder / "short.bin", gltf.buffer.substr(0, 10));
  const auto path = write_file(folder / "scene.gltf", gltf.root.dump());
  expect_sentence(path, "short.bin' has 10 bytes, but 42 are needed");
}

/// Every property of the document, replaced by values of every JSON type: an error or a scene, never a crash.
TEST_F(GltfBadInput, AnyPropertyOfAnyTypeNeverCrashes) {
  GltfWriter gltf = one_triangle();
  gltf.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
  gltf.root["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9728}}};
  gltf.root["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  gltf.root["skins"] = {{{"joints", {0}}}};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  gltf.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  gltf.root["nodes"][0]["camera"] = 0;
  gltf.root["buffers"] = {{{"byteLength", gltf.buffer.size()}}};
  testing::internal::CaptureStderr();
  ASSERT_EQ(sentence(write(gltf)), "");
  const json flat = gltf.root.flatten();
  const json values = {nullptr,
                       true,
                       -1,
                       3,
                       1e300,
                       uint64_t(1) << 63,
                       "text",
                       json::array(),
                       json::array({1}),
                       json::object(),
                       json::object({{"index", 0}})};
  for (const auto& [pointer, unused] : flat.items()) {
    for (json::json_pointer at(pointer); !at.empty(); at.pop_back())
      for (const json& value : values) {
        GltfWriter damaged = gltf;
        damaged.root[at] = value;
        sentence(write(damaged));
      }
  }
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace izb
