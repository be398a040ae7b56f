// SPDX-License-Identifier: MIT
#include "gpu/timers.h"

namespace izb::gpu {

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
    timers_.add(name_, elapsed.count());
  } else {
    glQueryCounter(end_.name(), GL_TIMESTAMP);
    timers_.pending_.push_back({name_, std::move(begin_), std::move(end_)});
  }
  glPopDebugGroup();
}

void StageTimers::collect() {
  for (const Pending& p : pending_) {
    GLuint64 begin_ns = 0, end_ns = 0;
    glGetQueryObjectui64v(p.begin.name(), GL_QUERY_RESULT, &begin_ns);
    glGetQueryObjectui64v(p.end.name(), GL_QUERY_RESULT, &end_ns);
    add(p.name, static_cast<double>(end_ns - begin_ns) * 1e-6);
  }
  pending_.clear();
}

void StageTimers::add(const std::string& name, double ms) {
  for (Stage& stage : stages_)
    if (stage.name == name) return stage.samples_ms.push_back(ms);
  stages_.push_back({name, {ms}});
}

}  // namespace izb::gpu
