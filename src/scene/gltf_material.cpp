// SPDX-License-Identifier: MIT
#include "scene/gltf_material.h"

#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"

namespace izb {
namespace {

constexpr const char* texture_transform = "KHR_texture_transform";

Wrap to_wrap(int gltf_wrap) {
  switch (gltf_wrap) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    default:
      return Wrap::repeat;
  }
}

double number_or(const tinygltf::Value& object, const char* name, double otherwise) {
  return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

glm::vec2 vec2_or(const tinygltf::Value& object, const char* name, float otherwise) {
  if (!object.Has(name)) return glm::vec2(otherwise);
  const tinygltf::Value& v = object.Get(name);
  return {static_cast<float>(v.Get(0).GetNumberAsDouble()), static_cast<float>(v.Get(1).GetNumberAsDouble())};
}

/// Translation * rotation * scale. The rotation turns v towards u, as the specification's examples do (v
/// points down).
glm::mat3 uv_transform_of(const tinygltf::TextureInfo& info) {
  const auto it = info.extensions.find(texture_transform);
  if (it == info.extensions.end()) return glm::mat3(1.0f);
  const glm::vec2 offset = vec2_or(it->second, "offset", 0.0f), scale = vec2_or(it->second, "scale", 1.0f);
  const auto angle_rad = static_cast<float>(number_or(it->second, "rotation", 0.0));
  const float c = std::cos(angle_rad), s = std::sin(angle_rad);
  const glm::mat3 translation(1, 0, 0, 0, 1, 0, offset.x, offset.y, 1);
  const glm::mat3 rotation(c, -s, 0, s, c, 0, 0, 0, 1);
  const glm::mat3 scaling(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1);
  return translation * rotation * scaling;
}

/// One scene texture for each pair of image and sampling that is used.
class TextureCache {
 public:
  TextureCache(tinygltf::Model& model, Scene& scene) : model_(model), scene_(scene) {
    for (const tinygltf::Material& m : model.materials)
      if (const int t = m.pbrMetallicRoughness.baseColorTexture.index; t >= 0) {
        const int source = model.textures[static_cast<size_t>(t)].source;
        if (source >= 0) textures_of_image_[source][key(t)] = -1;
      }
  }

  /// Index into Scene::textures, or -1 if the image is absent.
  int get(int gltf_texture) {
    const tinygltf::Texture& source = model_.textures[static_cast<size_t>(gltf_texture)];
    if (source.source < 0) return -1;
    tinygltf::Image& image = model_.images[static_cast<size_t>(source.source)];
    std::map<Key, int>& users = textures_of_image_[source.source];
    int& index = users[key(gltf_texture)];
    if (index >= 0) return index;
    if (image.image.empty()) return -1;

    Texture texture;
    texture.name = !image.name.empty() ? image.name : image.uri;
    texture.width_px = image.width, texture.height_px = image.height;
    std::tie(texture.wrap_u, texture.wrap_v, texture.nearest) = key(gltf_texture);
    if (users.size() == 1)
      texture.rgba = std::move(image.image);
    else
      texture.rgba = image.image;
    index = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    return index;
  }

 private:
  using Key = std::tuple<Wrap, Wrap, bool>;

  Key key(int gltf_texture) const {
    const int sampler = model_.textures[static_cast<size_t>(gltf_texture)].sampler;
    if (sampler < 0) return {Wrap::repeat, Wrap::repeat, false};
    const tinygltf::Sampler& s = model_.samplers[static_cast<size_t>(sampler)];
    return {to_wrap(s.wrapS), to_wrap(s.wrapT), s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST};
  }

  tinygltf::Model& model_;
  Scene& scene_;
  std::map<int, std::map<Key, int>> textures_of_image_;
};

AlphaMode to_alpha_mode(const std::string& name) {
  return name == "MASK" ? AlphaMode::mask : name == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

}  // namespace

int base_color_uv_set(const tinygltf::Model& model, int material) {
  if (material < 0) return -1;
  const tinygltf::TextureInfo& info =
      model.materials[static_cast<size_t>(material)].pbrMetallicRoughness.baseColorTexture;
  if (info.index < 0) return -1;
  const auto it = info.extensions.find(texture_transform);
  if (it != info.extensions.end() && it->second.Has("texCoord")) return it->second.Get("texCoord").GetNumberAsInt();
  return info.texCoord;
}

void load_materials(tinygltf::Model& model, Scene& scene) {
  TextureCache textures(model, scene);
  size_t blended = 0, unlit = 0, other_textures = 0;
  for (const tinygltf::Material& source : model.materials) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    for (int c = 0; c < 4; ++c)
      material.base_color[c] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(c)]);
    if (pbr.baseColorTexture.index >= 0) {
      material.base_color_texture = textures.get(pbr.baseColorTexture.index);
      material.uv_transform = uv_transform_of(pbr.baseColorTexture);
    }
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.alpha_mode = to_alpha_mode(source.alphaMode);
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    blended += material.alpha_mode == AlphaMode::blend;
    unlit += source.extensions.contains("KHR_materials_unlit");
    other_textures += source.normalTexture.index >= 0 || source.occlusionTexture.index >= 0 ||
                      source.emissiveTexture.index >= 0 || pbr.metallicRoughnessTexture.index >= 0;
    scene.materials.push_back(std::move(material));
  }
  const auto say = [&](const char* what, size_t count, const char* consequence) {
    if (count > 0) scene.ignored.push_back(fmt::format("{}: {}, {}", what, count, consequence));
  };
  say("materials with alpha blending", blended, "they cast and receive as opaque");
  say("unlit materials", unlit, "lit like the others");
  say("materials with normal, metallic-roughness, occlusion or emissive textures", other_textures,
      "these textures are not shown");
}

}  // namespace izb
