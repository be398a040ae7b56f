// SPDX-License-Identifier: MIT
// What a scene is opened with: its facts for the interface, and a frame that says by name or by numbers what the batch
// program would have chosen by itself.
#pragma once
#include "scene/pose.h"
#include "view/frame.h"

namespace izb {

/// Poses the scene as those options say. Throws izb::Error as Poser does.
void pose_scene(Poser& poser, const Scene& scene, const FrameOptions& options);

/// Throws izb::Error and izb::UsageError as choose_frame() does.
SceneFacts facts_of(const std::string& file, const Scene& scene, Poser& poser, const FrameOptions& asked);

}  // namespace izb
