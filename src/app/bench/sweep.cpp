// SPDX-License-Identifier: MIT
#include "app/bench/sweep.h"

#include <algorithm>
#include <cstdlib>

#include "app/bench/scene_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/shipped.h"
#include "base/version.h"
#include "scene/procedural.h"

namespace izb::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const Procedural* find_procedural(const std::string& name) {
  const auto all = procedurals();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Procedural& p) { return name == p.name; });
  return it == all.end() ? nullptr : &*it;
}

bool is_scene_file(const fs::path& path) {
  return path.extension() == ".glb" || path.extension() == ".gltf";
}

std::vector<fs::path> scene_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error, ignored;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file(ignored) && is_scene_file(at->path())) files.push_back(at->path());
  if (error) fail("cannot read the folder '{}': {}", folder.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

/// A value of a sweep: itself, or one for each extent; of a missing one, the next smaller's.
json value_for(const json& part, const std::string& key, Extent extent, const json& otherwise) {
  if (!part.contains(key)) return otherwise;
  const json& value = part[key];
  if (!value.is_object()) return value;
  for (const char* name : {"complete", "full", "quick"}) {
    if (name == std::string("complete") && extent != Extent::complete) continue;
    if (name == std::string("full") && extent == Extent::quick) continue;
    if (value.contains(name)) return value[name];
  }
  return otherwise;
}

/// Results, tables and pictures go by the names: a file whose name is taken has its folder's before its own, and what
/// is there twice is there once.
void make_names_unique(std::vector<BenchScene>& scenes) {
  std::vector<BenchScene> unique;
  const auto with_name = [&](const std::string& name) {
    return std::find_if(unique.begin(), unique.end(), [&](const BenchScene& s) { return s.name == name; });
  };
  for (BenchScene& scene : scenes) {
    const auto same =
        std::find_if(unique.begin(), unique.end(), [&](const BenchScene& s) { return s.file == scene.file; });
    if (same != unique.end()) continue;
    if (with_name(scene.name) != unique.end()) {
      const fs::path path = scene.file;
      const std::string longer = (path.parent_path().filename() / path.filename()).string();
      scene.name = longer;
      for (int n = 2; with_name(scene.name) != unique.end(); ++n) scene.name = fmt::format("{} ({})", longer, n);
    }
    unique.push_back(std::move(scene));
  }
  scenes = std::move(unique);
}

class Planner {
 public:
  Planner(const json& views, const SweepRequest& request, const fs::path& folder)
      : request_(request), folder_(folder.empty() ? folder : fs::absolute(folder)), views_(views) {}

  void add(std::vector<Job>& jobs, const std::string& experiment, const json& part) {
    const int triangles = value_for(part, "triangles", request_.extent, 0).get<int>();
    std::vector<BenchScene> scenes;
    for (const std::string& word : request_.scenes) add_scenes(scenes, word, triangles);
    if (request_.scenes.empty())
      for (const json& word : value_for(part, "scenes", request_.extent, json::array()))
        add_scenes(scenes, word.get<std::string>(), triangles);
    // Files after what the sweeps name, so that the latter keep their names.
    std::stable_partition(scenes.begin(), scenes.end(), [](const BenchScene& s) { return !s.procedural.empty(); });
    make_names_unique(scenes);
    for (BenchScene& scene : scenes) {
      if (!scene.procedural.empty() && part.contains("procedural_frame"))
        for (const auto& [option, value] : part["procedural_frame"].items()) scene.frame[option] = value;
      if (scene.procedural.empty() && part.at("measure") == "animation" && files_.at(scene.file).animated)
        scene.frame["time"] = "0", scene.frame["loop"] = "on";
      add_jobs(jobs, experiment, part, scene);
    }
  }

 private:
  void add_jobs(std::vector<Job>& jobs, const std::string& experiment, const json& part, const BenchScene& scene) {
    Job job;
    job.experiment = experiment;
    job.part = part.value("part", "");
    job.measure = part.at("measure");
    job.scene = scene;
    job.context = request_.context;
    job.size =
        request_.size.empty() ? value_for(part, "size", request_.extent, "1280x720").get<std::string>() : request_.size;
    job.frames = request_.frames > 0 ? request_.frames : value_for(part, "frames", request_.extent, 3).get<int>();
    // A change takes two.
    if (job.measure == "temporal") job.frames = std::max(job.frames, 2);
    const json settings = part.value("settings", json::object());
    for (const auto& setting : settings.items())
      job.settings[setting.key()] = value_for(settings, setting.key(), request_.extent, nullptr);
    for (const json& c : value_for(part, "configurations", request_.extent, json::array())) {
      Configuration configuration{c.at("name"),
                                  c.value("technique", "izb"),
                                  c.value("preset", ""),
                                  c.value("size", ""),
                                  c.value("options", std::map<std::string, std::string>()),
                                  c.value("notes", json::object())};
      job.configurations.push_back(std::move(configuration));
    }
    if (!job.settings.value("process_each", false)) {
      jobs.push_back(std::move(job));
      return;
    }
    for (const Configuration& one : job.configurations) {
      jobs.push_back(job);
      jobs.back().configurations = {one};
    }
  }

  /// `word`: a procedural scene, whatever lies in the working directory; a file or a folder; "files".
  void add_scenes(std::vector<BenchScene>& scenes, const std::string& word, int triangles) {
    if (find_procedural(word)) {
      scenes.push_back(procedural_scene(word, triangles));
      return;
    }
    if (word == "files") {
      if (const char* folder = std::getenv("IZB_SCENES"))
        for (const fs::path& file : scene_files(folder)) scenes.push_back(file_scene(file));
      return;
    }
    std::error_code ignored;
    if (fs::is_directory(word, ignored)) {
      const std::vector<fs::path> files = scene_files(word);
      if (files.empty()) throw UsageError(fmt::format("the folder '{}' holds no .glb and no .gltf", word));
      for (const fs::path& file : files) scenes.push_back(file_scene(file));
      return;
    }
    if (fs::exists(word, ignored)) {
      scenes.push_back(file_scene(word));
      return;
    }
    if (const char* folder = std::getenv("IZB_SCENES"))
      for (const char* extension : {".glb", ".gltf"})
        if (const fs::path file = fs::path(folder) / (word + extension); fs::exists(file, ignored)) {
          scenes.push_back(file_scene(file));
          return;
        }
    throw UsageError(fmt::format("'{}' is no file, no folder and no procedural scene", word));
  }

  BenchScene procedural_scene(const std::string& name, int triangles) const {
    const Procedural& p = *find_procedural(name);
    // Fewer than its own, to be quick; never more than it is known by.
    if (!p.any_triangles || size_t(triangles) >= p.triangles) triangles = 0;
    BenchScene scene;
    scene.name = scene.procedural = name;
    scene.triangles = triangles;
    // Another commit may make another scene of the same name.
    scene.file = (folder_ / "scenes" / fmt::format("{}-{}-{}.glb", name, triangles, commit())).string();
    scene.frame["camera"] = "main";
    return scene;
  }

  BenchScene file_scene(const fs::path& path) {
    BenchScene scene;
    scene.name = path.stem().string();
    scene.file = fs::absolute(path).lexically_normal().string();
    auto known = files_.find(scene.file);
    if (known == files_.end()) known = files_.emplace(scene.file, known_of(scene.file)).first;
    scene.sha256 = known->second.sha256;
    if (views_.contains(scene.name)) scene.frame["viewpoint"] = scene.name;
    return scene;
  }

  /// One that cannot be read is a row that says so, not the end of the others.
  static SceneFile known_of(const fs::path& path) {
    try {
      return look_into(path);
    } catch (const Error&) {
      return {};
    }
  }

  const SweepRequest& request_;
  fs::path folder_;
  const json& views_;
  std::map<std::string, SceneFile> files_;  ///< that are read already
};

json parts_of(const json& experiment) {
  return experiment.is_array() ? experiment : json::array({experiment});
}

}  // namespace

json read_bench_data(const std::string& name) {
  const fs::path found = shipped_path(name, "bench/" + name);
  const std::string text = read_text_file(found);
  try {
    return json::parse(text);
  } catch (const json::exception& e) {
    fail("'{}' is not the JSON that it should be: {}", found.string(), e.what());
  }
}

std::vector<Job> plan(const json& sweeps, const json& views, const SweepRequest& request, const fs::path& folder) {
  const auto wanted = [&](const char* name) {
    const auto& list = request.experiments;
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  };
  Planner planner(views, request, folder);
  std::vector<Job> jobs;
  for (const char* name : experiment_names)
    if (wanted(name))
      for (const json& part : parts_of(sweeps.at(name))) planner.add(jobs, name, part);
  return jobs;
}

}  // namespace izb::bench
