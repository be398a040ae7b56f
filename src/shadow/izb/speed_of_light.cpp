// SPDX-License-Identifier: MIT
// The paper's speed of light (table 2): the frame's tests are stored, then a compute pass makes them, one an
// invocation.
#include "base/error.h"
#include "shadow/izb/izb.h"
#include "shared/bindings.h"

namespace izb {
namespace {

int rows_for(uint64_t tests) {
  return static_cast<int>((tests + shared::tests_a_row - 1) / shared::tests_a_row);
}

/// A list of so many rows, if there is room for it and for a mask beside it.
gpu::Texture make_list(int rows, const gpu::Texture& mask) {
  const gpu::Capabilities capabilities = gpu::query_capabilities();
  const gpu::Plan plan{
      gpu::planned_texture("tests", GL_RG32UI, shared::tests_a_row, rows, {"--size"}),
      gpu::planned_texture("mask", GL_R32UI, mask.width_px(), mask.height_px(), {"--size"}),
  };
  gpu::expect_room({{"speed of light", plan}}, gpu::memory_room(capabilities), capabilities);
  return {"izb stored tests", GL_RG32UI, shared::tests_a_row, rows};
}

}  // namespace

// Counted before, since with removal the order of fragments decides which tests there are: then some more than counted.
gpu::Texture Izb::store_tests(const FrameInputs& in, Visibility& out, uint32_t& stored) {
  constexpr int attempts = 4;
  uint64_t expected = tests_of(visibility_counted(in, out, {IzbProgram::visibility_counted, built_.zcull}));
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const uint64_t capacity = expected + (built_.removal ? expected / 32 : 0) + 1;
    if (capacity >= uint64_t{1} << 31)
      fail("the speed of light cannot number {} tests: reduce --size", expected);  // ints do, in the shaders
    gpu::Texture list = make_list(rows_for(capacity), out.mask);
    glBindImageTexture(IMAGE_WORK, list.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32UI);
    const shared::Counters counted = visibility_counted(in, out, {IzbProgram::visibility_stored, built_.zcull});
    if (const std::string reason = fault(); !reason.empty()) fail("the speed of light: {}", reason);
    if (counted.unstorable != 0)
      fail("the speed of light cannot store this scene's tests: it numbers {} parts of {} triangles each",
           shared::storable_instances, shared::storable_triangles);
    if (counted.pairs > counted.capacity)
      fail(
          "the speed of light does not decide all tests in double, as the frame did: {} pairs need more room than "
          "--pairs {}",
          counted.pairs, counted.capacity);
    stored = counted.stored;
    if (rows_for(stored) <= list.height_px()) return list;
    expected = stored;
  }
  fail("the speed of light: the number of tests differs too much from frame to frame to store them");
}

void Izb::test_stored(const FrameInputs& in, uint32_t stored) {
  const bool masks = in.masked_casters && knows_masks(IzbProgram::speed_of_light, built_);
  const gpu::Program& program = programs_.get(IzbProgram::speed_of_light, masks);
  program.use();
  glUniform1i(0, static_cast<int>(stored));
  program.dispatch(shared::tests_a_row, rows_for(stored), 64, 1);
  settle(in);
}

// The clears are not timed, what takes part in deciding is: the frame's own time holds the pairs in double, too.
std::optional<SpeedOfLight> Izb::speed_of_light(const FrameInputs& in, Visibility& out, int repeats) {
  const std::vector<uint32_t> mask = out.mask.read_uint();
  SpeedOfLight result;
  uint32_t stored = 0;
  const gpu::Texture list = store_tests(in, out, stored);
  result.tests = stored;
  result.same_mask = out.mask.read_uint() == mask;

  Visibility alone{gpu::Texture("izb speed of light", GL_R32UI, out.mask.width_px(), out.mask.height_px())};
  bind_lists(alone);
  glBindTextureUnit(UNIT_TESTS, list.name());
  gpu::StageTimers timers(gpu::query_capabilities().software);
  for (int i = -1; i < repeats; ++i) {  // the first for what drivers compile on first use
    alone.mask.clear_uint(0);
    if (built_.occluders) {
      restore_lists(in, &alone);
      bind_lists(alone);
      glBindTextureUnit(UNIT_TESTS, list.name());
    }
    reset_counters();
    {
      const gpu::StageTimers::Scope scope(timers, "speed of light");
      test_stored(in, stored);
    }
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    timers.collect();
    if (i < 0) timers.clear();
    result.same_mask = result.same_mask && alone.mask.read_uint() == mask;
  }
  result.ms = timers.stages().at(0).samples_ms;
  return result;
}

}  // namespace izb
