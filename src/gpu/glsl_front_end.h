// SPDX-License-Identifier: MIT
// glslang as the front end: resolves #include, checks the text, and names file and line of the real file. Needs no GL.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace izb::gpu {

enum class ShaderKind { vertex, geometry, fragment, compute };

using Defines = std::map<std::string, std::string>;

/// What one program is made of: files below glsl/, each of the kind that its name tells (x.vert.glsl).
struct ProgramSpec {
  std::string label;
  std::vector<std::string> files;
  Defines defines;
  std::vector<std::string> extensions{};  ///< that a driver must have to take it

  bool operator==(const ProgramSpec&) const = default;
};

struct CheckedShader {
  ShaderKind kind;
  std::string text;  ///< includes resolved; #line numbers carry an index into `files`
  std::vector<std::string> files;
};

/// The folder of the shader files: $IZB_GLSL, the source tree, or beside the installed program.
std::filesystem::path glsl_folder();

/// What decides what check_program makes of it: glslang's version, the names and texts of its files and of all that
/// they include, also where the preprocessor would skip the include, and the defines. Files that are not there have no
/// text; never throws for them.
std::string program_text(const ProgramSpec& spec);

/// Every member file preprocessed, checked, and linked with its fellows by glslang. Throws izb::Error whose text has
/// one `file:line: message` a line.
std::vector<CheckedShader> check_program(const ProgramSpec& spec);

}  // namespace izb::gpu
