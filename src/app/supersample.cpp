// SPDX-License-Identifier: MIT
#include "app/supersample.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_precision.hpp>
#include <stdexcept>

#include "app/results.h"
#include "app/sequence.h"
#include "base/error.h"
#include "frame/samples.h"
#include "frame/spine.h"
#include "image/exr.h"
#include "reference/parallel.h"

namespace izb {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double lit_of_a_frame = 32.0;  // a whole one
constexpr const char* colors[] = {"R", "G", "B"};

/// The renderer as it is while frames are added up, and afterwards as it was.
class Accumulating {
 public:
  Accumulating(Renderer& renderer, std::optional<float> exposure) : renderer_(renderer) {
    renderer_.keep_geometry(true);
    renderer_.expose_as(exposure);
  }
  ~Accumulating() {
    renderer_.keep_geometry(false);
    renderer_.expose_as({});
  }
  Accumulating(const Accumulating&) = delete;
  Accumulating& operator=(const Accumulating&) = delete;

 private:
  Renderer& renderer_;
};

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Frame `n` of a supersampled one.
void render_shifted(Session& s, int n) {
  Camera camera = s.frame.camera;
  camera.pixel_shift += pixel_shift(static_cast<uint32_t>(n));
  s.renderer.render(camera, s.frame.lights, s.timers);
}

void check_fits(const Session& s, const Accumulated& sums) {
  const Size size = s.frame.size;
  if (sums.width_px != size.width_px || sums.height_px != size.height_px || sums.lights.size() != s.frame.lights.size())
    throw std::logic_error("sums of frames of another size or with other lights");
}

Accumulated nothing_of(const Session& s) {
  Accumulated sums;
  sums.width_px = s.frame.size.width_px, sums.height_px = s.frame.size.height_px;
  const size_t count = sums.pixel_count();
  sums.color.resize(3 * count);
  sums.surface.resize(count);
  sums.lights.resize(s.frame.lights.size(), {std::vector<uint32_t>(count), std::vector<uint32_t>(count)});
  return sums;
}

/// What each bit pattern of 16 is as a float.
const std::vector<float>& half_values() {
  static const std::vector<float> values = [] {
    std::vector<float> all(1u << 16);
    for (uint32_t bits = 0; bits < all.size(); ++bits) all[bits] = glm::unpackHalf1x16(static_cast<uint16_t>(bits));
    return all;
  }();
  return values;
}

/// Textures have their bottom row first. Calls body(first pixel of a texture's row, of the sums' row) for each row.
template <typename Body>
void for_each_row(const Accumulated& sums, Body&& body) {
  const size_t width = static_cast<size_t>(sums.width_px), height = static_cast<size_t>(sums.height_px);
  reference::parallel_for(height, 16, 0, [&](size_t begin, size_t end, unsigned) {
    for (size_t row = begin; row < end; ++row) body(row * width, (height - 1 - row) * width);
  });
}

void add_picture(const Renderer& renderer, const std::vector<float>& eye_distance, Accumulated& sums) {
  using Texel = glm::u16vec4;  // as the texture has it: nothing is converted on the way
  const std::vector<Texel> picture = renderer.picture().read<Texel>(GL_RGBA, GL_HALF_FLOAT, 1);
  const std::vector<float>& value = half_values();
  for_each_row(sums, [&](size_t from, size_t to) {
    for (size_t i = 0; i < static_cast<size_t>(sums.width_px); ++i) {
      for (int c = 0; c < 3; ++c)
        sums.color[3 * (to + i) + static_cast<size_t>(c)] += double(value[picture[from + i][c]]);
      sums.surface[to + i] += eye_distance[from + i] > 0.0f;
    }
  });
}

void add_light(const FrameInputs& in, const std::vector<uint32_t>& mask, const std::vector<float>& eye_distance,
               const std::vector<glm::vec2>& normals, const Accumulated& sums, Accumulated::OfLight& of) {
  for_each_row(sums, [&](size_t from, size_t to) {
    for (size_t i = 0; i < static_cast<size_t>(sums.width_px); ++i) {
      const float t = eye_distance[from + i];
      if (!(t > 0.0f)) continue;
      const glm::vec2 center_px(float(i) + 0.5f, float(from / static_cast<size_t>(sums.width_px)) + 0.5f);
      const uint32_t its_class = shared::receiver_class(in.light, shared::receiver_point(in.camera, center_px, t),
                                                        shared::octahedral_direction(normals[from + i]));
      if (its_class != shared::class_receiver) continue;
      ++of.receiver[to + i];
      of.lit[to + i] += 32u - static_cast<uint32_t>(std::popcount(mask[to + i]));
    }
  });
}

/// Adds the frame that the session rendered last.
void add_frame(Session& s, Accumulated& sums) {
  const gpu::StageTimers::Scope scope(s.timers, accumulate_name);
  const Renderer& renderer = s.renderer;
  std::vector<std::vector<uint32_t>> masks;  // first, since they may be wrong
  for (size_t i = 0; i < sums.lights.size(); ++i) masks.push_back(renderer.read_mask(i));
  const GBuffer& gbuffer = *renderer.inputs().gbuffer;
  const std::vector<float> eye_distance = gbuffer.eye_distance.read<float>(GL_RED, GL_FLOAT, 1);
  const std::vector<glm::vec2> normals = gbuffer.normal.read<glm::vec2>(GL_RG, GL_FLOAT, 1);
  add_picture(renderer, eye_distance, sums);
  for (size_t i = 0; i < sums.lights.size(); ++i)
    add_light(renderer.inputs(i), masks[i], eye_distance, normals, sums, sums.lights[i]);
  ++sums.frames;
}

}  // namespace

