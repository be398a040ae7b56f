// SPDX-License-Identifier: MIT
// What a run leaves behind: numbers as JSON, the frame as OpenEXR, a preview as PNG.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "app/commands.h"
#include "app/rendered_frame.h"
#include "image/image.h"

namespace izb {

/// `command` and `version`: how any result came about.
nlohmann::json origin_json(const Arguments& arguments);

/// How a result came about: command line, version, GL strings, options, scene. The same keys in every JSON.
nlohmann::json provenance(const RenderedFrame& rendered, const FrameOptions& options, const Arguments& arguments,
                          const std::string& scene_path);

/// SHA-256 of the mask's words, little-endian, top row first; of several masks of one after the other.
std::string mask_hash(std::span<const std::vector<uint32_t>> masks);

/// `mask_hash` of all masks of the last frame, `lights` (name, type, mask_hash), and `exposure`.
nlohmann::json masks_json(const RenderedFrame& rendered);

/// What the channels of a light are called after the first word: nothing where there is one light.
std::string channel_suffix(std::span<const Light> lights, size_t light);

/// The last frame as channels R G B, depth, normal.X/Y/Z, and of its light mask, visibility, list_length (where the
/// technique has lists): of several lights mask.NAME and so on. With the standard attributes worldToCamera and
/// worldToNDC, the lights, and `facts` as text.
Image frame_image(const RenderedFrame& rendered, const nlohmann::json& facts);

/// The same attributes for another image of the frame, which need not be rendered yet.
void add_attributes(Image& image, const RenderedFrame& rendered, const nlohmann::json& facts);

double median(std::vector<double> values);

/// `stages` of the JSON: name, gpu_ms (median), samples.
nlohmann::json stages_json(const gpu::StageTimers& timers);

nlohmann::json counts_json(const Counts& counts);

/// `memory_bytes` and `memory_available_bytes` (null where the system does not say).
nlohmann::json memory_json(const Renderer& renderer);
/// One line of them: "memory: izb 70.2 MB, gbuffer 82.9 MB, scene 11.8 MB; 164.9 MB of 23000.0 MB available".
std::string memory_line(const nlohmann::json& json);

}  // namespace izb
