// SPDX-License-Identifier: MIT
#include "view/side.h"

#include <chrono>

#include "app/results.h"
#include "app/session.h"
#include "base/error.h"
#include "frame/read_back.h"
#include "image/srgb.h"

namespace izb {
namespace {

/// Half floats have some 30,000 values between 0 and 1: the power of each is taken once.
const std::vector<uint8_t>& srgb_of_halves() {
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> codes(1 << 16);
    for (uint32_t bits = 0; bits < codes.size(); ++bits) codes[bits] = to_srgb8(glm::unpackHalf2x16(bits).x);
    return codes;
  }();
  return table;
}

std::shared_ptr<const Image8> read_picture(const gpu::Texture& picture) {
  auto image = std::make_shared<Image8>();
  image->width_px = picture.width_px(), image->height_px = picture.height_px(), image->components = 4;
  const std::vector<uint16_t> halves = picture.read<uint16_t>(GL_RGBA, GL_HALF_FLOAT, 4);
  const std::vector<uint8_t>& codes = srgb_of_halves();
  image->pixels.resize(halves.size());
  const size_t row = 4 * size_t(image->width_px);
  for (size_t y = 0; y < size_t(image->height_px); ++y) {
    const uint16_t* from = &halves[(size_t(image->height_px) - 1 - y) * row];
    uint8_t* to = &image->pixels[y * row];
    for (size_t i = 0; i < row; i += 4) {
      to[i] = codes[from[i]], to[i + 1] = codes[from[i + 1]], to[i + 2] = codes[from[i + 2]];
      to[i + 3] = 255;
    }
  }
  return image;
}

}  // namespace

void Side::forget() {
  renderer_.reset();
  technique_.reset();
}

SidePicture Side::paint(const Stage3D& stage, const SideState& state, const FrameChoice& frame, int light,
                        bool at_rest) {
  SidePicture failed;
  failed.technique = state.technique;
  try {
    if (!technique_ || given_ || state_.technique != state.technique) {
      forget();
      technique_ = state.make();
    } else if (state_ != state) {
      // The programs that the new options share with the old ones stay.
      const std::unique_ptr<Technique> wanted = state.make();
      copy_options(*wanted, *technique_);
    }
    given_ = false;
    state_ = state;
    return render(stage, frame, light, at_rest);
  } catch (const Error& e) {
    forget();
    failed.error = e.what();
  } catch (const std::bad_alloc&) {
    forget();
    failed.error = "not enough memory";
  }
  return failed;
}

SidePicture Side::paint_given(const Stage3D& stage, const SamplePattern& samples,
                              const std::vector<std::vector<uint32_t>>& masks, const FrameChoice& frame, int light) {
  if (!technique_ || !given_ || technique_->samples().offsets_px != samples.offsets_px) {
    forget();
    technique_ = std::make_unique<GivenMask>(samples);
  }
  given_ = true;
  static_cast<GivenMask&>(*technique_).give(masks);
  SidePicture failed;
  failed.technique = "truth";
  try {
    return render(stage, frame, light, true);
  } catch (const Error& e) {
    forget();
    failed.error = e.what();
  }
  return failed;
}

SidePicture Side::render(const Stage3D& stage, const FrameChoice& frame, int light, bool at_rest) {
  if (!renderer_) {
    renderer_ = std::make_unique<Renderer>(stage.scene, stage.gl.capabilities, stage.buffers);
    timers_ = gpu::StageTimers(stage.gl.capabilities.software);
  }
  SidePicture side;
  side.technique = technique_->info().name;
  renderer_->prepare(*technique_, frame.size.width_px, frame.size.height_px, frame.lights);
  timers_.clear();
  const auto start = std::chrono::steady_clock::now();
  renderer_->render(frame.camera, frame.lights, timers_);
  glFinish();
  side.frame_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  timers_.collect();
  for (const gpu::StageTimers::Stage& s : timers_.stages()) side.stages.push_back({s.name, s.samples_ms.back()});
  side.spp = technique_->samples().count();
  std::vector<std::vector<uint32_t>> masks;
  for (size_t i = 0; i < renderer_->light_count(); ++i) masks.push_back(renderer_->read_mask(i));
  if (at_rest) side.mask_hash = mask_hash(masks);
  side.mask = std::move(masks[static_cast<size_t>(std::min<int>(light, int(masks.size()) - 1))]);
  side.picture = read_picture(renderer_->picture());
  return side;
}

}  // namespace izb