void accumulate(Session& s, Accumulated& sums, int frames_until, const AccumulateSteps& steps) {
  if (frames_until > largest_supersample)
    fail("{} frames are more than can be supersampled, {}", frames_until, largest_supersample);
  if (sums.frames == 0) sums = nothing_of(s);
  check_fits(s, sums);
  const Accumulating accumulating(s.renderer, sums.exposure);
  Clock::time_point last_checkpoint = Clock::now();
  while (sums.frames < frames_until) {
    glFinish();
    const auto start = Clock::now();
    render_shifted(s, sums.frames);
    add_frame(s, sums);
    const double frame_ms = ms_since(start);
    s.timers.collect();
    if (sums.frames == 1 && exposure_is_measured(s.frame.lights)) {
      sums.exposure = s.renderer.exposure();
      s.renderer.expose_as(sums.exposure);
    }
    if (steps.frame) steps.frame(frame_ms);
    const bool is_last = sums.frames == frames_until;
    if (is_last || !steps.checkpoint || ms_since(last_checkpoint) < 1000.0 * steps.checkpoint_s) continue;
    steps.checkpoint(sums);
    last_checkpoint = Clock::now();
  }
}

Image image_of(const Accumulated& sums, std::span<const Light> lights) {
  if (sums.frames < 1 || lights.size() != sums.lights.size()) throw std::logic_error("no sums of these lights");
  Image image;
  image.width_px = sums.width_px, image.height_px = sums.height_px;
  const auto plane = [&](const std::string& name, auto&& value) {
    std::vector<decltype(value(size_t{}))> values(sums.pixel_count());
    for (size_t i = 0; i < values.size(); ++i) values[i] = value(i);
    image.add(name, std::move(values));
  };
  const double all = sums.frames;
  const auto share = [&](const std::string& name, const std::vector<uint32_t>& counts, double whole) {
    plane(name, [&](size_t i) { return static_cast<float>(counts[i] / whole); });
  };
  for (size_t c = 0; c < std::size(colors); ++c) {
    const auto sum = [&](size_t i) { return sums.color[3 * i + c]; };
    plane(colors[c], [&](size_t i) { return static_cast<float>(sum(i) / all); });
    plane(std::string("sum_high.") + colors[c],
          [&](size_t i) { return static_cast<uint32_t>(std::bit_cast<uint64_t>(sum(i)) >> 32); });
    plane(std::string("sum_low.") + colors[c],
          [&](size_t i) { return static_cast<uint32_t>(std::bit_cast<uint64_t>(sum(i))); });
  }
  share("surface", sums.surface, all);
  for (size_t light = 0; light < lights.size(); ++light) {
    const std::string suffix = channel_suffix(lights, light);
    share("receiver" + suffix, sums.lights[light].receiver, all);
    share("lit" + suffix, sums.lights[light].lit, all * lit_of_a_frame);
  }
  return image;
}

