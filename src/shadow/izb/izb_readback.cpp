// SPDX-License-Identifier: MIT
// What a frame left on the GPU, read back: counts, lists, furthest depths, z-cull.
#include <algorithm>
#include <stdexcept>

#include "shadow/izb/izb.h"
#include "shared/bindings.h"
#include "shared/lists.h"

namespace izb {

uint64_t fragments_of(const shared::Counters& c) {
  return c.fragments + (uint64_t{c.carries & 0xffffu} << 32);
}

uint64_t tests_of(const shared::Counters& c) {
  return c.visibility_tests + (uint64_t{c.carries >> 16} << 32);
}

Counts Izb::count(const FrameInputs& in, Visibility& out, bool unculled) {
  Counts counts;
  shared::Counters culled{};
  if (unculled || !built_.zcull) {
    culled = visibility_counted(in, out, {IzbProgram::visibility_counted_all, false});
    counts = {{"triangles", culled.triangles}, {"fragments", fragments_of(culled)}};
  }
  if (built_.zcull) culled = visibility_counted(in, out, {IzbProgram::visibility_counted, true});
  const std::vector<uint64_t> histogram = list_histogram(in);
  uint64_t nodes = 0, lists = 0;
  for (size_t length = 1; length < histogram.size(); ++length) {
    nodes += histogram[length] * length;
    lists += histogram[length];
  }
  counts.insert(counts.end(), {{"triangles_after_zcull", culled.triangles},
                               {"fragments_after_zcull", fragments_of(culled)},
                               {"visibility_tests", tests_of(culled)},
                               {"nodes", nodes},
                               {"lists", lists},
                               {"longest_list", histogram.empty() ? 0 : histogram.size() - 1},
                               {"pairs_in_double", culled.pairs},
                               {"nodes_removed", culled.removed},
                               {"masks_unchanged", culled.unchanged}});
  if (built_.compute()) counts.emplace_back("triangles_drawn", culled.drawn);
  return counts;
}

std::vector<float> Izb::work(const FrameInputs& in, Visibility& out, IzbProgram program, gpu::Texture sums) {
  restore_lists(in, &out);
  sums.clear_uint(0);
  glBindImageTexture(IMAGE_WORK, sums.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  visibility(in, out, {program, built_.zcull});
  const std::vector<uint32_t> words = sums.read_uint();
  return {words.begin(), words.end()};
}

std::vector<float> Izb::tests_a_pixel(const FrameInputs& in, Visibility& out) {
  return work(in, out, IzbProgram::visibility_tests,
              gpu::Texture("izb tests", GL_R32UI, shape_.width_px, shape_.height_px));
}

std::vector<float> Izb::fragments_a_texel(const FrameInputs& in, Visibility& out) {
  const gpu::Capabilities capabilities = gpu::query_capabilities();
  gpu::expect_room({{"fragments a texel",
                     {gpu::planned_texture("fragments", GL_R32UI, built_.grid, built_.grid, {"--grid", "--cascades"},
                                           heads_.layers())}}},
                   gpu::memory_room(capabilities), capabilities);
  return work(in, out, IzbProgram::visibility_fragments,
              gpu::Texture::array("izb fragments", GL_R32UI, built_.grid, built_.grid, heads_.layers()));
}

std::string Izb::fault() const {
  if (read_counters().unfinished == 0) return {};
  return "a list of the light-space grid is longer than this driver's loops may run, so that shadows are missing: "
         "take a larger --grid or more --cascades";
}

/// Removal leaves shorter lists behind; and of what is hidden the mask is made with them.
void Izb::restore_lists(const FrameInputs& in, Visibility* out) {
  if (!built_.removal && !built_.occluders) return;
  if (built_.occluders) occlude(in);
  build(in, out);
  if (built_.occluders && built_.zcull) zcull(layers_of(in));
}

IzbLists Izb::read_lists() const {
  const std::vector<uint32_t> heads = heads_.read_uint();
  const bool pairs = nodes_.format() == GL_RG32UI;  // next pointer and another word; else the pointer alone
  const size_t words = pairs ? 2 : 1;
  const std::vector<uint32_t> nodes =
      nodes_.read<uint32_t>(pairs ? GL_RG_INTEGER : GL_RED_INTEGER, GL_UNSIGNED_INT, static_cast<int>(words));
  const auto at = [&](uint32_t node) -> size_t {
    if (built_.pool()) return node;
    const glm::ivec2 px = shared::pixel_from_node(node);
    const int slot = built_.many_samples() ? shared::slot_from_node(node) : 0;
    return (size_t(slot) * nodes_.height_px() + px.y) * nodes_.width_px() + px.x;
  };
  std::vector<bool> seen(nodes.size() / words);
  IzbLists lists;
  lists.first.reserve(heads.size() + 1);
  for (const uint32_t head : heads) {
    lists.first.push_back(static_cast<uint32_t>(lists.nodes.size()));
    for (uint32_t node = head; node != shared::no_node; node = nodes[words * at(node)]) {
      if (seen[at(node)]) throw std::logic_error("an IZB node stands in two lists");
      seen[at(node)] = true;
      lists.nodes.push_back(built_.pool() ? nodes[words * at(node) + 1] : node);
    }
  }
  lists.first.push_back(static_cast<uint32_t>(lists.nodes.size()));
  return lists;
}

IzbInternals Izb::internals() const {
  IzbInternals all;
  all.grid = built_.grid;
  all.layers = built_.cascades * shape_.faces;
  all.lists = read_lists();
  // The images hold the floats' bits, since atomics know only integers.
  const auto floats = [](const gpu::Texture& bits) { return bits.read<float>(GL_RED_INTEGER, GL_UNSIGNED_INT, 1); };
  if (built_.zcull) {
    all.furthest = floats(furthest_);
    all.zcull = depth_.read<uint16_t>(GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 1);
  }
  if (built_.pyramid()) {
    all.pyramid = floats(pyramid_);
    all.pyramid_size = {pyramid_.width_px(), pyramid_.height_px()};
  }
  return all;
}

std::vector<float> Izb::list_lengths(const FrameInputs& in) {
  restore_lists(in, nullptr);
  const IzbLists lists = read_lists();
  std::vector<float> lengths(size_t(shape_.width_px) * shape_.height_px, 0.0f);
  for (size_t i = 0; i < lists.count(); ++i)
    for (const uint32_t node : lists[i]) {
      const glm::ivec2 px = shared::pixel_from_node(node);
      float& longest = lengths[size_t(px.y) * shape_.width_px + px.x];
      longest = std::max(longest, static_cast<float>(lists[i].size()));
    }
  return lengths;
}

std::vector<uint64_t> Izb::list_histogram(const FrameInputs& in) {
  restore_lists(in, nullptr);
  const IzbLists lists = read_lists();
  std::vector<uint64_t> histogram;
  for (size_t i = 0; i < lists.count(); ++i) {
    if (histogram.size() <= lists[i].size()) histogram.resize(lists[i].size() + 1);
    ++histogram[lists[i].size()];
  }
  return histogram;
}

}  // namespace izb
