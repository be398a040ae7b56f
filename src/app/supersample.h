// SPDX-License-Identifier: MIT
// Supersampled frames: the mean of many, each of which sees the scene through another point of its pixels. Sums are
// exact, so that it does not matter how often the work was interrupted.
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session.h"
#include "image/image.h"

namespace izb {

/// Counts of this many frames come back from shares in floats.
inline constexpr int largest_supersample = 1 << 17;

/// Sums over the frames 0 to `frames` - 1, frame n with pixel_shift(n). One entry a pixel, top row first.
struct Accumulated {
  int width_px = 0, height_px = 0;
  int frames = 0;
  std::optional<float> exposure;  ///< of all frames: what frame 0 measured; nothing: it measured none
  std::vector<double> color;      ///< R, G, B in linear light, three a pixel
  std::vector<uint32_t> surface;  ///< frames whose ray through the pixel meets a triangle
  struct OfLight {
    std::vector<uint32_t> receiver;  ///< frames in which it is a receiver: no sky, in a spot's cone, N.L > 0
    std::vector<uint32_t> lit;  ///< of these, what is not in shadow, in 32nds of a frame: with --spp 1 0 or 32 each
    bool operator==(const OfLight&) const = default;
  };
  std::vector<OfLight> lights;  ///< in the order of the frame's

  size_t pixel_count() const { return size_t(width_px) * size_t(height_px); }
  bool operator==(const Accumulated&) const = default;
};

/// What may happen between frames.
struct AccumulateSteps {
  /// Called with the sums once so many seconds have passed since the last time, but not after the last frame.
  double checkpoint_s = std::numeric_limits<double>::infinity();
  std::function<void(const Accumulated&)> checkpoint{};
  /// Called after each frame with its wall time.
  std::function<void(double frame_ms)> frame{};
};

/// Renders frames by the session's camera, lights and technique where it stands, until `sums` holds `frames_until` of
/// them: from its own on, or all where it is empty. A technique may keep what it builds of triangles that stay the
/// same, and no frame but the first measures an exposure. Stage times go to the session's timers. Throws izb::Error
/// where there is no memory for the sums, or a mask is wrong; the sums are then as they were.
void accumulate(Session& session, Accumulated& sums, int frames_until, const AccumulateSteps& steps = {});

/// Means and shares as channels: R, G, B (linear light), surface (of all frames, those that see a surface there), and
/// for each light receiver and lit (of all samples: could be lit; are lit), with channel_suffix(). Further sum_high and
/// sum_low .R .G .B, the words of the sums in double, from which accumulated_of() restores all exactly.
Image image_of(const Accumulated& sums, std::span<const Light> lights);

/// The sums of `frames` frames again from their image. Throws izb::Error, naming `file`, where a channel is missing.
Accumulated accumulated_of(const Image& image, std::span<const Light> lights, int frames, std::optional<float> exposure,
                           const std::string& file);

/// The sums that the file at `path` holds of the session's frame; none where there is no file. `facts` are those of the
/// frame as asked for, see rendered_facts(). Throws izb::Error where the file is of another frame, is broken, or holds
/// more frames than `facts` ask for.
Accumulated resumed_sums(const Session& session, const std::string& path, const nlohmann::json& facts);

/// `facts` of a supersampled frame with what is known once there are sums: `supersample`, the frames in the sums,
/// lights, exposure, memory, and of the frames of this run their number, `frames_rendered`, and median times.
nlohmann::json supersampled_facts(const RenderedFrame& rendered, const Accumulated& sums,
                                  const std::vector<double>& frame_ms, nlohmann::json facts);

/// image_of() with the attributes that other frames have.
Image supersampled_image(const RenderedFrame& rendered, const Accumulated& sums, const nlohmann::json& facts);

}  // namespace izb
