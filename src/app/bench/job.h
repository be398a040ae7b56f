// SPDX-License-Identifier: MIT
// A job of the research harness: one scene, measured in a process of its own for one part of one experiment.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/frame_options.h"

namespace izb::bench {

/// What a job measures: a file, and the frame's options (camera, viewpoint, light) by name.
struct BenchScene {
  std::string name;
  std::string file;
  std::string procedural;  ///< the procedural scene that the file holds; empty: somebody's file
  int triangles = 0;       ///< asked of a procedural scene, 0: its own number
  std::string sha256;      ///< of somebody's file, so that a result is known to be of it
  std::map<std::string, std::string> frame;
};

/// A technique with options that differ from its defaults, under the name that the tables give it.
struct Configuration {
  std::string name;
  std::string technique = "izb";
  std::string preset;
  std::string size;  ///< empty: the job's
  std::map<std::string, std::string> options;
  nlohmann::json notes = nlohmann::json::object();  ///< for the tables: "paper" and the like

  /// "izb --spp 1": technique, preset and options as the command line takes them.
  std::string command_line() const;
};

struct Job {
  std::string experiment, part, measure;
  BenchScene scene;
  std::string size;
  std::string context = "auto";
  int frames = 1;
  std::vector<Configuration> configurations;
  nlohmann::json settings = nlohmann::json::object();  ///< of the measure
};

nlohmann::json to_json(const Job& job);
/// Throws nlohmann::json::exception where `json` was not made by to_json().
Job job_from(const nlohmann::json& json);

/// Whether they measure the same, wherever the scene's file lies.
bool same_work(Job a, Job b);

/// A name as a part of a file's: letters, digits, '_', '-' and what is not ASCII. Where more had to go, or it is long,
/// it ends with a digest, so that two names never become one.
std::string file_word(const std::string& name);

/// The options of the job's frame. Throws izb::UsageError for an option that there is not.
FrameOptions frame_options(const Job& job);
/// The technique with its options. Throws izb::UsageError likewise.
std::unique_ptr<Technique> make_technique(const Configuration& configuration);

}  // namespace izb::bench
