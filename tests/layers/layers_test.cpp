// SPDX-License-Identifier: MIT
// The one-way order of the layers, read from the #include lines:
//   base → image → scene → reference;  base → gpu;  scene + gpu → frame → shadow → app → view
// and the homes of the libraries that only one file may see.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A folder of src/ and those that it may include, itself aside.
const std::map<std::string, std::set<std::string>> layers{
    {"base", {}},
    {"image", {"base"}},
    {"scene", {"base", "image"}},
    {"reference", {"base", "image", "scene"}},
    {"gpu", {"base"}},
    {"frame", {"base", "image", "scene", "gpu", "shared"}},
    {"shadow", {"base", "image", "scene", "gpu", "frame", "shared"}},
    {"app", {"base", "image", "scene", "reference", "gpu", "frame", "shadow", "shared"}},
    {"view", {"base", "image", "scene", "reference", "gpu", "frame", "shadow", "app", "shared"}}};

/// Headers (a regular expression over the text between the quotes or brackets) that only some files may
/// include.
struct Home {
  const char* header;
  const char* file;  ///< regular expression over the path below src/
};

const Home homes[] = {
    {"(GLFW/.*)|(glfw.*)", "gpu/context_glfw\\.cpp|view/window/window\\.cpp"},
    {"imgui.*", "view/window/.*"},
    {"EGL/.*", "gpu/context_egl\\.cpp"},
    {"GL/osmesa.*", "gpu/context_osmesa\\.cpp"},
    {"GL/.*", "gpu/(gl\\.h|context_[a-z]+\\.cpp)"},
    {"(.*/)?tiny_gltf\\.h", "scene/gltf[a-z_]*\\.(h|cpp)"},
    {"meshoptimizer\\.h|draco/.*", "scene/gltf_compression\\.cpp"},
    {"(OpenEXR/.*)|(Imf.*)", "image/exr\\.cpp"},
    {"png\\.h", "image/png\\.cpp"},
    {"(glslang|SPIRV)/.*", "gpu/glsl_front_end\\.cpp"},
    {"embree.*", "reference/embree[a-z_]*\\.cpp"},
    {"gmp(xx)?\\.h", "reference/.*\\.cpp"},
    {"openssl/.*", "base/(sha256|base64)\\.cpp"},
};

std::vector<std::string> included(const fs::path& file) {
  static const std::regex directive("\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::vector<std::string> names;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (std::smatch match; std::regex_match(line, match, directive)) names.push_back(match[1]);
  return names;
}

/// Why a file of src/ may not include a header, or "".
std::string violation(const std::string& file, const std::string& header) {
  for (const Home& home : homes)
    if (std::regex_match(header, std::regex(home.header)) && !std::regex_match(file, std::regex(home.file)))
      return "only " + std::string(home.file) + " may";
  if (header.starts_with(".")) return "includes are written from src/";
  const size_t slash = header.find('/');
  if (slash == std::string::npos) return "";
  const std::string from = file.substr(0, file.find('/'));
  const std::string to = header.substr(0, slash);
  if (to != "shared" && !layers.contains(to)) return "";  // of a library
  const auto layer = layers.find(from);
  if (layer == layers.end()) return "the folder " + from + " has no place in the order of the layers";
  if (from == "shadow") {
    const std::string room = file.substr(0, file.rfind('/'));
    if (to == "reference") return room == "shadow/ray_traced" ? "" : "only the room ray_traced may";
    // A room is entered through the registry only, and knows no other room.
    const std::string target = header.substr(0, header.rfind('/'));
    if (to == "shadow" && target != "shadow" && target != room && file != "shadow/registry.cpp")
      return "a room includes no other room";
  }
  if (to == from || layer->second.contains(to)) return "";
  return from + " stands below " + to + " or beside it";
}

/// Every forbidden include below `src`, as "file: header: why".
std::vector<std::string> violations(const fs::path& src) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(src)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp" && extension != ".in") continue;
    const std::string file = entry.path().lexically_relative(src);
    for (const std::string& header : included(entry.path()))
      if (const std::string why = violation(file, header); !why.empty())
        found.push_back(file + ": " + header + ": " + why);
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Layers, EveryFolderOfTheTreeHasAPlace) {
  for (const auto& entry : fs::directory_iterator(IZB_SOURCE_DIR "/src")) {
    if (entry.is_directory()) {
      EXPECT_TRUE(layers.contains(entry.path().filename())) << entry.path();
    }
  }
}

TEST(Layers, TheTreeKeepsTheOrder) {
  const std::vector<std::string> found = violations(IZB_SOURCE_DIR "/src");
  for (const std::string& line : found) ADD_FAILURE() << line;
}

/// A tree of its own, in which each test plants one file.
struct Planted : testing::Test {
  const fs::path src = fs::path(testing::TempDir()) / ("izb_layers_test_" + std::to_string(getpid()));
  ~Planted() override { fs::remove_all(src); }
  std::vector<std::string> with(const std::string& file, const std::string& text) {
    fs::remove_all(src);
    fs::create_directories((src / file).parent_path());
    std::ofstream(src / file) << text;
    return violations(src);
  }
  bool allowed(const std::string& file, const std::string& text) { return with(file, text).empty(); }
};

