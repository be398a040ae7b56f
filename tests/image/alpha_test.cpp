// SPDX-License-Identifier: MIT
// Alpha masks whose shadow is known as a formula: a sheet with holes over a floor, crossed with every technique.
#include <functional>

#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 320, height_px = 240;
const char* const techniques[] = {"izb", "ray_traced"};
const Camera above = look_at({0.3, 9.0, 5.0}, {0, 0, 0}, glm::radians(45.0));

/// A sheet from (-2, -2) to (2, 2) at height 2 over a floor; u = x and v = z there.
Scene sheet_over_floor(const Texture& texture, const Material& like) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f));
  add_soup(scene, rectangle({-2, 2, -2}, {0, 0, 4}, {4, 0, 0}));
  scene.textures.push_back(texture);
  Material material = like;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture = 0;
  scene.materials.push_back(material);
  Mesh& sheet = scene.meshes[1];
  sheet.material = 1;
  for (const glm::vec3& p : sheet.positions) sheet.uvs.emplace_back(p.x, p.z);
  return scene;
}

Texture texture_of(int texture_width, int texture_height, const std::vector<uint8_t>& alpha, bool nearest, Wrap wrap) {
  Texture t;
  t.width_px = texture_width, t.height_px = texture_height;
  t.nearest = nearest;
  t.wrap_u = t.wrap_v = wrap;
  for (const uint8_t a : alpha) t.rgba.insert(t.rgba.end(), {255, 255, 255, a});
  return t;
}

/// By how much a point of the sheet is there (positive) or not, in world units or less; the outline of the sheet
/// counts, too.
using Sheet = std::function<double(double x, double z)>;

/// Every receiver of the floor and of the sheet must be as the formula says, but for those too close to a border.
void expect_shadow_of(const Scene& scene, const Sheet& sheet, const char* what) {
  const auto with_outline = [&](double x, double z) {
    return std::min(sheet(x, z), 2.0 - std::max(std::abs(x), std::abs(z)));
  };
  for (const Light& light : {sun(135, 50), spot({0.4, 6.0, -0.3}, {0, 0, 0}, 50), point_light({0.4, 6.0, -0.3})})
    for (const char* technique : techniques) {
      const Frame frame = render_frame(scene, above, light, width_px, height_px, {}, technique);
      size_t dark = 0, lit = 0, wrong = 0, close = 0, seen = 0;
      for (size_t i = 0; i < frame.mask.size(); ++i) {
        if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
        const glm::dvec3 p =
            glm::dvec3(above.world_from_view * glm::dvec4(glm::dvec3(frame.receivers.points_vs[i]), 1.0));
        const double margin = 10.0 * double(frame.receivers.band[i]);
        if (p.y > 1.0) {
          ++seen;
          wrong += with_outline(p.x, p.z) < -margin;  // a hole hides nothing
          continue;
        }
        // The eye's ray must have passed the sheet, too.
        const glm::dvec3 eye(above.world_from_view[3]);
        const glm::dvec3 passed = glm::mix(eye, p, (eye.y - 2.0) / (eye.y - p.y));
        wrong += with_outline(passed.x, passed.z) > margin;
        const glm::dvec3 on = light.type == LightType::directional
                                  ? p + light.direction_ws * ((2.0 - p.y) / light.direction_ws.y)
                                  : glm::mix(p, light.position_ws, (2.0 - p.y) / (light.position_ws.y - p.y));
        const double there = with_outline(on.x, on.z);
        if (std::abs(there) < margin) {
          ++close;
          continue;
        }
        ++(there > 0.0 ? dark : lit);
        wrong += (frame.mask[i] != 0) != (there > 0.0);
      }
      EXPECT_EQ(wrong, 0u) << what << ", " << technique << ", " << type_name(light.type);
      EXPECT_GT(dark, 500u) << what;
      EXPECT_GT(lit, 5000u) << what;
      EXPECT_GT(seen, 1000u) << what;
      EXPECT_LT(close, 4000u) << what;
      EXPECT_EQ(expect_explained(frame).explained_by_alpha, 0u);
    }
}

