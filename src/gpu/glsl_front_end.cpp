// SPDX-License-Identifier: MIT
#include "gpu/glsl_front_end.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/build_info.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/shipped.h"

namespace izb::gpu {
namespace {

constexpr int glsl_version = 450;
/// To be changed with what this file makes of a text: programs are kept by it.
constexpr int front_end_version = 1;

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read shader {}", path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Finds #include "x" below the shader folder; names stay relative to it, so that messages are the same everywhere.
class Includer final : public glslang::TShader::Includer {
 public:
  IncludeResult* includeLocal(const char* name, const char*, size_t) override {
    std::ifstream in(glsl_folder() / name, std::ios::binary);
    if (!in) return nullptr;
    std::ostringstream text;
    text << in.rdbuf();
    texts_.push_back(std::make_unique<std::string>(text.str()));
    return new IncludeResult(name, texts_.back()->data(), texts_.back()->size(), nullptr);
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  std::vector<std::unique_ptr<std::string>> texts_;
};

struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

ShaderKind kind_of(const std::string& file) {
  if (file.ends_with(".vert.glsl")) return ShaderKind::vertex;
  if (file.ends_with(".geom.glsl")) return ShaderKind::geometry;
  if (file.ends_with(".frag.glsl")) return ShaderKind::fragment;
  if (file.ends_with(".comp.glsl")) return ShaderKind::compute;
  fail("shader {} has no kind in its name", file);
}

EShLanguage language_of(ShaderKind kind) {
  switch (kind) {
    case ShaderKind::vertex:
      return EShLangVertex;
    case ShaderKind::geometry:
      return EShLangGeometry;
    case ShaderKind::fragment:
      return EShLangFragment;
    default:
      return EShLangCompute;
  }
}

/// The defines stand right after #version, the first line of each of our files.
std::string with_defines(const std::string& file, const Defines& defines) {
  const std::string text = read(glsl_folder() / file);
  const size_t end = text.find('\n');
  if (!text.starts_with("#version 450 core") || end == std::string::npos)
    fail("{}:1: a shader begins with '#version 450 core'", file);
  std::string head = "#version 450 core\n#extension GL_GOOGLE_include_directive : require\n";
  for (const auto& [name, value] : defines) head += fmt::format("#define {} {}\n", name, value);
  return head + fmt::format("#line 2 \"{}\"\n", file) + text.substr(end + 1);
}

/// glslang writes `ERROR: file:line: text`; the person wants `file:line: text`.
std::string readable(const std::string& log) {
  std::string out;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.find("compilation errors") != std::string::npos) continue;
    if (line.starts_with("ERROR: ")) line.erase(0, 7);
    out += (out.empty() ? "" : "\n") + line;
  }
  return out;
}

/// Drivers know neither file names in #line nor the include extension.
CheckedShader for_driver(ShaderKind kind, const std::string& preprocessed) {
  CheckedShader result{kind, "", {}};
  static const std::regex line_directive("^#line ([0-9]+) \"([^\"]*)\".*");
  std::istringstream lines(preprocessed);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (line.starts_with("#extension GL_GOOGLE"))
      line = "";
    else if (std::regex_match(line, match, line_directive)) {
      auto found = std::find(result.files.begin(), result.files.end(), match[2]);
      if (found == result.files.end()) found = result.files.insert(found, match[2]);
      line = fmt::format("#line {} {}", match[1].str(), found - result.files.begin());
    }
    result.text += line + "\n";
  }
  return result;
}

}  // namespace

std::filesystem::path glsl_folder() {
  if (const char* folder = std::getenv("IZB_GLSL")) return folder;
  return shipped_path("glsl", "glsl", "set IZB_GLSL to the folder of the shaders");
}

std::string program_text(const ProgramSpec& spec) {
  constexpr std::string_view include = "#include \"";
  const std::filesystem::path folder = glsl_folder();
  std::string all = fmt::format("front end {}, glslang {}.{}.{}\n", front_end_version, GLSLANG_VERSION_MAJOR,
                                GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH);
  for (const auto& [name, value] : spec.defines) all += fmt::format("#define {} {}\n", name, value);
  std::vector<std::string> files = spec.files;
  for (size_t i = 0; i < files.size(); ++i) {
    std::ostringstream text;
    text << std::ifstream(folder / files[i], std::ios::binary).rdbuf();
    all += fmt::format("{} {}\n{}\n", files[i], text.view().size(), text.view());
    std::istringstream lines(text.str());
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with(include)) continue;
      const std::string name = line.substr(include.size(), line.find('"', include.size()) - include.size());
      if (std::find(files.begin(), files.end(), name) == files.end()) files.push_back(name);
    }
  }
  return all;
}

std::vector<CheckedShader> check_program(const ProgramSpec& spec) {
  static const Process process;
  const auto messages = static_cast<EShMessages>(EShMsgDefault | EShMsgCascadingErrors);
  const TBuiltInResource& limits = *GetDefaultResources();

  std::vector<CheckedShader> result;
  std::vector<std::unique_ptr<glslang::TShader>> shaders;
  std::vector<std::string> texts;
  texts.reserve(spec.files.size());
  Includer includer;
  glslang::TProgram program;
  for (const std::string& file : spec.files) {
    const ShaderKind kind = kind_of(file);
    texts.push_back(with_defines(file, spec.defines));
    const char* text = texts.back().c_str();
    const char* name = file.c_str();
    auto make = [&] {
      auto shader = std::make_unique<glslang::TShader>(language_of(kind));
      shader->setStringsWithLengthsAndNames(&text, nullptr, &name, 1);
      shader->setEnvInput(glslang::EShSourceGlsl, language_of(kind), glslang::EShClientOpenGL, glsl_version);
      return shader;
    };
    std::string preprocessed;
    const auto scratch = make();
    if (!scratch->preprocess(&limits, glsl_version, ECoreProfile, false, false, messages, &preprocessed, includer))
      fail("shader program '{}':\n{}", spec.label, readable(scratch->getInfoLog()));
    shaders.push_back(make());
    if (!shaders.back()->parse(&limits, glsl_version, ECoreProfile, false, false, messages, includer))
      fail("shader program '{}':\n{}", spec.label, readable(shaders.back()->getInfoLog()));
    program.addShader(shaders.back().get());
    result.push_back(for_driver(kind, preprocessed));
  }
  if (!program.link(messages)) fail("shader program '{}':\n{}", spec.label, readable(program.getInfoLog()));
  return result;
}

}  // namespace izb::gpu