TEST_F(Planted, HigherAndNeighbouringLayersAreFound) {
  EXPECT_EQ(with("base/a.h", "// text\n#include \"scene/scene.h\"\n"),
            std::vector<std::string>{"base/a.h: scene/scene.h: base stands below scene or beside it"});
  EXPECT_FALSE(allowed("image/a.cpp", "#include \"scene/scene.h\"\n"));
  EXPECT_FALSE(allowed("scene/a.cpp", "#include <reference/truth.h>\n"));
  EXPECT_FALSE(allowed("scene/a.cpp", "  #  include \"gpu/gl.h\"\n"));
  EXPECT_FALSE(allowed("gpu/a.cpp", "#include \"scene/scene.h\"\n"));
  EXPECT_FALSE(allowed("gpu/a.cpp", "#include \"image/image.h\"\n"));
  EXPECT_FALSE(allowed("reference/a.cpp", "#include \"gpu/gl.h\"\n"));
  EXPECT_FALSE(allowed("frame/a.cpp", "#include \"shadow/technique.h\"\n"));
  EXPECT_FALSE(allowed("frame/a.cpp", "#include \"reference/truth.h\"\n"));
  EXPECT_FALSE(allowed("shadow/a.cpp", "#include \"app/session.h\"\n"));
  EXPECT_FALSE(allowed("elsewhere/a.cpp", "#include \"base/error.h\"\n"));
  EXPECT_FALSE(allowed("base/a.cpp", "#include \"../scene/scene.h\"\n"));
  EXPECT_TRUE(allowed("app/a.cpp", "#include \"base/error.h\"\n#include \"reference/truth.h\"\n#include <vector>\n"));
}

TEST_F(Planted, SharedTextAndReferenceAreKeptFromWhoMustNotSeeThem) {
  EXPECT_FALSE(allowed("reference/a.cpp", "#include \"shared/light.h\"\n"));
  EXPECT_FALSE(allowed("scene/a.cpp", "#include \"shared/light.h\"\n"));
  EXPECT_FALSE(allowed("gpu/a.cpp", "#include \"shared/bindings.h\"\n"));
  EXPECT_TRUE(allowed("frame/a.cpp", "#include \"shared/light.h\"\n"));
  EXPECT_FALSE(allowed("shadow/a.cpp", "#include \"reference/truth.h\"\n"));
  EXPECT_FALSE(allowed("shadow/izb/a.cpp", "#include \"reference/truth.h\"\n"));
  EXPECT_TRUE(allowed("shadow/ray_traced/a.cpp", "#include \"reference/truth.h\"\n"));
}

TEST_F(Planted, RoomsHaveNoCorridor) {
  EXPECT_FALSE(allowed("shadow/izb/a.cpp", "#include \"shadow/ray_traced/ray_traced.h\"\n"));
  EXPECT_FALSE(allowed("shadow/renderer.cpp", "#include \"shadow/izb/izb.h\"\n"));
  EXPECT_TRUE(allowed("shadow/registry.cpp", "#include \"shadow/izb/izb.h\"\n"));
  EXPECT_TRUE(allowed("shadow/izb/a.cpp", "#include \"shadow/izb/izb.h\"\n#include \"shadow/technique.h\"\n"));
}

TEST_F(Planted, LibrariesStayInTheirFiles) {
  const std::pair<const char*, const char*> pairs[] = {{"GLFW/glfw3.h", "gpu/context_glfw.cpp"},
                                                       {"imgui.h", "view/window/panels.cpp"},
                                                       {"EGL/egl.h", "gpu/context_egl.cpp"},
                                                       {"GL/osmesa.h", "gpu/context_osmesa.cpp"},
                                                       {"GL/glcorearb.h", "gpu/gl.h"},
                                                       {"tiny_gltf.h", "scene/gltf_nodes.cpp"},
                                                       {"draco/compression/decode.h", "scene/gltf_compression.cpp"},
                                                       {"ImfHeader.h", "image/exr.cpp"},
                                                       {"OpenEXR/ImfHeader.h", "image/exr.cpp"},
                                                       {"glslang/Public/ShaderLang.h", "gpu/glsl_front_end.cpp"},
                                                       {"embree3/rtcore.h", "reference/embree.cpp"},
                                                       {"gmpxx.h", "reference/exact.cpp"},
                                                       {"png.h", "image/png.cpp"},
                                                       {"openssl/evp.h", "base/sha256.cpp"}};
  for (const auto& [header, home] : pairs) {
    const std::string text = "#include <" + std::string(header) + ">\n";
    EXPECT_TRUE(allowed(home, text)) << header;
    EXPECT_FALSE(allowed("app/a.cpp", text)) << header;
    EXPECT_FALSE(allowed("gpu/context.h", text)) << header;
  }
}

}  // namespace
