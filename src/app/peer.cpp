// SPDX-License-Identifier: MIT
#include "app/peer.h"

#include "app/results.h"
#include "shadow/ray_traced/receivers.h"

namespace izb {

Peer::Peer(const Renderer& renderer, bool fastest_build_only)
    : tracer_(make_triangles(renderer.inputs()), reference::BuildQuality::low),
      samples_{{"low", reference::BuildQuality::low, {}, {}},
               {"medium", reference::BuildQuality::medium, {}, {}},
               {"high", reference::BuildQuality::high, {}, {}}} {
  if (fastest_build_only) samples_.resize(1);
  const GBufferImage gbuffer = read_gbuffer(*renderer.inputs().gbuffer);
  for (size_t i = 0; i < renderer.light_count(); ++i) {
    receivers_.push_back(make_receivers(gbuffer, renderer.inputs(i)));
    lights_.push_back(make_light_point(renderer.inputs(i).light));
  }
}

void Peer::run() {
  for (Samples& s : samples_) {
    s.rebuild_ms.push_back(tracer_.rebuild(s.quality));
    double trace_ms = 0.0;
    rays_ = 0;
    for (size_t i = 0; i < lights_.size(); ++i) {
      const reference::MaskTrace traced = tracer_.trace_mask(lights_[i], receivers_[i]);
      trace_ms += traced.trace_ms;
      rays_ += traced.rays;
    }
    s.trace_ms.push_back(trace_ms);
  }
}

nlohmann::json Peer::to_json() const {
  nlohmann::json json;
  json["name"] = reference::embree_version();
  json["rays"] = rays_;
  double fastest_rebuild = 0.0, its_sum = 0.0;
  for (const Samples& s : samples_) {
    const double rebuild = median(s.rebuild_ms), trace = median(s.trace_ms);
    json[s.name] = {{"rebuild_ms", rebuild},
                    {"trace_ms", trace},
                    {"sum_ms", rebuild + trace},
                    {"rebuild_samples", s.rebuild_ms},
                    {"trace_samples", s.trace_ms}};
    if (its_sum == 0.0 || rebuild < fastest_rebuild) {
      fastest_rebuild = rebuild;
      its_sum = rebuild + trace;
    }
  }
  json["fastest_rebuild_plus_trace_ms"] = its_sum;
  return json;
}

}  // namespace izb
