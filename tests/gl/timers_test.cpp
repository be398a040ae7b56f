// SPDX-License-Identifier: MIT
#include "gpu/timers.h"

#include <gtest/gtest.h>

#include <thread>

namespace {

using izb::gpu::StageTimers;

class Timers : public testing::TestWithParam<bool> {};

TEST_P(Timers, CollectSamplesByNameInOrderOfFirstUse) {
  StageTimers timers(GetParam());
  EXPECT_STREQ(timers.method(), GetParam() ? "wall" : "query");
  const izb::gpu::Buffer buffer("work", 1 << 20);
  for (int frame = 0; frame < 3; ++frame) {
    for (const char* name : {"second", "first", "second"}) {
      const StageTimers::Scope scope(timers, name);
      glClearNamedBufferData(buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    }
    timers.collect();
  }
  ASSERT_EQ(timers.stages().size(), 2u);
  EXPECT_EQ(timers.stages()[0].name, "second");
  EXPECT_EQ(timers.stages()[1].name, "first");
  for (const StageTimers::Stage& stage : timers.stages()) {
    EXPECT_EQ(stage.samples_ms.size(), 3u);
    for (const double ms : stage.samples_ms) {
      EXPECT_GE(ms, 0.0);
      EXPECT_LT(ms, 60000.0);
    }
  }
  timers.clear();
  EXPECT_TRUE(timers.stages().empty());
}

TEST_P(Timers, WhatAGivenUpFrameLeftIsCleared) {
  StageTimers timers(GetParam());
  { const StageTimers::Scope scope(timers, "given up"); }
  timers.clear();
  { const StageTimers::Scope scope(timers, "next"); }
  timers.collect();
  ASSERT_EQ(timers.stages().size(), 1u);
  EXPECT_EQ(timers.stages()[0].name, "next");
}

INSTANTIATE_TEST_SUITE_P(, Timers, testing::Values(true, false),
                         [](const auto& test) { return std::string(test.param ? "wall" : "query"); });

TEST(WallTimers, MeasureTheTimeBetweenFinishes) {
  StageTimers timers(true);
  for (int part = 0; part < 2; ++part) {
    const StageTimers::Scope scope(timers, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  timers.collect();
  ASSERT_EQ(timers.stages().at(0).samples_ms.size(), 1u);
  EXPECT_GE(timers.stages()[0].samples_ms[0], 40.0);
}

}  // namespace
