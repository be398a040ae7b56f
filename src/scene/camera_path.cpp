// SPDX-License-Identifier: MIT
#include "scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "scene/view.h"

namespace izb {
namespace {

using nlohmann::json;

/// Everything of a key that is interpolated.
using Values = std::array<double, 7>;

Values values_of(const CameraPath::Key& key) {
  return {key.eye_ws.x, key.eye_ws.y, key.eye_ws.z, key.target_ws.x, key.target_ws.y, key.target_ws.z, key.yfov_deg};
}

/// At key k, in units a second.
Values tangent(const std::vector<CameraPath::Key>& keys, size_t k) {
  Values out{};
  if (keys.size() < 2) return out;
  const auto slope = [&](size_t a, size_t i) {
    return (values_of(keys[a + 1])[i] - values_of(keys[a])[i]) / (keys[a + 1].time_s - keys[a].time_s);
  };
  for (size_t i = 0; i < out.size(); ++i) {
    if (k == 0) {
      out[i] = slope(0, i);
    } else if (k + 1 == keys.size()) {
      out[i] = slope(k - 1, i);
    } else {
      const double before_s = keys[k].time_s - keys[k - 1].time_s, after_s = keys[k + 1].time_s - keys[k].time_s;
      out[i] = (slope(k - 1, i) * after_s + slope(k, i) * before_s) / (before_s + after_s);
    }
  }
  return out;
}

Camera camera_of(const Values& v) {
  const double yfov_deg = std::clamp(v[6], 0.1, 170.0);  // splines overshoot
  return look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, glm::radians(yfov_deg));
}

double number(const json& value, const std::string& where, const char* what) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) fail("{}: '{}' is not a number", where, what);
  return value.get<double>();
}

glm::dvec3 vector(const json& key, const char* name, const std::string& where) {
  if (!key.contains(name) || !key[name].is_array() || key[name].size() != 3)
    fail("{}: '{}' is not an array of 3 numbers", where, name);
  return {number(key[name][0], where, name), number(key[name][1], where, name), number(key[name][2], where, name)};
}

CameraPath::Key read_key(const json& entry, const std::string& where, double yfov_deg) {
  if (!entry.is_object()) fail("{} is not an object", where);
  CameraPath::Key key;
  key.time_s = number(entry.value("time", json()), where, "time");
  key.eye_ws = vector(entry, "eye", where);
  key.target_ws = vector(entry, "target", where);
  if (key.eye_ws == key.target_ws) fail("{}: 'eye' and 'target' are the same point", where);
  key.yfov_deg = entry.contains("fov") ? number(entry["fov"], where, "fov") : yfov_deg;
  if (!(key.yfov_deg >= 0.1 && key.yfov_deg <= 170.0)) fail("{}: 'fov' is not between 0.1 and 170 degrees", where);
  return key;
}

}  // namespace

Camera CameraPath::at(double time_s) const {
  if (time_s <= keys.front().time_s) return camera_of(values_of(keys.front()));
  if (time_s >= keys.back().time_s) return camera_of(values_of(keys.back()));
  const auto next =
      std::upper_bound(keys.begin(), keys.end(), time_s, [](double t, const Key& key) { return t < key.time_s; });
  const size_t k = static_cast<size_t>(next - keys.begin()) - 1;
  const double length_s = keys[k + 1].time_s - keys[k].time_s, u = (time_s - keys[k].time_s) / length_s;
  const double u2 = u * u, u3 = u2 * u;
  const Values a = values_of(keys[k]), b = values_of(keys[k + 1]);
  const Values leaving = tangent(keys, k), arriving = tangent(keys, k + 1);
  Values v;
  for (size_t i = 0; i < v.size(); ++i)
    v[i] = (2 * u3 - 3 * u2 + 1) * a[i] + length_s * (u3 - 2 * u2 + u) * leaving[i] + (3 * u2 - 2 * u3) * b[i] +
           length_s * (u3 - u2) * arriving[i];
  return camera_of(v);
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  json document;
  try {
    document = json::parse(read_text_file(file));
  } catch (const json::exception& e) {
    fail("cannot read the camera path '{}': it is no JSON: {}", file.string(), e.what());
  }
  const std::string name = fmt::format("the camera path '{}'", file.string());
  if (!document.is_object() || !document.contains("keys") || !document["keys"].is_array() || document["keys"].empty())
    fail("{} has no array 'keys' with at least one key", name);
  CameraPath path;
  for (const json& entry : document["keys"]) {
    const std::string where = fmt::format("{}, key {}", name, path.keys.size());
    const double yfov_deg = path.keys.empty() ? 45.0 : path.keys.back().yfov_deg;
    path.keys.push_back(read_key(entry, where, yfov_deg));
    if (const size_t n = path.keys.size(); n > 1 && !(path.keys[n - 1].time_s > path.keys[n - 2].time_s))
      fail("{}: its time is not after that of the key before", where);
  }
  return path;
}

}  // namespace izb
