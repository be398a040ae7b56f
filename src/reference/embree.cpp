// SPDX-License-Identifier: MIT
#include "reference/embree.h"

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>
#include <string>

#include "base/error.h"
#include "reference/exact.h"
#include "reference/parallel.h"

#if IZB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace izb::reference {
namespace {

constexpr int packet = 16;
// Packets cover tiles of pixels where the rows are known: less far apart than 16 pixels of a row.
constexpr size_t packet_width = 8, packet_height = 2;
constexpr size_t rays_per_chunk = 4096;
constexpr float infinity = std::numeric_limits<float>::infinity();

// What the filters below need beside the ray. Embree hands back the pointer to its context: it comes first.
struct Query {
#if IZB_EMBREE_MAJOR >= 4
  RTCRayQueryContext context;
#else
  RTCIntersectContext context;
#endif
  const Receivers* receivers = nullptr;  // shadow rays: of which each has its place as the ray's id
  const uint8_t* holding = nullptr;      // shadow rays: of each triangle whether its plane holds the light; or null
  const Cutouts* cutouts = nullptr;      // what holes the triangles have, or null
  const glm::vec3* vertices = nullptr;   // of all triangles
  // all_hits(): takes every hit as the ray's id and a triangle, and lets the ray go on
  std::vector<std::pair<uint32_t, uint32_t>>* all_hits = nullptr;

  explicit Query(bool coherent) {
#if IZB_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    (void)coherent;
#else
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
  }
};

// Whether the ray passes through a hole of the triangle, by doubles from its vertices: the hit's own are too coarse.
bool passes_hole(const Query& query, const RTCFilterFunctionNArguments* args, unsigned i, unsigned triangle) {
  if (!query.cutouts || !query.cutouts->masked(triangle)) return false;
  const glm::dvec3 origin(RTCRayN_org_x(args->ray, args->N, i), RTCRayN_org_y(args->ray, args->N, i),
                          RTCRayN_org_z(args->ray, args->N, i));
  const glm::dvec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                             RTCRayN_dir_z(args->ray, args->N, i));
  const glm::vec3* v = query.vertices + 3 * size_t(triangle);
  return !query.cutouts->there(triangle, {v[0], v[1], v[2]}, origin, direction);
}

// A filter costs less than the noise of measuring it (it runs once a hit), and no offset along the ray would
// do: at grazing light a point's own triangle is met arbitrarily far away.
void skip_what_casts_nothing(const RTCFilterFunctionNArguments* args) {
  const auto* query = reinterpret_cast<const Query*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;  // lanes that are off hold no id
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    if (query->receivers->spared(RTCRayN_id(args->ray, args->N, i)) == triangle ||
        (query->holding && query->holding[triangle]) || passes_hole(*query, args, i, triangle))
      args->valid[i] = 0;
  }
}

void collect_all(const RTCFilterFunctionNArguments* args) {
  const auto* query = reinterpret_cast<const Query*>(args->context);
  auto* all = query->all_hits;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (!all) {
      if (passes_hole(*query, args, i, RTCHitN_primID(args->hit, args->N, i))) args->valid[i] = 0;
      continue;
    }
    all->emplace_back(RTCRayN_id(args->ray, args->N, i), RTCHitN_primID(args->hit, args->N, i));
    args->valid[i] = 0;
  }
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays, Query& query) {
#if IZB_EMBREE_MAJOR >= 4
  RTCOccludedArguments args;
  rtcInitOccludedArguments(&args);
  args.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  args.context = &query.context;
  rtcOccluded16(valid, scene, &rays, &args);
#else
  rtcOccluded16(valid, scene, &query.context, &rays);
#endif
}

void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays, Query& query) {
#if IZB_EMBREE_MAJOR >= 4
  RTCIntersectArguments args;
  rtcInitIntersectArguments(&args);
  args.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  args.context = &query.context;
  rtcIntersect16(valid, scene, &rays, &args);
#else
  rtcIntersect16(valid, scene, &query.context, &rays);
#endif
}