/// Distance to the nearest multiple of `step`.
double to_line(double x, double step) {
  return std::abs(x - step * std::round(x / step));
}

/// How far a point lies in the cell of a checker that is there: cells of side `step`, of which (0, 0) is.
double checker(double x, double z, double step) {
  const auto cell = [&](double v) { return static_cast<long>(std::floor(v / step)); };
  const double inside = std::min(to_line(x, step), to_line(z, step));
  return (cell(x) + cell(z)) % 2 == 0 ? inside : -inside;
}

TEST(AlphaClosedForm, ANearestCheckerByEachWrapMode) {
  const std::vector<uint8_t> pattern{255, 0, 0, 255};
  expect_shadow_of(
      sheet_over_floor(texture_of(2, 2, pattern, true, Wrap::repeat), {}),
      [](double x, double z) { return checker(x, z, 0.5); }, "repeat");
  // Mirrored about each whole number: what lies nearest to it is joined.
  expect_shadow_of(
      sheet_over_floor(texture_of(2, 2, pattern, true, Wrap::mirrored_repeat), {}),
      [](double x, double z) { return checker(x + 0.5, z + 0.5, 1.0); }, "mirrored");
  // Beyond [0, 1] the border's texels go on.
  expect_shadow_of(
      sheet_over_floor(texture_of(2, 2, pattern, true, Wrap::clamp_to_edge), {}),
      [](double x, double z) {
        const double distance = std::min(std::abs(x - 0.5), std::abs(z - 0.5));
        return (x < 0.5) == (z < 0.5) ? distance : -distance;
      },
      "clamp");
}

// Between the centres of a row that is there and one that is not alpha falls linearly: the border lies where the
// cut-off says.
TEST(AlphaClosedForm, ABilinearStripeEndsWhereTheCutoffSays) {
  const Texture texture = texture_of(1, 2, {255, 0}, false, Wrap::repeat);  // centres at v = 1/4 and 3/4
  for (const float cutoff : {0.25f, 0.5f, 0.8f}) {
    Material material;
    material.alpha_cutoff = cutoff;
    expect_shadow_of(
        sheet_over_floor(texture, material),
        [&](double, double z) {
          const double from_center = to_line(z - 0.25, 1.0);
          return 0.5 * (1.0 - double(cutoff)) - from_center;
        },
        "stripe");
    // A factor on alpha moves the border as a higher cut-off would.
    material.alpha_cutoff = 0.5f * cutoff;
    material.base_color.a = 0.5f;
    expect_shadow_of(
        sheet_over_floor(texture, material),
        [&](double, double z) { return 0.5 * (1.0 - double(cutoff)) - to_line(z - 0.25, 1.0); }, "factor");
  }
}

TEST(AlphaClosedForm, TheTextureMayBeTurnedScaledAndMoved) {
  Material material;
  // u = z / 2 + 1 / 4, v = -x / 2
  material.uv_transform = glm::mat3(0, -0.5f, 0, 0.5f, 0, 0, 0.25f, 0, 1);
  expect_shadow_of(
      sheet_over_floor(texture_of(2, 2, {255, 0, 0, 255}, true, Wrap::repeat), material),
      [](double x, double z) { return checker(-x, z + 0.5, 1.0); }, "transform");
}

TEST(AlphaClosedForm, ACutoffOfZeroIsPassedByAllAndOneByFullAlphaAlone) {
  const Texture texture = texture_of(2, 2, {255, 0, 0, 255}, true, Wrap::repeat);
  Material material;
  material.alpha_cutoff = 0.0f;
  expect_shadow_of(
      sheet_over_floor(texture, material), [](double, double) { return 100.0; }, "zero");
  material.alpha_cutoff = 1.0f;
  expect_shadow_of(
      sheet_over_floor(texture, material), [](double x, double z) { return checker(x, z, 0.5); }, "one");
}

}  // namespace
}  // namespace izb::test
