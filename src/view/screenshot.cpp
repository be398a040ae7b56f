// SPDX-License-Identifier: MIT
#include "view/screenshot.h"

#include <fmt/format.h>

#include <span>

#include "app/outputs.h"
#include "app/results.h"
#include "app/statistics.h"
#include "base/json_text.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb {

std::vector<std::string> write_screenshot(const std::string& stem, const Request& request,
                                          const RenderedFrame& rendered) {
  Outputs outputs;
  AtomicFile* const png = outputs.open("picture", stem + ".png");
  AtomicFile* const exr = outputs.open("image", stem + ".exr");
  AtomicFile* const text = outputs.open("numbers", stem + ".json");
  FrameOptions frame = request.state.frame;
  frame.size = fmt::format("{}x{}", request.size.width_px, request.size.height_px);
  frame.technique = rendered.technique.info().name;
  nlohmann::json json = provenance(rendered, frame, batch_arguments(request.state, request.state.active, request.size),
                                   request.state.scene);
  json.update(masks_json(rendered));
  json["stages"] = stages_json(rendered.timers);
  json.update(memory_json(rendered.renderer));
  const Image image = frame_image(rendered, json);
  add_statistics(json, rendered);
  write_exr(*exr, image);
  write_png(*png, preview(image));
  const std::string file = json_text(json, 1) + "\n";
  text->write(std::as_bytes(std::span(file)));
  outputs.commit();
  return {stem + ".png", stem + ".exr", stem + ".json"};
}

}  // namespace izb