RTCBuildQuality embree_quality(BuildQuality quality) {
  switch (quality) {
    case BuildQuality::low:
      return RTC_BUILD_QUALITY_LOW;
    case BuildQuality::medium:
      return RTC_BUILD_QUALITY_MEDIUM;
    case BuildQuality::high:
      return RTC_BUILD_QUALITY_HIGH;
  }
  fail("unknown Embree build quality {}", static_cast<int>(quality));
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

float largest(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Points are rounded to float, so they lie up to an ulp of their largest coordinate off their surface: a ray
// starts 8 such ulps away, or it would meet the neighbours and coplanar duplicates of its own triangle. An
// occluder within that distance is lost to the ray; it is far less than the band (1/64 pixel: some 100 ulps).
float start_distance(const glm::vec3& point) {
  return 8.0f * largest(point) * 0x1p-23f;
}

// Camera rays of one packet, from the first on.
struct CameraPacket {
  RTCRayHit16 rays;
  alignas(64) int valid[packet];

  // Lanes from `end` on are off and repeat the last ray.
  void load(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, size_t first, size_t end,
            float t_near) {
    for (int lane = 0; lane < packet; ++lane) {
      const size_t i = first + static_cast<size_t>(lane), ray = std::min(i, end - 1);
      valid[lane] = i < end ? -1 : 0;
      const glm::vec3 o = origins[origins.size() == 1 ? 0 : ray], d = directions[ray];
      rays.ray.org_x[lane] = o.x, rays.ray.org_y[lane] = o.y, rays.ray.org_z[lane] = o.z;
      rays.ray.dir_x[lane] = d.x, rays.ray.dir_y[lane] = d.y, rays.ray.dir_z[lane] = d.z;
      rays.ray.tnear[lane] = t_near;
      rays.ray.time[lane] = 0.0f, rays.ray.mask[lane] = 0xFFFFFFFFu, rays.ray.flags[lane] = 0;
      rays.ray.id[lane] = static_cast<unsigned>(i);
      rays.hit.geomID[lane] = rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }
};

// Collects samples of receivers until 16 rays are full. Packets hold receivers only, whatever lies between them.
class ShadowPacket {
 public:
  ShadowPacket(RTCScene scene, const LightPoint& light, const Query& query, const Receivers& receivers,
               std::vector<uint32_t>& mask)
      : scene_(scene), light_(light), receivers_(receivers), mask_(mask), query_(query) {
    for (int lane = 0; lane < packet; ++lane)
      ray_.time[lane] = 0.0f, ray_.mask[lane] = 0xFFFFFFFFu, ray_.flags[lane] = 0;
  }

  // The receivers among [begin, end).
  void add(size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      if (receivers_.classes[i] == PixelClass::receiver) add(i);
  }

  // Traces what is left; returns the number of rays of all packets.
  uint64_t finish() {
    if (lanes_) flush();
    return traced_;
  }

 private:
  void add(size_t i) {
    const MicroQuad quad = receivers_.quad(i);
    for (int s = 0; s < receivers_.sample_count(); ++s)
      add(i, glm::vec3(quad.at(receivers_.offsets_px[static_cast<size_t>(s)])), receivers_.word_of(s));
  }

  void add(size_t i, const glm::vec3& p, uint32_t word) {
    const glm::vec3 d = light_.positional ? light_.xyz_vs - p : light_.xyz_vs;
    ray_.org_x[lanes_] = p.x, ray_.org_y[lanes_] = p.y, ray_.org_z[lanes_] = p.z;
    ray_.dir_x[lanes_] = d.x, ray_.dir_y[lanes_] = d.y, ray_.dir_z[lanes_] = d.z;
    // Distances are in units of the direction; the largest coordinate stands for its length (within sqrt(3)).
    ray_.tnear[lanes_] = start_distance(p) / largest(d);
    ray_.tfar[lanes_] = light_.positional ? 1.0f - 0x1p-24f : infinity;  // strictly before the light
    ray_.id[lanes_] = static_cast<unsigned>(i);
    word_[lanes_] = word;
    if (++lanes_ == packet) flush();
  }

  void flush() {
    alignas(64) int valid[packet];
    for (int lane = 0; lane < packet; ++lane) valid[lane] = lane < lanes_ ? -1 : 0;
    // Without 16-wide instructions Embree looks at the rays of lanes that are off, too: empty ones.
    for (int lane = lanes_; lane < packet; ++lane) {
      ray_.org_x[lane] = ray_.org_x[0], ray_.org_y[lane] = ray_.org_y[0], ray_.org_z[lane] = ray_.org_z[0];
      ray_.dir_x[lane] = ray_.dir_x[0], ray_.dir_y[lane] = ray_.dir_y[0], ray_.dir_z[lane] = ray_.dir_z[0];
      ray_.tnear[lane] = infinity, ray_.tfar[lane] = -infinity, ray_.id[lane] = ray_.id[0];
    }
    occluded(valid, scene_, ray_, query_);
    for (int lane = 0; lane < lanes_; ++lane)
      if (ray_.tfar[lane] < 0.0f) mask_[ray_.id[lane]] |= word_[lane];  // Embree: -infinity where occluded
    traced_ += static_cast<uint64_t>(lanes_);
    lanes_ = 0;
  }

  RTCScene scene_;
  const LightPoint& light_;
  const Receivers& receivers_;
  std::vector<uint32_t>& mask_;
  Query query_;
  RTCRay16 ray_;
  uint32_t word_[packet];  // what each ray sets in its receiver's mask word
  int lanes_ = 0;
  uint64_t traced_ = 0;
};

}  // namespace

bool embree_available() {
  return true;
}

const char* embree_version() {
  return "Embree " RTC_VERSION_STRING;
}

struct RayTracer::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  unsigned threads = 0;
  size_t triangle_count = 0;
  double build_ms = 0.0;
  std::shared_ptr<const Cutouts> cutouts;

  ~State() {
    if (geometry) rtcReleaseGeometry(geometry);
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  const glm::vec3* vertices() const {
    return static_cast<const glm::vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
  }

  Query query() const {
    Query query(true);
    query.cutouts = cutouts.get();
    query.vertices = vertices();
    return query;
  }

  using Holding = std::shared_ptr<const std::vector<uint8_t>>;
  // Of the last lights that were asked for: a frame with several asks for each in turn.
  struct Held {
    LightPoint light;
    Holding triangles;
  };
  static constexpr size_t most_held = 8;
  mutable std::vector<Held> held;
  mutable std::mutex held_guard;

  // Of each triangle whether its plane holds the light; null if none does.
  Holding triangles_that_hold(const LightPoint& light) const {
    if (!light.positional) return {};
    const std::scoped_lock lock(held_guard);
    for (const Held& known : held)
      if (known.light.xyz_vs == light.xyz_vs && known.light.band == light.band) return known.triangles;
    if (held.size() == most_held) held.erase(held.begin());
    return held.emplace_back(Held{light, find_triangles_that_hold(light)}).triangles;
  }

  Holding find_triangles_that_hold(const LightPoint& light) const {
    const glm::vec3* const vertices = this->vertices();
    std::vector<uint8_t> holding(triangle_count);
    std::atomic<bool> any{false};
    parallel_for(triangle_count, rays_per_chunk, threads, [&](size_t begin, size_t end, unsigned) {
      for (size_t t = begin; t < end; ++t)
        if (holds_light({vertices[3 * t], vertices[3 * t + 1], vertices[3 * t + 2]}, light)) holding[t] = 1, any = true;
    });
    return any ? std::make_shared<const std::vector<uint8_t>>(std::move(holding)) : nullptr;
  }

  void check(const char* what) const {
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
      fail("Embree failed to {} (error {})", what, static_cast<int>(error));
  }
};

RayTracer::RayTracer(const Triangles& triangles, BuildQuality quality, unsigned threads)
    : state_(std::make_unique<State>()) {
  const size_t count = triangles.count();
  if (count == 0) fail("cannot trace rays: the frame has no triangle");
  if (triangles.positions_vs.size() % 3 != 0 || count >= no_triangle / 3)
    fail("cannot trace rays: {} vertices are not a list of fewer than 2^32 / 3 triangles",
         triangles.positions_vs.size());
  State& s = *state_;
  s.threads = thread_count(threads);
  s.triangle_count = count;
  s.cutouts = triangles.cutouts;
  s.device = rtcNewDevice(("threads=" + std::to_string(s.threads)).c_str());
  if (!s.device) fail("Embree cannot make a device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  s.scene = rtcNewScene(s.device);
  s.geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes at each vertex, so it gets buffers of its own, which it pads.
  auto* vertices = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(s.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(s.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), count));
  if (!vertices || !indices) fail("Embree has no memory for {} triangles", count);
  std::copy(triangles.positions_vs.begin(), triangles.positions_vs.end(), vertices);
  for (size_t i = 0; i < 3 * count; ++i) indices[i] = static_cast<uint32_t>(i);
  rtcSetGeometryOccludedFilterFunction(s.geometry, skip_what_casts_nothing);
  rtcSetGeometryIntersectFilterFunction(s.geometry, collect_all);
  rtcAttachGeometry(s.scene, s.geometry);
  rebuild(quality);
}

RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;

double RayTracer::build_ms() const {
  return state_->build_ms;
}

double RayTracer::rebuild(BuildQuality quality) {
  State& s = *state_;
  // Robust: no ray slips between triangles that share an edge. Low is Embree's builder for dynamic scenes.
  int flags = RTC_SCENE_FLAG_ROBUST;
  if (quality == BuildQuality::low) flags |= RTC_SCENE_FLAG_DYNAMIC;
  rtcSetSceneFlags(s.scene, static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(s.scene, embree_quality(quality));
  rtcSetGeometryBuildQuality(s.geometry, embree_quality(quality));
  rtcUpdateGeometryBuffer(s.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(s.geometry);
  const auto start = std::chrono::steady_clock::now();
  rtcCommitScene(s.scene);
  s.build_ms = ms_since(start);
  s.check("build its hierarchy");
  return s.build_ms;
}

MaskTrace RayTracer::trace_mask(const LightPoint& light, const Receivers& receivers) const {
  const State& s = *state_;
  receivers.check("trace a mask");
  const size_t count = receivers.count();
  const size_t width = static_cast<size_t>(std::max(receivers.width_px, 0));
  if (width != 0 && count % width != 0) fail("cannot trace a mask: {} points do not fill rows of {}", count, width);
  MaskTrace result;
  result.mask.resize(count);
  const State::Holding holding = s.triangles_that_hold(light);
  Query query = s.query();
  query.receivers = &receivers;
  query.holding = holding ? holding->data() : nullptr;
  std::atomic<uint64_t> rays{0};
  const auto start = std::chrono::steady_clock::now();
  if (width == 0) {
    parallel_for(count, rays_per_chunk, s.threads, [&](size_t begin, size_t end, unsigned) {
      ShadowPacket packets(s.scene, light, query, receivers, result.mask);
      packets.add(begin, end);
      rays += packets.finish();
    });
  } else {
    parallel_for(count / width, packet_height, s.threads, [&](size_t first_row, size_t end_row, unsigned) {
      ShadowPacket packets(s.scene, light, query, receivers, result.mask);
      for (size_t left = 0; left < width; left += packet_width)
        for (size_t row = first_row; row < end_row; ++row)
          packets.add(row * width + left, row * width + std::min(left + packet_width, width));
      rays += packets.finish();
    });
  }
  result.trace_ms = ms_since(start);
  result.rays = rays;
  s.check("trace shadow rays");
  return result;
}

PrimaryHits RayTracer::primary_hits(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                                    float t_near, float t_far) const {
  const State& s = *state_;
  const size_t count = directions.size();
  if (origins.size() != 1 && origins.size() != count)
    fail("cannot trace camera rays: {} directions come with {} origins", count, origins.size());
  PrimaryHits hits;
  hits.triangle.resize(count, no_triangle);
  hits.t.resize(count, infinity);
  parallel_for(count, rays_per_chunk, s.threads, [&](size_t begin, size_t end, unsigned) {
    Query query = s.query();
    CameraPacket p;
    for (size_t first = begin; first < end; first += packet) {
      p.load(origins, directions, first, end, t_near);
      std::fill_n(p.rays.ray.tfar, packet, t_far);
      intersect(p.valid, s.scene, p.rays, query);
      for (size_t i = first; i < std::min(first + packet, end); ++i) {
        const size_t lane = i - first;
        if (p.rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
        hits.triangle[i] = p.rays.hit.primID[lane];
        hits.t[i] = p.rays.ray.tfar[lane];
      }
    }
  });
  s.check("trace camera rays");
  return hits;
}

AllHits RayTracer::all_hits(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, float t_near,
                            std::span<const float> t_far) const {
  const size_t count = directions.size();
  if (origins.size() != count || t_far.size() != count)
    fail("cannot trace camera rays: {} directions come with {} origins and {} ends", count, origins.size(),
         t_far.size());
  std::vector<std::pair<uint32_t, uint32_t>> found;
  Query query(true);
  query.all_hits = &found;
  CameraPacket p;
  for (size_t first = 0; first < count; first += packet) {
    p.load(origins, directions, first, count, t_near);
    for (size_t lane = 0; lane < packet; ++lane) p.rays.ray.tfar[lane] = t_far[std::min(first + lane, count - 1)];
    intersect(p.valid, state_->scene, p.rays, query);
  }
  state_->check("trace camera rays");
  // A hierarchy with spatial splits may offer one triangle several times.
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  AllHits hits;
  for (const auto& [ray, triangle] : found) {
    hits.first.resize(std::max<size_t>(hits.first.size(), ray + 1), hits.triangles.size());
    hits.triangles.push_back(triangle);
  }
  hits.first.resize(count + 1, hits.triangles.size());
  return hits;
}

}  // namespace izb::reference
