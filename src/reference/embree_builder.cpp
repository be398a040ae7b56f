// SPDX-License-Identifier: MIT
// build_hierarchy() by Embree's builder interface: it makes nodes of our own kind, which are then laid out in one
// array.
#include <chrono>
#include <memory>
#include <string>

#include "base/error.h"
#include "reference/hierarchy.h"
#include "reference/parallel.h"

#if IZB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace izb::reference {
namespace {

// In memory of Embree's, which goes with its hierarchy.
struct BuiltNode {
  uint32_t count = 0;  // references; 0: no leaf
  BuiltNode* children[2] = {nullptr, nullptr};
  Box boxes[2];
  uint32_t triangles[Hierarchy::largest_leaf];
};

BuiltNode* make_node(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), alignof(BuiltNode))) BuiltNode();
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
  return make_node(allocator);
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<BuiltNode*>(node)->children[i] = static_cast<BuiltNode*>(children[i]);
}

Box box_of(const RTCBounds& b) {
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<BuiltNode*>(node)->boxes[i] = box_of(*bounds[i]);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*) {
  BuiltNode* leaf = make_node(allocator);
  leaf->count = static_cast<uint32_t>(count);
  for (size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
  return leaf;
}

std::array<glm::vec3, 3> corners_of(const Triangles& triangles, uint32_t triangle) {
  const glm::vec3* v = &triangles.positions_vs[3 * size_t(triangle)];
  return {v[0], v[1], v[2]};
}

void split(const RTCBuildPrimitive* p, unsigned dimension, float position, RTCBounds* left, RTCBounds* right,
           void* triangles) {
  const Box box{{p->lower_x, p->lower_y, p->lower_z}, {p->upper_x, p->upper_y, p->upper_z}};
  const std::array<Box, 2> parts = split_box(corners_of(*static_cast<const Triangles*>(triangles), p->primID), box,
                                             static_cast<int>(dimension), position);
  const auto put = [](const Box& from, RTCBounds& to) {
    to.lower_x = from.lower.x, to.lower_y = from.lower.y, to.lower_z = from.lower.z;
    to.upper_x = from.upper.x, to.upper_y = from.upper.y, to.upper_z = from.upper.z;
  };
  put(parts[0], *left), put(parts[1], *right);
}

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

Hierarchy::Child lay_out(const BuiltNode& built, const Box& box, int depth, Hierarchy& all) {
  Hierarchy::Child child{box, 0, built.count};
  all.depth = std::max(all.depth, depth);
  if (built.count != 0) {
    child.first = static_cast<uint32_t>(all.references.size());
    all.references.insert(all.references.end(), built.triangles, built.triangles + built.count);
    return child;
  }
  child.first = static_cast<uint32_t>(all.nodes.size());
  all.nodes.emplace_back();
  for (size_t i = 0; i < 2; ++i) {
    const Hierarchy::Child its = lay_out(*built.children[i], built.boxes[i], depth + 1, all);
    all.nodes[child.first][i] = its;
  }
  return child;
}

}  // namespace

Hierarchy build_hierarchy(const Triangles& triangles, unsigned threads) {
  const size_t count = triangles.count();
  if (count == 0) fail("cannot build a hierarchy: the frame has no triangle");
  const std::string setting = "threads=" + std::to_string(thread_count(threads));
  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(setting.c_str()));
  if (!device) fail("Embree cannot make a device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, Release> bvh(rtcNewBVH(device.get()));
  std::vector<RTCBuildPrimitive> primitives(2 * count);  // as many again by splits
  Box whole{glm::vec3(std::numeric_limits<float>::infinity()), glm::vec3(-std::numeric_limits<float>::infinity())};
  for (size_t i = 0; i < count; ++i) {
    const std::array<glm::vec3, 3> c = corners_of(triangles, static_cast<uint32_t>(i));
    const glm::vec3 lower = glm::min(c[0], glm::min(c[1], c[2])), upper = glm::max(c[0], glm::max(c[1], c[2]));
    primitives[i] = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, static_cast<unsigned>(i)};
    whole = {glm::min(whole.lower, lower), glm::max(whole.upper, upper)};
  }
  const auto start = std::chrono::steady_clock::now();
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = 256;
  arguments.maxLeafSize = Hierarchy::largest_leaf;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = count;
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.splitPrimitive = split;
  arguments.userPtr = const_cast<Triangles*>(&triangles);
  const auto* const root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
  if (const RTCError error = rtcGetDeviceError(device.get()); !root || error != RTC_ERROR_NONE)
    fail("Embree failed to build a hierarchy for beams (error {})", static_cast<int>(error));
  Hierarchy all;
  all.root = lay_out(*root, whole, 0, all);
  all.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return all;
}

}  // namespace izb::reference
