// SPDX-License-Identifier: MIT
#include "gpu/timers.h"

#include <numeric>

namespace izb::gpu {
namespace {

StageTimers::Stage& of_name(std::vector<StageTimers::Stage>& stages, const std::string& name) {
  for (StageTimers::Stage& stage : stages)
    if (stage.name == name) return stage;
  return stages.emplace_back(StageTimers::Stage{name, {}});
}

}  // namespace

StageTimers::Scope::Scope(StageTimers& timers, const char* name) : timers_(timers), name_(name) {
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
  if (timers_.wall_clock_) {
    glFinish();
    start_ = std::chrono::steady_clock::now();
  } else {
    begin_ = Query(name, GL_TIMESTAMP);
    end_ = Query(name, GL_TIMESTAMP);
    glQueryCounter(begin_.name(), GL_TIMESTAMP);
  }
}

StageTimers::Scope::~Scope() {
  if (timers_.wall_clock_) {
    glFinish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
    timers_.pending_.push_back({name_, elapsed.count(), {}, {}});
  } else {
    glQueryCounter(end_.name(), GL_TIMESTAMP);
    timers_.pending_.push_back({name_, 0.0, std::move(begin_), std::move(end_)});
  }
  glPopDebugGroup();
}

void StageTimers::collect() {
  std::vector<Stage> frame;
  for (const Pending& p : pending_) {
    double ms = p.ms;
    if (!wall_clock_) {
      GLuint64 begin_ns = 0, end_ns = 0;
      glGetQueryObjectui64v(p.begin.name(), GL_QUERY_RESULT, &begin_ns);
      glGetQueryObjectui64v(p.end.name(), GL_QUERY_RESULT, &end_ns);
      ms = static_cast<double>(end_ns - begin_ns) * 1e-6;
    }
    of_name(frame, p.name).samples_ms.push_back(ms);
  }
  pending_.clear();
  for (const Stage& stage : frame)
    of_name(stages_, stage.name)
        .samples_ms.push_back(std::accumulate(stage.samples_ms.begin(), stage.samples_ms.end(), 0.0));
}

}  // namespace izb::gpu
