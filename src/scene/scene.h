// SPDX-License-Identifier: MIT
// A scene as plain data: no GL, no file format. World space is right-handed, y up, metres (glTF 2.0's convention).
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace izb {

/// A morph target: what is added to each position and normal, times its weight. Either is empty or has one entry a
/// position of its mesh.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals;
};

/// One indexed triangle list in object space, at rest. `normals` and `uvs` are empty or have one entry a position.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit length; empty: the triangle's own normal is used (flat)
  std::vector<glm::vec2> uvs;      ///< texture coordinates that the base-colour texture reads
  std::vector<uint32_t> indices;   ///< 3 a triangle, every index < positions.size()
  uint32_t material = 0;

  std::vector<MorphTarget> targets;
  uint32_t influences = 0;       ///< joints that each vertex follows, 0: none
  std::vector<uint16_t> joints;  ///< `influences` a vertex, entries of its skin's joints
  std::vector<float> weights;    ///< likewise, of one vertex with the sum 1

  size_t triangle_count() const { return indices.size() / 3; }
  size_t bytes() const {  ///< of all arrays
    size_t n = (positions.size() + normals.size()) * sizeof(glm::vec3) + uvs.size() * sizeof(glm::vec2) +
               indices.size() * sizeof(uint32_t) + joints.size() * (sizeof(uint16_t) + sizeof(float));
    for (const MorphTarget& t : targets) n += (t.positions.size() + t.normals.size()) * sizeof(glm::vec3);
    return n;
  }
};

/// One placement of a mesh. What pose() changes is as the scene stands now.
struct Instance {
  uint32_t mesh = 0;
  glm::dmat4 world_from_object{1.0};  ///< of a skinned one: from the space in which its skin puts it, a translation
  int node = -1;                      ///< whose transform it takes, -1: none
  int skin = -1;
  std::vector<float> morph_weights{};  ///< one a target of the mesh, or empty: all 0

  bool deforms() const { return skin >= 0 || !morph_weights.empty(); }
};

/// A node of the hierarchy, at rest.
struct Node {
  std::string name;
  int parent = -1;  ///< a node before this one, -1: a root
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit length
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix;  ///< in place of the three, and not to be animated
  std::vector<double> morph_weights;
};

/// What places the vertices of a skinned mesh (glTF 2.0, section 3.7.3).
struct Skin {
  std::vector<uint32_t> joints;             ///< nodes
  std::vector<glm::dmat4> joint_from_bind;  ///< inverse bind matrices, one a joint
  std::vector<glm::dmat4> world_from_bind;  ///< one a joint, as posed
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

/// An 8-bit RGBA image, sRGB colour and linear alpha, top row first.
struct Texture {
  std::string name;
  int width_px = 0, height_px = 0;
  std::vector<uint8_t> rgba;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
  std::string name;
  glm::vec4 base_color{1.0f};    ///< linear factor
  int base_color_texture = -1;   ///< index into Scene::textures or -1
  glm::mat3 uv_transform{1.0f};  ///< KHR_texture_transform, applied to (u, v, 1)
  float metallic = 1.0f, roughness = 1.0f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;

  /// Of such a material only the points are there whose alpha is at least the cut-off.
  bool masked() const { return alpha_mode == AlphaMode::mask; }
};

enum class LightType { directional, spot, point };

/// A punctual light (KHR_lights_punctual). `direction_ws` is the way its light travels.
struct Light {
  std::string name;
  LightType type = LightType::directional;
  glm::dvec3 position_ws{0.0};
  glm::dvec3 direction_ws{0.0, -1.0, 0.0};  ///< unit length
  glm::vec3 color{1.0f};                    ///< linear
  float intensity = 1.0f;                   ///< lux, of a positional light candela
  double range = 0.0;           ///< of a positional light: beyond it there is none of its light; 0: no limit
  double inner_cone_rad = 0.0;  ///< spot: half-angle
  double outer_cone_rad = 0.7853981633974483;
  int node = -1;  ///< that places it, -1: none
};

/// A camera: looks along -z of its own space.
struct Camera {
  std::string name;
  glm::dmat4 world_from_view{1.0};  ///< rigid: rotation and translation only
  bool orthographic = false;
  double yfov_rad = 0.8;  ///< perspective
  double ymag = 1.0;      ///< orthographic: half the visible height, in world units
  double near_plane = 0.01;
  double far_plane = std::numeric_limits<double>::infinity();
  int node = -1;  ///< that places it, -1: none
  /// Where in its pixel each ray passes: in pixels from the centre, x right, y up. Triangles in view space do not
  /// depend on it.
  glm::dvec2 pixel_shift{0.0};
};

struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(min.x <= max.x); }
  void add(const glm::dvec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
  glm::dvec3 center() const { return 0.5 * (min + max); }
  double radius() const { return empty() ? 0.0 : 0.5 * glm::length(max - min); }
};

enum class Interpolation { step, linear, cubic_spline };
enum class AnimatedProperty { translation, rotation, scale, morph_weights };

/// The keys of one property of one node (glTF 2.0, section 3.11).
struct Track {
  uint32_t node = 0;
  AnimatedProperty property = AnimatedProperty::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;  ///< ascending, at least one
  std::vector<float> values;   ///< the same number for each key; of a spline in-tangent, value, out-tangent
};

struct Animation {
  std::string name;
  std::vector<Track> tracks;
  double length_s = 0.0;  ///< time of the last key
  std::string fault;      ///< why it cannot be played, or empty
};

struct Scene {
  std::string name;  ///< stem of the file it came from
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;  ///< never empty: meshes without one refer to a default material
  std::vector<Texture> textures;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<Node> nodes;  ///< parents before children; empty: nothing moves
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<std::string>
      ignored;  ///< one sentence for each thing of the file that is not shown, or shown differently

  size_t triangle_count() const {  ///< instances counted
    size_t n = 0;
    for (const Instance& i : instances) n += meshes[i.mesh].triangle_count();
    return n;
  }
  size_t geometry_bytes() const {  ///< each mesh once, as it stands here, and the instances
    size_t n = instances.size() * sizeof(Instance);
    for (const Mesh& m : meshes) n += m.bytes();
    return n;
  }
};

}  // namespace izb
