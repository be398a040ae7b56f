// SPDX-License-Identifier: MIT
#include "view/truth_job.h"

#include <algorithm>

#include "base/error.h"
#include "reference/embree.h"

namespace izb {
namespace {

constexpr size_t pixels_a_step = 16384;  // some tens of milliseconds of 32 rays each, on two cores

template <typename T>
std::vector<T> part_of(const std::vector<T>& all, size_t first, size_t end) {
  return all.empty() ? all : std::vector<T>(all.begin() + ptrdiff_t(first), all.begin() + ptrdiff_t(end));
}

reference::Receivers part_of(const reference::Receivers& all, size_t first, size_t end) {
  reference::Receivers part;
  part.points_vs = part_of(all.points_vs, first, end);
  part.own_triangle = part_of(all.own_triangle, first, end);
  part.classes = part_of(all.classes, first, end);
  part.band = part_of(all.band, first, end);
  part.width_px = all.width_px;
  part.offsets_px = all.offsets_px;
  part.camera = all.camera;
  part.centers_vs = part_of(all.centers_vs, first, end);
  part.slopes = part_of(all.slopes, first, end);
  return part;
}

}  // namespace

void TruthJob::start(TruthTask task) {
  cancel();
  cancelled_ = false;
  progress_ = 0.0f;
  thread_ = std::thread([this, given = std::move(task)] { work(given); });
}

void TruthJob::cancel() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

void TruthJob::work(const TruthTask& task) {
  TracedTruth traced{task.serial, {}, {}};
  try {
    // One core is left to the interface.
    const unsigned threads = std::max(2u, std::thread::hardware_concurrency()) - 1;
    const reference::RayTracer tracer(task.triangles, reference::BuildQuality::medium, threads);
    size_t all = 0, done = 0;
    for (const reference::Receivers& r : task.receivers) all += r.count();
    for (size_t light = 0; light < task.lights.size(); ++light) {
      const reference::Receivers& receivers = task.receivers[light];
      const size_t row = size_t(std::max(receivers.width_px, 1)), step = std::max(pixels_a_step / row, size_t(1)) * row;
      std::vector<uint32_t>& mask = traced.masks.emplace_back();
      for (size_t first = 0; first < receivers.count(); first += step) {
        if (cancelled_) return;
        const size_t end = std::min(first + step, receivers.count());
        const auto part = tracer.trace_mask(task.lights[light], part_of(receivers, first, end)).mask;
        mask.insert(mask.end(), part.begin(), part.end());
        done += end - first;
        progress_ = float(done) / float(all);
      }
    }
  } catch (const Error& e) {
    traced.masks.clear();
    traced.error = e.what();
  } catch (const std::bad_alloc&) {
    traced.masks.clear();
    traced.error = "not enough memory for the ray tracer";
  } catch (const std::exception& e) {  // a bug: the viewer goes on
    traced.masks.clear();
    traced.error = fmt::format("unexpected failure of the ray tracer: {}", e.what());
  }
  if (!cancelled_) done_(std::move(traced));
}

}  // namespace izb