Accumulated accumulated_of(const Image& image, std::span<const Light> lights, int frames, std::optional<float> exposure,
                           const std::string& file) {
  Accumulated sums;
  sums.width_px = image.width_px, sums.height_px = image.height_px;
  sums.frames = frames, sums.exposure = exposure;
  // A float share is off by 2^-24 of itself, so that counts below 2^23 are what they round to.
  const auto counts = [&](const std::string& name, double whole) {
    std::vector<uint32_t> values;
    for (const float share : image.floats(name)) {
      if (!(share >= 0.0f && share <= 1.0f)) fail("its channel '{}' holds {}, which is no share", name, share);
      values.push_back(static_cast<uint32_t>(std::lround(share * whole)));
    }
    return values;
  };
  try {
    sums.color.resize(3 * sums.pixel_count());
    for (size_t c = 0; c < std::size(colors); ++c) {
      const std::vector<uint32_t>& high = image.uints(std::string("sum_high.") + colors[c]);
      const std::vector<uint32_t>& low = image.uints(std::string("sum_low.") + colors[c]);
      for (size_t i = 0; i < high.size(); ++i)
        sums.color[3 * i + c] = std::bit_cast<double>(uint64_t{high[i]} << 32 | low[i]);
    }
    sums.surface = counts("surface", frames);
    for (size_t light = 0; light < lights.size(); ++light) {
      const std::string suffix = channel_suffix(lights, light);
      sums.lights.push_back({counts("receiver" + suffix, frames), counts("lit" + suffix, frames * lit_of_a_frame)});
    }
  } catch (const Error& e) {
    fail("cannot go on with '{}': {}", file, e.what());
  }
  return sums;
}

Accumulated resumed_sums(const Session& s, const std::string& path, const nlohmann::json& facts) {
  const nlohmann::json stored = rendered_facts(path, facts);
  if (stored.is_null()) return {};
  const nlohmann::json frames = stored["supersample"], exposure = stored.value("exposure", nlohmann::json());
  const bool measured = exposure_is_measured(s.frame.lights);
  if (!frames.is_number_integer() || frames < 1 || frames > largest_supersample || (measured && !exposure.is_number()))
    fail("'{}' does not say what it holds, so --resume stops", path);
  if (frames > facts["supersample"])
    fail("'{}' holds {} frames already, more than --supersample {}, so --resume stops", path, frames.get<int>(),
         facts["supersample"].get<int>());
  const Image image = read_exr(path);
  if (image.width_px != s.frame.size.width_px || image.height_px != s.frame.size.height_px)
    fail("'{}' has {} x {} pixels, so --resume stops", path, image.width_px, image.height_px);
  return accumulated_of(image, s.frame.lights, frames, measured ? std::optional(exposure.get<float>()) : std::nullopt,
                        path);
}

nlohmann::json supersampled_facts(const RenderedFrame& rendered, const Accumulated& sums,
                                  const std::vector<double>& frame_ms, nlohmann::json facts) {
  facts["supersample"] = sums.frames;
  facts["frames_rendered"] = frame_ms.size();
  facts["lights"] = nlohmann::json::array();
  for (const Light& light : rendered.frame.lights)
    facts["lights"].push_back({{"name", light.name}, {"type", type_name(light.type)}});
  facts["exposure"] = sums.exposure.value_or(1.0f);
  facts["stages"] = stages_json(rendered.timers);
  for (nlohmann::json& stage : facts["stages"]) stage.erase("samples");  // as many as frames
  facts["frame_ms"] = frame_ms.empty() ? nlohmann::json() : nlohmann::json(median(frame_ms));
  facts.update(memory_json(rendered.renderer));
  return facts;
}

Image supersampled_image(const RenderedFrame& rendered, const Accumulated& sums, const nlohmann::json& facts) {
  Image image = image_of(sums, rendered.frame.lights);
  add_attributes(image, rendered, facts);
  return image;
}

}  // namespace izb
