// SPDX-License-Identifier: MIT
// What validation found, as JSON and as a table.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "frame/deform_check.h"
#include "reference/attribute.h"
#include "reference/model.h"
#include "reference/points.h"
#include "reference/settle.h"

namespace izb {

/// All that is known of one scene's frame under one light; the table shows a part of its JSON.
struct SceneReport {
  std::string scene;
  std::string label;  ///< the scene's name, and where it has several lights the light's
  nlohmann::json json;
};

nlohmann::json settled_json(const reference::Settled& settled);
nlohmann::json points_json(const reference::PointCheck& check);
nlohmann::json attribution_json(const reference::Attribution& sums);
nlohmann::json deformation_json(const DeformCheck& check);
nlohmann::json model_json(const reference::ModelError& error);

/// The first unexplained bits.
nlohmann::json records_json(const reference::Settled& settled, int width_px);

void print_table(const std::vector<SceneReport>& reports);

}  // namespace izb
